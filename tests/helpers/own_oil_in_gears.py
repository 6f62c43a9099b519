"""The axle and the helical pair in an oil whose laws one file each brings; also in FMUs."""

import json
import sys
import tomllib
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from drivetrain.axle_file.read_axle import read_axle
from fmu_src import helical_pair, hypoid_axle
from fmu_src.identity import contents
from fmu_src.native import helical_pair as native_pair
from fmu_src.native import hypoid_axle as native_axle
from fmu_src.native.model import OK, Operation
from gearlube.output.toml_text import toml_text
from gearlube_core.bearings.losses.rib import RibParameters, rib_friction
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.hypoid_axle import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.loss_band import loss_sensitivities
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.uncertain import changed_axle, uncertain_of
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil
from gearlube_core.film_model.model import FLANK, shipped_model
from gearlube_core.friction.line_points import line_friction
from gearlube_core.friction.traction_fit import steel_on_steel
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.formula_laws import log_viscosity_under
from tests.helpers.oil_with_own_law import SHEET, as_toml

Q, LIMIT, LOW_LIMIT = 20.0, 8e6, 1e5  # [-], Pa, Pa
OIL, TORQUE, SPEED = 353.15, 66.0, 240.0  # K, N.m, rad/s
INPUTS = [TORQUE, 176.0, OIL]
PRESSURE = 1e9  # Pa
PAIR_INPUTS = [226.0, 280.0, OIL]
PAIR_SPEED = 104.7  # rad/s
LINE = 4e5, 0.02, 8.0, 1.5  # N/m, m, m/s, m/s
RIB = RibParameters(0.03, 0.02, 0.2, 0.3, 0.2, 1.0, 1e-8, 1.9, 0.99, 0.15, 2.3e11), 800.0, 300.0
SURFACE, SOLID = gear_flanks(2e-8), steel_on_steel()
NUMBERS = {"q": Q, "limit": LIMIT}
BARUS = {"viscosity_law": "barus"}  # formulas keep the law of their source
LAWS = {
    "none": BARUS,
    "own_barus": {"viscosity_law": "own_barus"},
    "over_eta0_followed": {"viscosity_law": "over_eta0_followed"},
    "own_power": {"viscosity_law": "own_power", "law_numbers": {"q": Q}},
    "mcewen": {"viscosity_law": "mcewen", "law_numbers": {"q": Q}},
    "yasutomi": {"viscosity_law": "yasutomi"},
    "gecim_winer": BARUS | {"shear_law": "gecim_winer", "law_numbers": {"limit": LIMIT}},
}


def imported():
    import_module("tests.helpers.own_power_law")
    import_module("tests.helpers.gecim_winer_law")
    import_module("tests.helpers.viscosity_laws")


def axle_file(folder, laws, model=""):
    """An axle on smooth flanks, so that the oil alone carries, with its oil file beside it."""
    Path(folder, "oil.toml").write_text(as_toml({**SHEET, "eyring_stress_mpa": 4.0, **laws}))
    path = Path(folder, "axle.toml")
    path.write_text(
        '[gear_set]\nmesh_table = "mohammadpour_2015"\nroughness_rms_um = 0.02\n'
        f'[oil]\nfile = "oil.toml"\n{model}'
    )
    return path


def pair_file(folder, laws):
    axle_file(folder, laws)
    data = tomllib.loads(HelicalGearFile.shipped_text("he_2007"))
    path = Path(folder, "pair.toml")
    path.write_text(toml_text({**data, "name": "pair", "film": {"oil_file": "oil.toml"}}))
    return path


def axle_in(laws, model=""):
    with TemporaryDirectory() as folder:
        return read_axle(axle_file(folder, laws, model)).axle


def axle_definition(laws, model=""):
    with TemporaryDirectory() as folder:
        return hypoid_axle.definition_with_axle(axle_file(folder, laws, model))


def pair_definition(laws):
    with TemporaryDirectory() as folder:
        return helical_pair.definition_with(pair_file(folder, laws))


def pair_in(laws):
    with TemporaryDirectory() as folder:
        return helical_march_parameters(HelicalGearFile.given(str(pair_file(folder, laws))))


def started(model, speed, inputs):
    torque, wheel, oil = inputs
    model.initialise(
        pinion_speed=speed, pinion_torque=torque, wheel_torque=wheel, oil_temperature=oil
    )
    return model


def starts(definition):
    return {v.argument: v.decoded(v.start) for v in definition.variables if v.is_model_parameter}


def in_slave(definition, slave, values, inputs):
    """Outputs of the model that the PythonFMU with these resources starts, after a step."""
    with TemporaryDirectory() as folder:
        for name, content in definition.resources.items():
            Path(folder, name).write_bytes(content)
        inside = slave.definition_of(Path(folder))
    model = inside.start(starts(inside) | values, inputs)
    model.step(1e-4, *inputs)
    return model.outputs.tolist()


def refusal(call, *arguments):
    try:
        call(*arguments)
    except ParameterError as error:
        return str(error)
    return ""


def report_contacts():
    """Write friction of a contact line and of a rib, by law, as JSON."""
    imported()
    found = {}
    for name, laws in LAWS.items():
        oil = axle_in(laws).oil
        found[name] = {"line": line_friction(*LINE, oil.state(OIL), SURFACE, SOLID)._asdict()}
        if name == "gecim_winer":
            oil = replace(oil, shear_law=replace(oil.shear_law, limit=LOW_LIMIT))
        found[name]["rib"] = rib_friction(*RIB, oil.state(OIL))._asdict()
    sys.stdout.write(json.dumps(found))


def report():
    """Write outputs of axle and pair at rest and after a step, by law, as JSON."""
    imported()
    found = {}
    for name, laws in LAWS.items():
        if name == "over_eta0_followed":
            continue
        of_axle = axle_in(laws)
        axle = started(HypoidAxle(of_axle, loss_sensitivities(of_axle)), SPEED, INPUTS)
        one = found[name] = {"axle": axle.outputs.tolist()}
        if name in ("gecim_winer", "mcewen", "yasutomi"):
            continue
        smooth = replace(pair_in(laws), roughness_rms=2e-8)
        pair = started(HelicalPairModel(smooth), PAIR_SPEED, PAIR_INPUTS)
        one["pair"] = pair.outputs.tolist()
        lost = axle_losses(of_axle, torques=[TORQUE], speeds=[SPEED], temperatures=[OIL], angles=4)
        one["viscous loss"] = lost.power[0, 0, 0, LOSS_SOURCES.index("friction_viscous")]
        if name == "own_power":
            axle.step(1e-4, *INPUTS)
            pair.step(1e-4, *PAIR_INPUTS)
            one["axle moving"], one["pair moving"] = axle.outputs.tolist(), pair.outputs.tolist()
            values, slave = {"pinion_speed": SPEED}, hypoid_axle.HypoidAxle
            one["axle FMU"] = in_slave(axle_definition(laws), slave, values, INPUTS)
            values = {"pinion_speed": PAIR_SPEED, "roughness_rms": 2e-8}
            slave = helical_pair.HelicalPair
            one["pair FMU"] = in_slave(pair_definition(laws), slave, values, PAIR_INPUTS)
    sys.stdout.write(json.dumps(found))


def report_names():
    """Write what FMUs, error bars, film models and refusals know of a law, as JSON."""
    imported()
    laws = LAWS["own_power"]
    definition, pair = axle_definition(laws), pair_definition(laws)
    variables = {one.name: one for one in definition.variables}
    of_pair = {one.name: one for one in pair.variables}
    axle = axle_in(laws)
    bars = {one.name: one for one in uncertain_of(axle)}
    moved = {}
    for name in ("viscosity", "alpha", "oil_q"):
        oil = changed_axle(bars[name], axle, 2.0, np.ones(1)).oil
        state = oil.state(oil.alpha_temperature)
        under = log_viscosity_under(state.viscosity, state, PRESSURE)
        moved[name] = [state.eta0, state.alpha, under]
    oil = axle.oil
    state = oil.state(oil.alpha_temperature)
    by_net = axle_in(laws, '[film]\nmodel = "solved"\n')
    solved = started(HypoidAxle(by_net), SPEED, INPUTS)
    formula = started(HypoidAxle(axle), SPEED, INPUTS)
    found = {
        "literals": [variables["oil.name"].literals, of_pair["oil.name"].literals],
        "starts": [variables["oil.name"].start, of_pair["oil.name"].start],
        "by number": [variables["oil.name.number"].maximum, of_pair["oil.name.number"].maximum],
        "description": variables["oil.name"].description,
        "code": ["tests/helpers/own_power_law.py" in contents(one) for one in (definition, pair)],
        "as given": [state.eta0, state.alpha],
        "moved": moved,
        "factors": {name: bars[name].factor for name in moved},
        "share outside": solved.output("film.share_outside"),
        "films": [one.output("flank[2].film_thickness") for one in (solved, formula)],
        "film model": refusal(check_oil, shipped_model(FLANK), oil, axle.solid, "film.flank_model"),
        "refusals": [refusal(replace(oil, viscosity_law=one()).own_laws) for one in law_classes()],
    }
    sys.stdout.write(json.dumps(found))


def law_classes():
    """Laws of viscosity that formulas cannot follow, and one that they can by its kernel."""
    from tests.helpers import viscosity_laws as laws

    return laws.Steeper, laws.OverEta0, laws.OverEta0Followed


def report_native():
    """Write outputs of native entries and of Python after some steps, as JSON."""
    from tests.helpers.object_code import LoadedModel

    imported()
    laws, found = {**LAWS["gecim_winer"], **LAWS["own_power"], "law_numbers": NUMBERS}, {}
    for what, native, definition, inputs, speed in (
        ("axle", native_axle, axle_definition(laws), INPUTS, SPEED),
        ("pair", native_pair, pair_definition(laws), PAIR_INPUTS, PAIR_SPEED),
    ):
        values = {"pinion_speed": speed}
        loaded = LoadedModel(native.native_model(definition))  # keeps the code
        run = loaded.instance(values, inputs)
        assert run(Operation.START) == OK
        model = definition.start(starts(definition) | values, inputs)
        for _ in range(3):
            assert run.step(1e-4) == OK
            model.step(1e-4, *inputs)
        found[what] = [run.outputs.tolist(), model.outputs.tolist()]
    sys.stdout.write(json.dumps(found))
