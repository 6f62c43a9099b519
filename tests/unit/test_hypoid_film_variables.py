"""Datasets of hypoid and rough films: each variable has the value that its film has."""

from dataclasses import replace

import numpy as np

from gearlube.studies.films.datasets import hypoid
from gearlube.studies.films.rough import files
from gearlube_core.ehl.statistics.rough_film import (
    FILM_EDGES,
    PERCENT,
    PRESSURE_EDGES,
    FilmFriction,
    RoughFilmStatistics,
)
from gearlube_core.ehl.statistics.zone import FilmZone
from gearlube_core.ehl.transient.curves import FilmCurves
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named
from tests.helpers.made_films import THIN, a_film


def test_variables_of_hypoid_films_are_known(monkeypatch):
    """Films at rest at 0, 1 and 2 s, in time at 0 and 2 s, thermal at rest; one kept whole."""
    one, metre, newton = "1", "m", "N"
    films = {
        "load": newton, "central_film": metre, "minimum_film": metre, "minimum_film_x": metre,
        "minimum_film_y": metre, "pressure_max": "Pa", "traction_newtonian": one,
        "traction_eyring": one, "traction_heated": one, "load_error": one, "residual": one,
        "converged": one, "newton_steps": one, "seconds": "s", "grid_error": one,
        "time_error": one, "time_error_pressure": one,
    }  # fmt: skip
    thermal = {
        "central_film": metre, "minimum_film": metre, "cold_central_film": metre,
        "cold_minimum_film": metre, "pressure_max": "Pa", "traction": one, "rise_max": "K",
        "rise_surface": "K", "heat_balance": one, "turns": one, "converged": one, "seconds": "s",
    }  # fmt: skip
    motion = {"phase": one, "load": newton, "R_x": metre, "R_y": metre, "speed": "m/s",
              "psi": "rad", "slip": "m/s", "chi": "rad"}  # fmt: skip
    given = {"load": "given_load", "speed": "entrainment", "slip": "sliding"}
    formulas = {
        "hertz_pressure": "Pa", "chittenden_central": metre, "chittenden_minimum": metre,
        "component_central": metre, "component_minimum": metre, "grubin": metre,
        "evans_johnson": one, "evans_johnson_solved": one, "evans_johnson_roelands": one,
        "axle_friction": one, "asperity_share": one, "regime": one,
    }  # fmt: skip
    rest, dense = np.array([0.0, 1.0, 2.0]), np.array([0.0, 2.0])

    def curves(units, time, kept=None, factor=1.0):
        columns = [factor * made_up(name, 3)[: time.size] for name in units]
        return FilmCurves(("time", *units), np.column_stack([time, *columns]), kept or {})

    def at(time):
        return named(time=time, **{name: made_up(name) * (1.0 + time) for name in motion})

    def formula(flank, now, film):
        return named(**{name: film * made_up(name) * (1.0 + now.time) for name in formulas})

    monkeypatch.setattr(hypoid, "flank_formulas", formula)
    flank = named(
        film=named(
            cycle=named(at=at, time=dense), nodes=(33, 65),
            problem=lambda now: named(hertz_contact=(1e-4 * now.time, 1e-3 * now.time, 1e9)),
        ),
        drive=named(axle_film=np.array([2e-7, 4e-7]), axle_friction=np.array([0.02, 0.06])),
        case=named(
            name="mine", source="", pinion_torque_n_m=-50.0, pinion_speed=200.0, load="static",
            entrainment="path", oil="oil", oil_temperature=353.15, roughness_um=0.5, flow="eyring",
            solver=named(wedge="central"),
        ),
        parameters=named(mesh=named(name="table")), oil=named(tau0=5e6),
    )  # fmt: skip
    steady = curves(films, rest, {1: replace(a_film(), time=1.0)})
    made = hypoid.hypoid_dataset(flank, steady, curves(films, dense, factor=3.0),
                                 curves(thermal, rest))  # fmt: skip
    expected = {"steady_time": ("s", rest), "time": ("s", dense)}
    for name, unit in films.items():
        expected[f"steady_{name}"] = unit, made_up(name, 3)
        expected[name] = unit, 3.0 * made_up(name, 3)[:2]
    for name, unit in motion.items():
        expected[f"steady_{given.get(name, name)}"] = unit, made_up(name) * (1.0 + rest)
        expected[given.get(name, name)] = unit, made_up(name) * (1.0 + dense)
    for name in ("central_film", "minimum_film", "pressure_max", "traction_heated"):
        first, middle, last = made_up(name, 3)
        between = 3.0 * np.array([first, 0.5 * (first + middle), middle])
        expected[f"squeeze_{name}"] = "1", between / [first, middle, last]
    film = made_up("central_film", 3)
    expected |= {name: (unit, film * made_up(name) * (1.0 + rest)) for name, unit in
                 formulas.items()}  # fmt: skip
    expected |= {f"warm_{name}": (unit, made_up(name, 3)) for name, unit in thermal.items()}
    whole = a_film()
    expected |= {
        "axle_film": ("m", [2e-7, 3e-7, 4e-7]),
        "running_friction": ("1", [0.02, 0.04, 0.06]),
        "instant_position": ("1", [1]),
        "x": ("m", whole.x),
        "y": ("m", whole.y),
        "pressure": ("Pa", whole.pressure[None]),
        "film": ("m", whole.film[None]),
        "semi_axis_x": ("m", [1e-4]),
        "semi_axis_y": ("m", [1e-3]),
    }
    assert_variables(made, expected)
    known = {
        "flank": "coast", "pinion_torque": -50.0, "pinion_speed": 200.0, "oil_temperature": 353.15,
        "roughness_rms": 5e-7, "eyring_stress": 5e6, "nodes_minor": 33, "nodes_major": 65,
        "failures": 0, "converged": 1,
    }  # fmt: skip
    assert_attributes(made, known)


def test_variables_of_a_rough_film_are_known(monkeypatch):
    """Two films alike along y: three of five columns are inside, the middle one is touched.

    A cell has 1e-5 times 1e-4 m2. Solids carry 0.1 GPa below 5 nm, of the oil's 0.4 GPa and more.
    """
    x, y = 1e-5 * np.arange(-2.0, 3.0), 1e-4 * np.arange(4.0)
    oil = FilmFriction(oil=THIN, sliding=(2.0, 0.0), solid_coefficient=0.1)
    statistics = RoughFilmStatistics(
        zone=FilmZone.line(x, y, 1.5e-5), roughness=2e-8, smooth_film=8e-8, friction=oil,
        solids=lambda film: np.where(film < 5e-9, 1e8, 0.0),
    )  # fmt: skip
    monkeypatch.setattr(files, "new_statistics", lambda case: statistics)
    gathered = files.Gathered(None)
    film = 1e-9 * np.array([[400.0, 20.0, 3.0, 300.0, 500.0], [400.0, 30.0, 0.5, 200.0, 500.0]])
    pressure = 1e9 * np.array([[0.1, 0.4, 0.9, 0.5, 0.2], [0.2, 0.5, 1.2, 0.4, 0.1]])
    work = {"residual": "1", "load_error": "1", "time_error": "1", "newton_steps": "1",
            "krylov_steps": "1", "seconds": "s"}  # fmt: skip
    for k in (0, 1):
        both = (np.repeat(one[k][:, None], 4, axis=1) for one in (film, pressure))
        names = {name: made_up(name, 2)[k] for name in work}
        gathered.add(named(time=1e-6 * k, converged=k == 0, **names,
                           **dict(zip(("film", "pressure"), both, strict=True))))  # fmt: skip
    made = gathered.dataset()
    h, p, area = film[:, 1:4], pressure[:, 1:4], 4 * 1e-5 * 1e-4
    load = area * pressure.sum(axis=1)
    sheared = area * (0.01 * 2.0 / film).sum(axis=1)
    solids = area * 1e8
    ranks = np.array([0, 0, 0, 0, 1, 2, 2, 2, 2])  # of three columns at each percentage
    below = np.array([[0, 1, 1, 2], [1, 1, 1, 1]])
    shares = {
        name: np.mean(values.reshape(-1, 1) <= edges, axis=0)
        for name, values, edges in (("film", h, FILM_EDGES), ("pressure", p, PRESSURE_EDGES))
    }
    expected = {
        "film_load": ("N", load),
        "pressure_max": ("Pa", [0.9e9, 1.2e9]),
        "pressure_mean": ("Pa", [0.6e9, 0.7e9]),
        "film_min": ("m", [3e-9, 0.5e-9]),
        "film_mean": ("m", h.mean(axis=1)),
        "lambda_mean": ("1", h.mean(axis=1) / 2e-8),
        "solid_share": ("1", solids / load),
        "film_friction": ("N", sheared),
        "solid_friction": ("N", [0.1 * solids] * 2),
        "friction_coefficient": ("1", (sheared + 0.1 * solids) / load),
        "contact_share": ("1", below / 3.0),
        "contact_nodes": ("1", 4 * below),
        "film_percentile": ("m", np.sort(h)[:, ranks]),
        "pressure_percentile": ("Pa", np.sort(p)[:, ranks]),
        "film_function": ("1", shares["film"]),
        "pressure_function": ("1", shares["pressure"]),
        "film_histogram": ("1", np.diff(shares["film"])),
        "pressure_histogram": ("1", np.diff(shares["pressure"])),
        "time": ("s", [0.0, 1e-6]),
        "threshold": ("m", [1e-9, 5e-9, 1e-8, 2.5e-8]),
        "percent": ("%", PERCENT),
        "film_edge": ("m", FILM_EDGES),
        "pressure_edge": ("Pa", PRESSURE_EDGES),
        "converged": ("1", [1.0, 0.0]),
        "step": ("1", [0.0, 1.0]),
    } | {name: (unit, made_up(name, 2)) for name, unit in work.items()}
    all_times = {
        f"{name}_percentile_all": unit for name, unit in (("film", "m"), ("pressure", "Pa"))
    }
    assert_variables(made.drop_vars(all_times), expected)
    for values, (name, unit) in zip((h, p), all_times.items(), strict=True):
        exact = np.percentile(values, PERCENT, method="inverted_cdf")
        width = np.maximum(1e-9, 0.02 * exact) if unit == "m" else 1e7  # of a bin
        assert made[name].attrs["units"] == unit
        assert (np.abs(made[name].values - exact) <= width).all()
    known = {"roughness": 2e-8, "lambda_smooth": 4.0, "zone_nodes": 12, "gathered_films": 2}
    assert_attributes(made, known)
