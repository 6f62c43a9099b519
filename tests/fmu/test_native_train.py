"""FMUs of trains: against closed forms, against the train in Python, and with an own element."""

from __future__ import annotations

import math
import tomllib
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from drivetrain.train.train_file import TrainFile
from fmu_src.build import build_models
from fmu_src.check import problems
from fmu_src.native.build import NativeOptions, library_kind
from fmu_src.native.model_file import HEAD_SIZE, MODEL_FILE, with_checksum
from fmu_src.native.platforms import platform_of_this_machine
from fmu_src.native.train import train_model
from fmu_src.train import definition_with_train
from gearlube_core.errors import ParameterError
from tests.helpers.reference_run import check_reference
from tests.helpers.small_trains import (
    BRAKE,
    DAMPING,
    FIRST,
    ROTORS,
    SECOND,
    STIFFNESS,
    WITH_BRAKE,
)


def built(text: str, folder: Path) -> list[Path]:
    path = folder / "train.toml"
    path.write_text(text)
    options = NativeOptions(platforms=[platform_of_this_machine()])
    return build_models(folder, train=path, native=options)


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Two rotors with a brake of another package: FMI 2 and FMI 3."""
    return built(WITH_BRAKE, tmp_path_factory.mktemp("train"))


def test_the_fmu_has_the_name_of_the_train_and_passes_the_checker(fmus: list[Path]) -> None:
    assert [path.name for path in fmus] == ["TwoRotorsOnAShaft.fmu", "TwoRotorsOnAShaft_FMI3.fmu"]
    assert [problems(path) for path in fmus] == [[], []]


@pytest.mark.slow
def test_its_reference_results_come_out_again(tmp_path: Path) -> None:
    """The torque of the port, which starts at 10 N.m here, rises by a fifth."""
    fmu = built(ROTORS.replace("drive = 0.0", "drive = 10.0"), tmp_path)[0]
    expected = check_reference(fmu, tmp_path / "unpacked")
    assert np.ptp(np.diff(expected["engine.speed"])) > 0.0


def test_its_inputs_are_the_ports_and_the_oil(fmus: list[Path]) -> None:
    description = fmpy.read_model_description(str(fmus[0]))
    inputs = {v.name: v.start for v in description.modelVariables if v.causality == "input"}
    assert {name: float(start) for name, start in inputs.items()} == {
        "drive.torque": 0.0,
        "oil.temperature": pytest.approx(333.15),
    }
    parameters = [v.name for v in description.modelVariables if v.causality == "parameter"]
    assert parameters == ["engine.speed_start"]


@pytest.mark.parametrize("version", [0, 1])
def test_a_step_of_torque_twists_the_shaft_as_in_closed_form(
    fmus: list[Path], version: int
) -> None:
    """Relative motion is a damped oscillator under T/I1; the whole turns under T - brake.

    The brake acts on the second rotor from the start, where it already twists the shaft, at a
    speed far above that below which its torque falls. 64 steps a period leave 1e-6 of the swing.
    """
    torque, h, steps = 40.0, 1e-3, 20
    found = fmpy.simulate_fmu(
        str(fmus[version]),
        stop_time=steps * h,
        output_interval=h,
        step_size=h,
        start_values={"engine.speed_start": 100.0},
        input=np.array([(0.0, torque)], dtype=[("time", float), ("drive.torque", float)]),
        output=["shaft.torque", "engine.speed", "load.speed", "drive.power", "efficiency"],
    )
    t = found["time"]
    reduced = FIRST * SECOND / (FIRST + SECOND)
    w0 = math.sqrt(STIFFNESS / reduced)
    zeta = DAMPING / (2.0 * math.sqrt(STIFFNESS * reduced))
    w = w0 * math.sqrt(1.0 - zeta * zeta)
    mean = 100.0 + (torque - BRAKE) * t / (FIRST + SECOND)
    momentum = FIRST * found["engine.speed"] + SECOND * found["load.speed"]
    assert momentum / (FIRST + SECOND) == pytest.approx(mean, rel=1e-9)
    # at the start the first body of the start speeds bears what the brake leaves
    rest = BRAKE / STIFFNESS
    steady = (torque * SECOND + BRAKE * FIRST) / (FIRST + SECOND) / STIFFNESS
    decay = np.exp(-zeta * w0 * t)
    swing = decay * (np.cos(w * t) + zeta / math.sqrt(1.0 - zeta**2) * np.sin(w * t))
    twist = steady + (rest - steady) * swing
    rate = (steady - rest) * decay * np.sin(w * t) * w0 / math.sqrt(1.0 - zeta**2)
    expected = STIFFNESS * twist + DAMPING * rate
    np.testing.assert_allclose(found["shaft.torque"], expected, atol=1e-5 * torque)


def test_it_computes_what_the_train_computes_in_python(fmus: list[Path], tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    path.write_text(WITH_BRAKE)
    definition, _ = definition_with_train(path)
    inputs = [40.0, 333.15]
    model = definition.start_model({"engine.speed_start": 100.0}, inputs)
    for _ in range(20):
        model.step(1e-3, *inputs)
    found = fmpy.simulate_fmu(
        str(fmus[0]),
        stop_time=0.02,
        output_interval=1e-3,
        start_values={"engine.speed_start": 100.0, "drive.torque": 40.0},
        output=definition.output_names,
    )
    last = np.array([found[name][-1] for name in definition.output_names])
    np.testing.assert_allclose(last, model.outputs, rtol=1e-12, atol=1e-12)


def test_a_solver_of_its_own_finds_the_motion_of_the_steps(fmus: list[Path]) -> None:
    """Model exchange, FMI 2 and 3: CVode at 1e-9 against steps, whose error is 1e-5 at most.

    It is that of the closed form above.
    """
    names = ["shaft.torque", "engine.speed", "load.angle", "energy.brake", "efficiency"]
    found = {}
    for fmu, kind in ((0, "CoSimulation"), (0, "ModelExchange"), (1, "ModelExchange")):
        run = fmpy.simulate_fmu(
            str(fmus[fmu]), fmi_type=kind, stop_time=0.02, output_interval=1e-3,
            relative_tolerance=1e-9, start_values={"engine.speed_start": 100.0},
            input=np.array([(0.0, 40.0)], dtype=[("time", float), ("drive.torque", float)]),
            output=names,
        )  # fmt: skip
        found[fmu, kind] = np.array([run[name][-1] for name in names[:-1]])
    stepped = found.pop((0, "CoSimulation"))
    for values in found.values():
        np.testing.assert_allclose(values, stepped, rtol=1e-5)


def test_each_port_is_a_flange_of_fmi_3(fmus: list[Path]) -> None:
    with zipfile.ZipFile(fmus[1]) as archive:
        root = ElementTree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    found = {one.get("name"): [v.get("variableName") for v in one] for one in root.iter("Terminal")}
    assert found == {"drive": ["drive.torque", "engine.speed", "engine.angle"]}
    known = {v.name for v in fmpy.read_model_description(str(fmus[1])).modelVariables}
    assert {name for names in found.values() for name in names} <= known


def test_the_continuous_states_are_those_that_nothing_holds(fmus: list[Path]) -> None:
    description = fmpy.read_model_description(str(fmus[0]))
    states = [one.variable.derivative.name for one in description.derivatives]
    assert states == [
        "engine.angle", "engine.speed", "load.angle", "load.speed", "shaft.twist",
        "energy.drive.work", "energy.shaft_damping", "energy.brake",
    ]  # fmt: skip
    assert description.numberOfEventIndicators == 0


def test_a_saved_state_goes_on_as_if_nothing_had_been(fmus: list[Path]) -> None:
    description = read_model_description(str(fmus[0]))
    references = {v.name: v.valueReference for v in description.modelVariables}
    asked = [
        references[name] for name in ("shaft.torque", "load.speed", "shaft_damping.power_loss")
    ]
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=extract(str(fmus[0])),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.setReal([references["drive.torque"]], [10.0])
    fmu.exitInitializationMode()
    fmu.setReal([references["drive.torque"]], [60.0])
    fmu.doStep(0.0, 1e-3)
    state = fmu.getFMUState()
    fmu.doStep(1e-3, 1e-3)
    wanted = fmu.getReal(asked)
    fmu.setFMUState(state)
    saved = fmu.getReal(asked)
    fmu.doStep(1e-3, 1e-3)
    assert fmu.getReal(asked) == wanted
    assert saved != wanted
    fmu.terminate()
    fmu.freeInstance()


def test_another_number_in_the_file_of_the_model_is_refused(fmus: list[Path]) -> None:
    """The library is made for the numbers of this train, so it takes no others."""
    folder = Path(extract(str(fmus[0])))
    description = read_model_description(str(folder))
    file = folder / "resources" / MODEL_FILE
    sound = file.read_bytes()
    identifier = description.coSimulation.modelIdentifier
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=str(folder), modelIdentifier=identifier)
    file.write_bytes(with_checksum(sound[: HEAD_SIZE + 7] + b"\x41" + sound[HEAD_SIZE + 8 :]))
    with pytest.raises(Exception, match="instantiate"):
        fmu.instantiate()
    file.write_bytes(sound)
    fmu.instantiate()
    fmu.freeInstance()


def test_a_torque_beyond_its_limit_is_refused(fmus: list[Path]) -> None:
    with pytest.raises(Exception, match="fmi2"):
        fmpy.simulate_fmu(str(fmus[0]), stop_time=1e-3, start_values={"drive.torque": 1e9})


def test_what_cannot_be_combined_is_said(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="--train cannot be combined with --python"):
        build_models(tmp_path, train="e_axle")
    with pytest.raises(ParameterError, match="--train cannot be combined with --model"):
        build_models(tmp_path, "driveline", train="e_axle", native=NativeOptions())


@pytest.mark.slow
def test_trains_of_the_packages_elements_share_one_library(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(WITH_BRAKE)
    kinds = {library_kind(train_model(name)) for name in TrainFile.shipped()}
    assert len(kinds) == 1
    assert library_kind(train_model(own)) not in kinds
    assert not train_model(own).kind  # nothing is kept of it
    own.write_text(f'driver = "generated"\n{ROTORS}')
    assert not train_model(own).kind


@pytest.mark.slow
def test_a_second_train_is_built_of_the_library_of_the_first(tmp_path: Path) -> None:
    (tmp_path / "rotors.toml").write_text(ROTORS)
    said: list[str] = []
    native = NativeOptions(
        platforms=[platform_of_this_machine()], report=said.append, reference=False
    )
    build_models(tmp_path, train="e_axle", native=native)
    said.clear()
    (fmu, other) = build_models(tmp_path, train=tmp_path / "rotors.toml", native=native)
    assert not [line for line in said if "compiling" in line or "linking" in line]
    assert [problems(path) for path in (fmu, other)] == [[], []]
    found = fmpy.simulate_fmu(
        str(fmu), stop_time=0.02, output_interval=1e-3, output=["engine.speed", "load.speed"],
        start_values={"engine.speed_start": 100.0},
        input=np.array([(0.0, 40.0)], dtype=[("time", float), ("drive.torque", float)]),
    )  # fmt: skip
    momentum = FIRST * found["engine.speed"] + SECOND * found["load.speed"]
    mean = 100.0 + 40.0 * found["time"] / (FIRST + SECOND)
    # the torque changes the momentum alone, to the rounding of 20 steps
    assert momentum / (FIRST + SECOND) == pytest.approx(mean, rel=1e-9)


@pytest.mark.slow
def test_the_two_stage_axle_as_fmu_moves_as_in_python(tmp_path: Path) -> None:
    """Code for any processor rounds in another way: 4e-12 of a value were found after 20 ms."""
    native = NativeOptions(platforms=[platform_of_this_machine()])
    (fmu, _) = build_models(tmp_path, train="e_axle", native=native)
    definition, case = definition_with_train("e_axle")
    inputs = [*case.torques.values(), case.oil_temperature]
    speeds = {f"{name}.speed_start": value for name, value in case.speeds.items()}
    model = definition.start_model(speeds, inputs)
    for _ in range(20):
        model.step(1e-3, *inputs)
    found = fmpy.simulate_fmu(
        str(fmu), stop_time=0.02, output_interval=1e-3, output=definition.output_names
    )
    last = np.array([found[name][-1] for name in definition.output_names])
    scale = np.maximum(np.abs(model.outputs), 1e-9)
    assert np.max(np.abs(last - model.outputs) / scale) < 1e-9
    # model exchange: film friction is renewed where the event is, not at the next step
    names = ["counter.speed", "stage_1.dte", "stage_2.dte", "energy.friction"]
    solved, stepped = (
        fmpy.simulate_fmu(str(fmu), fmi_type=kind, stop_time=0.004, output_interval=1e-3,
                          relative_tolerance=1e-8, output=names)
        for kind in ("ModelExchange", "CoSimulation")
    )  # fmt: skip
    for name in names:  # 2e-4 of the friction, 5e-5 of the others were found
        assert solved[name][-1] == pytest.approx(stepped[name][-1], rel=1e-3), name


def test_the_shipped_file_is_complete() -> None:
    data = tomllib.loads(TrainFile.shipped_text("e_axle"))
    assert set(data["start"]["torque_n_m"]) == {
        name for name, one in data["elements"].items() if one["kind"] == "port"
    }
