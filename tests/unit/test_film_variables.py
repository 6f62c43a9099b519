"""Every variable of a film: known answers, steady and in time."""

import math

import numpy as np

from gearlube.studies.films.datasets import contact, helical
from gearlube.studies.films.datasets.helical import (
    CycleLines,
    cycle_dataset,
    with_steady_film,
    with_steady_points,
)
from gearlube.studies.films.film_formulas import FilmFormula
from gearlube.studies.films.run_march import compare_marches
from gearlube_core.ehl.line.thermal import ThermalLineSolution
from gearlube_core.ehl.point.thermal.solver import ThermalPointSolution
from gearlube_core.ehl.point.traction import PointTraction
from gearlube_core.ehl.transient.curves import FilmCurves
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named
from tests.helpers.made_films import ERROR, ERRORS, NUMBERS, THIN, a_film, fields

FORMULAS = [FilmFormula("central film", "A 1990", 3e-7, 0.01), FilmFormula("b", "B", 2e-7, 0.02)]
OF_FORMULAS = {
    "formula_film": ("m", [3e-7, 2e-7]),
    "formula_film_over_radius": ("1", [3e-5, 1e-5]),
    "formula_quantity": ("", ["central film", "b"]),
    "formula_source": ("", ["A 1990", "B"]),
}


def test_variables_of_a_line_film_are_known(monkeypatch):
    """Dry pressure and gap at X = 0, 3/5, 1 and 5/3 of the half-width: 5/3 4/3 - ln 3."""
    monkeypatch.setattr(contact, "line_film_formulas", lambda problem: FORMULAS)
    units = dict.fromkeys(("pressure", "mean_stress", "stress_1", "stress_2"), "Pa")
    units |= {"film": "m", "void": "1", "viscosity": "Pa s", "density": "kg/m3"}
    values, expected = fields(units, 4)
    numbers = {
        name: made_up(name)
        for name in ("maximum_pressure", "central_film", "minimum_film", "friction_coefficient",
                     "residual", "load_error")
    }  # fmt: skip
    problem = named(
        half_width=3e-4, hertz_pressure=1e9, radius=0.01, line_load=2e5, reduced_modulus=2e11,
        speed_1=3.0, speed_2=2.0, lubricant=named(temperature=333.0),
        groups=lambda: named(_asdict=lambda: {"U": 1.1, "W": 1.2}),
    )  # fmt: skip
    history = named(residual=[0.5, 0.25], load_error=[0.3, 0.2])
    film = named(
        **values, **numbers, problem=problem, x=3e-4 * np.array([0.0, 0.6, 1.0, 5.0 / 3.0]),
        mass_flow=made_up("flow", 3), friction=(7.0, -9.0), beyond=named(load=5e3),
        records=[(5, history), (9, named(residual=[]))], error=ERROR, converged=True, outcome="so",
    )  # fmt: skip
    expected |= OF_FORMULAS | {
        "mass_flow": ("kg/(m s)", made_up("flow", 3)),
        "hertz_pressure": ("Pa", [1e9, 0.8e9, 0.0, 0.0]),
        "hertz_gap": ("m", [0.0, 0.0, 0.0, 9e-8 / 0.02 * (20.0 / 9.0 - math.log(3.0))]),
        "x": ("m", film.x),
        "x_face": ("m", [9e-5, 2.4e-4, 4e-4]),
        "residual_history": ("1", [0.5, 0.25]),
        "load_error_history": ("1", [0.3, 0.2]),
        "nodes_history": ("1", [5.0, 5.0]),
    }
    made = contact.line_dataset(film, seconds=3.0)
    assert_variables(made, expected)
    known = {
        "radius": 0.01, "line_load": 2e5, "reduced_modulus": 2e11, "speed_1": 3.0, "speed_2": 2.0,
        "half_width": 3e-4, "hertz_pressure_max": 1e9, "group_U": 1.1, "group_W": 1.2,
        "pressure_max": numbers["maximum_pressure"], "friction_1": 7.0, "friction_2": -9.0,
        "temperature_inlet": 333.0, "load_beyond": 0.025, "iterations": 2, "seconds": 3.0,
        "turns": 0, "converged": 1, **ERRORS,
    } | {name: one for name, one in numbers.items() if name != "maximum_pressure"}  # fmt: skip
    assert_attributes(made, known)
    warm = ThermalLineSolution(
        film=named(**vars(film), nodes=(9,), numbers=NUMBERS, formal_order=2.0),
        temperature=300.0 + made_up("T", 4, 3), flux=made_up("flux", 4, 2), heating=np.zeros(4),
        changes=(2.0, 0.5), converged=False, outcome="not",
    )  # fmt: skip
    heated = {
        "height": ("1", [0.0, 0.5, 1.0]),
        "temperature": ("K", warm.temperature),
        "heat_flux_1": ("W/m2", warm.flux[:, 0]),
        "heat_flux_2": ("W/m2", warm.flux[:, 1]),
        "temperature_change": ("K", [2.0, 0.5]),
    }
    made = contact.line_dataset(warm)
    assert_variables(made, expected | heated)
    known = {"temperature_max": warm.temperature.max(), "turns": 2, "converged": 0}
    assert_attributes(made, known)


def test_variables_of_a_point_film_are_known(monkeypatch):
    """Dry pressure at the centre and at 3/5 of one and of both semi-axes."""
    shape = (2, 3)
    monkeypatch.setattr(contact, "point_film_formulas", lambda problem: FORMULAS)
    units = {"viscosity": "Pa s", "density": "kg/m3", "mean_stress": "Pa"}
    shear, expected = fields(units, *shape)
    monkeypatch.setattr(
        contact, "point_traction", lambda *_, **__: PointTraction(**shear, force=9.0)
    )
    values, own = fields({"pressure": "Pa", "film": "m", "fill": "1"}, *shape)
    problem = named(
        entrainment=(3.0, 4.0), sliding=(0.5, 0.25), hertz_contact=(2e-4, 4e-4, 1e9),
        x=2e-4 * np.array([0.0, 0.6]), y=4e-4 * np.array([0.0, 0.6, 0.8]), sides="ambient",
        lubricant=THIN._replace(temperature=333.0), hertz=named(R_x=0.01, R_y=0.03), load=100.0,
        contact_modulus=1e11,
    )  # fmt: skip
    outcome = named(
        residual=0.001, load_error=0.002, beyond=0.003, wedge="central", converged=True,
        sentence="so",
    )  # fmt: skip
    film = named(
        **values, problem=problem, outcome=outcome, residuals=(0.5, 0.125), krylov_steps=11,
        seconds=13.0, maximum_pressure=2e9, central_film=3e-7, minimum_film=2e-7, error=ERROR,
    )  # fmt: skip
    dry = np.sqrt(np.maximum([[1.0, 0.64, 0.36], [0.64, 0.28, 0.0]], 0.0))
    expected |= (
        own
        | OF_FORMULAS
        | {
            "hertz_pressure": ("Pa", 1e9 * dry),
            "residual_history": ("1", [0.5, 0.125]),
            "x": ("m", [0.0, 1.2e-4]),
            "y": ("m", [0.0, 2.4e-4, 3.2e-4]),
        }
    )
    made = contact.point_dataset(film)
    assert_variables(made, expected)
    known = {
        "radius_x": 0.01, "radius_y": 0.03, "load": 100.0, "reduced_modulus": 2e11,
        "entrainment_x": 3.0, "entrainment_y": 4.0, "sliding_x": 0.5, "sliding_y": 0.25,
        "semi_axis_x": 2e-4, "semi_axis_y": 4e-4, "hertz_pressure_max": 1e9, "pressure_max": 2e9,
        "central_film": 3e-7, "minimum_film": 2e-7, "friction_coefficient": 0.09,
        "friction_force": 9.0, "temperature_inlet": 333.0, "residual": 0.001, "load_error": 0.002,
        "load_beyond": 0.003, "iterations": 2, "krylov_steps": 11, "seconds": 13.0, "turns": 0,
        "converged": 1, **ERRORS,
    }  # fmt: skip
    assert_attributes(made, known)
    warm = ThermalPointSolution(
        film=named(**vars(film), nodes=shape, numbers=NUMBERS, formal_order=2.0),
        temperature=300.0 + made_up("T", *shape, 3), flux=made_up("flux", 2, *shape),
        heating=made_up("heat", *shape), **shear, balances=(0.5, 0.25), converged=False,
        outcome="not", seconds=5.0,
    )  # fmt: skip
    heated = {
        "height": ("1", [0.0, 0.5, 1.0]),
        "temperature": ("K", warm.temperature),
        "temperature_1": ("K", warm.temperature[..., 0]),
        "temperature_middle": ("K", warm.temperature[..., 1]),
        "temperature_2": ("K", warm.temperature[..., 2]),
        "heat_flux_1": ("W/m2", warm.flux[0]),
        "heat_flux_2": ("W/m2", warm.flux[1]),
        "heating": ("W/m2", warm.heating),
        "heat_balance_history": ("1", [0.5, 0.25]),
    }
    made = contact.point_dataset(warm)
    assert_variables(made, expected | heated)
    known = {"temperature_max": warm.temperature.max(), "turns": 1, "heat_balance": 0.25}
    assert_attributes(made, known)


def test_variables_of_a_helical_film_are_known(monkeypatch):
    """Oil of one viscosity: the shear stress is eta (u2 - u1)/h, of both signs along the line."""
    film = a_film()
    monkeypatch.setattr(helical, "line_of_step", lambda steps, step: (1e-3 * step, 2e-3))
    middle = named(half_width=3e-4, hertz_pressure=9e8)
    monkeypatch.setattr(helical, "_middle_line", lambda *_: middle)
    monkeypatch.setattr(helical, "line_film_formulas", lambda problem: FORMULAS)
    first, second = np.array([5.0, 4.0, 3.0, 2.0]), np.array([3.0, 3.5, 4.0, 4.5])
    of = named(
        steps=None, surface_speeds=lambda y, X: (first, second), lubricant=THIN,
        load=lambda X: 1e5 * X, gap=lambda x, y, X: X * film.film, torque=300.0, pinion_speed=200.0,
        convention="normal", contact_modulus=1e11,
    )  # fmt: skip
    stress = 0.01 * (second - first) / film.film
    across = 1e-4 * (0.5 * stress[0] + stress[1] + 0.5 * stress[2])
    ends = 1e-3 * np.array([0.5, 1.0, 1.0, 0.5])
    made = helical.helical_dataset(of, 4.0, film)
    expected = OF_FORMULAS | {
        "pressure": ("Pa", film.pressure),
        "film": ("m", film.film),
        "gap": ("m", 2e-3 * film.film),
        "mean_stress": ("Pa", stress),
        "speed_1": ("m/s", first),
        "speed_2": ("m/s", second),
        "x": ("m", film.x),
        "y": ("m", film.y),
    }
    assert_variables(made, expected)
    known = {
        "step": 4.0, "position": 4e-3, "line": 2e-3, "torque": 300.0, "pinion_speed": 200.0,
        "load": 200.0, "reduced_modulus": 2e11, "half_width": 3e-4, "hertz_pressure_max": 9e8,
        "pressure_max": 3e8, "pressure_max_x": -1e-4, "pressure_max_y": 1e-3,
        "central_film": film.film[1, 2], "minimum_film": 0.9e-7, "minimum_film_x": 1e-4,
        "minimum_film_y": 0.0, "loaded_length": 3e-3,
        "friction_coefficient": (np.abs(across) * ends).sum() / 200.0,
        "friction_force": (across * ends).sum(),
        "sliding_power": (across * (second - first) * ends).sum(), "residual": 0.02,
        "load_error": 0.01, "iterations": 7, "krylov_steps": 30, "seconds": 11.0, "converged": 1,
    }  # fmt: skip
    assert_attributes(made, known)
    rest = named(pressure=2.0 * film.pressure, film=3.0 * film.film, converged=True, outcome="so")
    beside = {"steady_pressure": ("Pa", 2.0 * film.pressure), "steady_film": ("m", 3.0 * film.film)}
    assert_variables(with_steady_film(made, rest), expected | beside)


def test_variables_of_a_helical_cycle_are_known():
    """Four steps; lines of two of them, a steady film at one."""
    units = dict.fromkeys(
        ("load_error", "converged", "newton_steps", "krylov_steps", "time_error",
         "time_error_pressure"), "1",
    )  # fmt: skip
    units |= dict.fromkeys(
        ("pressure_max_y", "minimum_film", "minimum_film_x", "minimum_film_y", "loaded_length"), "m"
    )
    units |= {"load": "N", "pressure_max": "Pa", "seconds": "s"}
    values, expected = fields(units, 4)
    step = np.array([3.0, 4.0, 5.0, 6.0])
    curves = FilmCurves(("step", *units), np.column_stack([step, *values.values()]), {})
    lines = CycleLines()
    for k in (1, 3):
        lines.add(int(step[k]), named(y=np.arange(2.0), pressure=k * np.array([[3.0, 5.0], [7, 2]]),
                                      film=k * np.array([[6.0, 4.0], [5.0, 9.0]])))  # fmt: skip
    of = named(
        steps=named(position=lambda steps: 1e-3 * steps), torque=300.0, pinion_speed=200.0,
        convention="normal", time_step=1e-6, nodes=(9, 5), grading=(),
    )  # fmt: skip
    none = [math.nan, math.nan]
    expected |= {
        "step": ("1", step),
        "position": ("m", 1e-3 * step),
        "y": ("m", [0.0, 1.0]),
        "line_pressure": ("Pa", [none, [7.0, 5.0], none, [21.0, 15.0]]),
        "line_film": ("m", [none, [5.0, 4.0], none, [15.0, 12.0]]),
    }
    made = cycle_dataset(of, curves, lines, start=named(error=ERROR))
    assert_variables(made, expected)
    largest = values["time_error"].max()
    known = {
        "torque": 300.0, "pinion_speed": 200.0, "time_step": 1e-6, "nodes_across": 9,
        "nodes_along": 5, "spacing_across": "uniform", "largest_time_error": largest, "failures": 0,
        "converged": 1, **ERRORS,
    }  # fmt: skip
    assert_attributes(made, known)
    steady = with_steady_points(made, {5: named(maximum_pressure=3e8, minimum_film=2e-7)})
    points = {
        "steady_pressure_max": ("Pa", [math.nan, math.nan, 3e8, math.nan]),
        "steady_minimum_film": ("m", [math.nan, math.nan, 2e-7, math.nan]),
    }
    assert_variables(steady, expected | points)
    shorter = made.isel(step=slice(0, 3))
    compared = compare_marches({"a": made, "b": shorter})
    names = ("pressure_max", "minimum_film", "converged")
    both = {n: (units[n], [values[n], [*values[n][:3], math.nan]]) for n in names}
    assert_variables(compared, both | {"march": ("", ["a", "b"]), "step": ("1", step)})
