"""Every variable of a design and of a sensitivity analysis: known answers of made-up contacts."""

from dataclasses import dataclass

import numpy as np
import pytest

from gearlube.studies.design import dataset as design
from gearlube_core.hypoid_contact import tooth_body
from gearlube_core.hypoid_contact.sensitivity.sensitivity_dataset import sensitivity_dataset
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import assert_attributes, assert_variables, made_up, named

SIDES = ("drive", "coast")


def test_variables_of_a_design_are_known(monkeypatch):
    """The error of a pair is |place|, of the coast flanks -|place|; these miss their target."""
    place = np.arange(161) / 40.0 - 2.0
    sign = {"drive": 1.0, "coast": -1.0}
    shapes = {"path_s": (161,), "path_t": (161,), "ease_off": (21, 41), "closest": (21, 41),
              "path_contact_ratio": ()}  # fmt: skip

    def unloaded(side):
        numbers = {n: made_up(f"{n} {side}", *shape) for n, shape in shapes.items()}
        return numbers | {"path_error": sign[side] * np.abs(place)}

    notes = ("design_warnings", "design_inputs", "design_settings")
    for name, value in {
        "FlankPair": named(from_file=lambda file, side: side),
        "unloaded_contact": unloaded,
        "misses": lambda target, found, _: [0.1, 0.2, 3e-4, 0.4],
        **{name: lambda *_: [] for name in notes},
    }.items():
        monkeypatch.setattr(design, name, value)
    asked = {"s": "1", "t": "1", "error": "rad", "length": "m", "path_angle": "rad"}
    targets = {side: named(**{n: made_up(f"asked {n} {side}") for n in asked}) for side in SIDES}
    measured = named(**{n: made_up(f"found {n}") for n in asked})
    edges = ("pinion tip", "gear tip", "ends")
    amounts = {side: {edge: made_up(f"{side} {edge}") for edge in edges} for side in SIDES}
    of = named(
        targets=targets, measured={"drive": measured, "coast": "no extreme"},
        relieved={"drive": named(error=63e-6), "coast": "no extreme"}, as_cut=None,
        relief=named(amounts=amounts, pressure={"drive": 1.5e9, "coast": 1.6e9}, torque=300.0),
        file=shipped_file(),
        designed=named(
            results=list, file=named(design_method=1, machine=named(gear="form-cut"))
        ),
    )  # fmt: skip
    face = np.array([0.0, 0.5, 1.0])

    def a_side(undercut):
        return named(s=np.array([0.1, 0.2, 0.3, 0.4]), undercut=np.array(undercut, bool))

    deepest = {"pinion": ([1, 1, 0, 0], [0, 0, 0, 0]), "gear": ([0, 0, 0, 0], [1, 1, 1, 0])}
    forms = {
        member: named(
            t=face, topland=made_up(f"topland {member}", 3), slot=made_up(f"slot {member}", 3),
            active=made_up(f"active {member}"), normal_module=made_up(f"module {member}"),
            drive=a_side(drive), coast=a_side(coast),
        )
        for member, (drive, coast) in deepest.items()
    }  # fmt: skip
    made = design.design_dataset(of, forms)
    phase = np.arange(400) / 400

    def both(values):
        return np.stack([values(side) for side in SIDES])

    def of_members(name):
        return np.stack([made_up(f"{name} {member}", 3) for member in forms])

    units = {"path_s": "1", "path_t": "1", "ease_off": "m", "closest": "m",
             "path_contact_ratio": "1"}  # fmt: skip
    expected = {
        name: (unit, both(lambda side, n=name: made_up(f"{n} {side}", *shapes[n])))
        for name, unit in units.items()
    } | {
        "path_error": ("rad", both(lambda side: sign[side] * np.abs(place))),
        "error": ("rad", both(lambda side: sign[side] * np.minimum(phase, 1.0 - phase))),
        "topland": ("m", of_members("topland")),
        "slot": ("m", of_members("slot")),
        "relieved_error": ("rad", [63e-6, np.nan]),
        "missed_error": ("1", [0.1, np.nan]),
        "missed_path_angle": ("rad", [0.2, np.nan]),
        "missed_centre": ("m", [3e-4, np.nan]),
        "missed_length": ("1", [0.4, np.nan]),
        "undercut": ("1", [[0.2, np.nan], [np.nan, 0.3]]),
        "active": ("1", [made_up(f"active {member}") for member in forms]),
        "normal_module": ("m", [made_up(f"module {member}") for member in forms]),
        "relief": ("m", [[1e-6 * amounts[side][edge] for edge in edges] for side in SIDES]),
        "relief_pressure": ("Pa", [1.5e9, 1.6e9]),
        "side": ("", SIDES),
        "member": ("", list(forms)),
        "edge": ("", edges),
        "face": ("1", face),
        "path_phase": ("1", place),
        "mesh_phase": ("1", phase),
        "ease_s": ("1", np.arange(21) / 20),
        "ease_t": ("1", np.arange(41) / 40),
    }
    for name, unit in asked.items():
        expected[f"asked_{name}"] = unit, both(lambda side, n=name: getattr(targets[side], n))
        expected[f"found_{name}"] = unit, [getattr(measured, name), np.nan]
    assert_variables(made, expected)
    assert_attributes(made, {"method": 1, "cut": "form-cut", "relief_torque": 300.0})


def test_variables_of_a_sensitivity_analysis_are_known():
    """The error is a mean and 3 and 4 urad of the first two orders; its rates are multiples."""
    scalars = {"unloaded_pp": "rad", "unloaded_s": "1", "unloaded_t": "1"}
    over_mesh = {"touching": "rad", "gear_torque": "N.m", "force": "N", "secant_stiffness": "N/m",
                 "pressure_max": "Pa", "sliding_loss": "1", "s": "1", "t": "1"}  # fmt: skip
    places = made_up("s", 2), made_up("t", 3)
    phase = np.arange(8) / 8
    wave = 7e-6 + 3e-6 * np.cos(2.0 * np.pi * phase) + 4e-6 * np.cos(4.0 * np.pi * phase)
    rates = np.array([0.5, -2.0])  # of two parameters

    def a_part(k):
        part = {"rotation": k * wave, "rotation_rate": np.outer(k * wave, rates)}
        for name, shape in [(n, ()) for n in scalars] + [("ease_off", (2, 3))]:
            part[name] = k * made_up(name, *shape)
            part[f"{name}_rate"] = k * np.multiply.outer(rates, made_up(name, *shape))
        for name, shape in [(n, ()) for n in over_mesh] + [("share", (5,))]:
            values = k * made_up(name, 8, *shape)
            part[name] = values
            part[f"{name}_rate"] = np.stack([rate * values for rate in rates], axis=1)
        return part

    parameters = [named(name="a", unit="mm", value=1.5, tolerance=0.01),
                  named(name="b", unit="deg", value=2.5, tolerance=0.02)]  # fmt: skip
    parts = {"drive": a_part(1.0), "coast": a_part(2.0)}
    made = sensitivity_dataset(shipped_file(), parameters, parts, phase, places, 50.0)
    k = np.array([1.0, 2.0])
    own = "unit of the parameter"
    expected = {
        "side": ("", SIDES),
        "parameter": ("", ["a", "b"]),
        "unit": ("", ["mm", "deg"]),
        "value": (own, [1.5, 2.5]),
        "tolerance": (own, [0.01, 0.02]),
        "phase": ("1", phase),
        "pair": ("1", [-2, -1, 0, 1, 2]),
        "ease_s": ("1", places[0]),
        "ease_t": ("1", places[1]),
    }
    # at phases 0 and 1/4: 7 + 3 + 4 and 7 - 4
    whole = {"te_pp": ("rad", 11e-6), "te_1": ("rad", 3e-6), "rotation": ("rad", wave),
             "ease_off": ("m", made_up("ease_off", 2, 3)),
             "share": ("1", made_up("share", 8, 5))}  # fmt: skip
    whole |= {name: (unit, made_up(name)) for name, unit in scalars.items()}
    whole |= {name: (unit, made_up(name, 8)) for name, unit in over_mesh.items()}
    for name, (unit, values) in whole.items():
        expected[name] = unit, np.multiply.outer(k, values)
        changes = np.multiply.outer(np.outer(k, rates), values)
        if name == "te_1":
            changes = np.abs(values) * np.outer(k, rates)
        expected[f"{name}_rate"] = f"{unit} per unit of the parameter", changes
    assert_variables(made, expected)
    assert_attributes(made, {"torque": 50.0})


@pytest.mark.parametrize("left", SIDES)
def test_compliances_lie_on_the_whole_flank_of_their_side(left, monkeypatch):
    """A body that begins at 0.2 of the profile: 0, 1/2 and 1 of it are 0.2, 0.6 and 1."""

    @dataclass
    class Flank:
        s: np.ndarray

    monkeypatch.setattr(tooth_body, "lowest_profile_position", lambda file, role: 0.2)
    flanks = Flank(np.array([0.0, 0.5, 1.0])), Flank(np.array([0.25, 0.75, 1.0]))
    found = tooth_body._by_side(None, "pinion", flanks, left)
    right = "coast" if left == "drive" else "drive"
    np.testing.assert_allclose(found[left].s, [0.2, 0.6, 1.0], rtol=1e-14)
    np.testing.assert_allclose(found[right].s, [0.4, 0.8, 1.0], rtol=1e-14)
