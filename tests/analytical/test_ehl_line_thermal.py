"""Energy of a line film: conduction, moving surfaces, shear, balance, and its isothermal limit."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.ehl.line.energy import (
    FilmFields,
    SurfaceHeating,
    fill_shear,
    fill_surface_weights,
    march_energy,
)
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.line.thermal import ThermalSettings, solve_thermal_line
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.oil.eyring_1936 import Eyring
from gearlube_core.oil.film_oil import thermal_viscosity
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of, jamali_2015_oil
from gearlube_core.oil.oil_file import OilFile
from gearlube_core.oil.oil_heat import OilHeat
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

T0 = 363.15  # K
OIL = film_oil(
    eta0=0.00625,
    alpha=13.3e-9,
    law="houpert",
    temperature=T0,
    temperature_exponent=1.0,
    heat=OilHeat(expansion=6.5e-4),
    eyring_stress=10e6,
)


def contact(slide_roll: float, **changes) -> LineProblem:
    return thesis_line(slide_roll=slide_roll, **({"lubricant": OIL} | changes))


def uniform_film(n: int, p: float, h: float, slope: float, speed: float) -> FilmFields:
    one = np.ones(n)
    return FilmFields(p * one, slope * one, h * one, 870.0 * one, speed * one, one)


def marched(fields, step, surfaces, oil, heights, old=None):
    n = fields.p.size
    now, before = np.empty(n), np.empty(n)
    fill_surface_weights(step, now, before)
    T, flux = np.empty((n, heights)), np.empty((n, 2))
    tau, eta, heating = np.empty(n), np.empty(n), np.empty(n)
    old = np.full((n, heights), T0) if old is None else old
    march_energy(fields, step, surfaces, oil, now, before, old, T, flux, tau, eta, heating)
    return T, flux, tau, heating


def test_surface_weights_integrate_linear_flux_exactly():
    n, step = 50, 2e-6
    now, before = np.empty(n), np.empty(n)
    fill_surface_weights(step, now, before)
    x = n * step
    assert now.sum() + before.sum() == pytest.approx(2.0 * math.sqrt(x), rel=1e-12)
    # q = s: the interval that ends m nodes upstream runs from x - (m + 1) D to x - m D
    m = np.arange(n)
    rising = (now * (x - m * step) + before * (x - (m + 1) * step)).sum()
    assert rising == pytest.approx(4.0 / 3.0 * x**1.5, rel=1e-12)


def test_developed_film_between_cold_walls_has_the_parabola_of_conduction():
    h, us = 0.2e-6, 2.0
    oil = film_oil(eta0=0.5, alpha=0.0, law="barus", temperature=T0)
    walls = SurfaceHeating(2.0, 4.0, 0.0, 0.0, T0)
    # 400 times the depth h^2 rho c u/k that conduction needs
    T, flux, tau, heating = marched(uniform_film(400, 0.0, h, 0.0, 3.0), 1e-5, walls, oil, 17)
    stress = 0.5 * us / h
    assert tau[-1] == pytest.approx(stress, rel=1e-12)
    assert T[-1, 8] - T0 == pytest.approx(stress * us * h / (8.0 * oil.conductivity), rel=1e-6)
    # half of the heat leaves through each wall
    assert flux[-1] == pytest.approx(0.5 * stress * us, rel=1e-6)
    assert heating[-1] == pytest.approx(stress * us, rel=1e-12)


def test_oil_under_pressure_conducts_and_holds_more_heat():
    p, us = 0.8e9, 2.0
    heat = OilHeat(0.0, 0.137, 2000.0, "mineral")
    oil = film_oil(eta0=0.5, alpha=0.0, law="barus", temperature=T0, heat=heat)
    walls = SurfaceHeating(2.0, 4.0, 0.0, 0.0, T0)
    thin, thick = 0.2e-6, 50e-6
    T, flux, _, _ = marched(uniform_film(400, p, thin, 0.0, 3.0), 1e-5, walls, oil, 17)
    conductivity = 0.137 * (1.0 + 1.72 * 0.8 / (1.0 + 0.54 * 0.8))
    assert T[-1, 8] - T0 == pytest.approx(0.5 * us * us / (8.0 * conductivity), rel=1e-6)
    assert flux[-1] == pytest.approx(0.25 * us * us / thin, rel=1e-6)
    # over the first step of a thick film hardly any heat is conducted: 2e-4 of it
    T = marched(uniform_film(2, p, thick, 0.0, 3.0), 1e-6, walls, oil, 17)[0]
    capacity = oil.rho0 * 2000.0 * (1.0 + 0.47 * 0.8 / (1.0 + 0.81 * 0.8))
    warming = 0.5 * (us / thick) ** 2 * 1e-6 / (capacity * 3.0)
    assert T[1, 8] - T0 == pytest.approx(warming, rel=1e-3)
    sheet = {"name": "a", "base_oil": "pao", "density_kg_m3": 850.0, "viscosity_index": 150.0}
    sheet |= {"viscosity_40_degc_mm2_s": 100.0, "heat_under_pressure": "mineral"}
    lubricant = OilFile.from_data(sheet, "the test").described().lubricant
    assert film_oil_of(lubricant, T0).heat_rise == oil.heat_rise


def test_surfaces_warm_with_the_root_of_the_distance():
    h, n, step = 0.05e-6, 400, 1e-6
    heat = OilHeat(heat_capacity=1e-3)
    oil = film_oil(eta0=0.5, alpha=0.0, law="barus", temperature=T0, heat=heat)
    surfaces = SurfaceHeating(5.0, 6.0, 2e-8, 2e-8, T0)
    T, flux, _, heating = marched(uniform_film(n, 0.0, h, 0.0, 5.5), step, surfaces, oil, 9)
    # like bodies share the heat evenly; an oil without heat capacity carries none away
    assert flux[5:].sum(axis=1) == pytest.approx(heating[5:], rel=1e-5)
    rise = 2.0 * 2e-8 * 0.5 * heating[-1] * math.sqrt((n - 1) * step)
    # the first cell holds half of its heat back: sqrt of half a step in 400
    assert T[-1, 0] - T0 == pytest.approx(rise, rel=5e-3)
    quarter = T[(n - 1) // 4, 0] - T0
    assert (T[-1, 0] - T0) / quarter == pytest.approx(2.0, rel=1e-2)


@pytest.mark.parametrize("limit_slope", [0.0, 0.002], ids=["sheared", "slipping"])
def test_a_broken_film_is_heated_in_its_share_of_full_film(limit_slope):
    oil = OIL._replace(limit_slope=limit_slope)
    film = uniform_film(2, 4e8, 0.3e-6, 1e13, 2.0)._replace(wet=np.array([0.3, 1.0]))
    heat = np.empty((2, 9))
    T = np.full((2, 9), T0)
    for i in range(2):
        fill_shear(T, i, film, 1.5, oil, heat[i])
    assert heat[0] == pytest.approx(0.3 * heat[1], rel=1e-13)
    assert heat[1].max() > 0.0


@each("tau0", [None, 5e6])
@each("slope", [0.0, 3e13, -8e13])
def test_shear_across_an_unevenly_warm_film_slides_as_the_surfaces_do(tau0, slope):
    oil = OIL._replace(shear=Eyring(tau0 or 0.0))
    p, h, us, m = 4e8, 0.3e-6, 1.5, 2001
    z = np.linspace(-0.5, 0.5, m)
    T = (T0 + 30.0 * (1.0 - 4.0 * z * z) + 20.0 * z)[None, :]
    heat = np.empty(m)
    tau, eta = fill_shear(T, 0, uniform_film(1, p, h, slope, 1.0), us, oil, heat)

    def rate(s, mean):
        fluidity = 1.0 / thermal_viscosity(oil, p, T0 + 30.0 * (1.0 - 4.0 * s * s) + 20.0 * s)
        stress = mean + slope * h * s
        return fluidity * (stress if tau0 is None else tau0 * math.sinh(stress / tau0))

    mean = brentq(lambda t: h * quad(rate, -0.5, 0.5, args=(t,))[0] - us, -2e8, 2e8, rtol=1e-12)
    # trapezoidal rule on 2000 cells
    assert tau == pytest.approx(mean, rel=1e-5, abs=10.0)
    work = quad(lambda s: (mean + slope * h * s) * rate(s, mean), -0.5, 0.5)[0]
    assert np.trapezoid(heat, z) == pytest.approx(work, rel=1e-5)

    def pumped(s):
        return 12.0 * s * s / thermal_viscosity(oil, p, T0 + 30.0 * (1.0 - 4.0 * s * s) + 20.0 * s)

    fluidity = quad(pumped, -0.5, 0.5)[0]
    assert eta == pytest.approx(1.0 / fluidity, rel=1e-5)


@pytest.mark.slow
def test_heat_goes_into_the_bodies_and_out_with_the_oil():
    solution = solve_thermal_line(contact(1.0), STEEL, STEEL, LineSettings(nodes=501))
    film = solution.film
    step = film.x[1] - film.x[0]
    taken = solution.flux.sum() * step
    made = solution.heating.sum() * step
    # the oil leaves warm: its flow times its heat capacity and rise, at most the largest
    flow = float(film.mass_flow[250])
    carried = flow * OIL.heat_capacity * (solution.temperature[-1].mean() - T0)
    assert carried < 0.02 * made
    # compression and expansion balance to a few per cent of the heat of shear
    assert taken == pytest.approx(made, rel=0.03)
    # work of the surfaces against mid-film shear, less flow by pressure
    sliding = film.problem.speed_2 - film.problem.speed_1
    assert film.friction_coefficient * 360e3 * sliding == pytest.approx(made, rel=0.03)


@pytest.mark.slow
def test_surfaces_flash_as_jaeger_says_for_a_band_of_heat():
    solution = solve_thermal_line(contact(0.36), STEEL, STEEL, LineSettings(nodes=501))
    film = solution.film
    step = film.x[1] - film.x[0]
    b = film.problem.half_width
    diffusion = STEEL.density * STEEL.heat_capacity * STEEL.conductivity
    for body, speed in enumerate((film.problem.speed_1, film.problem.speed_2)):
        q = solution.flux[:, body].sum() * step / (2.0 * b)
        band = 2.0 * q * math.sqrt(2.0 * b / (math.pi * diffusion * speed))
        rise = solution.surface_temperature[body].max() - T0
        # an even band against one that follows the pressure: within a tenth
        assert rise == pytest.approx(band, rel=0.1)


@pytest.mark.slow
def test_pure_rolling_film_cools_where_it_expands():
    solution = solve_thermal_line(contact(1e-6), STEEL, STEEL, LineSettings(nodes=151))
    still = contact(1e-6, lubricant=OIL._replace(expansion=0.0))
    without = solve_thermal_line(still, STEEL, STEEL, LineSettings(nodes=151))
    # shear by pressure flow alone can only warm; compression and expansion do both
    assert without.temperature.min() >= T0 - 1e-9
    assert solution.temperature.min() < T0 - 0.1


@pytest.mark.slow
def test_heat_lowers_traction_and_more_so_at_more_sliding():
    reductions = []
    for slide_roll in (0.05, 0.36, 1.0):
        warm = solve_thermal_line(contact(slide_roll), STEEL, STEEL, LineSettings(nodes=201))
        cold = solve_line(contact(slide_roll), LineSettings(nodes=201))
        assert warm.converged
        reductions.append(warm.film.friction_coefficient / cold.friction_coefficient)
    assert 1.0 > reductions[0] > reductions[1] > reductions[2] > 0.2


def test_bodies_and_oil_that_conduct_without_limit_leave_the_film_isothermal():
    cold = replace(STEEL, conductivity=3000.0, heat_capacity=5000.0, density=3e4)
    problem = contact(0.36, lubricant=OIL._replace(conductivity=1e4))
    warm = solve_thermal_line(problem, cold, cold, LineSettings(nodes=301))
    isothermal = solve_line(problem, LineSettings(nodes=301))
    # bodies (4.5e11/1.7e8)^(1/2) = 51 times better than steel at taking heat up: 16 K/51, and
    # what the steeper traction of the cold film adds
    assert warm.max_temperature - T0 < 0.6
    assert warm.film.central_film == pytest.approx(isothermal.central_film, rel=1e-3)
    assert warm.film.friction_coefficient == pytest.approx(
        isothermal.friction_coefficient, rel=1e-2
    )


@pytest.mark.slow
def test_temperature_does_not_depend_on_the_grids():
    base = solve_thermal_line(contact(1.0), STEEL, STEEL, LineSettings(nodes=301))
    fine = solve_thermal_line(
        contact(1.0), STEEL, STEEL, LineSettings(nodes=601), ThermalSettings(heights=33)
    )
    assert base.max_temperature - T0 == pytest.approx(fine.max_temperature - T0, rel=0.01)
    assert base.film.friction_coefficient == pytest.approx(fine.film.friction_coefficient, rel=0.01)


@pytest.mark.slow
def test_reversed_motion_mirrors_the_temperatures():
    forward = contact(0.36, domain=(-1.0e-3, 0.38e-3))
    backward = replace(
        forward, speed_1=-forward.speed_1, speed_2=-forward.speed_2, domain=(-0.38e-3, 1.0e-3)
    )
    one = solve_thermal_line(forward, STEEL, STEEL, LineSettings(nodes=201))
    other = solve_thermal_line(backward, STEEL, STEEL, LineSettings(nodes=201))
    # within the tolerance of the turns
    assert other.temperature[::-1] == pytest.approx(one.temperature, abs=5e-3)
    assert other.film.friction_coefficient == pytest.approx(
        -one.film.friction_coefficient, rel=1e-4
    )


def test_what_the_reduced_form_cannot_do_is_refused():
    with pytest.raises(ParameterError, match="both surfaces"):
        solve_thermal_line(contact(2.5), STEEL, STEEL)
    with pytest.raises(ParameterError, match="houpert"):
        solve_thermal_line(contact(0.3, lubricant=jamali_2015_oil()), STEEL, STEEL)
    with pytest.raises(ConvergenceError, match="relaxation"):
        solve_thermal_line(
            contact(1.0), STEEL, STEEL, LineSettings(nodes=201), ThermalSettings(max_turns=2)
        )
