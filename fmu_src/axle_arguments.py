"""The parameters of an axle under the names that its FMU's variables give to the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from fmu_src.definition import Value
from fmu_src.variables import HYPOID_AXLE, SHARED_PRELOAD
from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.number import numbers_of
from gearlube_core.oil.lubricant import Lubricant

CUSTOM_OIL = "custom"  # literal of oil.name where the axle file has an oil of its own
_OILS = next(variable.literals for variable in HYPOID_AXLE if variable.argument == "oil")
_VARIABLES = {variable.argument: variable for variable in HYPOID_AXLE if variable.argument}
_ROLES = ("pinion", "gear")
_SHARED = "bearing_preload"  # that of the gear's shaft has its prefix as all else of a shaft
# arguments of bearings among the released variables, all of tapered roller bearings
OF_BEARINGS = tuple(one for one in _VARIABLES if "_bearing_" in f"_{one}" and "_loss" not in one)


def bearing_arguments(bearing: Bearing, role: str) -> dict[str, str]:
    """Return the numbers of a bearing that its FMU has for the shaft of a role, by argument."""
    kind: Any = type(bearing)
    names = [name for name, one in numbers_of(kind).items() if one.fmi]
    return {
        _SHARED if (role, name) == ("pinion", "preload") else f"{role}_bearing_{name}": name
        for name in names
    }


def start_arguments(axle: HypoidAxleParameters) -> dict[str, Value]:
    """Return the arguments with which `axle_parameters` leaves an axle as it is."""
    preload, gear_preload = (one.preload_force() for one in axle.bearings)
    special: dict[str, Value] = {
        "bearing_preload": preload,
        "gear_bearing_preload": SHARED_PRELOAD if gear_preload == preload else gear_preload,
        "bearing_approach": getattr(axle.bearing, "approach", "full"),
        "oil": _oil_argument(axle.oil),
        "friction": axle.friction_law.name or axle.friction,  # type: ignore[dict-item]
        **{f"friction_{name}": value for name, value in axle.friction_law.numbers.items()},
    }
    for role, bearing in zip(_ROLES, axle.bearings, strict=True):
        names = bearing_arguments(bearing, role).items()
        special = {argument: getattr(bearing, name) for argument, name in names} | special
    others = [v.argument for v in HYPOID_AXLE if v.is_model_parameter and hasattr(axle, v.argument)]
    return {name: getattr(axle, name) for name in others} | special


def _oil_argument(oil: Lubricant) -> str:
    return oil.name if oil.name in _OILS and oil == Lubricant.named(oil.name) else CUSTOM_OIL


def axle_parameters(
    arguments: Mapping[str, Value], base: HypoidAxleParameters | None = None
) -> HypoidAxleParameters:
    """Return an axle with changes.

    Parameters
    ----------
    arguments : mapping
        By name: fields of `HypoidAxleParameters`, and `bearing_preload`, `gear_bearing_preload`
        (below 0: that of the pinion's shaft), `bearing_approach`, `oil`, and the numbers of the
        bearings of either shaft, `pinion_bearing_contact_angle`, `gear_bearing_f0` and so on.
    base : HypoidAxleParameters, optional
        By default the paper's axle.

    Raises
    ------
    ParameterError
        A value out of the range of its variable, or an option or oil that does not exist.
    """
    base = base or mohammadpour_2015_axle()
    tapered = isinstance(base.bearing, TaperedRollerBearing)
    if not tapered:
        _check_left_alone(arguments, base)
    for name, value in arguments.items():
        variable = _VARIABLES.get(name)
        of_others = name in OF_BEARINGS and not tapered
        if variable is not None and variable.type == "Real" and not of_others:
            # the model itself allows other bearings than its FMU
            check_within(variable.name, float(value), *variable.range, variable.unit)
    given: dict[str, Any] = start_arguments(base) | dict(arguments)
    oil = given.pop("oil")
    law = base.friction_law
    numbers = {name: given.pop(f"friction_{name}") for name in law.numbers}
    if numbers and given["friction"] == law.name:
        given["friction"] = replace(law, **numbers)
    if given[f"gear_{_SHARED}"] < 0.0:
        given[f"gear_{_SHARED}"] = given[_SHARED]
    made = []
    for role, bearing in zip(_ROLES, base.bearings, strict=True):
        of_one = bearing_arguments(bearing, role).items()
        changes = {name: given[argument] for argument, name in of_one}
        if tapered:
            changes |= {"interference": None, "approach": given["bearing_approach"]}
        made.append(replace(bearing, **changes))
    of_axle = {
        name: value
        for name, value in given.items()
        if name not in OF_BEARINGS and "_bearing_" not in name
    }
    return replace(
        base,
        **of_axle,
        bearing=made[0],
        gear_bearing=None if made[1] == made[0] else made[1],
        oil=base.oil if oil == CUSTOM_OIL else Lubricant.named(oil),
    )


def _check_left_alone(arguments: Mapping[str, Value], base: HypoidAxleParameters) -> None:
    """Refuse a change of what only tapered roller bearings have, where the axle has others."""
    starts = start_arguments(base)
    own = bearing_arguments(base.bearing, "pinion") | bearing_arguments(base.bearing, "gear")
    for name in OF_BEARINGS:
        start = starts.get(name, 0.0)
        if name not in own and arguments.get(name, start) != start:
            raise ParameterError(
                f"{_VARIABLES[name].name} must stay {start}, got {arguments[name]}: bearings of "
                f"the type {base.bearing.name} do not have it. Leave it out."
            )
