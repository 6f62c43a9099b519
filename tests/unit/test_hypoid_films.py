"""Films of hypoid flanks: oblique motion, cases and axles in motion."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube.studies.films import run_hypoid
from gearlube.studies.films.hypoid import flank
from gearlube_core.ehl.gears.hypoid_film import pair_contact, phase_of
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.transient.level import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.ehl.transient.steady import solve_steady_film
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.sliding_direction import sliding_direction
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.hypoid_film_cases import flank_cycle, hypoid_film
from tests.helpers.known_answers import named

SETTINGS = PointSolverSettings(wedge="quick", tolerance=1e-8, load_tolerance=1e-9)


def oblique_problem(psi, sliding=None):
    return elliptical_contact(
        R_x=0.0177,
        R_y=0.5,
        entrainment=(2.5 * math.cos(psi), 2.5 * math.sin(psi)),
        load=1500.0,
        contact_modulus=115.4e9,
        lubricant=film_oil(
            eta0=0.0171, alpha=2.38e-8, eyring_stress=None if sliding is None else 2e6
        ),
        sliding=sliding,
        nodes=(33, 25),
    )


def as_moving_film(problem, slope):
    u = problem.entrainment[0]
    slip, side_slip = problem.sliding or (0.0, 0.0)

    def conditions(x, y, time):
        return FilmConditions(
            gap=problem.gap(x[:, None], y[None, :]),
            load=problem.load,
            speed_1=np.full(y.size, u - 0.5 * slip),
            speed_2=np.full(y.size, u + 0.5 * slip),
            slope=slope,
            side_sliding=side_slip,
        )

    return MovingFilm(
        conditions=conditions,
        lubricant=problem.lubricant,
        contact_modulus=problem.contact_modulus,
        x_limits=problem.x_limits,
        y_limits=problem.y_limits,
        nodes=problem.nodes,
        hertz=problem.hertz,
        load=problem.load,
        speed=u,
    )


def test_at_rest_it_is_the_film_of_the_steady_solver():
    psi = math.radians(50.0)
    problem = oblique_problem(psi)
    steady = solve_point_contact(problem, SETTINGS)
    moving = solve_steady_film(as_moving_film(problem, math.tan(psi)), 0.0, SETTINGS)
    # two starts, one system of equations, both solved to 1e-8
    np.testing.assert_allclose(moving.film, steady.film, rtol=1e-6)
    # flow along the contact skews the film: it is not that of its component across
    assert np.abs(steady.film / steady.film[:, ::-1] - 1.0).max() > 0.05


SLIDINGS = [(1.2, 0.9), (-0.7, 1.4), (0.0, 1.6)]  # to both sides of the minor axis and across it


@pytest.mark.slow
@pytest.mark.parametrize("sliding", SLIDINGS)
def test_an_eyring_film_in_time_slides_at_any_angle_as_the_steady_one(sliding):
    psi = math.radians(50.0)
    problem = oblique_problem(psi, sliding)
    steady = solve_point_contact(problem, SETTINGS)
    film = as_moving_film(problem, math.tan(psi))
    moving = solve_steady_film(film, 0.0, SETTINGS)
    np.testing.assert_allclose(moving.film, steady.film, rtol=1e-6)
    # and it is another film than one that slides along x at the same speed
    along = oblique_problem(psi, (math.hypot(*sliding), 0.0))
    other = solve_steady_film(as_moving_film(along, math.tan(psi)), 0.0, SETTINGS)
    assert np.abs(other.film / moving.film - 1.0).max() > 1e-3


def test_rows_that_slide_in_different_directions_are_refused():
    film = as_moving_film(oblique_problem(0.3, (0.5, 0.5)), 0.3)

    def uneven(x, y, time):
        now = film.conditions(x, y, time)
        return replace(now, speed_2=now.speed_2 + np.linspace(0.0, 0.1, y.size))

    with pytest.raises(ParameterError, match=r"must not vary .* got a spread of 0\.1 m/s"):
        solve_steady_film(replace(film, conditions=uneven), 0.0, SETTINGS)


def test_entrainment_towards_smaller_y_is_refused():
    problem = oblique_problem(0.3)
    with pytest.raises(ParameterError, match="slope must be"):
        solve_steady_film(as_moving_film(problem, -0.3), 0.0, SETTINGS)


TABLE = shipped_mesh_table("mohammadpour_2015")


@each("true", np.radians([20.0, 80.0, 100.0, 170.0, -15.0, -120.0]))
def test_a_folded_angle_of_sliding_finds_its_quadrant(true):
    psi = np.radians([50.0])
    folded = np.arccos(np.abs(np.cos([true])))
    found = sliding_direction(psi, folded, np.cos(psi - true))
    assert np.cos(found[0] - true) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("torque", [50.0, -100.0])
def test_vectors_at_nodes_have_the_arms_of_the_table(torque):
    level = int(np.flatnonzero(TABLE.torque == torque)[0])
    w = {key: values[level] for key, values in TABLE.windows.items()}
    node = np.arange(0, TABLE.nodes, 7)
    found = pair_contact(TABLE, torque, 3.0 * node / TABLE.nodes - 1.5)
    speed = np.linalg.norm(found.entrainment, axis=1)
    slip = np.linalg.norm(found.sliding, axis=1)
    np.testing.assert_allclose(speed, w["entrainment_arm"][node], rtol=1e-12)
    # xi.v of either member is its arm
    half = 0.5 * found.sliding
    xi = found.sliding / slip[:, None]
    pinion = np.einsum("ni,ni->n", found.entrainment + half, xi)
    gear = np.einsum("ni,ni->n", found.entrainment - half, xi) * TABLE.ratio
    # chi is stored beside the arms, each interpolated: a few micrometres of 20 mm
    np.testing.assert_allclose(pinion, w["friction_arm_p"][node], rtol=3e-3)
    np.testing.assert_allclose(gear, w["friction_arm_g"][node], rtol=3e-3)


@pytest.mark.parametrize(("torque", "side"), [(50.0, "drive"), (-50.0, "coast")])
def test_vectors_are_those_of_the_flanks(torque, side):
    """Sliding along the minor axis changes its sign within the engagement; the table folds it."""
    pair = FlankPair.from_file(HypoidGearFile.named("mohammadpour_2015"), side)
    phase = np.linspace(-0.4, 0.5, 5)
    k = path_kinematics(contact_path(pair, phase * pair.gear_pitch))
    found = pair_contact(TABLE, torque, phase)
    for column, axis in enumerate((k.minor_axis, k.major_axis)):
        side_of = np.sign(np.einsum("ni,ni->n", k.entrainment, axis))
        for vectors, exact in ((found.entrainment, k.entrainment), (found.sliding, k.sliding)):
            expected = side_of * np.einsum("ni,ni->n", exact, axis)
            # the table holds the centre of force of loaded flanks, 1 mm from the unloaded point
            np.testing.assert_allclose(vectors[:, column], expected, atol=1e-3)
    if side == "drive":
        assert found.sliding[0, 0] < 0.0 < found.sliding[-1, 0]


def test_phase_counts_mesh_periods_from_the_middle_of_the_window():
    period = 2.0 * np.pi / TABLE.pinion_teeth
    np.testing.assert_allclose(phase_of(TABLE, period * np.array([0.0, 1.5, 2.9, 3.0])),
                               [-1.5, 0.0, 1.4, -1.5], atol=1e-12)  # fmt: skip


def test_conditions_hold_load_speeds_and_the_paraboloid_of_the_time():
    cycle = flank_cycle()
    film = hypoid_film(cycle)
    x, y = np.array([-1e-4, 0.0, 2e-4]), np.array([-2e-3, 1e-3])
    time = float(cycle.time[10])
    now = film.conditions(x, y, time)
    assert now.load == cycle.load[10]
    u, v = cycle.entrainment[10]
    assert now.slope == pytest.approx(v / u)
    np.testing.assert_allclose(0.5 * (now.speed_1 + now.speed_2), u)
    np.testing.assert_allclose(now.speed_2 - now.speed_1, cycle.sliding[10, 0])
    assert now.side_sliding == pytest.approx(cycle.sliding[10, 1])
    expected = x[:, None] ** 2 / (2 * cycle.R_x[10]) + y**2 / (2 * cycle.R_y[10])
    np.testing.assert_allclose(now.gap, expected)
    # the domain of the march holds the ellipse of every instant
    (x_low, x_high), (y_low, y_high) = film.domain()
    for instant in cycle.instants():
        a_x, a_y, _ = film.problem(instant).hertz_contact
        assert x_low < -2.4 * a_x
        assert 1.4 * a_x < x_high
        assert y_low < -a_y
        assert a_y < y_high


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"load": lambda v: v - v.max()}, "load of a flank's cycle must be above 0 N"),
        ({"entrainment": lambda v: -v}, "entrainment of a flank's cycle must be above 0 m/s"),
        ({"time": lambda v: v[::-1]}, "time of a flank's cycle must rise"),
        ({"R_x": lambda v: v[:-1]}, "R_x of a flank's cycle must be finite and of shape"),
    ],
)
def test_a_cycle_that_makes_no_sense_is_refused(change, says):
    cycle = flank_cycle()
    with pytest.raises(ParameterError, match=says):
        replace(cycle, **{name: act(getattr(cycle, name)) for name, act in change.items()})


SPEED, TORQUE, TEETH, RATIO = 300.0, 50.0, 13, 3.0
WINDOW = 3.0 * 2.0 * np.pi / TEETH  # three mesh periods


class Axle:
    """A pinion of 0.01 kg m2 that runs 5 % too fast; load, film and friction tell its angle."""

    made = None

    def __init__(self, parameters):
        self.outputs = np.zeros(64)
        self.steps, self.times = [], 0.0
        Axle.made = self

    def initialise(self, *, pinion_speed, pinion_torque, wheel_torque, oil_temperature):
        assert (pinion_torque, wheel_torque, oil_temperature) == (TORQUE, RATIO * TORQUE, 353.0)
        self.angle, self.speed = 0.0, 1.05 * pinion_speed
        self.write()

    def step(self, h, torque, wheel_torque, oil_temperature):
        assert torque == TORQUE
        self.speed += h * (torque - wheel_torque / RATIO) / 0.01
        self.angle += h * self.speed
        self.times += h
        self.steps.append(h)
        self.write()

    def write(self):
        turned = self.angle % WINDOW
        places = (flank._PHI, flank._SPEED, flank._LOAD, flank._FILM, flank._MU)
        values = (self.angle, self.speed, 1.0 + turned, 2.0 + turned, 3.0 + turned)
        self.outputs[list(places)] = values


def test_samples_of_the_running_axle_are_those_of_one_window(monkeypatch):
    monkeypatch.setattr(flank, "HypoidAxle", Axle)
    parameters = named(mesh=named(ratio=RATIO, pinion_teeth=TEETH))
    drive = flank.dynamic_drive(parameters, SPEED, TORQUE, 353.0)
    h = 2.0 * np.pi / (TEETH * SPEED * 128)  # 128 steps a mesh period
    assert set(Axle.made.steps) == {h}
    # 0.8 s to settle, then at most two windows
    assert 0.8 < Axle.made.times < 0.8 + 2.1 * WINDOW / SPEED
    # the excess dies as exp(-10 t), with what the reset adds: below 1e-3 of it after 0.8 s
    assert drive.speed == pytest.approx(SPEED, rel=1e-4)
    assert drive.time == pytest.approx(h * np.arange(3 * 128), rel=1e-12)
    # the window begins within a step of its first sample
    assert 0.0 <= drive.angle[0] < 1.01 * h * SPEED
    assert np.diff(drive.angle) == pytest.approx(h * SPEED, rel=1e-4)
    for offset, values in ((1.0, drive.load), (2.0, drive.axle_film), (3.0, drive.axle_friction)):
        assert values == pytest.approx(offset + drive.angle, rel=1e-9)


def test_a_pair_at_constant_speed_has_its_share_of_the_mesh_force(monkeypatch):
    share = np.linspace(0.0, 1.0, 3 * 128)
    monkeypatch.setattr(flank, "phase_of", lambda mesh, angle: angle)
    monkeypatch.setattr(flank, "pair_contact", lambda mesh, torque, phase: named(share=share))
    parameters = named(mesh=named(pinion_teeth=TEETH, mean=lambda name, torque: 0.02))
    drive = flank.static_drive(parameters, SPEED, -TORQUE)
    assert drive.load == pytest.approx(TORQUE / 0.02 * share)
    assert drive.angle == pytest.approx(WINDOW * np.arange(384) / 384)
    assert drive.time == pytest.approx(drive.angle / SPEED)
    assert (drive.speed == SPEED).all()
    assert np.isnan([drive.axle_film, drive.axle_friction]).all()


@pytest.mark.parametrize(
    ("load", "film", "warned"),
    [("dynamic", [1.0, np.nan], True), ("dynamic", [1.0, 2.0], False), ("static", [np.nan], False)],
)
def test_samples_without_a_film_are_a_warning_where_the_axle_runs(caplog, load, film, warned):
    run_hypoid._warn_of_separation(
        named(case=named(load=load), drive=named(axle_film=np.array(film)))
    )
    assert ("gives no film at some samples" in caplog.text) == warned


def test_the_loaded_span_is_that_around_the_largest_load():
    load = np.array([5.0, 0.1, *np.linspace(1.0, 9.0, 9), 0.5, 6.0])
    case = named(smallest_load=0.1, first_phase=0.0, last_phase=20.0)
    phase = np.arange(13.0)
    assert flank.loaded_span(case, phase, load) == slice(2, 11)
    case.first_phase, case.last_phase = 3.0, 10.0
    assert flank.loaded_span(case, phase, load) == slice(3, 11)
