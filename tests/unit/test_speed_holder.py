"""A holder keeps the speed of a shaft, and its work counts."""

from __future__ import annotations

import math

import pytest

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.held_port import HeldPort, SpeedHolder
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import Body
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant

OIL, H, GAIN = 333.15, 1e-4, 30.0
AXLE, GEARS = mohammadpour_2015_axle(), helical_march_parameters(HelicalGearFile.named("he_2007"))
# a model, its speed [rad/s], torques with a load that is not balanced [N.m], a step of it,
# and the ratio
CASES = {
    "axle": (
        lambda holder: HypoidAxle(AXLE, holder=holder),
        52.0,
        (60.0, 170.0),
        30.0,
        AXLE.mesh.ratio,
    ),
    "pair": (
        lambda holder: HelicalPairModel(GEARS, holder),
        104.0,
        (226.0, 300.0),
        60.0,
        GEARS.pair.ratio,
    ),
}


@pytest.fixture(params=CASES)
def case(request):
    return CASES[request.param]


def started(case, mode):
    make, speed, (pinion, wheel), *_ = case
    model = make(SpeedHolder(mode=mode, governor_gain=GAIN))
    model.initialise(
        pinion_speed=speed, pinion_torque=pinion, wheel_torque=wheel, oil_temperature=OIL
    )
    return model


def balance(model):
    """Work put in less heat and what is stored [J]."""
    energy = {name: model.output(name) for name in model.output_names if name.startswith("energy.")}
    return energy.pop("energy.pinion_work") - sum(energy.values())


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["governor", "imposed"])
def test_the_speed_stays_under_a_step_of_the_load_and_the_work_of_the_holder_counts(case, mode):
    _, speed, (pinion, wheel), more, ratio = case
    model, free = started(case, mode), started(case, "none")
    begin, means = balance(model), []
    for load in (wheel, wheel + more):
        torque = fastest = slowest = 0.0
        for k in range(2000):
            model.step(H, pinion, load, OIL)
            if k >= 1000:
                torque += 1e-3 * model.output("speed.hold_torque")
                off = model.output("pinion.speed") - speed
                slowest, fastest = min(slowest, off), max(fastest, off)
        means.append(torque)
        if mode == "imposed":
            assert max(fastest, -slowest) < 1e-9 * speed
        else:
            # the mean of gain * error, by its definition; the swing is that of the mesh
            assert slowest == pytest.approx(-torque / GAIN, rel=0.2)
    # rigid bodies: the load over the ratio, and what friction takes of it, at most 6 %
    assert more / ratio <= means[1] - means[0] <= 1.06 * more / ratio
    # of the work put in: the load level of the mesh data, and with it the stiffness, follows the
    # torque of the holder by 30 N.m, for which no work is counted, as with an input
    left = balance(model) - begin
    assert abs(left) < 1e-5 * model.output("energy.pinion_work")
    for _ in range(2000):
        free.step(H, pinion, wheel, OIL)
    assert free.output("pinion.speed") < 0.7 * speed  # why a holder is there
    assert free.output("speed.hold_torque") == 0.0


def test_an_imposed_speed_follows_a_new_reference_by_its_time_constant(case):
    _, speed, (pinion, wheel), *_ = case
    model = started(case, "imposed")
    for _ in range(30):
        model.step(H, pinion, wheel, OIL, speed + 1.0)
    # RK4 with two steps or more in a time constant
    left = speed + 1.0 - model.output("pinion.speed")
    assert left == pytest.approx(math.exp(-3.0), rel=2e-3)


def test_without_a_holder_the_reference_changes_no_bit(case):
    _, speed, (pinion, wheel), *_ = case
    model, other = started(case, "none"), started(case, "none")
    for _ in range(20):
        model.step(H, pinion, wheel, OIL)
        other.step(H, pinion, wheel, OIL, speed + 10.0)
    assert model.outputs.tolist() == other.outputs.tolist()


def test_the_load_level_of_the_mesh_counts_what_the_holder_puts_in():
    """A holder that drives alone reads the mesh data at its own torque."""
    driven = HypoidAxle(AXLE, holder=SpeedHolder(mode="imposed"))
    driven.initialise(pinion_speed=52.0, pinion_torque=0.0, wheel_torque=160.0, oil_temperature=OIL)
    for _ in range(2000):
        driven.step(H, 0.0, 160.0, OIL)
    # ten time constants of the level; it swings with the mesh
    assert driven.output("mesh.load_torque") == pytest.approx(160.0 / AXLE.mesh.ratio, rel=0.06)


def test_what_no_holder_can_do_is_refused(case):
    make, speed, (pinion, wheel), *_ = case
    model = started(case, "imposed")
    for reference in (5001.0, -5001.0, math.nan):
        with pytest.raises(ParameterError, match=r"speed\.reference .*rad/s"):
            model.step(H, pinion, wheel, OIL, reference)
    given = {"pinion_torque": pinion, "wheel_torque": wheel, "oil_temperature": OIL}
    with pytest.raises(ParameterError, match=r"against pinion\.speed_start .* got -50 rad/s"):
        model.initialise(pinion_speed=speed, speed_reference=-50.0, **given)
    make(None).initialise(pinion_speed=speed, speed_reference=-50.0, **given)  # holds nothing
    with pytest.raises(ParameterError, match="mode must be one of none, governor, imposed"):
        SpeedHolder(mode="steady")
    with pytest.raises(ParameterError, match=r"governor_gain .* N.m.s/rad"):
        SpeedHolder(governor_gain=0.0)


def rotors(mode, **given):
    bodies = [Body.spinning("engine", 0.2), Body.spinning("wheel", 2.0)]
    shaft = HalfShaft(name="shaft", first="engine", second="wheel", stiffness=1e4, damping=20.0)
    holder = SpeedHolder(mode=mode, governor_gain=GAIN)
    ports = [
        HeldPort(name="motor", body="engine", holder=holder, speed_reference=100.0, **given),
        Port(name="load", body="wheel", sign=-1.0),
    ]
    return Train(bodies, [shaft, *ports], Lubricant.named("mohammadpour_2015"))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("mode", "droop"), [("imposed", 0.0), ("governor", 60.0 / GAIN)])
def test_a_train_is_held_at_a_port(mode, droop, sign):
    train = rotors(mode, sign=sign)
    torques = {"motor": 0.0, "load": sign * 60.0}
    train.initialise({"engine": sign * 100.0}, torques, OIL)
    for _ in range(4000):
        train.step(1e-3, torques, OIL)
    # rotors on one shaft without friction: the holder bears the whole load
    assert sign * train.state("engine.rz.rate") == pytest.approx(100.0 - droop, rel=1e-9)
    assert train.outputs()["motor.hold_torque"] == pytest.approx(60.0, rel=1e-6)
    for _ in range(4000):
        train.step(1e-3, torques | {"motor.speed_reference": 120.0}, OIL)
    assert sign * train.state("wheel.rz.rate") == pytest.approx(120.0 - droop, rel=1e-6)


def test_what_a_train_cannot_hold_is_refused():
    with pytest.raises(ParameterError, match="a held_port, got exponential"):
        rotors("imposed").changed(integration="exponential")
    train = rotors("none")
    torques = {"motor": 0.0, "load": 0.0}
    train.initialise({"engine": 100.0}, torques, OIL)
    with pytest.raises(ParameterError, match="torques must be given for every port"):
        train.step(1e-3, torques | {"motor.speed_reference": 120.0}, OIL)
    still = Body(name="engine", mass=1.0, inertia=1.0, polar_inertia=0.2, held=("rz",))
    port = HeldPort(name="motor", body="engine")
    with pytest.raises(ParameterError, match="must be a rigid body that turns, got engine"):
        Train([still], [port], Lubricant.named("mohammadpour_2015"))
