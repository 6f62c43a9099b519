"""What the stiffness of loaded contact changes of statements H9 to H21 of He et al. 2007."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from docs.helical.cases import HE, HIGH, LOW, at_orders, density, line_lengths
from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.he_2007 import PINION_SPEED, PINION_TORQUE, he_2007_pair


def table_density(mesh: LineMesh, torque: float) -> float:
    """Return the mean tangent density of a line mesh at one of its torques [N/m2]."""
    level = int(np.argmin(np.abs(mesh.torque - torque)))
    lengths = line_lengths(mesh.phase, mesh.lines)
    part = lengths[..., None] / mesh.station.size
    return float((mesh.density[level] * part).sum() / lengths.sum())


def column(mesh: LineMesh) -> list[str]:
    """Return what was found with one stiffness, in the order of the table."""
    low, high = (
        periodic_response(replace(he_2007_pair(mu), mesh=mesh), PINION_SPEED) for mu in (LOW, HIGH)
    )

    def growth(name: str) -> np.ndarray:
        return np.asarray(harmonics(high.signal(name)) / harmonics(low.signal(name)))

    x, z, delta = growth("u_xp"), growth("u_zp"), growth("delta_z")
    off, axial = at_orders(x, *range(7, 16)), at_orders(z, 7, 8, 9)
    size = harmonics(high.signal("delta_z"))
    swing = [1e6 * float(np.ptp(r.signal("delta_z"))) for r in (low, high)]
    return [
        f"{1e-9 * table_density(mesh, PINION_TORQUE):.2f}",
        f"{swing[0]:.2f} / {swing[1]:.2f}",
        f"{x[0]:.1f}, {x[1]:.1f} / {x[2]:.2f} / {off.min():.2f} to {off.max():.2f}",
        ", ".join(f"{v:.2f}" for v in axial),
        " / ".join(f"{delta[n - 1]:.2f}" for n in (1, 2, 3, 6)),
        f"{size[0] / size[1:].max():.1f} times",
    ]


def loaded_claims_rows() -> list[tuple[str, str]]:
    """Return one density, of ISO 6336-1, and loaded contact side by side."""
    one = constant_density_mesh(HE, density(), "He et al. 2007 eq. (2)")
    return list(zip(column(one), column(named_line_mesh("he_2007")), strict=True))
