"""The axle with a law of friction that one file brings: by its name, in Python and in an FMU."""

import json
import sys
import tomllib
from dataclasses import replace
from importlib import import_module, reload
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from drivetrain.axle_file.axle_file import AxleFile
from fmu_src.hypoid_axle import definition_with_axle
from fmu_src.identity import contents
from fmu_src.native.hypoid_axle import native_model
from fmu_src.native.model import OK, Operation
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.uncertain import changed_axle, uncertain_of
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_friction import friction_laws

SPEED, TORQUE, OIL = 240.0, 66.0, 368.15  # rad/s, N.m, K
COEFFICIENTS = (0.04, 0.08)
AXLE = (
    '[gear_set]\nmesh_table = "mohammadpour_2015"\n'
    '[model]\nfriction = "coulomb"\nfriction_numbers = { mu = 0.08 }\n'
)


def file_with(text):
    return AxleFile.from_data(tomllib.loads(text), "the file")


def report():
    """Write the outputs of the axle at rest and moving, for two coefficients, as JSON."""
    import_module("tests.helpers.coulomb_law")
    found = []
    for axle in (replace(mohammadpour_2015_axle(), friction="coulomb"), of_file()):
        made = HypoidAxle(axle)
        made.initialise(
            pinion_speed=SPEED, pinion_torque=TORQUE, wheel_torque=176.0, oil_temperature=OIL
        )
        at_rest = made.outputs.tolist()
        made.step(1e-4, TORQUE, 176.0, OIL)
        found.append({"at rest": at_rest, "moving": made.outputs.tolist()})
    sys.stdout.write(json.dumps(found))


def of_file(text=AXLE):
    return file_with(text).car_axle(notes=False).axle


def refusal(text):
    try:
        of_file(text)
    except ParameterError as error:
        return str(error)
    return ""


def definition():
    with TemporaryDirectory() as folder:
        path = Path(folder, "axle.toml")
        path.write_text(AXLE)
        return definition_with_axle(path)


def report_names():
    """Write what axle file, FMU and error bars know of the law, as JSON."""
    before = refusal(AXLE)
    with TemporaryDirectory() as folder:  # where an installed package would be
        entry = Path(folder, "coulomb-1.0.dist-info", "entry_points.txt")
        entry.parent.mkdir()
        laws = "broken = no_such_module_at_all\ncoulomb = tests.helpers.coulomb_law\n"
        entry.write_text(f"[gearlube.laws]\n{laws}")
        sys.path.append(folder)
        axle = of_file()
    uncertain = next(one for one in uncertain_of(axle) if one.name == "friction_mu")
    upper = changed_axle(uncertain, axle, 2.0, np.ones(1))
    variables = {one.name: one for one in definition().variables}
    law, mu = variables["friction.model"], variables["friction.mu"]
    by_name = AXLE.replace("friction_numbers = { mu = 0.08 }\n", "")
    notes = file_with(by_name).car_axle().inputs
    read_again = reload(sys.modules["tests.helpers.coulomb_law"])  # as a notebook does
    found = {
        "before": before,
        "read again": friction_laws()["coulomb"] is read_again.Coulomb,
        "wrong name": refusal(AXLE.replace("mu =", "nu =")),
        "wrong value": refusal(AXLE.replace("0.08", "0.8")),
        "note": next(list(one) for one in notes if one.field == "model.friction_numbers.mu"),
        "upper": upper.friction_law.numbers["mu"],
        "range": [axle.ranges[1].low, axle.ranges[1].high],
        "literals": law.literals,
        "by number": variables["friction.model.number"].maximum,
        "code": "tests/helpers/coulomb_law.py" in contents(definition()),
        "mu": [mu.start, mu.minimum, mu.maximum, mu.unit, mu.description],
        "references": list(variables).index("friction.mu") - len(variables),
    }
    sys.stdout.write(json.dumps(found))


def report_native():
    """Write outputs of the native FMU's entry and of Python after some steps, as JSON."""
    from tests.helpers.object_code import LoadedModel

    import_module("tests.helpers.coulomb_law")
    of_fmu, inputs = definition(), [TORQUE, 176.0, OIL]
    loaded = LoadedModel(native_model(of_fmu))
    found = []
    for values in ({"pinion_speed": SPEED}, {"pinion_speed": SPEED, "friction_mu": 0.05}):
        run = loaded.instance(values, inputs)
        assert run(Operation.START) == OK
        axle = of_fmu.start({"friction": "coulomb", "friction_mu": 0.08} | values, inputs)
        for _ in range(3):
            assert run.step(1e-4) == OK
            axle.step(1e-4, *inputs)
        found.append([run.outputs.tolist(), axle.outputs.tolist()])
    sys.stdout.write(json.dumps(found))
