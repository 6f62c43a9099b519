"""Motion of the pair in the coordinates of its drive flanks and coast flanks: kernels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.march.state import (
    PHI_P,
    PSI,
    TH_G,
    TH_P,
    U_G,
    U_P,
)
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import plane_strain
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number

SPEED_OF_FULL_FRICTION = 0.01  # rad/s; below, friction fades so that it has no jump at rest


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankScalars:
    """Numbers of the flanks that a user may give.

    Parameters
    ----------
    backlash : float
        Normal backlash [m], 0 to 2e-3.
    """

    backlash: Annotated[float, Number("m", 0.0, 2e-3, "100 um is 1e-4 m.")]


class FlankConstants(NamedTuple):
    """Geometry of the flanks, of which the back ones are the drive ones turned about."""

    plane: ContactPlane
    damping: float  # `mesh_damping.damping_factor` [sqrt(kg)]
    backlash: float  # normal [m]
    coast_phase: float  # phase of drive flank plus phase of coast flank [mesh periods]
    turn_cos: float  # cosine and sine of twice the angle of the line of centres against y
    turn_sin: float
    line_work: float  # 1: lines that move under load exchange work with the pinion; 0: none
    lines: float  # contact lines in the line mesh
    phases: float  # mesh phases in it
    stations: float  # places along a line in it


class FlankView(NamedTuple):
    """Motion as one flank sees it."""

    a: float  # compression at x = z = 0 [m]
    tilt: float  # th_yp - th_yg [rad]
    phase: float  # [mesh periods]


@kernel
def drive_view(s: Array, p: FlankConstants) -> FlankView:
    """Return compression and phase of the drive flanks; s[PSI] is -psi of docs/conventions.md."""
    plane = p.plane
    a, tilt = plane_strain(
        s[U_P] - s[U_G] + s[PSI],
        s[U_P + 2] - s[U_G + 2],
        s[TH_P],
        s[TH_P + 1],
        s[TH_G],
        s[TH_G + 1],
        plane,
    )
    return FlankView(a, tilt, plane.r_bp * s[PHI_P] / plane.pitch)


@kernel
def turned(x: float, y: float, p: FlankConstants) -> tuple[float, float]:
    """Return x and y of a vector after half a turn about the line of centres; z changes sign."""
    return -p.turn_cos * x + p.turn_sin * y, p.turn_sin * x + p.turn_cos * y


@kernel
def coast_view(s: Array, p: FlankConstants) -> FlankView:
    """Return compression and phase of the coast flanks.

    Notes
    -----
    Half a turn about the line of centres carries either gear into itself, its coast flanks into
    drive flanks: the coast flanks are the drive flanks of the turned motion, less the backlash.
    """
    plane = p.plane
    u_px, _ = turned(s[U_P], s[U_P + 1], p)
    u_gx, _ = turned(s[U_G], s[U_G + 1], p)
    th_px, th_py = turned(s[TH_P], s[TH_P + 1], p)
    th_gx, th_gy = turned(s[TH_G], s[TH_G + 1], p)
    closing = u_px - u_gx - s[PSI]
    axial = s[U_G + 2] - s[U_P + 2]
    a, tilt = plane_strain(closing, axial, th_px, th_py, th_gx, th_gy, plane)
    phase = p.coast_phase - plane.r_bp * s[PHI_P] / plane.pitch
    return FlankView(a - p.backlash, tilt, phase)


@kernel
def deepest(view: FlankView, offset_low: float, p: FlankConstants) -> float:
    """Return a bound of the deflection anywhere on a flank [m]; not above 0 nothing touches."""
    plane = p.plane
    reach = abs(view.tilt) * (0.5 * plane.W * plane.cos_b + plane.x_g * plane.sin_b)
    return view.a + reach - offset_low


@kernel
def touches(view: FlankView, offset_low: float, p: FlankConstants) -> bool:
    """Return whether a flank can touch anywhere: a quick bound."""
    return deepest(view, offset_low, p) > 0.0


@kernel
def coast_deepest(s: Array, offset_low: float, p: FlankConstants) -> float:
    """Return a bound of the deflection of the coast flanks [m] that costs less than their view."""
    reach = 0.0
    for i in range(3):
        reach += abs(s[U_P + i]) + abs(s[U_G + i])
    size = p.plane.W + 2.0 * p.plane.x_g + p.plane.r_bp + p.plane.r_bg
    for i in range(2):
        reach += size * (abs(s[TH_P + i]) + abs(s[TH_G + i]))
    return reach - s[PSI] * p.plane.cos_b - p.backlash - offset_low


@kernel
def coast_near(s: Array, offset_low: float, p: FlankConstants) -> bool:
    """Return whether the coast flanks can touch, by `coast_deepest`."""
    return coast_deepest(s, offset_low, p) > 0.0


@kernel
def friction_direction(pinion_speed: float) -> float:
    """Return the direction of rotation: +1 forward, -1 backward, linear between near rest."""
    return min(max(pinion_speed / SPEED_OF_FULL_FRICTION, -1.0), 1.0)
