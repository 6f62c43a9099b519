"""Parts of a model for the native FMU: one compiled entry, constant data, sizes and words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property

from numba import types

from fmu_src.definition import Definition, Stepped, Value
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain
from gearlube_core.dynamics.ranges import Range

_POINTER = types.CPointer(types.float64)
# operation, step, data, parameters, inputs, state, work, outputs
ENTRY_SIGNATURE = types.int64(types.int64, types.float64, *6 * [_POINTER])
OK = 0


@dataclass(frozen=True, kw_only=True)
class Exchange:
    """Data of a model for model exchange.

    Parameters
    ----------
    states : tuple of str
        Variables that hold the continuous states. Each has a variable with it as `rate_of`.
    places : tuple of int
        Where they stand in `state`.
    units : tuple of float
        One in `state` is so much in the variable's unit; below 0 where the signs differ.
    indicators : tuple of str
        Variables whose change of sign is an event.
    inputs_at : int
        Place in the state of the inputs, in their order.
    of_states : frozenset of str
        Outputs that depend on states alone, not at once on an input.
    """

    states: tuple[str, ...]
    places: tuple[int, ...]
    units: tuple[float, ...]
    indicators: tuple[str, ...]
    inputs_at: int
    of_states: frozenset[str]

    def rates(self, definition: Definition) -> list[str]:
        """Return the variables that hold the rates of the states, in their order."""
        of_state = {v.rate_of: v.name for v in definition.variables if v.rate_of}
        return [of_state[name] for name in self.states]


class Operation(IntEnum):
    """Requests to the entry of a model."""

    START = 0  # parameters and inputs -> work, state in static equilibrium, outputs
    STEP = 1  # state and inputs -> state one communication step later, outputs unless lazy
    OUTPUTS = 2  # state and its own inputs -> outputs
    RESUME = 3  # parameters -> work; the state comes from elsewhere
    MOTION = 4  # state after a step -> the outputs named in `motion`
    DERIVATIVES = 5  # state and its own inputs -> rates and event indicators, among the outputs
    EVENT = 6  # state -> state after what an event changes, if anything
    SHOW = 7  # state after a step -> the outputs of the groups whose sum is `step`, see `Group`
    CHECK = 8  # OK if the data can be used; `parameters` are the lengths of data and work, and
    # `inputs` how many options each parameter has; see `kind`


class Group(IntEnum):
    """Outputs that SHOW writes alone, as `model.h` counts; those of RATES by DERIVATIVES too."""

    RATES = 2
    FLANKS = 4
    BEARINGS = 8


@dataclass(frozen=True, kw_only=True)
class NativeModel:
    """A model as a native FMU needs it.

    Parameters
    ----------
    definition : Definition
        Variables and names.
    entry : callable, optional
        Plain Python function over kernels, to be compiled with ENTRY_SIGNATURE:
        `entry(operation, step, data, parameters, inputs, state, work, outputs) -> status`.
        `parameters` are the values of the FMI parameters and `inputs` those of the inputs, both
        in the order of the variables; `outputs` follow `definition.output_names`. The status is
        OK or a key of `refusals`; with any other status but OK `state` is unchanged.
    make_data : callable
        Returns `data`. It is called once, where `kind` is given after the library is built, which
        needs none of them.
    kind : str
        All that the entry is compiled for, in words. Then it must not depend on `data`, `work_size`
        or any words of the model, and it must know the operation CHECK: the library is kept for all
        models of the kind. Without it a library fits this model alone.
    any_sizes : bool
        Whether the library is one for models of other variables too: the entry of such a kind knows
        no size, and CHECK gets all of `gl_sizes` behind both lengths.
    uncertain : tuple of Uncertain
        Data that its losses are known to a factor by.
    in_python : callable, optional
        Starts the model in Python if `Definition.start_model` does not: for reference results.
    state_size : int
        Everything that the future depends on: states, inputs of the last step, step control.
    control_at : int
        Place in the state from which on all values must be above 0.
    work_size : int
        What follows from the parameters, and scratch; never saved.
    limits_at : int
        Place in `work` of lowest and highest value of each input, written by START and RESUME.
    ranges_at : int
        Place in `work` of the `RangeLimits`, the same.
    ranges : tuple of Range
        Words of the ranges, in the order of `RANGE_OUTPUTS` without the first; the limits are
        those in `work`.
    refusals : mapping of int to str
        Why an operation was refused, by status.
    c_code : mapping of str to str
        Instead of `entry`: C files by name, of which the first defines `gearlube_entry` and
        includes the others.
    motion : frozenset of str
        Outputs that cost next to nothing. With any, STEP writes no outputs: MOTION writes these and
        OUTPUTS all of them, when the host reads one.
    groups : mapping of Group to frozenset of str
        Outputs of each group; of RATES those besides rates and event indicators.
    exchange : Exchange, optional
        Without it the FMU is for co-simulation only, and the entry is never asked for
        DERIVATIVES and EVENT.
    """

    definition: Definition
    make_data: Callable[[], Array]
    state_size: int
    control_at: int
    work_size: int
    limits_at: int
    ranges_at: int
    ranges: tuple[Range, ...]
    refusals: Mapping[int, str]
    entry: Callable[..., int] | None = None
    c_code: Mapping[str, str] = field(default_factory=dict)
    motion: frozenset[str] = frozenset()
    groups: Mapping[Group, frozenset[str]] = field(default_factory=dict)
    exchange: Exchange | None = None
    kind: str = ""
    any_sizes: bool = False
    uncertain: tuple[Uncertain, ...] = ()
    in_python: Callable[[Mapping[str, Value], Sequence[float]], Stepped] | None = None

    @cached_property
    def data(self) -> Array:
        """Constants that only a table or a gear decides, of shape (n,)."""
        return self.make_data()
