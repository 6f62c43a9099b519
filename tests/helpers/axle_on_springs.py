"""The axle on a bearing type that one file brings: by its name, in Python and in an FMU."""

import json
import sys
import tomllib
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from drivetrain.axle_file.axle_file import AxleFile
from fmu_src.axle_arguments import axle_parameters
from fmu_src.hypoid_axle import DEFINITION, definition_with_axle
from fmu_src.identity import contents
from fmu_src.native.hypoid_axle import native_model
from fmu_src.native.model import OK, Operation
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, linearise
from gearlube_core.dynamics.hypoid_axle.uncertain import changed_axle, uncertain_of
from gearlube_core.errors import ParameterError

STIFFNESS = 3e8  # N/m, of the two bearings of a shaft together, in every direction
DRAGS = (0.0, 0.02, 0.05)  # N.m.s/rad: of the first case; of pinion and gear of the others
SPEED, TORQUE, OIL = 240.0, 66.0, 368.15  # rad/s, N.m, K
TORQUES = (TORQUE, 176.0)  # N.m
GEAR_SET = '[gear_set]\nmesh_table = "mohammadpour_2015"\n'
SPRINGS = f'{GEAR_SET}[pinion.bearing]\ntype = "springs"\n'
WITH_DRAG = (
    f"{SPRINGS}stiffness_n_per_um = 200.0\ndrag_n_m_s_per_rad = {DRAGS[1]}\n"
    f'[gear.bearing]\ntype = "springs"\ndrag_n_m_s_per_rad = {DRAGS[2]}\n'
)


def file_with(text):
    return AxleFile.from_data(tomllib.loads(text), "the file")


def of_file(text):
    return file_with(text).car_axle(notes=False).axle


def started(parameters):
    axle = HypoidAxle(parameters)
    axle.initialise(
        pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=TORQUES[1], oil_temperature=OIL
    )
    return axle


def report():
    """Write what the axle on springs does to stdout, as JSON."""
    import_module("tests.helpers.spring_bearing")
    axle = started(of_file(SPRINGS))
    found = {
        "frequencies": linearise(axle, OIL, TORQUE).modes()[0].tolist(),
        "at rest": axle.outputs.tolist(),
    }
    for _ in range(3):
        axle.step(1e-4, *TORQUES, OIL)
    found["moving"] = axle.outputs.tolist()
    laws = ("palmgren", "skf_2013", "biboulet_houpert_2010", "solved_films")
    found["with drag"] = [
        started(replace(of_file(WITH_DRAG), bearing_torque_loss=law)).outputs.tolist()
        for law in laws
    ]
    sys.stdout.write(json.dumps(found))


def refusal(text, changes=None):
    try:
        axle_parameters(changes or {}, of_file(text))
    except ParameterError as error:
        return str(error)
    return ""


def definition(text):
    with TemporaryDirectory() as folder:
        path = Path(folder, "axle.toml")
        path.write_text(text)
        return definition_with_axle(path)


def report_names():
    """Write what axle file, FMU and error bars know of the type, as JSON."""
    before = refusal(SPRINGS)
    with TemporaryDirectory() as folder:  # where an installed package would be
        entry = Path(folder, "springs-1.0.dist-info", "entry_points.txt")
        entry.parent.mkdir()
        entry.write_text("[gearlube.bearings]\nsprings = tests.helpers.spring_bearing\n")
        sys.path.append(folder)
        axle = of_file(WITH_DRAG)
    uncertain = next(one for one in uncertain_of(axle) if one.name == "bearing_stiffness")
    upper = changed_axle(uncertain, axle, 2.0, np.ones(1))
    of_fmu = definition(WITH_DRAG)
    released = [variable.name for variable in DEFINITION.variables]
    notes = file_with(WITH_DRAG).car_axle().inputs
    sys.stdout.write(json.dumps({
        "before": before,
        "refusals": [
            refusal(SPRINGS + line)
            for line in ("stifness_n_per_um = 3.0", "stiffness_n_per_um = 0.3", "drag = '1'",
                         "preload_n = 3e3", "[gear.bearing]\nrollers = 12",
                         '[model]\nbearing_approach = "full"')
        ],
        "left alone": refusal(SPRINGS, {"bearing_preload": 2500.0}),
        "notes": [list(one) for one in notes if one.field.startswith("gear.bearing")],
        "varied": file_with(SPRINGS).varied({"pinion.bearing.stiffness_n_per_um": 250.0})
        .car_axle(notes=False).axle.bearing.stiffness,
        "upper": [one.stiffness for one in upper.bearings],
        "preload": any(one.name == "preload" for one in uncertain_of(axle)),
        "code": "tests/helpers/spring_bearing.py" in contents(of_fmu),
        "same references": [one.name for one in of_fmu.variables][: len(released)] == released,
        "own": [[one.name, one.start, one.minimum, one.maximum, one.unit, one.description]
                for one in of_fmu.variables[len(released):]],
        "fixed": [[one.name, one.start, one.minimum, one.maximum] for one in of_fmu.variables
                  if one.description.startswith("Without effect") and one.type == "Real"],
    }))  # fmt: skip


def report_native():
    """Write outputs of the native FMU's entry and of Python after some steps, as JSON."""
    from tests.helpers.object_code import LoadedModel

    import_module("tests.helpers.spring_bearing")
    of_fmu, inputs = definition(WITH_DRAG), [*TORQUES, OIL]
    loaded = LoadedModel(native_model(of_fmu))
    found = []
    for changes in ({}, {"pinion_bearing_stiffness": 4e8, "gear_bearing_drag": 0.5}):
        values = {"pinion_speed": SPEED} | changes
        run = loaded.instance(values, inputs)
        assert run(Operation.START) == OK
        axle = of_fmu.start(values, inputs)
        for _ in range(3):
            assert run.step(1e-4) == OK
            axle.step(1e-4, *inputs)
        found.append([run.outputs.tolist(), axle.outputs.tolist()])
    sys.stdout.write(json.dumps(found))


def quantity(outputs, name):
    """One output of a list that `report` wrote."""
    return outputs[OUTPUT_INDEX[name]]


def along_axes(outputs, name):
    """A vector of `quantity`."""
    return np.array([quantity(outputs, f"{name}.{axis}") for axis in "xyz"])
