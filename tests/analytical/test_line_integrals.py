"""Loads, loss and film along the lines of a mesh period against closed forms."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.friction.line_integrals import LineFrictionCycle, friction_along_lines
from gearlube_core.friction.line_points import (
    line_friction,
    line_points,
    normal_force,
    table_line_load,
    uniform_line_load,
)
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh, uniform_line_mesh
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.named_pairs import named_pair

SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
SURFACE = SurfaceParameters(sigma=0.5e-6, xi_beta_sigma=0.055, sigma_over_beta=0.001)
OIL = Lubricant.named("mohammadpour_2015")
TORQUE, SPEED, TEMPERATURE = 226.0, 104.72, 353.15
HE = named_pair("he_2007")


def cycle(pair: HelicalPair, phases: int = 48, nodes: int = 12) -> LineFrictionCycle:
    points = line_points(pair, phases, nodes)
    return friction_along_lines(
        points,
        uniform_line_load(points, TORQUE),
        pinion_speed=SPEED,
        pinion_torque=TORQUE,
        lubricant=OIL,
        oil_temperature=TEMPERATURE,
        surface=SURFACE,
        solid=SOLID,
    )


def density_table(torque: tuple[float, ...], phases: int, **changes: Array) -> LineMesh:
    base = uniform_line_mesh(
        name="table",
        source="test",
        pinion_teeth=HE.pinion_teeth,
        gear_teeth=HE.gear_teeth,
        base_pitch=HE.base_pitch,
        lines=3,
        density=1.3e10,
    )
    shape = (len(torque), phases, 3, 2)
    fields: dict[str, Any] = {"density": np.full(shape, 1.3e10), "offset": np.zeros(shape)}
    return replace(
        base,
        torque=np.array(torque),
        phase=np.arange(phases) / phases,
        station=np.array([0.0, 1.0]),
        **(fields | changes),
    )


def approach_and_recess(pair: HelicalPair) -> tuple[float, float]:
    """Contact ratios before and after the pitch point."""
    return (
        (pair.pitch_point - pair.contact_start) / pair.base_pitch,
        (pair.contact_end - pair.pitch_point) / pair.base_pitch,
    )


def test_points_measure_the_lines() -> None:
    points = line_points(HE, 64, 3)
    # mean over the period of a trapezoid with corners between phases: 1/64^2
    assert points.total_length.mean() == pytest.approx(HE.mean_contact_length, rel=1e-3)
    half = 0.5 * HE.face_width
    assert (abs(points.z) <= half).all()
    inside = points.length > 0.0
    assert (points.x[inside] > HE.contact_start).all()
    assert (points.x[inside] < HE.contact_end).all()
    # points climb along (sin b, 0, cos b)
    slope = np.diff(points.x)[inside[..., 1:]] / np.diff(points.z)[inside[..., 1:]]
    # differences of numbers with 16 digits a hundredth of their size
    assert slope == pytest.approx(math.tan(HE.base_helix_angle), rel=1e-9)


@pytest.mark.parametrize("name", ["he_2007", "jamali_2015_a"])
def test_stations_run_evenly_along_every_line(name: str) -> None:
    pair = named_pair(name)
    points = line_points(pair, 7, 3)
    length = points.length.sum(axis=2)
    filled = length > 0.0
    assert not filled.all()
    # moments of an even share from 0 to 1: Gauss's rule is exact
    for power in (1, 2):
        moment = (points.length * points.station**power).sum(axis=2)
        assert moment == pytest.approx(length / (1.0 + power), abs=1e-15)
    assert not points.station[~filled].any()
    # from one point to the next: as far along the axis, by the line's slant
    z, x, station = (np.diff(a[filled]) for a in (points.z, points.x, points.station))
    along = length[filled][:, None] * station
    assert z == pytest.approx(along * math.cos(pair.base_helix_angle), abs=1e-15)
    assert x == pytest.approx(along * math.sin(pair.base_helix_angle), abs=1e-15)


def test_uniform_loads_carry_the_torque_at_every_phase() -> None:
    points = line_points(HE)
    load = uniform_line_load(points, TORQUE)
    carried = (load * points.length).sum(axis=(1, 2))
    moment = carried * HE.pinion_base_radius * math.cos(HE.base_helix_angle)
    assert moment == pytest.approx(TORQUE, rel=1e-13)


def test_lines_of_constant_length_have_the_loss_factor_of_the_path_of_contact() -> None:
    wide = replace(HE, face_width=HE.base_pitch / math.tan(HE.base_helix_angle))
    assert wide.overlap_ratio == pytest.approx(1.0, rel=1e-14)
    approach, recess = approach_and_recess(wide)
    # mean of w |u_s| over the plane: (w_p + w_g) times the mean of |x - P| from A to D
    expected = (
        math.pi
        * (1.0 + 1.0 / wide.ratio)
        / (wide.pinion_teeth * math.cos(wide.base_helix_angle))
        * (approach**2 + recess**2)
        / (approach + recess)
    )
    # |x - P| is exact on split lines; the mean over 48 phases is not
    assert cycle(wide, 48, 4).loss_factor == pytest.approx(expected, rel=1e-3)
    assert cycle(wide, 480, 4).loss_factor == pytest.approx(expected, rel=1e-5)


def test_spur_gears_have_the_loss_factor_of_niemann_and_winter() -> None:
    spur = replace(
        HE,
        helix_angle=0.0,
        normal_module=HE.transverse_module,
        normal_pressure_angle=HE.transverse_pressure_angle,
    )
    approach, recess = approach_and_recess(spur)
    ratio = approach + recess
    assert 1.0 < ratio < 2.0
    # Niemann and Winter 1989, ISO/TR 14179-2: pi (u + 1)/(z_1 u cos b) (1 - e + e_1^2 + e_2^2),
    # half the load on each of two pairs of teeth
    expected = (
        math.pi
        * (spur.ratio + 1.0)
        / (spur.pinion_teeth * spur.ratio)
        * (1.0 - ratio + approach**2 + recess**2)
    )
    # lines come and go at once: 1/phases
    assert cycle(spur, 1000, 2).loss_factor == pytest.approx(expected, rel=4e-3)


@pytest.mark.slow
def test_loss_is_the_integral_of_friction_times_sliding() -> None:
    result = cycle(HE, 4, 16)
    plane = HE.plane
    oil = lubricant_state(OIL.parameters(), TEMPERATURE)
    tan_b = math.tan(HE.base_helix_angle)
    for n, phase in enumerate(result.points.phase):
        # midpoints of the line by its general law, without the package's clipping
        total, length = 0.0, 0.0
        count = 20_000
        z = (np.arange(count) + 0.5) / count * HE.face_width - 0.5 * HE.face_width
        load = float(result.line_load[n].max())
        for i in range(3):
            X = plane.A + (phase + i) * plane.pitch
            x = X - (0.5 * plane.W - z) * tan_b
            for x_i in x[(x >= plane.A) & (x <= plane.D)]:
                motion = line_kinematics(x_i, SPEED, plane)
                state = line_friction(
                    load, motion.R, motion.entrainment, motion.sliding, oil, SURFACE, SOLID
                )
                friction = state.viscous_friction + state.boundary_friction
                dl = HE.face_width / count / math.cos(HE.base_helix_angle)
                total += friction * abs(motion.sliding) * dl
                length += dl
        assert load * length == pytest.approx(normal_force(HE, TORQUE), rel=1e-4)
        # ends of lines within half a midpoint, 1e-4 of their length
        assert result.power_loss[n] == pytest.approx(total, rel=2e-4)


def test_mean_coefficient_loss_factor_and_efficiency_are_one_statement() -> None:
    result = cycle(HE)
    lost = 1.0 - result.efficiency
    assert lost == pytest.approx(result.mean_coefficient * result.loss_factor, rel=1e-12)
    assert result.mean_power_loss == pytest.approx(lost * TORQUE * SPEED, rel=1e-12)


def test_friction_changes_sign_at_the_pitch_line() -> None:
    result = cycle(HE)
    before = result.points.x < HE.pitch_point
    inside = result.points.length > 0.0
    assert (result.coefficient[inside & before] < 0.0).all()
    assert (result.coefficient[inside & ~before] > 0.0).all()


def test_refined_points_and_phases_change_the_loss_little() -> None:
    fine = cycle(HE, 384, 24).mean_power_loss
    coarse, default = cycle(HE, 24, 12).mean_power_loss, cycle(HE).mean_power_loss
    # second order in the phases
    assert default == pytest.approx(fine, rel=2e-4)
    assert abs(default - fine) < 0.5 * abs(coarse - fine) + 1e-6 * fine


def test_a_uniform_table_gives_the_uniform_load() -> None:
    points = line_points(HE, 16, 4)
    load = table_line_load(points, density_table((1.0,), 1), TORQUE)
    assert load == pytest.approx(uniform_line_load(points, TORQUE), rel=1e-12)


def test_loads_of_a_table_carry_the_torque_and_never_pull() -> None:
    rng = np.random.default_rng(5)
    shape = (2, 8, 3, 2)
    table = density_table(
        (100.0, 300.0),
        8,
        density=1e10 * rng.uniform(0.2, 2.0, shape),
        offset=20e-6 * rng.uniform(-1.0, 1.0, shape),
    )
    points = line_points(HE, 20, 6)
    load = table_line_load(points, table, TORQUE)
    assert (load >= 0.0).all()
    assert ((load == 0.0) & (points.length > 0.0)).any()  # offsets of 20 um open some lines
    carried = (load * points.length).sum(axis=(1, 2))
    assert carried == pytest.approx(normal_force(HE, TORQUE), rel=1e-12)


def test_a_table_is_linear_in_torque_phase_and_station() -> None:
    torque, phases = (100.0, 300.0), 4
    level = np.array([1.0, 3.0])[:, None, None, None]
    place = np.array([1.0, 1.5])[None, None, None, :]
    density = np.broadcast_to(1e10 * level * place, (2, phases, 3, 2)).copy()
    points = line_points(HE, 6, 3)
    load = table_line_load(points, density_table(torque, phases, density=density), 200.0)
    inside = points.length > 0.0
    # offset zero: load along a line in proportion to the density 1 + station/2
    shape = np.where(inside, load / (1.0 + 0.5 * points.station), np.nan)
    for n in range(points.phase.size):
        values = shape[n][inside[n]]
        assert values == pytest.approx(values[0], rel=1e-12)


def test_a_line_keeps_its_load_into_the_next_period() -> None:
    # density by the line's age in periods, a + i: one function along the life of a line
    phases = 4
    age = np.arange(phases)[:, None] / phases + np.arange(3)[None, :]
    density = np.broadcast_to((1e10 * (1.0 + age))[None, :, :, None], (1, phases, 3, 2)).copy()
    points = line_points(HE, 16, 3)
    load = table_line_load(points, density_table((226.0,), phases, density=density), TORQUE)
    for n, phase in enumerate(points.phase):
        ages = phase + np.arange(3)
        inside = points.length[n] > 0.0
        shape = np.where(inside, load[n] / (1.0 + ages)[:, None], np.nan)[inside]
        if phase <= 1.0 - 1.0 / phases:
            assert shape == pytest.approx(shape[0], rel=1e-12)
        else:  # of the oldest line the next period is not in the table: its last value holds
            young = inside & (np.arange(3) < 2)[:, None]
            values = (load[n] / (1.0 + ages)[:, None])[young]
            assert values == pytest.approx(values[0], rel=1e-12)


def test_smallest_film_is_where_curvature_and_load_say() -> None:
    result = cycle(HE, 96, 24)
    place = result.smallest_film
    inside = result.points.length > 0.0
    assert place.thickness == result.minimum_film[inside].min()
    # entrainment changes by 12 % along the path, the radius by more: thinnest near an end of it
    ends = (HE.contact_start, HE.contact_end)
    assert min(abs(place.x - end) for end in ends) < 0.05 * (ends[1] - ends[0])
    assert (result.minimum_film[inside] < result.central_film[inside]).all()
