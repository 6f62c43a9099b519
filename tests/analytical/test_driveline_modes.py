"""Natural modes against matrices and closed forms written down by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from drivetrain.driveline.model import Driveline
from drivetrain.driveline.modes import coupled_modes, driveline_modes
from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.engine import Engine
from drivetrain.road_load import mohammadpour_2015_road_load, mohammadpour_2015_vehicle
from gearlube_core.dynamics.hypoid_axle.linearise import LinearAxle
from tests.helpers.each import each

RATIO = 36 / 13
INERTIA = 1.734e-3 + 5.81e-2 / RATIO**2
LOAD = mohammadpour_2015_road_load()
DAMPED = DrivelineParameters(road_load=LOAD)
# No damper, a tyre that does not creep, no drag that depends on speed, no controller.
CREEP_FREE = 1e7
UNDAMPED = replace(
    DAMPED,
    road_load=replace(LOAD, vehicle=replace(mohammadpour_2015_vehicle(), drag_coefficient=0.0)),
    engine=Engine(orders=(), flywheel_damping=0.0),
    propshaft_damping=0.0,
    half_shaft_damping=0.0,
    tyre_slip_stiffness=DAMPED.tyre_stiffness * CREEP_FREE,
    tyre_relaxation_length=CREEP_FREE,
    speed_control_frequency=0.0,
)


@each("speed_kmh", [20.0, 60.0, 100.0])
def test_undamped_modes_are_those_of_a_chain_of_five_masses(speed_kmh: float) -> None:
    line = Driveline(UNDAMPED, speed_kmh / 3.6)
    g, r = line.gear_ratio, LOAD.tyre.rolling_radius
    box = 0.06 + 0.012 / g**2
    # Coordinates: crank, gearbox input, pinion, hubs, vehicle (m).
    inertia = np.diag([0.16, box, INERTIA, 1.8, 1300.0 + 1.8 / r**2])
    stiffness = np.zeros((5, 5))
    for k, row in (
        (400.0, [1, -1, 0, 0, 0]),
        (UNDAMPED.propshaft_stiffness, [0, 1 / g, -1, 0, 0]),
        (UNDAMPED.half_shaft_stiffness, [0, 0, 1 / RATIO, -1, 0]),
        (DAMPED.tyre_stiffness, [0, 0, 0, r, -1]),
    ):
        stiffness += k * np.outer(row, row)
    expected = np.sqrt(np.abs(eigh(stiffness, inertia, eigvals_only=True)))[1:] / (2 * math.pi)
    modes = driveline_modes(line)
    # Residual creep V/sigma of 1e-6 1/s and rounding of eigenvalues.
    assert [m.frequency for m in reversed(modes)] == pytest.approx(list(expected), rel=1e-6)
    assert max(m.damping_ratio for m in modes) < 1e-6


MESH, BEARING = 3e8, 4e8  # N/m
MASSES = np.diag([1.734e-3, 5.81e-2, 12.0, 12.0, 12.0, 49.9, 49.9, 49.9])
# how much the two rotations and the six displacements close the mesh [m], [-]
CLOSING = np.array([0.0207, -0.0207 * RATIO, -0.3, 0.6, 0.4, 0.2, -0.5, 0.5])


def elastic_axle() -> LinearAxle:
    stiffness = MESH * np.outer(CLOSING, CLOSING) + np.diag([0.0, 0.0, *6 * [BEARING]])
    return LinearAxle(MASSES, np.zeros((8, 8)), stiffness, np.zeros((8, 8)))


def test_undamped_modes_of_axle_and_car_are_those_of_their_matrices() -> None:
    line = Driveline(UNDAMPED, 60.0 / 3.6)
    g, r = line.gear_ratio, LOAD.tyre.rolling_radius
    # coordinates: those of the axle, then crank, gearbox input, hubs, vehicle (m)
    inertia = np.zeros((12, 12))
    inertia[:8, :8] = MASSES
    inertia[8:, 8:] = np.diag([0.16, 0.06 + 0.012 / g**2, 1.8, 1300.0 + 1.8 / r**2])
    springs = {
        "mesh": (MESH, {i: float(CLOSING[i]) for i in range(8)}),
        "flywheel springs": (400.0, {8: 1.0, 9: -1.0}),
        "propshaft": (UNDAMPED.propshaft_stiffness, {9: 1.0 / g, 0: -1.0}),
        "half-shafts": (UNDAMPED.half_shaft_stiffness, {1: 1.0, 10: -1.0}),
        "tyres": (DAMPED.tyre_stiffness, {10: r, 11: -1.0}),
    }
    parts = {"bearings": np.diag([0.0, 0.0, *6 * [BEARING], *4 * [0.0]])}
    for name, (k, ends) in springs.items():
        row = np.zeros(12)
        row[list(ends)] = list(ends.values())
        parts[name] = k * np.outer(row, row)
    values, shapes = eigh(sum(parts.values()), inertia)
    modes = coupled_modes(elastic_axle(), line)
    # residual creep of 1e-6 1/s and rounding of eigenvalues of matrices of condition 1e13
    expected = np.sqrt(values[1:]) / (2.0 * math.pi)
    assert [one.frequency for one in modes] == pytest.approx(list(expected), rel=1e-5)
    # shares are of one mode each; those of close frequencies may mix
    for one, value, shape in zip(modes, values[1:], shapes.T[1:], strict=True):
        if np.sum(np.abs(values / value - 1.0) < 0.01) == 1:
            whole = shape @ sum(parts.values()) @ shape
            for name, matrix in parts.items():
                assert one.strain[name] == pytest.approx(shape @ matrix @ shape / whole, abs=1e-4)
            moved = np.sqrt(np.diag(MASSES)) * one.shape  # modal mass 1 in both; the sign is free
            expected = np.sqrt(np.diag(MASSES)) * shape[:8]
            assert np.abs(moved @ expected) == pytest.approx(expected @ expected, abs=1e-4)
            assert moved @ moved == pytest.approx(expected @ expected, abs=1e-4)


def test_a_stiff_axle_in_its_car_has_the_modes_of_a_rigid_one() -> None:
    stiff = elastic_axle()
    stiff = replace(stiff, stiffness=100.0 * stiff.stiffness)
    line = Driveline(DAMPED, 60.0 / 3.6)
    rigid = driveline_modes(line)[0]
    found = min(coupled_modes(stiff, line), key=lambda one: abs(one.frequency - rigid.frequency))
    # the axle's own springs take part by the ratio of the stiffnesses, below 1 % here: half of
    # that in the frequency
    assert found.frequency == pytest.approx(rigid.frequency, rel=5e-3)
    assert found.damping_ratio == pytest.approx(rigid.damping_ratio, rel=5e-3)
    assert found.car_strain > 0.99


def test_an_axle_without_a_car_rings_alone() -> None:
    free = coupled_modes(elastic_axle(), None)
    values = eigh(elastic_axle().stiffness, MASSES, eigvals_only=True)
    expected = np.sqrt(values[1:]) / (2.0 * math.pi)
    assert [one.frequency for one in free] == pytest.approx(list(expected), rel=1e-6)
    assert all(one.car_strain == 0.0 for one in free)


def test_an_axle_between_two_walls_rings_on_both_shafts_and_has_their_damping() -> None:
    walls = replace(
        UNDAMPED,
        engine=Engine(orders=(), secondary_inertia=1e7, flywheel_damping=0.0),
        wheel_inertia=1e7,
        propshaft_damping=0.5,
        half_shaft_damping=2.0,
    )
    mode = driveline_modes(Driveline(walls, 60 / 3.6))[0]
    c = 0.5 + 2.0 / RATIO**2
    k = walls.propshaft_stiffness + walls.half_shaft_stiffness / RATIO**2
    # Walls of 1e7 kg m2 against 1e-2 kg m2.
    assert mode.frequency == pytest.approx(math.sqrt(k / INERTIA) / (2 * math.pi), rel=1e-6)
    assert mode.damping_ratio == pytest.approx(c / (2 * math.sqrt(k * INERTIA)), rel=1e-6)
    assert mode.name == "axle on propshaft"


def test_the_default_car_shuffles_below_ten_hertz_and_rings_at_the_axle_near_300() -> None:
    modes = driveline_modes(Driveline(DAMPED, 60 / 3.6))
    assert modes[0].name == "axle on propshaft"
    assert 280 < modes[0].frequency < 310  # mesh frequency of about 60 km/h
    # Shuffle of passenger cars: 2 to 10 Hz depending on the gear.
    assert 2 < modes[-1].frequency < 10
    assert all(0.0 < mode.damping_ratio < 0.5 for mode in modes)
    for mode in modes:
        assert sum(mode.motion.values()) == pytest.approx(1.0, abs=1e-12)
        assert sum(mode.strain.values()) == pytest.approx(1.0, abs=1e-12)


def test_a_heavier_pinion_lowers_the_axle_mode() -> None:
    line = Driveline(DAMPED, 60 / 3.6)
    heavier = driveline_modes(line, pinion_inertia=2 * 1.734e-3)
    assert heavier[0].frequency < driveline_modes(line)[0].frequency


def test_the_speed_controller_is_critically_damped_and_slower_than_every_mode() -> None:
    from drivetrain.driveline.steady_state import rigid_axle_jacobian

    line = Driveline(DAMPED, 60 / 3.6)
    eigenvalues = np.linalg.eigvals(rigid_axle_jacobian(DAMPED, line.steady))
    slow = eigenvalues[np.abs(eigenvalues) < 2 * math.pi]
    # Two poles near 0.1 Hz; drag and elasticity move them by tens of per cent as a double root.
    assert len(slow) == 2
    assert math.sqrt(abs(np.prod(slow))) == pytest.approx(2 * math.pi * 0.1, rel=0.05)
    without = driveline_modes(Driveline(replace(DAMPED, speed_control_frequency=0.0), 60 / 3.6))
    axle, free = driveline_modes(line)[0], without[0]
    # The fast mode must not feel the controller: loop gain 0.1 Hz / 290 Hz squared.
    assert axle.frequency == pytest.approx(free.frequency, rel=1e-6)
    assert axle.damping_ratio == pytest.approx(free.damping_ratio, abs=1e-6)
    # Shuffle at 6 Hz loses about 2 * 0.1 / 6 / 2 of damping ratio, since the engine answers a
    # change of vehicle speed through the whole driveline.
    for mode, free in zip(driveline_modes(line), without, strict=True):
        assert mode.frequency == pytest.approx(free.frequency, rel=0.03)
        assert mode.damping_ratio == pytest.approx(free.damping_ratio, abs=0.025)
