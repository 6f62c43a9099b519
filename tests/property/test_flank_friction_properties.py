"""What must hold for the friction of any flank."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, SolidParameters, solid_parameters
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import ContactGeometry, contact_geometry
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

Contact = tuple[ContactGeometry, LubricantState, SurfaceParameters, SolidParameters]
loads = st.floats(1e-2, 2e4)
speeds = st.floats(1e-3, 40.0)
signed_speeds = st.one_of(st.floats(-40.0, 40.0), st.floats(-1e-4, 1e-4), st.just(0.0))
forms = st.sampled_from([0, 1])


@st.composite
def flanks(draw: st.DrawFn) -> Contact:
    """Draw geometry, oil and surface of a flank contact."""
    R_x = draw(st.floats(2e-3, 0.1))
    ratio = draw(st.floats(1.0, 200.0))
    psi = draw(st.floats(0.0, 1.4))
    oil = PARAMETERS[draw(st.sampled_from(sorted(PARAMETERS)))]
    temperature = draw(st.floats(275.0, 420.0))
    sigma = draw(st.floats(0.05e-6, 3e-6))
    return (
        contact_geometry(R_x, ratio * R_x, psi, SOLID.contact_modulus),
        lubricant_state(oil, temperature),
        SurfaceParameters(sigma, 0.055, 0.001),
        SOLID,
    )


@given(flanks(), loads, speeds, signed_speeds, st.floats(1.01, 10.0))
def test_film_falls_with_load_and_grows_with_speed(
    contact: Contact, load: float, speed: float, slip: float, factor: float
) -> None:
    base = flank_friction(load, speed, slip, *contact, 0).film_thickness
    assert flank_friction(factor * load, speed, slip, *contact, 0).film_thickness < base
    assert flank_friction(load, factor * speed, slip, *contact, 0).film_thickness > base


@given(flanks(), st.floats(0.0, 2e4), signed_speeds, signed_speeds, forms)
def test_every_state_is_finite_and_friction_never_drives(
    contact: Contact, load: float, speed: float, slip: float, form: int
) -> None:
    state = flank_friction(load, speed, slip, *contact, form)
    assert all(math.isfinite(value) and value >= 0.0 for value in state)
    # the caller applies the force against sliding: its power is minus force times speed
    assert (state.viscous_friction + state.boundary_friction) * abs(slip) >= 0.0


@given(flanks(), loads, speeds, signed_speeds, forms)
def test_viscous_friction_stays_below_the_isothermal_eyring_film(
    contact: Contact, load: float, speed: float, slip: float, form: int
) -> None:
    oil = contact[1]
    state = flank_friction(load, speed, slip, *contact, form)
    tau0 = eyring_stress_under(oil, state.mean_pressure)
    ratio = oil.eta0 * abs(slip) / (state.film_thickness * tau0)
    limit = eyring_stress_ratio(ratio, _grown(oil, state.mean_pressure))
    largest = limit * tau0 * load / state.mean_pressure
    # rounding; sliding of 1e-300 m/s and less leaves subnormal numbers with few digits
    assert state.viscous_friction <= largest * (1.0 + 1e-12) + 1e-290


@given(flanks(), loads, speeds, signed_speeds)
def test_boundary_friction_stays_below_that_of_bare_asperities(
    contact: Contact, load: float, speed: float, slip: float
) -> None:
    oil = contact[1]
    state = flank_friction(load, speed, slip, *contact, 0)
    area = load / state.mean_pressure
    assert state.boundary_friction <= oil.gamma * load + oil.tau_l0 * area * 0.0150


@given(flanks(), loads, speeds, st.floats(1e-6, 30.0), st.floats(1.001, 3.0))
def test_friction_never_falls_with_sliding_speed(
    contact: Contact, load: float, speed: float, slip: float, factor: float
) -> None:
    slow = flank_friction(load, speed, slip, *contact, 0)
    fast = flank_friction(load, speed, factor * slip, *contact, 0)
    total_slow = slow.viscous_friction + slow.boundary_friction
    # below its maximum the traction grows, on the plateau it is constant; rounding
    assert fast.viscous_friction + fast.boundary_friction >= total_slow * (1.0 - 1e-13)


@given(flanks(), loads, speeds, st.floats(0.01, 30.0))
def test_rougher_flanks_have_more_boundary_friction(
    contact: Contact, load: float, speed: float, slip: float
) -> None:
    geometry, oil, surface, solid = contact
    smooth = flank_friction(load, speed, slip, *contact, 0)
    assume(smooth.film_ratio < 4.9)
    rough_surface = surface._replace(sigma=1.3 * surface.sigma)
    rough = flank_friction(load, speed, slip, geometry, oil, rough_surface, solid, 0)
    assert rough.boundary_friction > smooth.boundary_friction


@given(flanks(), loads, speeds, signed_speeds, forms)
def test_friction_coefficient_is_total_friction_over_load(
    contact: Contact, load: float, speed: float, slip: float, form: int
) -> None:
    state = flank_friction(load, speed, slip, *contact, form)
    total = state.viscous_friction + state.boundary_friction
    # rounding; sliding of 1e-300 m/s and less leaves subnormal numbers with few digits
    assert state.friction_coefficient * load == pytest.approx(total, rel=1e-13, abs=1e-290)
