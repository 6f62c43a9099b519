"""A model that is left alone is that of its FMU's start values."""

from dataclasses import MISSING, fields
from inspect import Parameter, signature

import pytest

from fmu_src.helical_variables import HELICAL_PAIR
from fmu_src.variables import HYPOID_AXLE
from gearlube_core.dynamics.helical_pair.march.parameters import HelicalMarchParameters
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.parameters import HypoidAxleParameters


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
