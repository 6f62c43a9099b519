"""A run-up of two gears on soft supports: against their answer by frequency, and as a sound."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from drivetrain.train.train_file import TrainCase
from gearlube.studies.drivetrain.operation import Operation, lost_power
from gearlube.studies.drivetrain.ramp import FILE, run_ramp
from gearlube.studies.sound.force_record import read_forces
from gearlube_core.dynamics.train.elements.drag import Seal
from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.dynamics.train.response import order_response
from gearlube_core.errors import ParameterError
from gearlube_core.housings.reduced_model import InterfaceNode, ReducedModel
from tests.helpers.small_trains import KELVIN, OIL

TORQUE, TEETH, SEAL = 50.0, 20, 0.5
ROTOR = 1e-2  # kg.m2
SLOW, FAST, DURATION = 200.0, 320.0, 3.0  # rad/s, s


def case(load: float = -2.0 * TORQUE) -> TrainCase:
    held = ("z", "rx", "ry")
    bodies = [
        Body(name="pinion", mass=2.0, inertia=1.0, polar_inertia=ROTOR, held=held),
        Body(name="wheel", mass=5.0, inertia=1.0, polar_inertia=5e-2, held=held),
    ]
    mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=TEETH, teeth_2=2 * TEETH,
                    normal_module=5e-3, face_width=0.05, backlash=1e-4, stiffness=4e8,
                    stiffness_waves=(0.01, 0.0), damping=2000.0)  # fmt: skip
    spring = {"K_xx": 1e8, "K_yy": 1e8, "K_zz": 1e8, "c_x": 2000.0, "c_y": 2000.0}
    elements = [
        mesh,
        Seal(name="seal", body="pinion", torque=SEAL),
        *(SpringSupport(name=f"{one}_bearing", body=one, **spring) for one in ("pinion", "wheel")),
        Port(name="motor", body="pinion"),
        Port(name="road", body="wheel", sign=-1.0),
    ]
    return TrainCase(
        name="two gears",
        train=Train(bodies, elements, OIL),
        speeds={"wheel": -0.5 * SLOW},
        torques={"motor": TORQUE, "road": load},
        oil_temperature=KELVIN,
    )


@pytest.fixture(scope="module")
def runup(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runup")
    run_ramp(case(), SLOW, FAST, duration=DURATION, folder=folder)
    return folder


def test_the_load_is_what_the_seal_leaves_of_the_torque_at_any_speed():
    operation = Operation.of(case())
    for speed, torque in ((50.0, 20.0), (400.0, 80.0), (100.0, -30.0)):
        there = operation.at(speed, torque)
        # a seal lacks 0.01 rad/s over the speed of its torque
        assert operation.load_of(there) == pytest.approx(torque - SEAL, abs=3e-4 * SEAL)
        assert lost_power(there.train) == pytest.approx(SEAL * speed, rel=3e-4)


@pytest.mark.slow
def test_the_shaft_follows_its_ramp(runup: Path):
    with xr.open_dataset(runup / FILE) as found:
        wanted = SLOW + (FAST - SLOW) * found["time"].values / DURATION
        # its mesh order swings by less; the loop is slow
        np.testing.assert_allclose(found["pinion_speed"].values, wanted, rtol=5e-3)


@pytest.mark.slow
def test_orders_of_the_run_up_are_those_by_frequency(runup: Path):
    """The rotor takes its inertia's torque from the mesh; 1 % waves err by their square.

    A resonance lags behind the ramp by 0.6 %, and by half of that in twice the time.
    """
    carried = 1.0 - ROTOR * (FAST - SLOW) / DURATION / (TORQUE - SEAL)
    with xr.open_dataset(runup / FILE) as found:
        speeds = found["block_speed"].values
        for part in ("mesh", "pinion_bearing", "wheel_bearing"):
            one = {"line": "mesh, 20", "part": part}
            in_time = found["order_track"].sel(one).values
            rpm = speeds * 60.0 / (2.0 * math.pi)
            by_frequency = np.interp(rpm, found["order_speed"], found["order_force"].sel(one))
            np.testing.assert_allclose(in_time, carried * by_frequency, rtol=0.01)


def test_sound_reads_the_forces_of_a_run_up(runup: Path):
    record = read_forces(runup)
    assert record.paths[:3] == ("pinion_bearing.x", "pinion_bearing.y", "pinion_bearing.z")
    assert record.speed[-1] == pytest.approx(FAST, rel=5e-3)


@pytest.mark.slow
def test_the_nodes_of_a_housing_move_in_a_run_up_as_by_frequency():
    """Its velocity is the mean square of all nodes; a line between two bins lacks up to 15 %."""
    plain = case()
    train = plain.train.changed(
        bodies=[*plain.train.bodies[:2], plate()],
        elements=[
            *(one for one in plain.train.elements if not isinstance(one, SpringSupport)),
            *(joint(f"{one}_bearing", one, f"case.{one}", 1e8) for one in ("pinion", "wheel")),
            *(joint(f"{one}_mount", f"case.{one}", "ground", 1e6) for one in ("pinion", "wheel")),
        ],
    )
    housed = replace(plain, train=train)
    found = run_ramp(housed, 0.98 * SLOW, SLOW, duration=1.5)
    moved = [f"case.{one}.displacement.{c}" for one in ("pinion", "wheel") for c in "xyz"]
    x = abs(order_response(housed.start(), "mesh", moved, [1.0], 1)[0, 0])
    velocity = math.sqrt((x**2).sum() / 2.0) * TEETH * SLOW
    assert found.attrs["nodes"] == "case.pinion, case.wheel"
    largest = found["velocity_waterfall"].isel(slice=-1).sel(spectrum=slice(300.0, 900.0)).max()
    assert 0.83 * velocity < float(largest) < 1.05 * velocity


def joint(name: str, first: str, second: str, stiffness: float) -> Joint:
    springs = {"K_xx": stiffness, "K_yy": stiffness, "K_zz": stiffness, "K_ax": 1e3, "K_ay": 1e3}
    return Joint(name=name, first=first, second=second, c_x=2e3, c_y=2e3, c_z=2e3, **springs)


def plate() -> Housing:
    """Return two masses on a stiff spring, at the axes of both gears."""
    lever, arm = np.eye(6), 0.075
    lever[1, 5], lever[2, 4] = -2.0 * arm, 2.0 * arm
    spring = np.diag([1e9, 1e9, 1e9, 1e7, 1e7, 1e7])
    model = ReducedModel(
        stiffness=np.block(
            [[spring, -spring @ lever], [-lever.T @ spring, lever.T @ spring @ lever]]
        ),
        mass=np.kron(np.eye(2), np.diag([5.0, 5.0, 5.0, 0.05, 0.05, 0.05])),
        nodes=(InterfaceNode("pinion", -arm, 0.0, 0.0), InterfaceNode("wheel", arm, 0.0, 0.0)),
        owner=np.repeat([0, 1], 6),
        direction=np.tile(np.arange(6), 2),
    )
    return Housing(name="case", model=model)


def test_a_train_whose_ports_take_nothing_has_no_run_up():
    with pytest.raises(ParameterError, match=r"one that takes it, got motor .* W, road 0 W"):
        run_ramp(case(load=0.0), SLOW, FAST)


def test_a_ramp_that_is_too_short_or_too_slow_is_refused_with_a_cure():
    with pytest.raises(ParameterError, match=r"8 .* got 0\.413803. Take 3\.87 s or more"):
        run_ramp(case(), 12.0, 14.0, duration=0.2)
    with pytest.raises(ParameterError, match=r"start of the run-up must be .* rpm, got 0\.9549"):
        run_ramp(case(), 0.1, 14.0)
