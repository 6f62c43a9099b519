"""Constants, motion and flanks of a helical pair."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import (
    ARANA_FRICTION,
    BOUNDARY_FRICTION,
    SHARE_EXPONENT,
    SurfaceParameters,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import plane_strain
from gearlube_core.dynamics.ranges import RangeLimits
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.helical_geometry.gear_body import BACKLASH
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number
from gearlube_core.oil.lubricant import LIMITING_SLOPE
from gearlube_core.oil.lubricant_state import LubricantParameters

LINES_MAX = 6  # contact lines at once; a total contact ratio above 6 is refused
POINTS_PER_LINE = 4  # two Gauss points on either side of the pitch line
FLANK_POINTS = LINES_MAX * POINTS_PER_LINE
# when friction was last computed, and its coefficients on both flanks
N_FRICTION = 1 + 2 * FLANK_POINTS
SPEED_OF_FULL_FRICTION = 0.01  # rad/s; below, friction fades so that it has no jump at rest


@dataclass(frozen=True, slots=True, kw_only=True)
class FlankScalars:
    """Numbers of the flanks that a user may give.

    Parameters
    ----------
    backlash : float
        Normal backlash [m], 0 to 0.01.
    """

    backlash: Annotated[float, BACKLASH]


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


class PairMotion(NamedTuple):
    """Motion of both members as their mesh takes it, in the axes of the contact plane."""

    psi: float  # relative rotation along the line of action [m]
    phi_p: float  # angle of the pinion, forward positive [rad]
    w_p: float  # speeds, forward positive [rad/s]
    w_g: float
    x_p: float  # displacement of the pinion [m]
    y_p: float
    z_p: float
    rx_p: float  # and its tilt [rad]
    ry_p: float
    x_g: float  # of the gear
    y_g: float
    z_g: float
    rx_g: float
    ry_g: float
    vx_p: float  # their rates
    vy_p: float
    ox_p: float
    oy_p: float
    vx_g: float
    vy_g: float
    ox_g: float
    oy_g: float


class FlankView(NamedTuple):
    """Motion as one flank sees it."""

    a: float  # compression at x = z = 0 [m]
    tilt: float  # th_yp - th_yg [rad]
    phase: float  # [mesh periods]


@kernel
def drive_view(m: PairMotion, p: FlankConstants) -> FlankView:
    """Return compression and phase of the drive flanks; m.psi is -psi of docs/conventions.md."""
    plane = p.plane
    a, tilt = plane_strain(
        m.x_p - m.x_g + m.psi,
        m.z_p - m.z_g,
        m.rx_p,
        m.ry_p,
        m.rx_g,
        m.ry_g,
        plane,
    )
    return FlankView(a, tilt, plane.r_bp * m.phi_p / plane.pitch)


@kernel
def turned(x: float, y: float, p: FlankConstants) -> tuple[float, float]:
    """Return x and y of a vector after half a turn about the line of centres; z changes sign."""
    return -p.turn_cos * x + p.turn_sin * y, p.turn_sin * x + p.turn_cos * y


@kernel
def coast_view(m: PairMotion, p: FlankConstants) -> FlankView:
    """Return compression and phase of the coast flanks.

    Notes
    -----
    Half a turn about the line of centres carries either gear into itself, its coast flanks into
    drive flanks: the coast flanks are the drive flanks of the turned motion, less the backlash.
    """
    plane = p.plane
    u_px, _ = turned(m.x_p, m.y_p, p)
    u_gx, _ = turned(m.x_g, m.y_g, p)
    th_px, th_py = turned(m.rx_p, m.ry_p, p)
    th_gx, th_gy = turned(m.rx_g, m.ry_g, p)
    closing = u_px - u_gx - m.psi
    axial = m.z_g - m.z_p
    a, tilt = plane_strain(closing, axial, th_px, th_py, th_gx, th_gy, plane)
    phase = p.coast_phase - plane.r_bp * m.phi_p / plane.pitch
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
def coast_deepest(m: PairMotion, offset_low: float, p: FlankConstants) -> float:
    """Return a bound of the deflection of the coast flanks [m] that costs less than their view."""
    reach = abs(m.x_p) + abs(m.x_g)
    reach += abs(m.y_p) + abs(m.y_g)
    reach += abs(m.z_p) + abs(m.z_g)
    size = p.plane.W + 2.0 * p.plane.x_g + p.plane.r_bp + p.plane.r_bg
    reach += size * (abs(m.rx_p) + abs(m.rx_g))
    reach += size * (abs(m.ry_p) + abs(m.ry_g))
    return reach - m.psi * p.plane.cos_b - p.backlash - offset_low


@kernel
def coast_near(m: PairMotion, offset_low: float, p: FlankConstants) -> bool:
    """Return whether the coast flanks can touch, by `coast_deepest`."""
    return coast_deepest(m, offset_low, p) > 0.0


@kernel
def friction_direction(pinion_speed: float) -> float:
    """Return the direction of rotation: +1 forward, -1 backward, linear between near rest."""
    return min(max(pinion_speed / SPEED_OF_FULL_FRICTION, -1.0), 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class MarchScalars(FlankScalars):
    """Numbers of the pair that a user may give, besides those of `FlankScalars`.

    Parameters
    ----------
    friction_updates_per_mesh_period : int
        How often friction of films is computed again at each contact point, 4 to 4096; frozen in
        between.
    boundary_friction, share_exponent : float
        Of the friction "arana_2019", see `flank_laws.AranaShare` [-].
    film_limiting_slope : float
        Limiting shear stress of a solved film over pressure [-], 0 for none: the film model knows
        none, so contacts whose mean stress comes near it count as outside.
    """

    friction_updates_per_mesh_period: Annotated[int, Number("1", 4, 4096)] = 16
    boundary_friction: Annotated[float, BOUNDARY_FRICTION] = ARANA_FRICTION
    share_exponent: Annotated[float, SHARE_EXPONENT] = 1.0
    film_limiting_slope: Annotated[float, LIMITING_SLOPE] = 0.0


class MarchConstants(NamedTuple):
    """Constants of the marching model; `flanks` come first, so that they can be read alone."""

    flanks: FlankConstants
    teeth: float  # of the pinion
    friction_form: float  # -1 off, 0 constant, 1 film, 2 film with Arana's share
    mu: float  # of the constant form [-]
    refreshes: float  # of the film's friction in a mesh period
    film: float  # place in FILM_MODELS
    limiting_slope: float  # of a solved film's shear stress over pressure [-]; 0: none
    surface: SurfaceParameters
    solid: SolidParameters
    oil: LubricantParameters
    ranges: RangeLimits
