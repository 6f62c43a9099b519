"""What must hold of a flank with a thermal Eyring film at every load, speed and option."""

import math
from itertools import product

import numpy as np
import pytest

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.errors import ParameterError
from gearlube_core.film import grubin_1949
from gearlube_core.friction import (
    flank_data,
    friction_torques,
    johnson_greenwood_1980,
    thermal_eyring_data,
    thermal_eyring_flank,
)
from gearlube_core.friction.thermal_eyring_data import (
    CIRCULAR,
    ELLIPTICAL,
    FILM_TEMPERATURES,
    ThermalEyringOptions,
    ThermalFlankState,
    grubin_contact_geometry,
    thermal_eyring_oil,
    thermal_eyring_options,
)
from gearlube_core.oil import houpert_1985
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.each import each

SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
E_STAR = SOLID.contact_modulus
SURFACE = SurfaceParameters(0.5e-6, 0.055, 0.001)
LUBRICANT = Lubricant.named("karagiannis_2012")
LAW = houpert_1985.houpert_parameters(LUBRICANT)
OILS = {T: thermal_eyring_oil(LAW, LUBRICANT.parameters(), T) for T in (313.15, 373.15)}
GEOMETRY = grubin_contact_geometry(0.018, 1.5, 0.8, E_STAR, ELLIPTICAL)
CONVENTION = grubin_1949.grubin_convention("consistent", E_STAR)
OPTIONS = [
    thermal_eyring_options(E_STAR, "consistent", temperature, flash)
    for temperature, flash in product(FILM_TEMPERATURES, (False, True))
]


def flank(
    load: float,
    rolling: float,
    sliding: float,
    options: ThermalEyringOptions = OPTIONS[0],
    temperature: float = 313.15,
) -> ThermalFlankState:
    return thermal_eyring_flank.thermal_eyring_flank(
        load, rolling, sliding, GEOMETRY, OILS[temperature], SURFACE, SOLID, options
    )


@each("options", OPTIONS)
@each("temperature", OILS)
def test_every_operating_point_converges_to_bounded_friction(
    options: ThermalEyringOptions, temperature: float
) -> None:
    loads, speeds = (0.0, 1e-3, 1.0, 300.0, 2400.0, 2e4), (0.0, 1e-3, 0.3, 5.0, 60.0)
    for load, rolling, slide in product(loads, speeds, (0.0, 1e-9, 1e-3, 0.1, 0.7, 2.0)):
        slip = slide * rolling
        state = flank(load, rolling, slip, options, temperature)
        assert state.status == 0.0, (load, rolling, slip)
        assert np.all(np.isfinite(state))
        assert min(state) >= 0.0
        assert state.asperity_load <= load
        # heat only weakens a film: no more than the stress between cold surfaces without heat
        eta = houpert_1985.houpert_viscosity(LAW, state.mean_pressure, temperature)
        isothermal = math.asinh(eta * slip / (state.film_thickness * 2e6)) * 2e6
        # rounding
        assert state.shear_stress <= isothermal * (1.0 + 1e-12)


@each("options", OPTIONS)
def test_reported_temperatures_are_a_solution(options: ThermalEyringOptions) -> None:
    state = flank(2000.0, 5.0, 3.2, options)
    oil = OILS[313.15]
    log = houpert_1985.houpert_log_viscosity(LAW, state.mean_pressure, 313.15 + state.flash)
    beta = houpert_1985.houpert_temperature_coefficient(LAW, log, 313.15 + state.flash)
    film = johnson_greenwood_1980.thermal_eyring_film(
        log - 9.67, beta, oil.conductivity, oil.tau0, state.film_thickness, 3.2
    )
    # left over by the search for temperatures: far below 1 mK
    assert state.shear_stress == pytest.approx(film.stress_ratio * oil.tau0, rel=1e-9)
    assert state.rise_effective == pytest.approx(film.rise_effective, rel=1e-8)
    if options.flash:
        flux = (state.viscous_friction + state.boundary_friction) * 3.2 / state.area
        R_e, E_reduced = GEOMETRY.R_e, 2.0 * E_STAR
        e2 = SOLID.conductivity * SOLID.density * SOLID.heat_capacity
        half_width = 16.0 / math.pi * state.mean_pressure * R_e / E_reduced
        # band source, half of the heat to each surface
        moving = flux / 2.0 * 4.0 / 3.0 * math.sqrt(2.0 * half_width / (math.pi * e2 * 5.0))
        # the stationary limit joined to it lowers the rise by 1 % at this Peclet number
        assert state.flash == pytest.approx(moving, rel=0.02)
    else:
        assert state.flash == 0.0
    temperature = 313.15
    if options.film_temperature == thermal_eyring_data.EFFECTIVE:
        temperature += state.flash + state.rise_effective
    eta = houpert_1985.houpert_viscosity(LAW, 0.0, temperature)
    # alpha = 5.1e-9 Z (ln eta + 9.67) at the temperature of the film, by hand
    alpha = 5.1e-9 * LAW.Z * (math.log(eta) + 9.67)
    h = grubin_1949.grubin_film_thickness(
        GEOMETRY.R_e, GEOMETRY.side_flow, eta, alpha, 5.0, 2000.0, CONVENTION
    )
    if options.film_temperature == thermal_eyring_data.INLET_SHEAR_HEATING:
        beta_0 = LAW.S0 * (math.log(eta) + 9.67) / (temperature - 138.0)
        h *= grubin_1949.inlet_heating_factor(
            eta, beta_0, oil.conductivity, 5.0, 3.2, 1.5 * state.mean_pressure, 2.0 * E_STAR
        )
    # as below
    assert state.film_thickness == pytest.approx(h, rel=1e-6)
    # last step of the search 1 mK, its error far smaller
    assert state.inlet_viscosity == pytest.approx(eta, rel=1e-6)


def test_heat_thins_films_and_lowers_traction() -> None:
    inlet, inlet_flash, effective, effective_flash, sheared, _ = (
        flank(2000.0, 5.0, 3.2, options) for options in OPTIONS
    )
    assert inlet_flash.shear_stress < inlet.shear_stress
    assert inlet_flash.film_thickness == inlet.film_thickness
    assert effective_flash.film_thickness < effective.film_thickness < inlet.film_thickness
    assert sheared.film_thickness < inlet.film_thickness


@each("options", OPTIONS)
def test_smooth_in_speed_and_load(options: ThermalEyringOptions) -> None:
    # differences of differences show steps left by iterations
    for position, start, step in ((0, 1500.0, 1.0), (1, 5.0, 1e-3), (2, 3.0, 1e-3)):
        point = [2000.0, 5.0, 3.2]
        values = []
        for i in range(40):
            point[position] = start + i * step
            values.append(flank(*point, options).friction_coefficient)
        curvature = np.diff(values, 2)
        # curvature of a smooth curve is steady; 1e-9 of mu is what a search may leave
        assert np.max(np.abs(curvature - curvature.mean())) < 1e-8 * values[0]


def test_film_and_pressure_follow_powers_of_load() -> None:
    low, high = flank(500.0, 5.0, 3.0), flank(1000.0, 5.0, 3.0)
    # power laws: rounding
    assert math.log2(high.film_thickness / low.film_thickness) == pytest.approx(-1 / 12, abs=1e-12)
    assert math.log2(high.mean_pressure / low.mean_pressure) == pytest.approx(1 / 3, abs=1e-12)
    assert low.area * low.mean_pressure == pytest.approx(500.0, rel=1e-13)


def test_friction_grows_with_load_and_stress_with_pressure() -> None:
    states = [flank(float(W), 5.0, 3.0) for W in np.geomspace(1.0, 5000.0, 40)]
    assert np.all(np.diff([s.viscous_friction for s in states]) > 0.0)
    assert np.all(np.diff([s.shear_stress for s in states]) > 0.0)
    assert np.all(np.diff([s.rise_effective for s in states]) > 0.0)


def test_forces_add_up() -> None:
    state = flank(2000.0, 1.0, 0.7, temperature=373.15)
    oil = OILS[373.15]
    smooth = state.area - state.asperity_area
    assert state.viscous_friction == pytest.approx(state.shear_stress * smooth, rel=1e-13)
    boundary = oil.tau_l0 * state.asperity_area + 0.17 * state.asperity_load
    # tanh of 700 is 1
    assert state.boundary_friction == pytest.approx(boundary, rel=1e-13)
    total = state.viscous_friction + state.boundary_friction
    assert state.friction_coefficient == pytest.approx(total / 2000.0, rel=1e-13)
    assert state.film_ratio == pytest.approx(state.film_thickness / 0.5e-6, rel=1e-14)


def test_friction_vanishes_with_sliding_and_load() -> None:
    assert flank(1000.0, 5.0, 0.0).friction_coefficient == 0.0
    assert flank(0.0, 5.0, 3.0).viscous_friction == 0.0
    assert flank(-5.0, 5.0, 3.0).boundary_friction == 0.0
    slow = [flank(1000.0, 0.05, slip).friction_coefficient for slip in (1e-9, 2e-9)]
    # both terms are linear at rest
    assert slow[1] == pytest.approx(2.0 * slow[0], rel=1e-6)


def test_direction_of_sliding_does_not_matter_to_magnitudes() -> None:
    forth, back = flank(1000.0, 5.0, 2.0), flank(1000.0, -5.0, -2.0)
    assert forth._replace(sliding_speed=0.0, entrainment_speed=0.0) == back._replace(
        sliding_speed=0.0, entrainment_speed=0.0
    )


def test_friction_never_feeds_the_gears() -> None:
    rng = np.random.default_rng(8)
    for _ in range(300):
        w_p, w_g = rng.uniform(-400, 400, 2)
        arm_p, arm_g = rng.uniform(-0.04, 0.04, 2)
        u, dU = friction_torques.flank_speeds(w_p, w_g, arm_p, arm_g)
        assert u == pytest.approx(0.5 * (w_p * arm_p + w_g * arm_g), abs=1e-12)
        f = flank(800.0, u, dU)
        force = f.viscous_friction + f.boundary_friction
        Q_p, Q_g, power = friction_torques.friction_torques(force, dU, arm_p, arm_g)
        # rounding of products of order 1 kW
        assert Q_p * w_p + Q_g * w_g == pytest.approx(-power, abs=1e-9)
        assert power == pytest.approx(force * abs(dU), rel=1e-14)
        assert power >= 0.0


def test_circular_pressure_is_load_over_the_area_of_the_equivalent_circle() -> None:
    R_x, R_y, W = 0.01, 0.5, 1200.0
    printed = thermal_eyring_data.circular_pressure_coefficient(R_x, R_y, E_STAR) * W ** (1 / 3)
    area = math.pi * (3.0 * W * math.sqrt(R_x * R_y) / (4.0 * E_STAR)) ** (2.0 / 3.0)
    # identity
    assert printed == pytest.approx(W / area, rel=1e-13)
    elliptical = flank_data.contact_geometry(R_x, R_y, 0.0, E_STAR).pressure_coefficient
    # 37 % between a circle and an ellipse of R_y/R_x = 50
    assert elliptical * W ** (1 / 3) / printed == pytest.approx(1.37, abs=0.01)
    circle = grubin_contact_geometry(0.02, 0.02, 0.0, E_STAR, CIRCULAR)
    ellipse = grubin_contact_geometry(0.02, 0.02, 0.0, E_STAR, ELLIPTICAL)
    assert circle.pressure_coefficient == pytest.approx(ellipse.pressure_coefficient, rel=1e-12)


def test_unknown_film_temperature_is_refused() -> None:
    with pytest.raises(ParameterError, match="inlet_shear_heating"):
        thermal_eyring_options(E_STAR, film_temperature="outlet")


def test_compiled_kernel_equals_its_python_function() -> None:
    """For all options; those of the torsional pair are interpreted to the last call elsewhere."""
    for options in OPTIONS:
        arguments = (1000.0, 5.0, 3.0, GEOMETRY, OILS[313.15], SURFACE, SOLID, options)
        compiled = thermal_eyring_flank.thermal_eyring_flank(*arguments)
        source = thermal_eyring_flank.thermal_eyring_flank.py_func(*arguments)
        # roundings, magnified by the logarithms of the root
        np.testing.assert_allclose(compiled, source, rtol=1e-12)


@pytest.mark.parametrize("position", [0, 1, 2])
def test_a_non_number_in_the_motion_is_not_hidden(position: int) -> None:
    motion = [1000.0, 5.0, 3.0]
    motion[position] = float("nan")
    for options in OPTIONS:
        state = flank(*motion, options)
        assert math.isnan(state.viscous_friction)
        assert state.status == 1.0
