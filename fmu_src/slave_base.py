"""Co-simulation slave of any `Definition`, on pythonfmu's FMI 2.0 wrapper.

Besides fmi2OK the wrapper can return fmi2Discard (`do_step` returns False) and fmi2Fatal
(a method raises). So a bad value is logged when it is set, and the step or initialisation that
would use it is refused. An impossible initialisation or call raises.
"""

from __future__ import annotations

import logging
import math
import sys
from abc import abstractmethod
from collections import Counter
from collections.abc import Iterable, Sequence
from enum import IntEnum
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from pythonfmu import Boolean, Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.enums import Fmi2Status

from fmu_src.definition import Definition, Model, Value
from fmu_src.identity import IDENTITY_FILE, check_identity, guid_of
from fmu_src.model_description import LOG_CATEGORIES
from fmu_src.values import Snapshot, Values
from fmu_src.variable import Variable
from fmu_src.wrapper import HostThread, guarded, told_on_stderr, unload_before_libraries
from gearlube_core.dynamics.train.stepped_model import MAX_STEP, STEP_ROUNDING
from gearlube_core.errors import GearLubeError, ParameterError, StepError

EXCEEDED = "range.exceeded"  # output: 0 while all is within its range


class _RangeWatch:
    """Steps of one run that ended outside a range.

    Parameters
    ----------
    output_names : sequence of str
        Of the model; without `EXCEEDED` nothing is watched.
    """

    def __init__(self, output_names: Sequence[str]) -> None:
        self._at = output_names.index(EXCEEDED) if EXCEEDED in output_names else -1
        self._steps: Counter[str] = Counter()
        self._all = 0

    def warnings(self, model: Model | None, time: float) -> list[str]:
        """Count the present outputs; return a sentence for each range left for the first time."""
        self._all += 1
        if self._at < 0 or model is None or model.outputs[self._at] == 0.0:
            return []
        exceeded = model.exceeded()
        new = [sentence for name, sentence in exceeded.items() if not self._steps[name]]
        self._steps.update(exceeded.keys())
        return [f"{sentence} First at t = {time:g} s; said once a run." for sentence in new]

    def counts(self) -> list[str]:
        """Return a sentence for each range that was left."""
        return [
            f"{name} was outside its range at {steps} of {self._all} communication points."
            for name, steps in self._steps.items()
        ]


# pythonfmu has no Enumeration; FMI 2 reads and sets it as Integer.
_CLASSES = {"Real": Real, "Integer": Integer, "Enumeration": Integer, "Boolean": Boolean}
_SHORT_STEP = 1e-6  # s


class _SlaveState(IntEnum):
    """State of a slave in the FMI state machine."""

    INSTANTIATED = 0
    INITIALISING = 1
    STEPPING = 2
    TERMINATED = 3

    @property
    def settable(self) -> tuple[str, ...]:
        """Causalities that can be set: parameters until initialised, nothing once terminated."""
        if self == _SlaveState.TERMINATED:
            return ()
        return ("input",) if self == _SlaveState.STEPPING else ("input", "parameter")


_LOGGER = logging.getLogger(__name__)
_LEVELS = {Fmi2Status.ok: logging.INFO, Fmi2Status.warning: logging.WARNING}


def _explained(error: BaseException) -> str:
    return str(error) if isinstance(error, GearLubeError) else f"{type(error).__name__}: {error}"


class CoSimulationSlave(Fmi2Slave):
    """FMI 2.0 co-simulation slave; a subclass only sets its `definition`."""

    log_categories = LOG_CATEGORIES

    @staticmethod
    @abstractmethod
    def definition_of(resources: Path) -> Definition:
        """Return the definition of the FMU whose resources lie in this folder."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        with told_on_stderr(self.instance_name):
            self._make()

    def _make(self) -> None:
        self.definition = self.definition_of(Path(self.resources or ""))
        self.modelName = self.definition.name
        self._values = Values(self.definition, lambda text: self.report(Fmi2Status.error, text))
        self._model: Model | None = None
        self._model_parameters: dict[str, Value] = {}
        self._stale = True
        self._broken = ""
        self._time = 0.0
        self._range_watch = _RangeWatch(self.definition.output_names)
        self._slave_state = _SlaveState.INSTANTIATED
        self._thread = HostThread()
        _register_variables(self, self.definition.variables)
        # Not logged yet: see the third habit in `fmu_src.wrapper`.
        self._warnings = [
            check_identity(self.definition, self.resources or ""),
            compile_ahead(self.definition) if self._is_in_fmu() else "",
        ]
        if self.resources:
            unload_before_libraries(self.resources)

    def _is_in_fmu(self) -> bool:
        """Whether this instance can be stepped; pythonfmu's builder only reads the variables."""
        return (Path(self.resources or "") / IDENTITY_FILE).is_file()

    def report(self, status: Fmi2Status, message: str) -> None:
        """Send `message` to the host's logger, and to Python's, which a host cannot switch off."""
        category = "logEvents" if status == Fmi2Status.ok else f"logStatus{status.name.title()}"
        # The wrapper leaks a reference to each text it passes on: equal texts share one object.
        self.log(sys.intern(f"{self.instance_name}: {message}"), status, category)
        _LOGGER.log(_LEVELS.get(status, logging.ERROR), "%s: %s", self.instance_name, message)

    def report_fatal(self, error: BaseException) -> None:
        """Log an error that the wrapper turns into fmi2Fatal."""
        self.report(Fmi2Status.fatal, _explained(error))

    @guarded
    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Note the start time [s]; the step size of the model follows from its frequencies."""
        self._log_warnings()
        self._expect(_SlaveState.INSTANTIATED)
        if not math.isfinite(start_time):
            raise ParameterError(f"The start time must be finite, got {start_time} s.")
        self._time = start_time

    @guarded
    def enter_initialization_mode(self) -> None:
        """Enter initialisation mode, in which outputs may be read."""
        self._log_warnings()
        self._expect(_SlaveState.INSTANTIATED)
        self._slave_state = _SlaveState.INITIALISING
        self._thread.hold()

    @guarded
    def exit_initialization_mode(self) -> None:
        """Compute the outputs at the start time; raise if that cannot be done."""
        self._expect(_SlaveState.INITIALISING)
        self._initialise_model()
        self._enter(_SlaveState.STEPPING)
        self._watch_ranges(self._time)
        settings = ", ".join(f"{name} = {value}" for name, value in self._model_parameters.items())
        self.report(Fmi2Status.ok, f"initialised at t = {self._time:g} s with {settings}")

    @guarded
    def terminate(self) -> None:
        """Take no further step; outputs can still be read."""
        self._expect(_SlaveState.STEPPING)
        self._enter(_SlaveState.TERMINATED)
        for count in self._range_watch.counts():
            self.report(Fmi2Status.ok, count)
        self._thread.release()

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance the model; on an error log it, keep the state and return False."""
        try:
            self._check_step(current_time, step_size)
            self._model.step(step_size, *self._values.inputs())  # type: ignore[union-attr]
            self._collect_outputs()
            self._watch_ranges(current_time + step_size)
        except BaseException as error:
            refusal = f"step at t = {current_time} s refused. {_explained(error)}"
            self.report(Fmi2Status.discard, refusal)
            return False
        self._time = current_time + step_size
        return True

    def _watch_ranges(self, time: float) -> None:
        for warning in self._range_watch.warnings(self._model, time):
            self.report(Fmi2Status.warning, warning)

    def _log_warnings(self) -> None:
        while self._warnings:
            warning = self._warnings.pop()
            if warning:
                self.report(Fmi2Status.warning, warning)

    def _enter(self, state: _SlaveState) -> None:
        self._slave_state = state
        self._values.allow_setting(*state.settable)

    def _expect(self, state: _SlaveState) -> None:
        if self._slave_state != state:
            raise StepError(
                f"The FMU must be in state {state.name}, is in {self._slave_state.name}."
            )

    def _check_step(self, t: float, h: float) -> None:
        self._expect(_SlaveState.STEPPING)
        if self._values.refused:
            raise StepError(" ".join(self._values.refused.values()))
        if self._broken:
            raise StepError(self._broken)
        # of the host's times; a limit, because a huge time must not allow any step
        rounding = 2.0 * sys.float_info.epsilon * (abs(self._time) + MAX_STEP)
        rounding = min(rounding, STEP_ROUNDING * MAX_STEP)
        if not 0.0 < h <= MAX_STEP + rounding:
            raise StepError(
                f"communicationStepSize must be above 0 and at most {MAX_STEP} s, got {h} s. "
                "Renew the torques at least that often."
            )
        if not abs(t - self._time) <= 1e-3 * h + rounding:
            raise StepError(
                f"currentCommunicationPoint must be {self._time!r} s, where the last step ended, "
                f"got {t!r} s. Restore an FMU state to repeat a step."
            )

    def _initialise_model(self) -> None:
        if not self._stale:
            return
        if self._values.refused:
            raise ParameterError(" ".join(self._values.refused.values()))
        self._start_model(self._values.inputs())
        self._collect_outputs()
        self._stale = False

    def _start_model(self, inputs: Sequence[float]) -> None:
        parameters = self._values.parameters()
        self._model = self.definition.start_model(parameters, inputs)
        self._model_parameters = parameters

    def _collect_outputs(self) -> None:
        outputs = self._model.outputs  # type: ignore[union-attr]
        if not math.isfinite(outputs.dot(outputs)):
            names = zip(self.definition.output_names, outputs.tolist(), strict=True)
            culprits = ", ".join(name for name, value in names if not math.isfinite(value))
            self._broken = (
                f"{culprits} must be finite and is not. "
                "Reset the FMU or restore an earlier state, then use smaller torques."
            )
            raise StepError(self._broken)
        self._values.store_outputs(outputs)

    def _read(self, kind: str, vrs: Sequence[int]) -> Any:
        index = self._values.index(kind, vrs)
        if self._stale and self._slave_state < _SlaveState.STEPPING and self._asks_for_output(vrs):
            self._initialise_model()
        return self._values.array[index]

    def _asks_for_output(self, vrs: Sequence[int]) -> bool:
        return any(self.definition.variables[vr].is_computed for vr in vrs)

    @guarded
    def get_real(self, vrs: Sequence[int]) -> list[float]:
        """Return the values of Real variables."""
        return self._read("Real", vrs).tolist()

    @guarded
    def get_integer(self, vrs: Sequence[int]) -> list[int]:
        """Return the values of Integer and Enumeration variables."""
        return [int(value) for value in self._read("Integer", vrs).tolist()]

    @guarded
    def get_boolean(self, vrs: Sequence[int]) -> list[bool]:
        """Return the values of Boolean variables."""
        return [value != 0.0 for value in self._read("Boolean", vrs).tolist()]

    @guarded
    def get_string(self, vrs: Sequence[int]) -> list[str]:
        """Return nothing: no variable is a String."""
        return [str(value) for value in self._read("String", vrs)]

    @guarded
    def set_string(self, vrs: Sequence[int], values: Sequence[str]) -> None:
        """Refuse any reference: no variable is a String."""
        self._values.index("String", vrs)

    @guarded
    def set_real(self, vrs: Sequence[int], values: Sequence[float]) -> None:
        """Set Real inputs, and Real parameters before the end of initialisation."""
        self._values.assign("Real", vrs, values)
        self._stale = True

    @guarded
    def set_integer(self, vrs: Sequence[int], values: Sequence[int]) -> None:
        """Set Integer and Enumeration parameters before the end of initialisation."""
        self._values.assign("Integer", vrs, values)
        self._stale = True

    @guarded
    def set_boolean(self, vrs: Sequence[int], values: Sequence[bool]) -> None:
        """Set Boolean variables."""
        self._values.assign("Boolean", vrs, values)
        self._stale = True

    @guarded
    def _get_fmu_state(self) -> bytes:
        return Snapshot(
            phase=int(self._slave_state),
            time=self._time,
            values=self._values.array,
            model=np.empty(0) if self._model is None else self._model.get_state(),
        ).to_bytes(guid_of(self.definition))

    @guarded
    def _set_fmu_state(self, state: bytes) -> None:
        snapshot = Snapshot.from_bytes(state, guid_of(self.definition))
        self._enter(_SlaveState(snapshot.phase))
        self._values.restore(snapshot.values)
        self._time, self._broken, self._stale = snapshot.time, "", True
        if snapshot.phase >= _SlaveState.STEPPING:
            if self._model is None or self._model_parameters != self._values.parameters():
                self._start_model(self._values.start_inputs())
            self._model.set_state(snapshot.model)  # type: ignore[union-attr]

    @staticmethod
    def _fmu_state_to_bytes(state: bytes) -> bytes:
        return state

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> bytes:
        # The wrapper does not survive an exception here; `_set_fmu_state` checks the content.
        return state


@cache
def compile_ahead(definition: Definition) -> str:
    """Run a temporary model for one step, once per process; return an error text, or ''."""
    table = definition.variables
    parameters = {v.name: v.decoded(v.start or 0.0) for v in table if v.is_model_parameter}
    inputs = [v.start or 0.0 for v in table if v.causality == "input"]
    try:
        definition.start_model(parameters, inputs).step(_SHORT_STEP, *inputs)
    except GearLubeError as error:
        return f"The model could not be run ahead of the simulation. {error}"
    return ""


def _register_variables(slave: Fmi2Slave, table: Iterable[Variable]) -> None:
    """Register `table` in order, so that pythonfmu counts the same value references."""
    for variable in table:
        initial = variable.initial
        slave.register_variable(
            _CLASSES[variable.type](
                variable.name,
                causality=Fmi2Causality[variable.causality],
                variability=Fmi2Variability[variable.variability],
                initial=None if initial is None else Fmi2Initial[initial],
                description=variable.description,
            ),
            nested=False,
        )
