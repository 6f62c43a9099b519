"""What the stiffness of loaded contact changes of statements H9 to H21 of He et al. 2007."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from docs.helical.cases import HE, HIGH, LOW, at_orders, density, with_helix
from docs.helical.loaded import COARSE, table_of_torques
from docs.helical.stiffness_density import table_density
from docs.helical.structure import TRANSVERSE
from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    linear_system,
    natural_frequencies,
)
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    PeriodicResponse,
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.parameters import Form, HelicalPairParameters
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE, he_2007_pair

ANGLES = (0.0, 5.0, 10.0, 15.0, math.degrees(HE.helix_angle), 25.0, 30.0)  # deg
_FRICTION = (0.1, 0.15, 0.2, 0.25, 0.3)


@dataclass(frozen=True, slots=True)
class Stiffness:
    """The pair with one kind of mesh stiffness, for any helix angle [deg]."""

    mesh_at: Callable[[float], LineMesh]

    def parameters(self, mu: float, angle: float) -> HelicalPairParameters:
        """Return the pair with a constant coefficient of friction."""
        pair = HE if angle == ANGLES[4] else with_helix(math.radians(angle))
        return replace(he_2007_pair(mu, pair), mesh=self.mesh_at(angle))

    def response(
        self, mu: float, *, angle: float = ANGLES[4], form: Form = "twelve_dof"
    ) -> PeriodicResponse:
        """Return the steady vibration at 1000 rpm."""
        return periodic_response(replace(self.parameters(mu, angle), form=form), PINION_SPEED)


def one_density() -> Stiffness:
    """Return the stiffness of He et al. 2007, eq. (2): ISO 6336-1, the same at every angle."""

    def mesh(angle: float) -> LineMesh:
        pair = HE if angle == ANGLES[4] else with_helix(math.radians(angle))
        return constant_density_mesh(pair, density(), "He et al. 2007 eq. (2)")

    return Stiffness(mesh)


def loaded_contact(store: Path) -> Stiffness:
    """Return the stiffness of loaded contact with elastic teeth; coarser ones off 21.5 degrees."""
    meshes = {
        angle: named_line_mesh("he_2007")
        if angle == ANGLES[4]
        else table_of_torques(with_helix(math.radians(angle)), COARSE, store)
        for angle in ANGLES
    }
    return Stiffness(meshes.__getitem__)


def column(stiffness: Stiffness) -> list[str]:
    """Return what was found with one stiffness, in the order of the table."""
    low, high = stiffness.response(LOW), stiffness.response(HIGH)

    def growth(name: str) -> np.ndarray:
        return np.asarray(harmonics(high.signal(name)) / harmonics(low.signal(name)))

    y = np.concatenate([growth("u_yp"), growth("u_yg")])
    x, z, delta = growth("u_xp"), growth("u_zp"), growth("delta_z")
    off, axial = at_orders(x, *range(7, 16)), at_orders(z, 7, 8, 9)
    orders = natural_frequencies(linear_system(stiffness.parameters(0.0, ANGLES[4])))
    orders = orders * low.period / (2.0 * np.pi)
    inside = int(((orders > 8.0) & (orders < 10.0)).sum())
    size = harmonics(high.signal("delta_z"))
    swing = [1e6 * float(np.ptp(r.signal("delta_z"))) for r in (low, high)]
    k = table_density(stiffness.mesh_at(ANGLES[4]), PINION_TORQUE)
    return [
        f"{1e-9 * k:.2f}",
        f"{swing[0]:.2f} / {swing[1]:.2f}",
        f"{y.min():.1f} to {y.max():.1f} times",
        f"{x[0]:.1f}, {x[1]:.1f} / {x[2]:.2f} / {off.min():.2f} to {off.max():.2f}",
        ", ".join(f"{v:.2f}" for v in axial),
        str(inside),
        _over_spur(stiffness, LOW),
        _over_spur(stiffness, HIGH),
        " / ".join(f"{delta[n - 1]:.2f}" for n in (1, 2, 3, 6)),
        f"{size[0] / size[1:].max():.1f} times",
        _over_tilt(low),
        _over_tilt(high),
        " / ".join(
            f"{100.0 * _six(stiffness, r, mu):.1f} %" for r, mu in ((low, LOW), (high, HIGH))
        ),
        " / ".join(f"{_axial_swing(stiffness, angle):.0f}" for angle in ANGLES[1:]),
        f"{_off_line(stiffness):.2f} %",
    ]


def _over_spur(stiffness: Stiffness, mu: float) -> str:
    spur, helical = (
        np.ptp(stiffness.response(mu, angle=angle).bearing_force, axis=0)
        for angle in (0.0, ANGLES[4])
    )
    ratios = spur[:2] / helical[:2]
    return f"{ratios[0]:.0f} / {ratios[1]:.0f} times"


def _over_tilt(response: PeriodicResponse) -> str:
    first = {n: harmonics(response.signal(n))[0] for n in ("delta_x", "delta_y", "delta_z")}
    return " / ".join(f"{first['delta_z'] / first[n]:.0f}" for n in ("delta_x", "delta_y"))


def _six(stiffness: Stiffness, twelve: PeriodicResponse, mu: float) -> float:
    six = stiffness.response(mu, form="six_dof")
    return max(
        float(np.abs(harmonics(six.signal(n), 6) / harmonics(twelve.signal(n), 6) - 1.0).max())
        for n in TRANSVERSE
    )


def _axial_swing(stiffness: Stiffness, angle: float) -> float:
    return float(np.ptp(stiffness.response(LOW, angle=angle).mesh_force[:, 2]))


def _off_line(stiffness: Stiffness) -> float:
    size = np.array([harmonics(stiffness.response(mu).signal("u_xp"))[0] for mu in _FRICTION])
    line = np.polyval(np.polyfit(_FRICTION, size, 1), _FRICTION)
    return 100.0 * float(np.abs(line / size - 1.0).max())


def loaded_claims_rows(store: Path) -> list[tuple[str, str]]:
    """Return both stiffnesses side by side."""
    return list(zip(*map(column, (one_density(), loaded_contact(store))), strict=True))
