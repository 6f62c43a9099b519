"""Motion of the pair as its drive flanks and its coast flanks see it: kernels."""

from __future__ import annotations

from typing import NamedTuple

from numpy import float64
from numpy.typing import NDArray

from gearlube_core.dynamics.helical_pair.march_constants import FlankConstants
from gearlube_core.dynamics.helical_pair.state import (
    PHI_P,
    PSI,
    TH_G,
    TH_P,
    U_G,
    U_P,
)
from gearlube_core.jit import kernel

SPEED_OF_FULL_FRICTION = 0.01  # rad/s; below, friction fades so that it has no jump at rest


class FlankView(NamedTuple):
    """Motion as one flank sees it."""

    a: float  # compression at x = z = 0 [m]
    tilt: float  # th_yp - th_yg [rad]
    phase: float  # [mesh periods]


@kernel
def drive_view(s: NDArray[float64], p: FlankConstants) -> FlankView:
    """Return compression and phase of the drive flanks.

    Notes
    -----
    He et al. 2007 eq. (4), sign reversed, with -psi of docs/conventions.md as s[PSI].
    """
    plane = p.plane
    c1 = s[U_P] - s[U_G] + s[PSI]
    c3 = s[U_P + 2] - s[U_G + 2] + plane.r_bp * s[TH_P] + plane.r_bg * s[TH_G]
    c3 -= plane.x_g * s[TH_G + 1]
    phase = plane.r_bp * s[PHI_P] / plane.pitch
    return FlankView(plane.cos_b * c1 - plane.sin_b * c3, s[TH_P + 1] - s[TH_G + 1], phase)


@kernel
def turned(x: float, y: float, p: FlankConstants) -> tuple[float, float]:
    """Return x and y of a vector after half a turn about the line of centres; z changes sign."""
    return -p.turn_cos * x + p.turn_sin * y, p.turn_sin * x + p.turn_cos * y


@kernel
def coast_view(s: NDArray[float64], p: FlankConstants) -> FlankView:
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
    c1 = u_px - u_gx - s[PSI]
    c3 = s[U_G + 2] - s[U_P + 2] + plane.r_bp * th_px + plane.r_bg * th_gx - plane.x_g * th_gy
    phase = p.coast_phase - plane.r_bp * s[PHI_P] / plane.pitch
    a = plane.cos_b * c1 - plane.sin_b * c3 - p.backlash
    return FlankView(a, th_py - th_gy, phase)


@kernel
def touches(view: FlankView, offset_low: float, p: FlankConstants) -> bool:
    """Return whether a flank can touch anywhere: a quick bound."""
    plane = p.plane
    reach = abs(view.tilt) * (0.5 * plane.W * plane.cos_b + plane.x_g * plane.sin_b)
    return view.a + reach - offset_low > 0.0


@kernel
def coast_near(s: NDArray[float64], offset_low: float, p: FlankConstants) -> bool:
    """Return whether the coast flanks can touch: a bound that costs less than their view."""
    reach = 0.0
    for i in range(3):
        reach += abs(s[U_P + i]) + abs(s[U_G + i])
    size = p.plane.W + 2.0 * p.plane.x_g + p.plane.r_bp + p.plane.r_bg
    for i in range(2):
        reach += size * (abs(s[TH_P + i]) + abs(s[TH_G + i]))
    return reach - s[PSI] * p.plane.cos_b - p.backlash - offset_low > 0.0


@kernel
def friction_direction(pinion_speed: float) -> float:
    """Return the direction of rotation: +1 forward, -1 backward, linear between near rest."""
    return min(max(pinion_speed / SPEED_OF_FULL_FRICTION, -1.0), 1.0)
