"""One compiled code for all lists against code for one list."""

from __future__ import annotations

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.helical_model.pair import helical_pair
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.train.choice import generated_kernel, interpreted_kernel, kernel_of
from gearlube_core.dynamics.train.element import COORDINATES
from gearlube_core.dynamics.train.elements.ball_bearing import BallBearing
from gearlube_core.dynamics.train.elements.cylindrical_bearing import CylindricalBearing
from gearlube_core.dynamics.train.elements.drag import Churning, Seal
from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.elements.spring_support import SpringSupport
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.part import ELEMENTS, Body, Element
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.frame_model import MOUNTS, box_frame, reduced
from tests.helpers.small_trains import OIL, two_rotors

KELVIN = 333.15


def moved(
    train: Train, speeds: dict[str, float], torques: dict[str, float]
) -> dict[str, np.ndarray | list[float]]:
    """Return what a train gives after some steps of several lengths."""
    train.initialise(speeds, torques, KELVIN)
    for h in (1e-6, 1e-4, 2.5e-4, 1e-4):
        train.step(h, {name: 1.01 * torque for name, torque in torques.items()}, KELVIN)
    begun = train.event(train.continuous)
    return {
        "state": train.get_state(),
        "outputs": list(train.outputs().values()),
        "rates": train.rates(),
        "derivative": train.derivative(begun),
        "indicators": train.indicators(begun),
        "modes": train.modes()[0],
        "energy": [train.energy],
    }


def assert_equal_bits(train: Train, speeds: dict[str, float], torques: dict[str, float]) -> None:
    parts = train.bodies, train.elements, train.oil
    by_list = moved(Train(*parts, driver="generated"), speeds, torques)
    by_rows = moved(Train(*parts, driver="interpreted"), speeds, torques)
    for name, found in by_rows.items():
        np.testing.assert_array_equal(found, by_list[name], name)
    assert abs(by_rows["state"]).max() > 0.0


def test_both_drivers_give_equal_bits():
    """The same element stands twice, so that its rows differ; two kinds share their kernels."""
    bodies = [Body.spinning("engine", 0.2), Body.spinning("wheel", 2.0)]
    bodies.append(Body(name="gear", mass=3.0, inertia=0.01, polar_inertia=0.02))
    bodies.append(Body(name="frame", mass=1.0, inertia=1.0, polar_inertia=1.0, held=COORDINATES))
    case = Housing(name="case", model=reduced(box_frame(), modes=5), highest_frequency=1e3)
    common = {"body": "gear", "housing": "frame", "pitch_diameter": 0.05, "f0": 2.0, "f1": 3e-4}
    elements: list[Element] = [
        Port(name="motor", body="engine"),
        HalfShaft(name="input", first="engine", second="gear", stiffness=2e4, damping=1.0),
        SpringSupport(name="bearings", body="gear", K_xx=1e8, K_yy=2e8, K_zz=3e7, K_ax=1e5,
                      K_ay=2e5),
        Seal(name="seal", body="gear", torque=0.3),
        Churning(name="sump", body="gear", law="boness_1989", ring_diameter=0.2, ring_width=0.03,
                 immersion=0.04, oil_volume=1e-3),
        HalfShaft(name="output", first="gear", second="wheel", stiffness=1e4, damping=2.0),
        Port(name="road", body="wheel", sign=-1.0),
        Seal(name="hub", body="wheel", torque=0.1),
        BallBearing(name="balls", n_balls=8, ball_diameter=0.01, inner_groove=0.52,
                    outer_groove=0.53, arm=-0.02, housing_z=-0.01, offset=5e-6, **common),
        CylindricalBearing(name="rollers", n_rollers=12, roller_diameter=0.01, roller_length=0.01,
                           arm=0.02, housing_z=0.02, clearance=-4e-6, damping_time=1e-5, **common),
        Joint(name="seat", first="gear", second="case.a_low", K_xx=1e8, K_yy=1e8, K_zz=1e7),
        *(Joint(name=one, first=f"case.{one}", second="ground", K_xx=3e5, K_yy=4e5, K_zz=2e5)
          for one in MOUNTS),
    ]  # fmt: skip
    train = Train([*bodies, case], elements, OIL)
    assert_equal_bits(train, {"engine": 100.0}, {"motor": 40.0, "road": 35.0})


@pytest.mark.slow
@pytest.mark.parametrize("name", TrainFile.shipped())
def test_both_drivers_give_equal_bits_of_shipped_trains(name: str):
    case = TrainFile.named(name).case()
    assert_equal_bits(case.train, dict(case.speeds), dict(case.torques))


@pytest.mark.parametrize("name", TrainFile.shipped())
def test_shipped_trains_compile_nothing_of_their_own(name: str):
    made = TrainFile.named(name).case().train.assembly
    assert kernel_of(made, "automatic") is interpreted_kernel()


def test_every_element_of_the_package_is_known_to_the_interpreter():
    shipped = [one for one in ELEMENTS.known().values() if ELEMENTS.is_ours(one)]
    assert all(one.interpreted for one in shipped)
    assert len(shipped) > 5


def test_lists_that_differ_in_the_size_of_tables_alone_share_generated_code():
    """The pair of He et al. with one density, and with its line mesh of 32 phases."""
    gears, mesh = HelicalGearFile.named("he_2007"), named_line_mesh("he_2007")
    pairs = [helical_march_parameters(gears, line_mesh=one) for one in (None, mesh)]
    trains = [Train(*helical_pair(one), one.oil) for one in pairs]
    first, second = (train.assembly for train in trains)
    assert first.memory.size < second.memory.size
    assert generated_kernel(first) is generated_kernel(second)
    load = {"input": 226.0, "output": 280.0}
    for train in trains:
        assert_equal_bits(train, {"wheel": 84.4}, load)


def test_an_element_from_outside_has_code_of_its_list():
    train = two_rotors(brake=3.0)
    assert kernel_of(train.assembly, "automatic") is generated_kernel(train.assembly)
    with pytest.raises(ParameterError, match="'brake' has such kernels"):
        Train(train.bodies, train.elements, train.oil, driver="interpreted")
