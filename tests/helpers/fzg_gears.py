"""The FZG gears of [arana_2019]: 16/24 teeth, 183.4 N.m at the pinion, oil of 90 degC."""

import math

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.friction.flank_laws import AranaShare
from gearlube_core.friction.line_integrals import LineFrictionCycle
from gearlube_core.friction.line_points import line_points, uniform_line_load
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.oil.lubricant import Lubricant

CENTRE, TORQUE = 91.5e-3, 183.4  # m, N.m
PAIR = HelicalPair(
    name="fzg_c",
    pinion_teeth=16,
    gear_teeth=24,
    normal_module=4.5e-3,
    normal_pressure_angle=math.radians(20.0),
    helix_angle=0.0,
    centre_distance=CENTRE,
    pinion_tip_radius=41.23e-3,
    gear_tip_radius=59.18e-3,
    pinion_root_radius=30.7e-3,
    gear_root_radius=48.65e-3,
    face_width=14e-3,
    profile_shift=(0.182, 0.172),
)
POINTS = line_points(PAIR)
ROUGH = 0.2e-6 * math.sqrt(2.0) * math.sqrt(math.pi / 2.0)  # Ra 0.2 um of both, Gaussian
OIL = "arana_2019_m100"


def friction(
    speed: float, mu_b: float | None = 0.065, film: str = "formula", rough: float = ROUGH
) -> LineFrictionCycle:
    """Friction at a speed of the pitch circles [m/s] at 90 degC."""
    given = FilmFriction(
        oil=Lubricant.named(OIL),
        oil_temperature=363.15,
        solid=STEEL_MOHAMMADPOUR_2015,
        roughness_rms=rough,
        film=film,
        asperities=None if mu_b is None else AranaShare(boundary_friction=mu_b),
    )
    pitch_radius = CENTRE * PAIR.pinion_teeth / (PAIR.pinion_teeth + PAIR.gear_teeth)
    load = uniform_line_load(POINTS, TORQUE)
    return given.cycle(POINTS, load, speed / pitch_radius, TORQUE)
