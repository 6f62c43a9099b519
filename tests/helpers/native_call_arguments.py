"""What random calls of a native FMU are made with."""

from __future__ import annotations

import math
from typing import Any

from tests.helpers.small_native_model import HIDDEN_OIL, SINGULAR_OIL

INSTANTIATED, INITIALISING, STEPPING, EVENTS, CONTINUOUS, TERMINATED = range(6)
RATES = ("der(pinion.angle)", "der(pinion.speed)", "event.wall")
STATES = (0.0, 1.0, 19.0, 20.0, 25.0, -3.0, 999.0, 1001.0, -1e300, math.nan, math.inf)
LARGEST = 2**40  # of the number that decides the arguments of a call
STEPS = (
    2.0**-10,
    2.0**-10,
    1e-3,
    1e-3,
    2.0**-10,
    0.1,
    1e-300,
    0.0,
    -1e-3,
    0.2,
    math.nan,
    math.inf,
    1e300,
)
TIMES = (*8 * [0.0], 1e-12, 0.5, -0.5, math.nan, -math.inf)
STARTS = (0.0, 0.0, 2.5, -1.0, math.nan, math.inf)
STOPS = (None, None, 10.0, 0.2, -5.0, math.nan, math.inf)
VALUES = {
    "Real": (1.0, 3.0, -3.0, 0.0, 31.0, 39.0, -39.0, 45.0, 51.0, 300.0, 1e300, 5e-324, -math.inf,
             math.nan, math.inf, SINGULAR_OIL, HIDDEN_OIL, 313.15, 500.0),
    "Integer": (1, 2, 0, 3, 16, -1, 2**31 - 1, -(2**31)),
    "Enumeration": (1, 2, 0, 3, -1, 2**31 - 1, -(2**31)),
    "Boolean": (0, 1),
}  # fmt: skip
LOGS = (b"logAll", b"logEvents", b"logStatusError", b"logStatusFatal", b"nothing", b"", None)
NOT_THERE = {
    2: "GetString SetString SetRealInputDerivatives GetRealOutputDerivatives CancelStep GetStatus "
    "GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus",
    3: "EnterStepMode EnterConfigurationMode ExitConfigurationMode GetFloat32 "
    "SetFloat32 GetInt8 SetInt8 GetUInt8 SetUInt8 GetInt16 SetInt16 GetUInt16 SetUInt16 GetUInt32 "
    "SetUInt32 GetUInt64 SetUInt64 GetString SetString GetBinary SetBinary GetClock SetClock "
    "GetNumberOfVariableDependencies GetVariableDependencies "
    "GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction "
    "SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction "
    "EvaluateDiscreteStates GetOutputDerivatives ActivateModelPartition",
}


class Arguments:
    """Arguments taken one after the other from a number; 0 takes the first of each choice."""

    def __init__(self, number: int) -> None:
        self._rest = number

    def one_of(self, choices: Any) -> Any:
        self._rest, place = divmod(self._rest, len(choices))
        return choices[place]
