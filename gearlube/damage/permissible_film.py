"""Film that keeps micropitting away: that of the C-GF test gear by the film law of the gears."""

from __future__ import annotations

import math
from dataclasses import replace

from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_law import flank_state
from gearlube_core.friction.solved_line import bounded_line_friction
from gearlube_core.rating.micropitting import MARGIN, TEST_POINT

# equal flanks with normal heights: rms is (pi/2)^(1/2) R_a, and of both 2^(1/2) times as much
_ROUGHNESS = math.sqrt(math.pi) * TEST_POINT[3]
_SLENDER = 100.0  # R_y/R_x of the ellipse in place of a line; of 20 or 400 the film is 7 % off


def permissible_ratio(axle: HypoidAxleParameters, test_torque: float, bulk: float) -> float:
    """Return the least film over composite roughness without micropitting, by the axle's films.

    lambda_GFP = 1.4 h/(pi^(1/2) R_a) at point A of the test gear, in the manner of [iso_6336_22]

    The torque is that of the failure stage of the oil's test [N.m], `bulk` the temperature of the
    flanks there [K]. By formulas an ellipse as slender as those of flanks stands for the line; a
    solved film is that of the shipped model of lines, and no number outside of it.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> round(permissible_ratio(mohammadpour_2015_axle(), 265.1, 363.15), 2)
    0.4
    """
    radius, speed, slip, line_load = _point(test_torque)
    if axle.film == "solved":
        lines = FilmFriction(
            oil=axle.oil, oil_temperature=bulk, solid=axle.solid, roughness_rms=_ROUGHNESS,
            film="solved",
        )  # fmt: skip
        return permissible_line_ratio(lines, test_torque, bulk)
    modulus = contact_modulus(axle.solid, axle.solid)
    law = replace(axle, roughness_rms=_ROUGHNESS).kernel_parameters().flank_law
    # the load whose line load in the middle, 0.75 F/b, is that of the test; b goes with F^(1/3)
    _, b, _ = hertz_ellipse(radius, _SLENDER * radius, modulus, 1.0)
    force = (line_load * b / 0.75) ** 1.5
    geometry = contact_geometry(radius, _SLENDER * radius, 0.0, modulus)
    oil = axle.oil.state(bulk)
    return MARGIN * float(flank_state(law, force, speed, slip, geometry, oil).film_ratio)


def permissible_line_ratio(film: FilmFriction, test_torque: float, bulk: float) -> float:
    """Return the same by the film of contact lines of a pair; others as in `permissible_ratio`."""
    radius, speed, slip, line_load = _point(test_torque)
    of = replace(film, roughness_rms=_ROUGHNESS, oil_temperature=bulk).constants()
    found = bounded_line_friction(
        line_load, radius, speed, slip, of.lubricant, of.surface, of.solid, of.film_model
    )
    outside = film.film == "solved" and found.outside > 0.0
    return math.nan if outside else MARGIN * float(found.state.film_ratio)


def _point(test_torque: float) -> tuple[float, float, float, float]:
    """Return radius, entrainment, sliding and line load of the test point."""
    radius, (u_1, u_2), load, _ = TEST_POINT
    return radius, 0.5 * (u_1 + u_2), u_2 - u_1, load * test_torque
