"""Common base of all models of trains: a state, the function that moves it, copies of both."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.linalg import null_space

from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RZ
from gearlube_core.dynamics.train.march import (
    ADVANCE,
    EXCHANGE,
    RATES,
    REFUSALS,
    RENEW,
    STIFFNESS,
    work_size,
)
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.dynamics.train.rest_search import OK, room_of
from gearlube_core.dynamics.train.supports import free_motions
from gearlube_core.errors import StepError

_TURNS = 1e-6  # of 1, a body in a way to turn


def _copied(
    of: Callable[..., MarchedTrain], given: Mapping[str, Any], state: Array
) -> MarchedTrain:
    """Return the model that these arguments give, in a state."""
    model = of(**given)
    model._take_state(state)
    return model


class MarchedTrain(ABC):
    """A train in a state.

    Parameters
    ----------
    made : Assembly
    operate : callable
        The function of `train_kernel` for its list.
    beside : ndarray of shape (n,)
        What is saved with the state of the train: inputs of the last step, then step control.
    """

    _temperature_at = 0  # place of the oil temperature in `beside`, NaN before `initialise`
    _refusals: Mapping[int, str] = REFUSALS  # of a step, by status
    _name, _origin = "this train", "train"  # of the model, and where its saved states come from

    def __init__(self, made: Assembly, operate: Callable[..., float], beside: Array) -> None:
        self._made, self.operate, self._beside = made, operate, beside
        self._data = made.numbers, made.memory, made.plan
        self._state, self._trial = np.zeros(made.sizes.states), np.zeros(made.sizes.states)
        self._work = np.zeros(work_size(made.sizes))

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        """Let a copy, also one out of a pickle, be a model of its own in the same state."""
        return _copied, (type(self), self._given(), self.get_state())

    @abstractmethod
    def _given(self) -> dict[str, Any]:
        """Return the arguments that the model was made of."""

    @property
    @abstractmethod
    def _least_rate(self) -> float:
        """Integrator steps a second."""

    @property
    def assembly(self) -> Assembly:
        """The train put together, for the kernels of its list."""
        return self._made

    def get_state(self) -> Array:
        """Return everything that the future depends on: states, inputs, step control."""
        return np.concatenate([self._state, self._beside])

    def set_state(self, state: Array) -> None:
        """Continue from what `get_state` returned; bit-exact.

        Raises
        ------
        StepError
            When the array has the wrong length or holds a NaN; the model is then as before.
        """
        values = np.asarray(state, dtype=np.float64)
        self._check_state(values)
        self._take_state(values)

    def _check_state(self, values: Array) -> None:
        """Raise StepError unless these numbers can be a state."""
        size = self._state.size + self._beside.size
        wrong = np.flatnonzero(~np.isfinite(values))
        if values.shape != (size,) or wrong.size:
            got = f", {values.ravel()[wrong[0]]} at place {wrong[0]}" if wrong.size else ""
            raise StepError(
                f"a state of {self._name} has {size} finite numbers, got shape {values.shape}{got}."
                f" Use an array from get_state of the same {self._origin}."
            )

    def _take_state(self, values: Array) -> None:
        self._state[:] = values[: self._state.size]
        self._beside[:] = values[self._state.size :]

    def _temperature(self) -> float:
        """Return the oil temperature of the last step [K]; raise StepError before `initialise`."""
        found = float(self._beside[self._temperature_at])
        if found != found:
            raise StepError(f"{self._name} has no state yet. Call initialise or set_state first.")
        return found

    def _status(self, s: Array) -> int:
        """Return OK, or why no step may begin or end in a state."""
        return OK

    def _march(self, h: float, temperature: float) -> None:
        """Advance the trial, which holds the state under new inputs, and take it."""
        status = self._status(self._state)
        if status == OK:
            status = int(self._call(ADVANCE, self._trial, h, self._least_rate, temperature))
        if status == OK:
            status = self._status(self._trial)
        if status != OK:
            raise StepError(f"step of {h:g} s refused: {self._refusals[status]}.")
        self._state[:] = self._trial

    def _rates(self, s: Array) -> Array:
        """Return d/dt of the integrated states, with what elements keep found again."""
        s, found = s.copy(), np.zeros(self._made.sizes.integrated)
        self._call(RENEW, s)
        self._call(RATES, s, work=found)
        return found

    def _exchanged(self, s: Array) -> Array:
        """Return what EXCHANGE writes, or raise StepError."""
        self._accept(self._call(EXCHANGE, s))
        return self._work[: outputs_at(self._made.sizes)].copy()

    def _accept(self, status: float) -> None:
        if status != OK:
            raise StepError(f"these values are refused: {self._refusals[int(status)]}.")

    def _stiffness(self) -> Array:
        """Return M^-1 K of the free coordinates about the present state."""
        m = int(self._call(STIFFNESS, self._state))
        return self._work[: m * m].reshape(m, m).copy()

    def _loose(self, speeds: Mapping[str, float]) -> list[str]:
        """Return the bodies that a start left free to turn, by the relations in its work array."""
        room = room_of(self._made.sizes)
        relations = self._work[room.relations : room.related].reshape(-1, room.coordinates)
        relations = relations[:, RZ::N_COORDINATES]
        still = [body.name in speeds or "rz" in body.held for body in self._made.bodies]
        sizes = np.maximum(abs(relations).max(axis=1, keepdims=True), np.finfo(float).tiny)
        free = null_space(np.vstack([relations / sizes, np.eye(len(still))[still]]))
        turns = abs(free).max(axis=1) > _TURNS
        return [body.name for body, one in zip(self._made.bodies, turns, strict=True) if one]

    def _free_motions(self) -> list[str]:
        """Return what can move without force, by what a start without rest left in its work."""
        room, m = room_of(self._made.sizes), int(self._work[0])
        places = self._work[room.places : room.places + m].astype(int)
        mobility = np.concatenate([body.mobility for body in self._made.bodies])
        at = places // BODY_STATES * N_COORDINATES + places % BODY_STATES
        stiffness = self._work[room.solver : room.solver + m * m].reshape(m, m)
        return free_motions(stiffness, mobility[at], [self._made.names[i] for i in places])

    def _call(
        self,
        operation: int,
        s: Array,
        size: float = 0.0,
        least_rate: float = 0.0,
        temperature: float | None = None,
        work: Array | None = None,
    ) -> float:
        """Call the function of the train on a state, by default at the last step's temperature."""
        if temperature is None:
            temperature = self._temperature()
        given = work if work is not None else self._work
        return self.operate(operation, s, temperature, *self._data, size, least_rate, given)
