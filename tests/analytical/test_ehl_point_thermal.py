"""Heat in a point contact: line limit, balances, symmetry, isothermal limit, flash temperature."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015 as STEEL
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.thermal import solve_thermal_line
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import EllipticParaboloid, PointContactProblem
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.thermal.solver import PointThermalSettings, solve_thermal_point
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.oil_heat import OilHeat

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
ENTRAINED = (4.0, 1.0)
SLID = (1.5, -1.0)


def contact(entrainment=ENTRAINED, sliding=SLID, nodes=(33, 33), **changes):
    problem = elliptical_contact(
        R_x=0.012,
        R_y=0.02,
        entrainment=entrainment,
        load=150.0,
        contact_modulus=115e9,
        lubricant=OIL,
        nodes=nodes,
        sliding=sliding,
    )
    return replace(problem, **changes)


@pytest.fixture(scope="module")
def warm():
    return solve_thermal_point(contact(), STEEL, STEEL)


@pytest.mark.slow
def test_middle_of_a_long_contact_is_the_lines_film():
    u, slip, modulus, radius = 6.71, 2.42, 227.5e9, 0.014
    line = LineProblem(
        lubricant=OIL,
        radius=radius,
        line_load=360e3,
        reduced_modulus=modulus,
        speed_1=u + 0.5 * slip,
        speed_2=u - 0.5 * slip,
        domain=(-1.0e-3, 0.5e-3),
    )
    expected = solve_thermal_line(line, STEEL, STEEL, LineSettings(nodes=501))
    shape = EllipticParaboloid(radius, 400.0 * radius)

    def ellipse(load: float) -> PointContactProblem:
        return PointContactProblem(
            gap=shape,
            entrainment=(u, 0.0),
            load=load,
            contact_modulus=0.5 * modulus,
            lubricant=OIL,
            x_limits=(-1.0e-3, 0.5e-3),
            y_limits=(-0.0125, 0.0125),
            nodes=(129, 49),
            hertz=shape,
            sliding=(-slip, 0.0),
        )

    load = brentq(lambda w: ellipse(w).hertz_contact[2] - line.hertz_pressure, 1e2, 1e5)
    found = solve_thermal_point(ellipse(load), STEEL, STEEL)
    middle, x = found.temperature[:, 24], found.film.problem.x
    rise = expected.max_temperature - T0
    # 40:1 and 129 nodes against a line on 501; both walls and the middle
    assert middle.max() - T0 == pytest.approx(rise, rel=0.015)
    for wall, given in zip((0, -1), expected.surface_temperature, strict=True):
        assert middle[:, wall].max() - T0 == pytest.approx(given.max() - T0, rel=0.015)
    force = np.trapezoid(found.mean_stress[:, 24], x)
    assert force == pytest.approx(
        -np.trapezoid(expected.film.mean_stress, expected.film.x), rel=0.015
    )
    film = float(np.interp(0.0, x, found.film.film[:, 24]))
    # 20 nodes of a coarse inlet in a half width
    assert film == pytest.approx(expected.film.central_film, rel=0.03)


@pytest.mark.slow
def test_heat_of_shear_goes_into_the_bodies_and_out_with_the_oil(warm):
    problem = warm.film.problem
    cell = (problem.x[1] - problem.x[0]) * (problem.y[1] - problem.y[0])
    made = warm.heating.sum() * cell
    assert warm.balances[-1] <= 1e-6
    # the oil carries little away, compression and expansion cancel to a few per cent
    assert warm.flux.sum() * cell == pytest.approx(made, rel=0.04)
    # what sliding works against mid-film shear, but for flow by pressure and the broken film
    assert warm.friction_force * math.hypot(*SLID) == pytest.approx(made, rel=0.03)


@pytest.mark.slow
def test_contact_turned_and_mirrored_is_as_warm(warm):
    limits = warm.film.problem.x_limits, warm.film.problem.y_limits
    turned = contact(
        entrainment=(-ENTRAINED[1], ENTRAINED[0]),
        sliding=(-SLID[1], SLID[0]),
        gap=EllipticParaboloid(0.02, 0.012),
        hertz=EllipticParaboloid(0.02, 0.012),
        x_limits=(-limits[1][1], -limits[1][0]),
        y_limits=limits[0],
    )
    other = solve_thermal_point(turned, STEEL, STEEL)
    # x, y of the first is y, -x of the other; the order of the sweeps is the same
    assert other.temperature[::-1].transpose(1, 0, 2) == pytest.approx(warm.temperature, abs=1e-3)
    assert other.friction_force == pytest.approx(warm.friction_force, rel=1e-5)


@pytest.mark.slow
def test_bodies_change_places_with_the_sense_of_sliding(warm):
    other = solve_thermal_point(contact(sliding=(-SLID[0], -SLID[1])), STEEL, STEEL)
    assert other.temperature[..., ::-1] == pytest.approx(warm.temperature, abs=1e-3)
    assert other.film.film == pytest.approx(warm.film.film, rel=1e-4)


@pytest.mark.slow
def test_slow_rolling_film_is_isothermal():
    slow = contact(entrainment=(0.02, 0.0), sliding=(0.0, 0.0), nodes=(49, 49))
    found = solve_thermal_point(slow, STEEL, STEEL)
    cold = solve_point_contact(slow)
    # heat of compression and of flow by pressure grow with the square of the speed
    assert abs(found.temperature - T0).max() < 0.05
    # 0.05 K thin the oil by 0.2 %, which is the most that the film can lose
    assert found.film.film == pytest.approx(cold.film, rel=2e-3)


@pytest.mark.slow
def test_surfaces_flash_as_half_spaces_under_the_heat_that_enters(warm):
    # Carslaw and Jaeger along each surface's own motion, here nearly along x: fast, one way
    straight = solve_thermal_point(
        contact(entrainment=(8.0, 0.0), sliding=(3.0, 0.0)), STEEL, STEEL
    )
    problem = straight.film.problem
    x, row = problem.x, 16
    step = x[1] - x[0]
    for body, speed in enumerate((6.5, 9.5)):
        q = straight.flux[body][:, row]
        diffusion = math.pi * STEEL.density * STEEL.heat_capacity * STEEL.conductivity * speed
        rise = [
            # cells of even heat: integral of (x - s)^(-1/2) over each
            2.0
            * sum(
                q[m] * (math.sqrt((i - m + 0.5) * step) - math.sqrt(max(i - m - 0.5, 0.0) * step))
                for m in range(i + 1)
            )
            / math.sqrt(diffusion)
            for i in range(x.size)
        ]
        found = straight.surface_temperature[body][:, row] - T0
        # Peclet number 50: the half cell at the node, conduction sideways
        assert found.max() == pytest.approx(max(rise), rel=0.04)


@pytest.mark.slow
def test_friction_passes_a_maximum_over_sliding_and_cold_friction_does_not():
    warm, cold = [], []
    cool = replace(STEEL, conductivity=3000.0, heat_capacity=5000.0, density=3e4)
    for ratio in (0.05, 0.3, 1.5):
        case = contact(entrainment=(4.0, 0.0), sliding=(4.0 * ratio, 0.0))
        warm.append(solve_thermal_point(case, STEEL, STEEL).friction_coefficient)
        still = replace(case, lubricant=OIL._replace(conductivity=1e4))
        cold.append(solve_thermal_point(still, cool, cool).friction_coefficient)
    assert warm[1] > warm[0]
    assert warm[2] < warm[1]
    assert cold[0] < cold[1] < cold[2]


@pytest.mark.slow
def test_heights_across_the_film_are_enough(warm):
    fine = solve_thermal_point(contact(), STEEL, STEEL, thermal=PointThermalSettings(heights=41))
    # the trapezoidal rule on 12 cells
    assert warm.max_temperature - T0 == pytest.approx(fine.max_temperature - T0, rel=0.005)
    assert warm.friction_coefficient == pytest.approx(fine.friction_coefficient, rel=1e-3)


def test_what_it_cannot_do_is_refused():
    with pytest.raises(ParameterError, match="sliding"):
        solve_thermal_point(contact(sliding=None), STEEL, STEEL)
    with pytest.raises(ParameterError, match="houpert"):
        solve_thermal_point(
            contact(lubricant=OIL._replace(viscosity=OIL.viscosity._replace(S0=0.0))), STEEL, STEEL
        )
    with pytest.raises(ConvergenceError, match="turns"):
        solve_thermal_point(contact(), STEEL, STEEL, thermal=PointThermalSettings(max_turns=2))
