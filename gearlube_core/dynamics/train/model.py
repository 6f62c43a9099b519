"""A train in motion: put it at rest under load, step it, read it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.ranges import MAX_SPEED, TOO_FAR
from gearlube_core.dynamics.stepped_model import TOO_FAR_WORDS, TOO_FAST_WORDS, too_many_steps_words
from gearlube_core.dynamics.train.assemble import assemble
from gearlube_core.dynamics.train.element import (
    BODY_STATES,
    COORDINATES,
    N_COORDINATES,
    RATE,
    RZ,
    W,
)
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.march import (
    ADVANCE,
    ENERGY,
    MAX_STEPS,
    NOT_FINITE,
    OK,
    RATES,
    RENEW,
    SETTLE,
    TOO_FAST,
    TOO_MANY_STEPS,
    WRITE,
    settle_work_size,
    train_kernel,
    work_size,
)
from gearlube_core.dynamics.train.part import Body, Element
from gearlube_core.errors import ConvergenceError, ParameterError, StepError
from gearlube_core.number import Output
from gearlube_core.oil.lubricant import Lubricant

_DIFFERENCE = 1e-8  # m and rad, of coordinates in a linearisation
_SETTLED = 1e-6  # of the largest force of a member at rest
_SAME_SPEED = 1e-6  # of the largest speed
_PASSES = 4  # friction of films depends on the loads, weakly
_LEAST_RATE = 1e3  # integrator steps a second, of a train without a mode that vibrates
_REFUSED = {
    NOT_FINITE: (
        "the state is no longer finite, or a body has moved by more than 0.1 m. Reduce the torques"
    ),
    TOO_MANY_STEPS: too_many_steps_words(MAX_STEPS),
    TOO_FAST: TOO_FAST_WORDS,
    TOO_FAR: TOO_FAR_WORDS,
}


class Train:
    """Bodies, and the elements that act on them, marched in time.

    Parameters
    ----------
    bodies : sequence of Body
    elements : sequence of Element
        Their order is the order of sums, so that another order changes the last digits.
    oil : Lubricant
        Of all elements.
    steps_per_highest_period : int
        Integrator steps per period of the highest mode, 6 to 4096.

    Notes
    -----
    Equations of motion are integrated by RK4 with a fixed step. The same input gives the same
    output to the bit.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
    >>> rotors = [Body.spinning("engine", 0.2), Body.spinning("wheel", 2.0)]
    >>> shaft = HalfShaft(name="shaft", first="engine", second="wheel", stiffness=1e4)
    >>> motor = Port(name="motor", body="engine")
    >>> train = Train(rotors, [shaft, motor], Lubricant.named("mohammadpour_2015"))
    >>> train.initialise({"engine": 100.0}, {"motor": 0.0}, 340.0)
    >>> frequency, shapes = train.modes()
    >>> round(float(frequency[-1]), 2)  # Hz: sqrt(k (1/I1 + 1/I2)) / 2 pi
    37.33
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        elements: Sequence[Element],
        oil: Lubricant,
        *,
        steps_per_highest_period: int = 16,
    ) -> None:
        check_within("steps_per_highest_period", steps_per_highest_period, 6, 4096)
        self.bodies, self.elements, self.oil = tuple(bodies), tuple(elements), oil
        self._made = assemble(bodies, elements, oil)
        self._operate = train_kernel(self._made.layout)
        n, size = self._made.layout.integrated, self._made.layout.states
        self._n, self._state, self._trial = n, self._made.state.copy(), np.zeros(size)
        self._work = np.zeros(work_size(self._made.layout))
        self._output_names = tuple(one.name for one in self._made.outputs)
        self._per_period, self._least_rate = float(steps_per_highest_period), _LEAST_RATE
        self._temperature = math.nan
        ports = (one.name for one in elements if isinstance(one, Port))
        self._ports = {name: self._made.kept[name] for name in ports}
        free = [
            BODY_STATES * i + j
            for i, body in enumerate(bodies)
            for j in range(N_COORDINATES)
            if COORDINATES[j] not in body.held
        ]
        self._free = np.array(free)

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of the integrated states, in order."""
        return self._made.names

    def initialise(
        self, speeds: Mapping[str, float], torques: Mapping[str, float], oil_temperature: float
    ) -> None:
        """Put the train into static equilibrium, turning.

        Parameters
        ----------
        speeds : mapping
            Speed about z of as many bodies as can turn independently [rad/s]; all others follow.
        torques : mapping
            Of every port [N.m]. The first body of `speeds` bears what they leave.
        oil_temperature : float
            [K]

        Raises
        ------
        ParameterError
            A speed or torque is missing or out of range.
        ConvergenceError
            No static equilibrium is found.
        """
        before = self._state.copy(), self._temperature, self._least_rate
        self._take(torques, oil_temperature)
        self._state[:] = self._made.state
        self._put(torques)
        try:
            self._rest(speeds)
        except (ConvergenceError, ParameterError):
            self._state[:], self._temperature, self._least_rate = before
            raise

    def step(self, h: float, torques: Mapping[str, float], oil_temperature: float) -> None:
        """Advance by `h` [s] under constant torques [N.m] and oil temperature [K].

        Raises
        ------
        ParameterError
            A torque is missing or out of range.
        StepError
            The step cannot be made; the train is then as before.
        """
        check_within("step size", h, 1e-9, 0.1, "s")
        before, trial, temperature = self._state, self._trial, self._temperature
        self._take(torques, oil_temperature)
        trial[:] = self._state
        self._state = trial
        self._put(torques)
        status = int(self._call(ADVANCE, trial, self._work, h))
        if status != OK:
            self._state, self._temperature = before, temperature
            raise StepError(f"step of {h:g} s refused: {_REFUSED[status]}.")
        self._trial = before

    def outputs(self) -> dict[str, float]:
        """Return all outputs in the present state, SI units, by name, see `output_records`.

        Powers are means over the last step of at least 1e-7 s; before the first one, those now.
        """
        names = self._output_names
        self._call(WRITE, self._state, self._work)
        return dict(zip(names, self._work[: len(names)].tolist(), strict=True))

    @property
    def output_records(self) -> tuple[Output, ...]:
        """Name, unit and words of every output, in order."""
        return self._made.outputs

    def state(self, name: str) -> float:
        """Return one of `state_names`; "body.rz" is an angle, "body.rz.rate" a speed."""
        return float(self._state[self._made.names.index(name)])

    @property
    def energy(self) -> float:
        """Kinetic and elastic energy of the train [J]."""
        return self._call(ENERGY, self._state, self._work)

    @property
    def work(self) -> float:
        """Work that the ports have put in since the start [J]."""
        return float(sum(self._state[at] for at in self._made.works.values()))

    @property
    def lost(self) -> dict[str, float]:
        """Energy that has become heat since the start, by its name [J]."""
        return {name: float(self._state[at]) for name, at in self._made.losses.items()}

    def rates(self) -> Array:
        """Return d/dt of the integrated states, in the order of `state_names`, exact."""
        found, s = np.zeros(self._n), self._state.copy()
        self._call(RENEW, s, found)
        self._call(RATES, s, found)
        return found

    def get_state(self) -> Array:
        """Return everything that the future depends on."""
        return np.concatenate([self._state, [self._temperature, self._least_rate]])

    def set_state(self, state: Array) -> None:
        """Continue from what `get_state` returned; bit-exact."""
        if state.shape != (self._state.size + 2,) or not np.all(np.isfinite(state)):
            raise StepError(
                f"a state of this train has {self._state.size + 2} finite numbers, got shape "
                f"{state.shape}. Use an array from get_state of the same train."
            )
        self._state[:] = state[:-2]
        self._temperature, self._least_rate = (float(one) for one in state[-2:])

    def modes(self) -> tuple[Array, Array]:
        """Return undamped natural frequencies [Hz] about the present state, rising, and shapes.

        Returns
        -------
        tuple of ndarray
            Frequencies, shape (m,), rigid rotations as 0; shapes, (free coordinates, m), each of
            modal mass 1 kg.
        """
        matrix = self._stiffness_over_mass()
        mobility = np.concatenate([body.mobility for body in self.bodies])
        mobility = mobility[mobility > 0.0]
        squares, shapes = np.linalg.eig(matrix)
        order = np.argsort(squares.real)
        shapes = shapes[:, order].real
        shapes /= np.sqrt((shapes**2 / mobility[:, None]).sum(axis=0))
        frequencies = np.sqrt(np.maximum(squares.real[order], 0.0)) / (2.0 * np.pi)
        return frequencies, shapes

    def _call(self, operation: int, s: Array, work: Array, size: float = 0.0) -> float:
        given = self._temperature, self._made.numbers, self._made.memory
        return self._operate(operation, s, *given, size, self._least_rate, work)

    def _take(self, torques: Mapping[str, float], oil_temperature: float) -> None:
        missing = sorted(set(self._ports) ^ set(torques))
        if missing:
            raise ParameterError(
                f"torques must be given for every port, which are {', '.join(self._ports)}; "
                f"wrong is {missing[0]}."
            )
        for name, torque in torques.items():
            check_within(f"torque of {name}", torque, -1e7, 1e7, "N.m")
        self.oil.check_temperature(oil_temperature, "oil_temperature")
        self._temperature = float(oil_temperature)

    def _put(self, torques: Mapping[str, float]) -> None:
        for name, torque in torques.items():
            self._state[self._ports[name]] = torque

    def _relations(self) -> Array:
        """Return rates of the own states over rates of all coordinates, (own, 6 x bodies)."""
        layout, s, slope = self._made.layout, self._state.copy(), np.zeros(self._n)
        first = BODY_STATES * layout.bodies
        for i in range(layout.bodies):
            s[BODY_STATES * i + RATE : BODY_STATES * (i + 1)] = 0.0
        self._call(RENEW, s, slope)
        found = np.zeros((layout.own, N_COORDINATES * layout.bodies))
        for j in range(found.shape[1]):
            at = BODY_STATES * (j // N_COORDINATES) + RATE + j % N_COORDINATES
            s[at] = 1.0
            self._call(RATES, s, slope)
            found[:, j] = slope[first : first + layout.own]
            s[at] = 0.0
        return found

    def _speeds(self, relations: Array, speeds: Mapping[str, float]) -> Array:
        """Return the speeds of all bodies at which no own state changes [rad/s]."""
        names = [body.name for body in self.bodies]
        turning = np.flatnonzero(["rz" not in body.held for body in self.bodies])
        system = [relations[:, RZ::N_COORDINATES][:, turning]]
        wanted = [np.zeros(relations.shape[0])]
        for name, speed in speeds.items():
            if name not in names:
                raise ParameterError(
                    f"speeds must name bodies of the train, got {name!r}. There are "
                    f"{', '.join(names)}."
                )
            check_within(f"speed of {name}", speed, -MAX_SPEED, MAX_SPEED, "rad/s")
            system.append((turning == names.index(name)).astype(float)[None])
            wanted.append(np.array([speed]))
        rows = np.vstack(system)
        rows /= np.abs(rows).max(axis=1, keepdims=True)  # of base radii and of ones
        found, _, rank, _ = np.linalg.lstsq(rows, np.concatenate(wanted), rcond=None)
        if rank < turning.size:
            raise ParameterError(
                f"speeds must fix all bodies that turn, got those of {', '.join(speeds)}, which "
                f"leave {turning.size - rank} free. Give more, or connect the bodies."
            )
        apart = np.abs(rows @ found - np.concatenate(wanted)).max(initial=0.0)
        if apart > _SAME_SPEED * max(1.0, *map(abs, speeds.values())):
            raise ParameterError(
                "speeds must fit together through meshes and shafts, got "
                f"{dict(speeds)}, which are {apart:.3g} rad/s apart. Give one of them."
            )
        out = np.zeros(len(names))
        out[turning] = found
        return out

    def _rest(self, speeds: Mapping[str, float]) -> None:
        """Write the static equilibrium at all angles zero into the state."""
        relations = self._relations()
        found = self._speeds(relations, speeds)
        bearing = BODY_STATES * [body.name for body in self.bodies].index(next(iter(speeds))) + RZ
        places = self._free[self._free != bearing]
        columns = places // BODY_STATES * N_COORDINATES + places % BODY_STATES
        related = np.ascontiguousarray(relations[:, columns])
        turns = columns % N_COORDINATES == RZ
        # loads of the own states that balance the torques of the ports
        slope, s = np.zeros(self._n), self._state
        s[[BODY_STATES * i + W for i in range(len(self.bodies))]] = found
        self._call(RENEW, s, slope)
        self._call(RATES, s, slope)
        mobility = np.concatenate([body.mobility for body in self.bodies])[columns]
        loads = np.linalg.lstsq(
            related[:, turns].T, (slope[places + RATE] / mobility)[turns], rcond=None
        )[0]
        guess: list[float] = []
        kept: dict[int, Array] = {}
        for one in self.elements:
            load = float(loads[len(guess)]) if one.states else 0.0
            guess += one.guess(load)
            if one.name not in self._ports:
                kept[self._made.kept[one.name]] = one.kept(load)
        turned = np.linalg.lstsq(related[:, turns], np.array(guess), rcond=None)[0]
        first = BODY_STATES * self._made.layout.bodies
        s[first : first + related.shape[0]] = related[:, turns] @ turned
        with np.errstate(divide="ignore"):
            reach = np.abs(guess)[:, None] / np.abs(related)
        scales = 0.1 * np.min(reach, axis=0, initial=np.inf)
        scales[~np.isfinite(scales)] = 0.1 * min(np.abs(guess), default=1e-6)
        work = np.zeros(settle_work_size(self._made.layout, places.size))
        head = np.concatenate([np.zeros(self._n), places, related.ravel(), scales])
        work[: head.size] = head
        for _ in range(_PASSES):
            for at, values in kept.items():
                s[at : at + values.size] = values
            self._call(RENEW, s, slope)
            self._call(SETTLE, s, work, float(places.size))
        out = work[head.size : head.size + places.size]
        size = np.abs(loads).max(initial=1.0)
        if not np.abs(out).max(initial=0.0) <= _SETTLED * max(size, 1.0):
            worst = self._made.names[places[int(np.nanargmax(np.abs(out)))]]
            raise ConvergenceError(
                f"no static equilibrium: forces on {worst} are out by {np.abs(out).max():g} N or "
                "N.m. Reduce the torques or stiffen the supports."
            )
        highest = float(self.modes()[0].max(initial=0.0))
        self._least_rate = max(_LEAST_RATE, self._per_period * highest)

    def _stiffness_over_mass(self) -> Array:
        """Return M^-1 K of the free coordinates about the present state, which turns on."""
        layout, first = self._made.layout, BODY_STATES * self._made.layout.bodies
        relations, s = self._relations(), self._state.copy()
        self._call(RENEW, s, np.zeros(self._n))
        for i in range(layout.bodies):
            s[BODY_STATES * i + RATE : BODY_STATES * i + W] = 0.0
        matrix, slope = np.zeros((self._free.size, self._free.size)), np.zeros(self._n)
        for j, place in enumerate(self._free):
            related = relations[:, place // BODY_STATES * N_COORDINATES + place % BODY_STATES]
            for sign in (1.0, -1.0):
                moved = s.copy()
                if place % BODY_STATES != RZ:  # periodic data stay where they are
                    moved[place] += sign * _DIFFERENCE
                moved[first : first + layout.own] += sign * _DIFFERENCE * related
                self._call(RATES, moved, slope)
                matrix[:, j] -= sign * slope[self._free + RATE] / (2.0 * _DIFFERENCE)
        return matrix
