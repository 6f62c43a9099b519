"""Sums over contact lines against dense sums of the definition, with friction of its own each."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.march import line_sums as module
from gearlube_core.dynamics.helical_pair.march.flanks import POINTS_PER_LINE
from gearlube_core.dynamics.helical_pair.march.line_sums import line_sums, pair_slot
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    mesh_at_torque,
    pack_march_mesh,
    pair_data,
)
from gearlube_core.kernels.places import place_below
from gearlube_core.mesh_table import kernels
from tests.helpers.each import each
from tests.helpers.helical_march_cases import he_march, wavy_mesh
from tests.helpers.source_of import interpret, source_of

WAVY = wavy_mesh(he_march())
CONSTANTS = WAVY.constants()
DATA = pair_data(CONSTANTS, WAVY.mesh, WAVY.film_model())
PLANE = CONSTANTS.flanks.plane
LINES = WAVY.mesh.lines
MU_AT = 3
# every tooth pair and place its own; none of them falls to zero between pitch line and end
MU = np.concatenate([np.full(MU_AT, 7.0), 0.05 + 0.03 * np.random.default_rng(5).random(24)])
POINTS = 20_001  # of each line: sums by the midpoint rule are good to 1e-8, kinks to 1e-6
FIELDS = ("N", "Nx", "Nz", "F", "Fx", "Fz", "energy", "stiffness", "whole", "built_up")


def between(values, phase, line, t):
    """A datum of a line, linear between phases and stations; a line goes on as the next one."""
    over = values[0, line + 1] if line + 1 < LINES else values[-1, line]
    rows = [np.interp(t, WAVY.mesh.station, row) for row in (*values[:, line], over)]
    at = (phase % 1.0) * values.shape[0]
    row = int(at)
    return rows[row] + (at - row) * (rows[row + 1] - rows[row])


def friction(slot, z, ends):
    """Linear through the Gauss points of either side of the pitch line, opposite there."""
    z_low, z_pitch, z_high = ends
    mu = MU[MU_AT + POINTS_PER_LINE * slot :][:POINTS_PER_LINE]
    result = np.empty_like(z)
    for start, end, first, second, sign, here in (
        (z_low, z_pitch, mu[0], mu[1], -1.0, z < z_pitch),
        (z_pitch, z_high, mu[2], mu[3], 1.0, z >= z_pitch),
    ):
        gauss = 0.5 * (start + end) + np.array([-0.5, 0.5]) * (end - start) / math.sqrt(3.0)
        slope = (second - first) / (gauss[1] - gauss[0]) if end > start else 0.0
        result[here] = sign * (first + slope * (z[here] - gauss[0]))
    return result


def defined(a, tilt, phase):
    """The integrals of `LineSums`, line by line."""
    sums = np.zeros(len(FIELDS))
    half, tan_b = 0.5 * PLANE.W, PLANE.sin_b / PLANE.cos_b
    for line in range(LINES):
        X = PLANE.A + (phase % 1.0 + line) * PLANE.pitch
        z_low = max(-half, half - (X - PLANE.A) / tan_b)
        z_high = min(half, half - (X - PLANE.D) / tan_b)
        if z_high <= z_low:
            continue
        z_pitch = min(max(half - (X - PLANE.P) / tan_b, z_low), z_high)
        step = (z_high - z_low) / POINTS
        z = z_low + step * (np.arange(POINTS) + 0.5)
        x = X - (half - z) * tan_b
        t = (z - z_low) / (z_high - z_low)
        k, e = (between(v[0], phase, line, t) for v in (WAVY.mesh.density, WAVY.mesh.offset))
        g = a + tilt * (z * PLANE.cos_b + x * PLANE.sin_b) - e
        touching = g > 0.0
        w = np.where(touching, k * g, 0.0)
        f = w * friction((math.floor(phase) - line) % LINES, z, (z_low, z_pitch, z_high))
        built = np.clip(g / DAMPING_BUILD_UP, 0.0, 1.0) * k
        terms = (w, w * x, w * z, f, f * x, f * z, 0.5 * w * g, k * touching, k, built)
        sums += np.sum(terms, axis=1) * step / PLANE.cos_b
    return sums


@pytest.mark.parametrize("phase", [0.11, 0.985, 2.6, -0.7])
@pytest.mark.parametrize(("a", "tilt"), [(20e-6, 0.0), (9e-6, 2e-4), (3e-6, -3e-4)])
def test_every_sum_is_its_integral_along_the_lines(monkeypatch, phase, a, tilt):
    interpret(monkeypatch, module)
    found = source_of(line_sums)(a, tilt, phase, DATA, MU, MU_AT)
    expected = defined(a, tilt, phase)
    N, Nx = expected[0], expected[1]
    # a jump within a cell, at the pitch line or where flanks part, costs up to a cell
    jump = 5e-6 * np.array([N, Nx, N * PLANE.W])
    limits = np.concatenate([0.2 * jump, jump, 1e-6 * expected[6:9], 1e-6 * expected[9:]])
    if a < 9e-6:
        limits[7] = 1e-4 * expected[7]
        # two points in a piece where the damping's share has kinks
        limits[9] = 0.05 * expected[9]
    elif a < 20e-6:
        limits[9] = 0.02 * expected[9]
    got = np.array([getattr(found, name) for name in FIELDS])
    np.testing.assert_array_less(np.abs(got - expected), limits)


def test_friction_between_its_points_falls_to_zero_and_no_further(monkeypatch):
    """mu 0 and 0.1 at both points of a side: a straight line up from the first of them."""
    interpret(monkeypatch, module)
    a, phase = 40e-6, 0.11
    here = (a, 0.0, phase, DATA)
    mu = np.zeros((6, POINTS_PER_LINE))
    mu[:, 3] = 0.1
    cut = source_of(line_sums)(*here, mu.ravel(), 0)
    mu[:, 2:] = 0.05
    even = source_of(line_sums)(*here, mu.ravel(), 0)
    # mean of max(0.1 sqrt(3) (t - t1), 0) over the side: two Gauss points at pieces' own places
    # see what a line does beyond 0.2113 of the side, t1: 0.1 sqrt(3) (1 - t1)^2/2
    t1 = 0.5 - 0.5 / math.sqrt(3.0)
    mean = 0.1 * math.sqrt(3.0) * 0.5 * (1.0 - t1) ** 2
    # load varies along the lines by a fifth, and pieces with the kink take two points
    ratio = cut.F / even.F
    assert ratio == pytest.approx(mean / 0.05, rel=0.05)


@pytest.mark.parametrize(("tilt", "dip"), [(0.0, 0.0), (1e-4, 0.0), (0.0, 30e-6), (2e-4, 30e-6)])
def test_parts_that_touch_all_along_carry_what_their_pieces_carry(monkeypatch, tilt, dip):
    """Moments against Gauss points piece by piece; with a dip the middle of line 1 stays open."""
    offset = WAVY.mesh.offset.copy()
    offset[:, :, 1, 2] += dip
    mesh = replace(WAVY.mesh, offset=offset)
    data = pair_data(CONSTANTS, mesh, WAVY.film_model())
    even = np.full(24, 0.06)
    interpret(monkeypatch, module)
    for phase in np.linspace(-1.0, 1.0, 9) + 0.013:
        found = source_of(line_sums)(20e-6, tilt, phase, data, even, 0)
        with monkeypatch.context() as context:
            context.setattr(module, "_FEW_STATIONS", 99)
            pieces = source_of(line_sums)(20e-6, tilt, phase, data, even, 0)
        scale = np.abs(pieces)
        scale[2:6] = scale[0]
        scale[7] = 1e-3 * scale[0]  # `moving`: a small difference of lines that grow and shrink
        np.testing.assert_array_less(np.abs(np.subtract(found, pieces)), 1e-12 * scale)


def test_moments_follow_the_mesh_to_another_load():
    mesh = replace(
        WAVY.mesh, torque=np.array([100.0, 200.0]),
        density=np.concatenate([WAVY.mesh.density, 2.0 * WAVY.mesh.density]),
        offset=np.concatenate([WAVY.mesh.offset, 0.5 * WAVY.mesh.offset]),
    )  # fmt: skip
    data = pair_data(CONSTANTS, mesh, WAVY.film_model())
    packed = pack_march_mesh(mesh)
    before = line_sums(20e-6, 0.0, 0.3, data, MU, MU_AT)
    mesh_at_torque(200.0, (packed.torque, packed.density, packed.offset), data)
    after = line_sums(20e-6, 0.0, 0.3, data, MU, MU_AT)
    assert after.whole == pytest.approx(2.0 * before.whole, rel=1e-12)
    # softer offsets carry more
    assert after.N > 2.0 * before.N


def test_friction_is_finite_where_a_line_ends_at_the_pitch_line():
    """Whole lines on one side, with coefficients left from when they had two."""
    for phase in np.linspace(-0.9, 2.9, 400):
        assert math.isfinite(line_sums(20e-6, 0.0, phase, DATA, MU, MU_AT).Fz)
        assert math.isfinite(line_sums(0.5e-6, 2e-4, phase, DATA, MU, MU_AT).Fz)


@pytest.mark.parametrize("phase", [0.11, 0.985, 2.6])
@pytest.mark.parametrize(("a", "tilt"), [(20e-6, 0.0), (9e-6, 2e-4), (3e-6, -3e-4)])
def test_energy_changes_by_the_work_of_moving_lines(monkeypatch, phase, a, tilt):
    interpret(monkeypatch, module)
    step = 1e-8  # m
    low, high = (
        source_of(line_sums)(a, tilt, phase + change / PLANE.pitch, DATA, MU, 0).energy
        for change in (-step, step)
    )
    found = source_of(line_sums)(a, tilt, phase, DATA, MU, 0)
    # rounding of energies of 0.1 J over 20 nm
    assert found.moving == pytest.approx((high - low) / (2.0 * step), rel=1e-5, abs=1e-7)
    assert abs(found.moving) > 1e-3


@pytest.mark.parametrize("lines", [1, 2, 3, 5])
def test_tooth_pair_keeps_its_place_from_line_to_line(lines):
    slot = source_of(pair_slot)
    for period in range(-3, 8):
        places = [slot(period + 0.4, line, lines) for line in range(lines)]
        assert sorted(places) == list(range(lines))
        # what was line i is line i + 1 a period later
        later = [slot(period + 1.4, line, lines) for line in range(lines)]
        assert later[1:] == places[:-1]
        assert places[0] == period % lines


# 2^53 and beyond: neighbouring floats lie whole mesh periods apart
HUGE = [2.0**53 + 2.0, -2.9e16, 1.4e19, -1e19, 2.0**63, 1e100, -1e305, 1.7e308, math.inf, math.nan]


@np.errstate(invalid="ignore")
@pytest.mark.parametrize("phase", [*HUGE, *[-phase for phase in HUGE]])
def test_every_phase_has_a_place_in_the_arrays(phase):
    sums = [line_sums(1e-5, 1e-4, phase, DATA, MU, MU_AT) for line_sums in (module.line_sums,
            module.line_sums.py_func)]  # fmt: skip
    for one in (pair_slot, pair_slot.py_func):
        assert {one(phase, line, LINES) for line in range(LINES)} == set(range(LINES))
    if math.isfinite(phase):
        # no part of a period is left: as at phase zero, but for who meets whose friction
        expected = module.line_sums(1e-5, 1e-4, 0.0, DATA, MU, MU_AT)
        for found in sums:
            assert (found.N, found.stiffness) == pytest.approx((expected.N, expected.stiffness))


@each(
    ("position", "place"),
    [(-1e300, 0), (-0.5, 0), (0.999, 0), (1.0, 1), (2.9, 2), (6.999, 6), (7.0, 6), (2.0**63, 6),
     (1e308, 6), (math.inf, 6), (-math.inf, 0), (math.nan, 0)],
)  # fmt: skip
def test_a_position_becomes_the_nearest_place(position, place):
    assert place_below(position, 7) == place_below.py_func(position, 7) == place


@np.errstate(invalid="ignore")
def test_tooth_pairs_have_places_beyond_the_precision_of_their_phase():
    for phi in [*HUGE, *[-phi for phi in HUGE]]:
        for pair in range(3):
            for pair_node in (kernels.pair_node, kernels.pair_node.py_func):
                assert 0 <= pair_node(60, 13.0, phi, pair)[0] < 60
