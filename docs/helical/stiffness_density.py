"""Which stiffness density: ISO 6336-1 with choices that the paper leaves open."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from docs.helical.cases import HE, HIGH, LINE_LOAD, LOW, density, line_lengths
from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
from gearlube_core.dynamics.helical_pair.he_2007 import PINION_SPEED, he_2007_pair
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.helical_geometry.iso_6336_stiffness import (
    iso_stiffness,
    rack_dedendum_of,
    stiffness_density,
    virtual_teeth,
)
from gearlube_core.mesh_table.line_mesh import LineMesh

# q' of ISO 6336-1 without profile shift, a transcription beside that of `iso_stiffness`
_Q = (0.04723, 0.15551, 0.25791)
_C_M = 0.8
_SIGNALS = ("u_xp", "u_yp", "delta_z")


@dataclass(frozen=True, slots=True)
class Choice:
    """One way to the density.

    Parameters
    ----------
    words : str
    teeth : tuple of float
        z_n1, z_n2 [-].
    rack_factor : float
        C_B [-].
    single, mesh : float
        c', c_gamma_alpha [N/(mm um)].
    density : float
        k [N/m2].
    """

    words: str
    teeth: tuple[float, float]
    rack_factor: float
    single: float
    mesh: float
    density: float


def choices() -> list[Choice]:
    """Return the densities: from the pair's own data, with a rack of 1.2, and as estimated."""
    return [
        _iso("own roots, z_n = z/(cos2(beta_b) cos(beta))", None),
        _iso("dedendum of the rack 1.2 modules", 1.2),
        _estimate(),
    ]


def _iso(words: str, dedendum: float | None) -> Choice:
    found = iso_stiffness(HE, line_load=LINE_LOAD, rack_dedendum=dedendum)
    return Choice(
        words,
        virtual_teeth(HE),
        found.basic_rack_factor,
        1e-9 * found.single,
        1e-9 * found.mesh,
        stiffness_density(found.mesh, HE),
    )


def _estimate() -> Choice:
    """Return the estimate from memory of the standard: z/cos3(beta), rack of 1.2."""
    cos = math.cos(HE.helix_angle)
    teeth = HE.pinion_teeth / cos**3, HE.gear_teeth / cos**3
    factor = 1.0 - 0.02 * (20.0 - math.degrees(HE.normal_pressure_angle))
    single = _C_M * factor * cos / (_Q[0] + _Q[1] / teeth[0] + _Q[2] / teeth[1])
    mesh = (0.75 * HE.transverse_contact_ratio + 0.25) * single
    return Choice(
        "dedendum 1.2, z_n = z/cos3(beta)",
        teeth,
        factor,
        single,
        mesh,
        stiffness_density(1e9 * mesh, HE),
    )


def used() -> str:
    """Return which choice `he_2007_pair` has, in words."""
    k = density()
    nearest = min(choices(), key=lambda c: abs(c.density - k))
    close = abs(nearest.density / k - 1.0) < 1e-3
    where = f"that of: {nearest.words}" if close else "none of these"
    depth = rack_dedendum_of(HE)
    return (
        f"\n`he_2007_pair` has k = {1e-9 * k:.2f} N/(mm um), {where}. The pair's own roots lie "
        f"{depth[0]:.3f} and {depth[1]:.3f} normal modules below the reference.\n"
    )


def table_density(mesh: LineMesh, torque: float) -> float:
    """Return the mean tangent density of a line mesh at one of its torques [N/m2]."""
    level = int(np.argmin(np.abs(mesh.torque - torque)))
    lengths = line_lengths(mesh.phase, mesh.lines)
    part = lengths[..., None] / mesh.station.size
    return float((mesh.density[level] * part).sum() / lengths.sum())


@dataclass(frozen=True, slots=True)
class Effect:
    """What a density does to the pair at 1000 rpm.

    Parameters
    ----------
    density : float
        [N/m2]
    mesh_order : float
        Frequency of the mesh's own mode over the mesh frequency [-].
    swing : float
        delta_z, peak to peak, mu = 0.1 [m].
    growth : tuple of float
        Orders 1 and 2 of u_xp, 2 of delta_z, at mu = 0.1 over 0.01 [-].
    off_line : float
        Furthest of the orders of u_yp but 4, 8, 12 from ten times [-].
    """

    density: float
    mesh_order: float
    swing: float
    growth: tuple[float, float, float]
    off_line: float


def effects(densities: Sequence[float]) -> list[Effect]:
    """Return what densities [N/m2] do."""
    return [_effect(k) for k in densities]


def _effect(k: float) -> Effect:
    mesh = constant_density_mesh(HE, k, "compared")
    responses = [
        periodic_response(replace(he_2007_pair(mu), mesh=mesh), PINION_SPEED) for mu in (LOW, HIGH)
    ]
    low, high = ({n: harmonics(r.signal(n)) for n in _SIGNALS} for r in responses)
    ratio = {name: high[name] / low[name] for name in _SIGNALS}
    one_sided = replace(responses[0].parameters, contact="one_sided")
    return Effect(
        k,
        SeparationProblem(one_sided).natural_frequency * responses[0].period,
        float(np.ptp(responses[1].signal("delta_z"))),
        (float(ratio["u_xp"][0]), float(ratio["u_xp"][1]), float(ratio["delta_z"][1])),
        float(np.abs(np.delete(ratio["u_yp"], [3, 7, 11]) - 10.0).max()),
    )
