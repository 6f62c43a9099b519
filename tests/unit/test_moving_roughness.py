"""Rough surfaces in motion: waves, lays, feed and schedule against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.surface.extrusion import Lay
from gearlube_core.surface.heights import HeightMap, Profile
from gearlube_core.surface.moving import FedFromInlet, GrownInPlace, MovingRoughness, MovingSurface
from gearlube_core.surface.moving_kernels import Moved, add_moved_heights, spline_coefficients
from gearlube_core.surface.schedule import RoughSchedule
from gearlube_core.surface.stand_ins import stand_in
from tests.helpers.each import each

WIDTH, HEIGHT = 1e-3, 2e-7  # m
A = 2.377e-4  # m, half-width of the thesis' contact
X = np.linspace(-2.5 * A, 1.5 * A, 801)
Y = WIDTH / 128 * np.arange(128.0)
SCHEDULE = RoughSchedule(time_step=5e-8, until_rough=0, rough=10)


def waves(period: float = 1e-4, count: int = 4, nodes: float = 10.0) -> Profile:
    points = round(count * nodes)
    turn = 2.0 * math.pi * count * np.arange(points) / points
    return Profile(height=HEIGHT * np.cos(turn), spacing=period / points, periodic=True)


def moving(profile: Profile, speed: float = 7.0, turns: int = 1) -> MovingSurface:
    lay = Lay(period=profile.length, width=WIDTH, turns=turns)
    return MovingSurface(heights=profile, lay=lay, speed=speed)


def rough(*surfaces: MovingSurface, **other) -> MovingRoughness:
    given = {"surfaces": surfaces, "x": X, "y": Y, "schedule": SCHEDULE} | other
    return MovingRoughness(**given)


@pytest.mark.parametrize(("nodes", "error"), [(8.0, 3.0e-7), (3.0, 1.5e-5), (2.05, 6.0e-5)])
def test_moved_waves_keep_their_amplitude(nodes: float, error: float):
    # the errors that the spline states; they fall with the fourth power of nodes a wave
    count, period = 20, 4e-4
    points = round(count * nodes)
    cosine = HEIGHT * np.cos(2.0 * math.pi * count * np.arange(points) / points)
    coefficients = spline_coefficients(cosine[None, :])
    x = np.linspace(-1e-4, 3e-4, 777)
    for travel in (0.0, 1.234e-6, 0.0377):
        height = np.zeros((777, 1))
        place = Moved(period, travel, 1.0, math.inf, 1.0)
        add_moved_heights(coefficients, x, np.zeros(1), place, height)
        expected = HEIGHT * np.cos(2.0 * math.pi * count * (x - travel) / period)
        assert np.abs(height[:, 0] - expected).max() <= error * HEIGHT


def test_both_surfaces_move_at_their_own_speeds_along_their_own_lays():
    fast, slow = waves(1.49e-4, 3, 12.0), waves(1e-4, 2, 12.0)
    both = rough(moving(fast, 7.93), moving(slow, 5.49, turns=-2))
    time = 3.217e-4
    x, y = X[:, None], Y[None, :]
    one = np.cos(2.0 * math.pi * 3 * ((x - 7.93 * time) / 1.49e-4 - y / WIDTH))
    two = np.cos(2.0 * math.pi * 2 * ((x - 5.49 * time) / 1e-4 + 2.0 * y / WIDTH))
    # 12 nodes a wave: 5e-8 of each
    assert np.abs(both.height(time) - HEIGHT * (one + two)).max() < 1e-7 * HEIGHT
    assert (both.height_at_step(7) == both.height(7 * 5e-8)).all()


@pytest.mark.parametrize(
    ("period_um", "angle_deg"), [(149.0, 8.475), (100.0, 5.711), (114.0, 6.504), (131.0, 7.463)]
)
def test_crests_lean_at_the_published_angles(period_um: float, angle_deg: float):
    # the crest is followed on the heights themselves; angles are given to 0.001 deg
    period = 1e-6 * period_um
    surface = rough(moving(waves(period, 1, 200.0), 1.0), x=np.linspace(0.0, 2.0 * period, 4001))
    heights = surface.height(0.0)
    middle = np.abs(surface.x - period) < 0.6 * period
    crest = surface.x[middle][heights[middle][:, [0, 32]].argmax(axis=0)]
    lean = math.degrees(math.atan((crest[1] - crest[0]) / Y[32]))
    # a node of 0.05 um or less is 0.012 deg over 0.25 mm
    assert lean == pytest.approx(angle_deg, abs=0.03)
    assert math.degrees(surface.surfaces[0].lay.angle) == pytest.approx(angle_deg, abs=0.0005)


def test_heights_repeat_over_the_width_and_after_a_period():
    case = stand_in("A")
    profiles = zip((case.fast, case.slow), case.lays, (7.93, 5.49), strict=True)
    surfaces = [MovingSurface(heights=p, lay=one, speed=u) for p, one, u in profiles]
    both = rough(*surfaces)
    beyond = both(X, Y + WIDTH, 1.0e-3)
    assert np.abs(beyond - both.height(1.0e-3)).max() < 1e-12 * HEIGHT / 1e-7
    alone = rough(surfaces[0])
    again = alone.height(2.0e-5 + 3.0 * case.fast.length / 7.93)
    # 1e-6 of a period is lost to rounding of places by no more than 1e-13 m
    assert np.abs(again - alone.height(2.0e-5)).max() < 1e-9 * HEIGHT


def test_measured_points_come_out_as_they_went_in():
    profile = stand_in("A").fast
    surface = rough(moving(profile), x=profile.x, y=Y)
    assert np.abs(surface.height(0.0)[:, 0] - profile.height).max() < 1e-15 / 1e-7 * HEIGHT


def test_maps_move_and_shear_between_their_own_rows():
    nx, ny = 96, 40  # rows of the map lie elsewhere than those of the film
    x, y = np.arange(nx) / nx, np.arange(ny) / ny

    def exact(along: np.ndarray, across: np.ndarray) -> np.ndarray:
        first = np.cos(2.0 * math.pi * (3.0 * along + 2.0 * across) + 0.4)
        return HEIGHT * (first + 0.5 * np.sin(2.0 * math.pi * (5.0 * along - across)))

    heights = HeightMap(
        height=exact(x[:, None], y[None, :]),
        spacing=(1e-4 / nx, 0.5 * WIDTH / ny),
        periodic=(True, True),
    )
    surface = MovingSurface(heights=heights, lay=Lay(period=1e-4, width=WIDTH, turns=1), speed=-3.0)
    time = 7.7e-5
    along = (X[:, None] + 3.0 * time) / 1e-4 - Y[None, :] / WIDTH
    expected = exact(along, Y[None, :] / (0.5 * WIDTH))
    assert np.abs(rough(surface).height(time) - expected).max() < 1e-7 * HEIGHT


def test_roughness_is_fed_from_the_inlet_with_its_surface():
    inlet = -2.5 * A
    feed = FedFromInlet(inlet=inlet, growth=A)
    fed, full = rough(moving(waves(), 5.0), feed=feed), rough(moving(waves(), 5.0))
    for moved in (0.0, 0.3 * A, 1.7 * A, 4.4 * A):
        share = np.clip((inlet + moved - X) / A, 0.0, 1.0)
        expected = share[:, None] * full.height(moved / 5.0)
        assert np.abs(fed.height(moved / 5.0) - expected).max() < 1e-12 * HEIGHT
    assert fed.rough_time == pytest.approx(5.0 * A / 5.0)
    assert np.abs(fed.height(0.999 * fed.rough_time) - full.height(0.999 * fed.rough_time)).any()
    late = 1.001 * fed.rough_time
    assert not np.abs(fed.height(late) - full.height(late)).any()


def test_roughness_grows_in_place_linearly():
    grown = rough(moving(waves(), 5.0), feed=GrownInPlace(duration=2e-5))
    full = rough(moving(waves(), 5.0))
    for time, share in ((0.0, 0.0), (0.5e-5, 0.25), (2e-5, 1.0), (5e-5, 1.0)):
        assert np.abs(grown.height(time) - share * full.height(time)).max() <= 1e-12 * HEIGHT
    assert (grown.rough_time, full.rough_time) == (2e-5, 0.0)


def test_schedule_of_the_thesis_has_its_numbers_of_steps():
    # [jamali_2015 7.7]: slide-roll ratio 0.3632, 2888 steps until rough, 4488 in all
    mean, ratio = 6.71, 0.3632
    fast, slow = mean * (1.0 + 0.5 * ratio), mean * (1.0 - 0.5 * ratio)
    schedule = RoughSchedule.by_travel(length=A, fast=fast, slow=slow)
    assert (schedule.until_rough, schedule.rough, schedule.steps) == (2888, 1600, 4488)
    # the slower surface, fed over a, passes the domain of 4 a by then and not before
    surface = moving(waves(nodes=40.0), slow)
    fed = rough(surface, feed=FedFromInlet(inlet=X[0], growth=A), schedule=schedule)
    assert schedule.time(2887) < fed.rough_time <= schedule.time(2888)
    # half a node of a/200 a step
    assert fast * schedule.time_step == pytest.approx(0.5 * A / 200.0)


def test_moved_heights_kernel_equals_its_source():
    random = np.random.default_rng(5)
    x = np.linspace(-1.0, 2.0, 31)
    for rows in (1, 7):
        coefficients, turns = random.standard_normal((rows, 24)), random.standard_normal(7)
        for moved in (Moved(0.7, 12.3, 0.8, 1.1, 0.4), Moved(0.7, -0.7 * 3.0, 1.0, math.inf, 1.0)):
            found = [np.ones((31, 7)), np.ones((31, 7))]
            for kernel, height in zip(
                (add_moved_heights, add_moved_heights.py_func), found, strict=True
            ):
                kernel(coefficients, x, turns, moved, height)
            assert found[0] == pytest.approx(found[1], rel=1e-13, abs=1e-13)


def test_heights_are_written_where_asked():
    surface = rough(moving(waves()))
    into = np.full((X.size, Y.size), 7.0)
    assert surface.height(1e-4, into) is into
    assert (into == surface.height(1e-4)).all()


SPIKE = np.where(np.arange(40) < 20, np.linspace(0.0, 1e-6, 40), 0.0)
STEEP = 1e-6 * np.cos(2.0 * math.pi * np.arange(40) / 10)


@each(
    ("wrong", "words"),
    [
        (lambda: rough(moving(waves(period=1.1e-4)), y=1.1 * Y), "1 mm over 128 rows"),
        (lambda: Lay.closing(1.49e-4, WIDTH, math.radians(8.0)), r"Nearest is 8\.4747 deg"),
        (
            lambda: moving(Profile(height=np.linspace(0, 1e-6, 40), spacing=1e-6, periodic=True)),
            "both ends must meet",
        ),
        (lambda: rough(moving(waves(period=2e-5))), "8 nodes a wave along x"),
        (lambda: rough(moving(waves(), turns=40)), "8 nodes a wave along y"),
        (lambda: moving(Profile(height=STEEP, spacing=1e-6, periodic=True)), "rms slope along x"),
        (
            lambda: moving(Profile(height=1e-3 * waves().height, spacing=2.5e-6, periodic=True)),
            "if mm are written instead",
        ),
        (lambda: rough(moving(waves()), y=WIDTH / 14 * np.arange(14.0)), "got 14. Take 16"),
        (lambda: rough(moving(waves()), y=WIDTH / 127 * np.arange(127.0)), "got 127. Take 128"),
        (
            lambda: rough(moving(waves(), 24.0)),
            r"time_step must be at most 4\.952e-08 s.*got 5e-08 s",
        ),
        (lambda: rough(), "one or two, got 0"),
        (
            lambda: rough(moving(waves(), 0.0), feed=FedFromInlet(inlet=X[0], growth=A)),
            "must be above 0 m/s so that its roughness enters",
        ),
        (
            lambda: MovingSurface(
                heights=waves(), lay=Lay(period=2e-4, width=WIDTH, turns=1), speed=1.0
            ),
            "lay.period must be that of profile, 100 um, got 200 um",
        ),
        (
            lambda: rough(
                moving(waves()),
                MovingSurface(
                    heights=waves(), lay=Lay(period=1e-4, width=2e-3, turns=1), speed=1.0
                ),
            ),
            "same width, got 1 and 2 mm",
        ),
        (lambda: RoughSchedule(time_step=1e-7, until_rough=-1, rough=3), "until_rough must be"),
        (lambda: RoughSchedule.by_travel(length=A, fast=1.0, slow=2.0), "fast must be at least"),
    ],
)
def test_what_cannot_move_through_a_contact_is_refused(wrong, words: str):
    with pytest.raises(ParameterError, match=words):
        wrong()


def square_map(period_y: float, measured: str = "along_x", open_y: bool = False) -> MovingSurface:
    turn = 2.0 * math.pi * np.arange(64) / 64
    heights = HeightMap(
        height=HEIGHT * np.cos(turn)[:, None] * np.ones(32) * (1.0 + 0.1 * np.sin(turn[::2])),
        spacing=(1e-4 / 64, period_y / 32),
        periodic=(True, not open_y),
    )
    lay = Lay(period=1e-4, width=WIDTH, turns=0, measured=measured)
    return MovingSurface(heights=heights, lay=lay, speed=1.0)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda: square_map(3e-4), "whole number of periods of 300 um, got 1000 um"),
        (lambda: square_map(WIDTH, measured="across_lay"), "must be along_x for height map"),
        (lambda: square_map(WIDTH, open_y=True), "must be periodic along y"),
    ],
)
def test_maps_that_do_not_repeat_over_the_width_are_refused(wrong, words: str):
    with pytest.raises(ParameterError, match=words):
        wrong()
    assert rough(square_map(0.5 * WIDTH)).height(0.0).shape == (801, 128)
