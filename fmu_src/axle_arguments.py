"""The parameters of an axle under the names that its FMU's variables give to the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from fmu_src.definition import Value
from fmu_src.variables import HYPOID_AXLE, SHARED_PRELOAD
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle,
)
from gearlube_core.dynamics.hypoid_axle.parameters import (
    HypoidAxleParameters,
)
from gearlube_core.errors import ParameterError
from gearlube_core.oil.lubricant import Lubricant

CUSTOM_OIL = "custom"  # literal of oil.name where the axle file has an oil of its own
_OILS = next(variable.literals for variable in HYPOID_AXLE if variable.argument == "oil")
_VARIABLES = {variable.argument: variable for variable in HYPOID_AXLE if variable.argument}
_OF_ONE_SHAFT = ("contact_angle", "f0", "f1")
_ROLES = ("pinion", "gear")


def tapered_bearings(
    axle: HypoidAxleParameters,
) -> tuple[TaperedRollerBearing, TaperedRollerBearing]:
    """Return the bearings of both shafts; raise ParameterError if they are of another class."""
    of_pinion, of_gear = axle.bearings
    if not (
        isinstance(of_pinion, TaperedRollerBearing) and isinstance(of_gear, TaperedRollerBearing)
    ):
        raise ParameterError(
            f"The bearings of an axle FMU must be a TaperedRollerBearing, got a "
            f"{type(of_pinion).__name__}. Run other bearings in Python."
        )
    return of_pinion, of_gear


def start_arguments(axle: HypoidAxleParameters) -> dict[str, Value]:
    """Return the arguments with which `axle_parameters` leaves an axle as it is."""
    of_pinion, of_gear = tapered_bearings(axle)
    preload, gear_preload = of_pinion.preload_force(), of_gear.preload_force()
    special: dict[str, Value] = {
        "bearing_preload": preload,
        "gear_bearing_preload": SHARED_PRELOAD if gear_preload == preload else gear_preload,
        "bearing_approach": of_pinion.approach,
        "oil": _oil_argument(axle.oil),
        "friction": axle.friction_law.name or axle.friction,  # type: ignore[dict-item]
        **{f"friction_{name}": value for name, value in axle.friction_law.numbers.items()},
    }
    for role, bearing in zip(_ROLES, (of_pinion, of_gear), strict=True):
        special |= {f"{role}_{name}": getattr(bearing, name) for name in _OF_ONE_SHAFT}
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
        (below 0: that of the pinion's shaft), `bearing_approach`, `oil`, and of either shaft
        `pinion_contact_angle`, `pinion_f0`, `pinion_f1`, `gear_contact_angle` and so on.
    base : HypoidAxleParameters, optional
        By default the paper's axle.

    Raises
    ------
    ParameterError
        A value out of the range of its variable, or an option or oil that does not exist.
    """
    base = base or mohammadpour_2015_axle()
    for name, value in arguments.items():
        variable = _VARIABLES.get(name)
        if variable is not None and variable.type == "Real":
            # the model itself allows other bearings than its FMU
            check_within(variable.name, float(value), *variable.range, variable.unit)
    given: dict[str, Any] = start_arguments(base) | dict(arguments)
    oil = given.pop("oil")
    law = base.friction_law
    numbers = {name: given.pop(f"friction_{name}") for name in law.numbers}
    if numbers and given["friction"] == law.name:
        given["friction"] = replace(law, **numbers)
    preload, gear_preload = given.pop("bearing_preload"), given.pop("gear_bearing_preload")
    shared = {"approach": given.pop("bearing_approach"), "interference": None}
    preloads = preload, preload if gear_preload < 0.0 else gear_preload
    made = [
        replace(
            bearing,
            preload=one,
            **shared,
            **{name: given.pop(f"{role}_{name}") for name in _OF_ONE_SHAFT},
        )
        for role, bearing, one in zip(_ROLES, tapered_bearings(base), preloads, strict=True)
    ]
    return replace(
        base,
        **given,
        bearing=made[0],
        gear_bearing=None if made[1] == made[0] else made[1],
        oil=base.oil if oil == CUSTOM_OIL else Lubricant.named(oil),
    )
