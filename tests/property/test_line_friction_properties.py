"""What must hold for the friction at any point of a contact line."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, SolidParameters, solid_parameters
from gearlube_core.friction.line_points import LINE_LOAD_FLOOR, line_friction
from gearlube_core.oil.eyring_1936 import eyring_stress_ratio
from gearlube_core.oil.lubricant import Lubricant, lubricant_names
from gearlube_core.oil.lubricant_state import (
    LubricantState,
    eyring_stress_under,
    lubricant_state,
)


def _grown(oil: LubricantState, p: float) -> float:
    """ln(eta/eta0) by Barus, or by the pressure factor of the oil."""
    return p / (oil.modulus + oil.modulus_slope * p) if oil.modulus > 0.0 else oil.alpha * p


SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
PARAMETERS = {name: Lubricant.named(name).parameters() for name in lubricant_names()}

Pair = tuple[LubricantState, SurfaceParameters, SolidParameters]
loads = st.floats(10.0 * LINE_LOAD_FLOOR, 1e6)
radii = st.floats(2e-3, 0.1)
speeds = st.floats(1e-3, 40.0)
signed_speeds = st.one_of(st.floats(-40.0, 40.0), st.floats(-1e-4, 1e-4), st.just(0.0))


@st.composite
def pairs(draw: st.DrawFn) -> Pair:
    """Draw oil and surface."""
    oil = PARAMETERS[draw(st.sampled_from(sorted(PARAMETERS)))]
    sigma = draw(st.floats(0.05e-6, 3e-6))
    state = lubricant_state(oil, draw(st.floats(275.0, 420.0)))
    return state, SurfaceParameters(sigma, 0.055, 0.001), SOLID


@given(pairs(), st.floats(0.0, 1e6), radii, signed_speeds, signed_speeds)
def test_every_state_is_finite_and_friction_never_drives(
    pair: Pair, load: float, R: float, speed: float, slip: float
) -> None:
    state = line_friction(load, R, speed, slip, *pair)
    assert all(math.isfinite(value) for value in state)
    magnitudes = state._replace(signed_coefficient=0.0)
    assert min(magnitudes) >= 0.0
    # power taken from the bodies: friction on surface 1 opposes u_1 - u_2
    assert state.signed_coefficient * slip >= 0.0


@given(pairs(), loads, radii, speeds, signed_speeds)
def test_reversed_sliding_reverses_friction_and_nothing_else(
    pair: Pair, load: float, R: float, speed: float, slip: float
) -> None:
    there = line_friction(load, R, speed, slip, *pair)
    back = line_friction(load, R, speed, -slip, *pair)
    assert back == there._replace(signed_coefficient=back.signed_coefficient)
    assert back.signed_coefficient == -there.signed_coefficient


@given(pairs(), loads, radii, speeds, signed_speeds, st.floats(1.01, 10.0))
def test_film_falls_with_load_and_grows_with_speed(
    pair: Pair, load: float, R: float, speed: float, slip: float, factor: float
) -> None:
    base = line_friction(load, R, speed, slip, *pair).film_thickness
    assert line_friction(factor * load, R, speed, slip, *pair).film_thickness < base
    assert line_friction(load, R, factor * speed, slip, *pair).film_thickness > base


@given(pairs(), loads, radii, speeds, st.floats(1e-6, 30.0), st.floats(1.001, 3.0))
def test_friction_never_falls_with_sliding_speed(
    pair: Pair, load: float, R: float, speed: float, slip: float, factor: float
) -> None:
    slow = line_friction(load, R, speed, slip, *pair)
    fast = line_friction(load, R, speed, factor * slip, *pair)
    # grows below its plateau, constant on it; rounding
    assert fast.signed_coefficient >= slow.signed_coefficient * (1.0 - 1e-13)


@given(pairs(), loads, radii, speeds, st.floats(0.01, 30.0))
def test_rougher_flanks_have_more_boundary_friction(
    pair: Pair, load: float, R: float, speed: float, slip: float
) -> None:
    oil, surface, solid = pair
    smooth = line_friction(load, R, speed, slip, oil, surface, solid)
    share = smooth.boundary_friction / (oil.gamma * load)
    assume(smooth.film_ratio < 4.9 and share < 0.9)  # a load all on asperities cannot grow
    rough = surface._replace(sigma=1.3 * surface.sigma)
    assert line_friction(load, R, speed, slip, oil, rough, solid).boundary_friction > (
        smooth.boundary_friction
    )


@given(pairs(), loads, radii, speeds, signed_speeds)
def test_traction_stays_below_the_isothermal_eyring_film(
    pair: Pair, load: float, R: float, speed: float, slip: float
) -> None:
    oil = pair[0]
    state = line_friction(load, R, speed, slip, *pair)
    tau = eyring_stress_under(oil, state.mean_pressure)
    ratio = oil.eta0 * abs(slip) / (state.film_thickness * tau)
    limit = eyring_stress_ratio(ratio, _grown(oil, state.mean_pressure))
    largest = limit * tau * load / state.mean_pressure
    # rounding; sliding of 1e-300 m/s and less leaves subnormal numbers with few digits
    assert state.viscous_friction <= largest * (1.0 + 1e-12) + 1e-290


@given(pairs(), loads, radii, speeds, signed_speeds)
def test_forces_per_length_add_up_to_the_coefficient(
    pair: Pair, load: float, R: float, speed: float, slip: float
) -> None:
    state = line_friction(load, R, speed, slip, *pair)
    total = state.viscous_friction + state.boundary_friction
    # rounding; sliding of 1e-300 m/s and less leaves subnormal numbers with few digits
    assert state.friction_coefficient * load == pytest.approx(total, rel=1e-13, abs=1e-290)
    assert abs(state.signed_coefficient) == state.friction_coefficient


@given(pairs(), loads, radii, speeds, signed_speeds, st.sampled_from(["load", "R", "u", "s"]))
def test_friction_is_continuous(
    pair: Pair, load: float, R: float, speed: float, slip: float, which: str
) -> None:
    step = 1.0 + 1e-7
    base = line_friction(load, R, speed, slip, *pair)
    near = line_friction(
        load * (step if which == "load" else 1.0),
        R * (step if which == "R" else 1.0),
        speed * (step if which == "u" else 1.0),
        slip * (step if which == "s" else 1.0),
        *pair,
    )
    # mu is at most 0.2 or tau/p; logarithmic slopes stay below 100, also where asperities end
    scale = 0.2 + pair[0].tau0 / base.mean_pressure
    assert abs(near.signed_coefficient - base.signed_coefficient) <= 1e-5 * scale
