"""Which stiffness density: ISO 6336-1 with choices that the paper leaves open."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from docs.helical.cases import HE, HIGH, LINE_LOAD, LOW, density, line_lengths
from gearlube_core.dynamics.helical_pair.gear_file_pair import constant_density_mesh
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
from tests.helpers.he_2007 import PINION_SPEED, he_2007_pair

# q' of ISO 6336-1 without profile shift, a transcription beside that of `iso_stiffness`
_Q = (0.04723, 0.15551, 0.25791)
_C_M = 0.8
_SIGNALS = ("u_xp", "u_yp", "delta_z")


Choice = tuple[tuple[float, float], float, float, float]  # z_n, C_B [-], c', c_gamma_alpha [N/m2]


def choices() -> list[Choice]:
    """Return own roots with z_n = z/(cos2(beta_b) cos(beta)), a rack of 1.2, and the estimate."""
    return [_iso(None), _iso(1.2), _estimate()]


def _iso(dedendum: float | None) -> Choice:
    found = iso_stiffness(HE, line_load=LINE_LOAD, rack_dedendum=dedendum)
    return virtual_teeth(HE), found.basic_rack_factor, found.single, found.mesh


def _estimate() -> Choice:
    """Return the estimate from memory of the standard: z/cos3(beta), rack of 1.2."""
    cos = math.cos(HE.helix_angle)
    teeth = HE.pinion_teeth / cos**3, HE.gear_teeth / cos**3
    factor = 1.0 - 0.02 * (20.0 - math.degrees(HE.normal_pressure_angle))
    single = 1e9 * _C_M * factor * cos / (_Q[0] + _Q[1] / teeth[0] + _Q[2] / teeth[1])
    return teeth, factor, single, (0.75 * HE.transverse_contact_ratio + 0.25) * single


def choice_rows() -> list[list[str]]:
    """Return the choices of density and what they do, from the second column on."""
    rows = []
    for teeth, rack_factor, single, mesh in choices():
        k = stiffness_density(mesh, HE)
        rows.append(
            [
                " / ".join(f"{z:.2f}" for z in teeth),
                f"{rack_factor:.3f}",
                *(f"{1e-9 * one:.2f}" for one in (single, mesh, k)),
                *_effect(k),
            ]
        )
    return rows


def own_density() -> tuple[str, str, str]:
    """Return the density of `he_2007_pair`, and how deep the roots of both members are."""
    return (f"{1e-9 * density():.2f}", *(f"{one:.3f}" for one in rack_dedendum_of(HE)))


def table_density(mesh: LineMesh, torque: float) -> float:
    """Return the mean tangent density of a line mesh at one of its torques [N/m2]."""
    level = int(np.argmin(np.abs(mesh.torque - torque)))
    lengths = line_lengths(mesh.phase, mesh.lines)
    part = lengths[..., None] / mesh.station.size
    return float((mesh.density[level] * part).sum() / lengths.sum())


def _effect(k: float) -> list[str]:
    """Return what a density [N/m2] does to the pair at 1000 rpm."""
    mesh = constant_density_mesh(HE, k, "compared")
    responses = [
        periodic_response(replace(he_2007_pair(mu), mesh=mesh), PINION_SPEED) for mu in (LOW, HIGH)
    ]
    low, high = ({n: harmonics(r.signal(n)) for n in _SIGNALS} for r in responses)
    ratio = {name: high[name] / low[name] for name in _SIGNALS}
    one_sided = replace(responses[0].parameters, contact="one_sided")
    natural = SeparationProblem(one_sided).natural_frequency
    return [
        f"{natural * responses[0].period:.2f}",
        f"{1e6 * np.ptp(responses[1].signal('delta_z')):.3f}",
        f"{ratio['u_xp'][0]:.1f} / {ratio['u_xp'][1]:.1f}",
        f"{ratio['delta_z'][1]:.2f}",
        f"{np.abs(np.delete(ratio['u_yp'], [3, 7, 11]) - 10.0).max():.2f}",
    ]
