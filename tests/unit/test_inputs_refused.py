"""Inputs of modifications and line friction that are refused; defaults of models."""

from dataclasses import MISSING, fields, replace
from inspect import Parameter, signature
from typing import Any

import numpy as np
import pytest

from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.friction.line_integrals import friction_along_lines
from gearlube_core.friction.line_points import line_points, table_line_load, uniform_line_load
from gearlube_core.helical_geometry.lay_angle import lay_angles
from gearlube_core.helical_geometry.meshing_steps import (
    MeshingSteps,
    meshing_steps,
    position_of_line,
)
from gearlube_core.helical_geometry.modification import (
    Crown,
    FlankModification,
    ModifiedPair,
    PowerTipRelief,
    TipRelief,
)
from gearlube_core.helical_geometry.undeformed_gap import UndeformedGap
from gearlube_core.mesh_table.line_mesh import uniform_line_mesh
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.each import each
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_steps
from tests.helpers.named_pairs import named_pair

PAIR = named_pair("jamali_2015_a")


@each(
    ("make", "named"),
    [
        (lambda: TipRelief(amount=70.0, extent=2e-3, k=1.0), "amount"),
        (lambda: TipRelief(amount=7e-5, extent=0.0, k=1.0), "extent"),
        (lambda: TipRelief(amount=7e-5, extent=2e-3, k=1.5), "k must"),
        (lambda: PowerTipRelief(amount=7e-5, extent=2e-3, beta=0.5), "beta"),
        (lambda: Crown(amount=-8e-6, start=0.0), "amount"),
        (lambda: FlankModification(lead_slope=15.0), "lead_slope"),
        (lambda: FlankModification(profile_slope=float("nan")), "profile_slope"),
        (lambda: FlankModification(facets=-1), "facets"),
        (lambda: FlankModification(facets=20.5), "facets"),
        (lambda: jamali_2015("c"), "design"),
        (lambda: UndeformedGap(modified=jamali_2015("a"), form="circle"), "form"),
        (lambda: lay_angles(0.0, PAIR, form="chord"), "form"),
        (lambda: lay_angles(0.0, PAIR, distance=0.0), "distance"),
        (lambda: meshing_steps(jamali_2015("a"), 4e-5, 0.95), "smallest_share"),
        (lambda: MeshingSteps(pair=PAIR, first_position=0.0, step=0.0, count=3), "step"),
    ],
)
def test_bad_inputs_are_refused_by_name(make, named):
    with pytest.raises(ParameterError, match=named):
        make()


@pytest.mark.parametrize(
    ("flank", "named"),
    [
        (FlankModification(crown=Crown(amount=8e-6, start=22e-3)), r"gear\.crown\.start"),
        (
            FlankModification(tip_relief=TipRelief(amount=7e-5, extent=0.02, k=1.0)),
            r"gear\.tip_relief\.extent",
        ),
    ],
)
def test_modifications_that_do_not_fit_the_pair_are_refused(flank, named):
    with pytest.raises(ParameterError, match=named):
        ModifiedPair(pair=PAIR, gear=flank)


def test_pair_without_modifications_removes_nothing():
    plain = ModifiedPair(pair=PAIR)
    assert np.all(plain.removal(np.linspace(0.018, 0.039, 5), 0.01) == 0.0)
    assert plain.contact_start == pytest.approx(PAIR.contact_start, rel=1e-14)
    assert plain.contact_end == pytest.approx(PAIR.contact_end, rel=1e-14)


def test_steps_name_positions_and_lines_alike():
    steps = jamali_2015_steps("b")
    n = np.array([0, 75, 300, 575])
    assert steps.step_at(steps.position(n)) == pytest.approx(n, abs=1e-9)
    assert position_of_line(steps.line(n), steps.pair) == pytest.approx(
        steps.position(n), abs=1e-15
    )


HE = named_pair("he_2007")
POINTS = line_points(HE, 4, 2)
TABLE = uniform_line_mesh(
    name="uniform",
    source="test",
    pinion_teeth=25,
    gear_teeth=31,
    base_pitch=HE.base_pitch,
    lines=3,
    density=1.3e10,
)
GOOD: dict[str, Any] = {
    "pinion_speed": 100.0,
    "pinion_torque": 200.0,
    "lubricant": Lubricant.named("jamali_2015"),
    "oil_temperature": 353.15,
    "surface": SurfaceParameters(0.5e-6, 0.055, 0.001),
    "solid": solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015),
}


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("pinion_speed", 0.0, "pinion_speed must be above 0 rad/s"),
        ("pinion_torque", -5.0, "pinion_torque must be above 0 N.m"),
        ("oil_temperature", 80.0, "oil_temperature must be within 273.15 to 423.15 K"),
    ],
)
def test_an_operating_point_out_of_range_is_refused(name: str, value: float, message: str) -> None:
    load = uniform_line_load(POINTS, 200.0)
    with pytest.raises(ParameterError, match=message):
        friction_along_lines(POINTS, load, **(GOOD | {name: value}))


def test_line_loads_of_other_points_are_refused() -> None:
    load = uniform_line_load(line_points(HE, 4, 3), 200.0)
    with pytest.raises(ParameterError, match=r"line_load must be .* \(4, 3, 4\).* \(4, 3, 6\)"):
        friction_along_lines(POINTS, load, **GOOD)
    with pytest.raises(ParameterError, match="line_load must be finite"):
        friction_along_lines(POINTS, np.full(POINTS.x.shape, np.nan), **GOOD)


def test_a_table_of_another_pair_is_refused() -> None:
    with pytest.raises(ParameterError, match="must be of the pair he_2007"):
        table_line_load(POINTS, replace(TABLE, gear_teeth=32), 200.0)
    with pytest.raises(ParameterError, match="must be of the pair he_2007"):
        table_line_load(POINTS, replace(TABLE, base_pitch=1.01 * HE.base_pitch), 200.0)
    short = replace(TABLE, density=TABLE.density[:, :, :2], offset=TABLE.offset[:, :, :2])
    with pytest.raises(ParameterError, match="must hold the 3 lines"):
        table_line_load(POINTS, short, 200.0)


def test_a_torque_outside_a_table_of_levels_is_refused() -> None:
    twice = replace(
        TABLE,
        torque=np.array([50.0, 100.0]),
        density=np.repeat(TABLE.density, 2, axis=0),
        offset=np.repeat(TABLE.offset, 2, axis=0),
    )
    with pytest.raises(ParameterError, match=r"pinion_torque must be within 50 to 100 N\.m"):
        table_line_load(POINTS, twice, 200.0)


def test_a_table_without_stiffness_is_refused() -> None:
    soft = replace(TABLE, density=np.zeros_like(TABLE.density))
    with pytest.raises(ParameterError, match="density above zero at every phase"):
        table_line_load(POINTS, soft, 200.0)


@pytest.mark.parametrize(("phases", "nodes"), [(0, 4), (4, 0)])
def test_a_period_without_points_is_refused(phases: int, nodes: int) -> None:
    with pytest.raises(ParameterError, match="must be within 1 to"):
        line_points(HE, phases, nodes)


def starts(variables):
    """Start value of every argument of the model; of an option its literal."""
    return {
        one.argument: one.literals[int(one.start) - 1] if one.literals else one.start
        for one in variables
        if one.is_model_parameter
    }


def defaults_of_fields(parameters):
    return {one.name: one.default for one in fields(parameters) if one.default is not MISSING}


def defaults_of_arguments(function):
    found = signature(function).parameters.values()
    return {one.name: one.default for one in found if one.default is not Parameter.empty}


@pytest.mark.parametrize(
    ("variables", "defaults", "least"),
    [
        (HELICAL_PAIR, defaults_of_fields(HelicalMarchParameters), 9),
        (HYPOID_AXLE, defaults_of_fields(HypoidAxleParameters), 9),
        (HYPOID_AXLE, defaults_of_arguments(mohammadpour_2015_axle), 4),
    ],
)
def test_defaults_are_the_start_values_of_the_variables(variables, defaults, least):
    start = starts(variables)
    both = start.keys() & defaults.keys()
    assert len(both) >= least
    assert {name: defaults[name] for name in both} == {name: start[name] for name in both}
