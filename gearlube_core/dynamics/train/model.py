"""A train in motion: put it at rest under load, step it, read it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal, NoReturn, get_args

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.dynamics.train.assemble import Bodies, assemble
from gearlube_core.dynamics.train.choice import Driver, kernel_of
from gearlube_core.dynamics.train.element import COORDINATES
from gearlube_core.dynamics.train.elements.held_port import REFERENCE, speed_references
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.march import ENERGY, EVENT, START, WRITE
from gearlube_core.dynamics.train.marched import MarchedTrain
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.dynamics.train.part import Element, Hidden
from gearlube_core.dynamics.train.plan import MOST_EXPONENTIAL
from gearlube_core.dynamics.train.rest import LEAST_RATE
from gearlube_core.dynamics.train.rest_search import APART, LOOSE, NO_REST, OK
from gearlube_core.dynamics.train.supports import whole
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.number import Output
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rads_to_rpm

Integration = Literal["automatic", "rk4", "exponential"]
MOST_TORQUE = 1e7  # N.m, of a port


class Train(MarchedTrain):
    """Bodies, and the elements that act on them, marched in time.

    Parameters
    ----------
    bodies : sequence of Body, Shaft, Housing
    elements : sequence of Element
        Their order is the order of sums, so that another order changes the last digits.
    oil : Lubricant
        Of all elements.
    steps_per_highest_period : int
        Integrator steps per period of the highest mode, 6 to 4096.
    driver : {"automatic", "interpreted", "generated"}
        One compiled code for all lists of the package's elements, or code generated for this list:
        10 to 25 % faster, after some 10 s of compilation. The code for all lists is compiled once
        on a machine, in some 80 s, and kept. Automatic: interpreted where it can be.
    losses_by_element : bool
        Whether losses are those of each element, "stage_1.friction"; else those of a kind are one.
    integration : {"automatic", "rk4", "exponential"}
        RK4, whose step is a share of the highest mode's period, or exponential Runge-Kutta steps,
        exact in all that is linear. Automatic: RK4.
    exponential_steps_per_ms : int
        Of these the least, 1 to 1000; at least a third of what elements ask for in a mesh period.

    Notes
    -----
    Steps have a fixed length. The same input gives the same output to the bit. Exponential steps
    are those of [krogstad_2005] on the modes with all contacts closed. Where a film
    or flank asks for parts of a step, RK4 steps take its place.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.half_shaft import HalfShaft
    >>> from gearlube_core.dynamics.train.part import Body
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
        bodies: Sequence[Bodies],
        elements: Sequence[Element],
        oil: Lubricant,
        *,
        steps_per_highest_period: int = 16,
        driver: Driver = "automatic",
        integration: Integration = "automatic",
        exponential_steps_per_ms: int = 25,
        losses_by_element: bool = False,
    ) -> None:
        check_within("steps_per_highest_period", steps_per_highest_period, 6, 4096)
        check_option("integration", integration, get_args(Integration))
        per_ms = exponential_steps_per_ms
        check_within("exponential_steps_per_ms", per_ms, 1, MOST_EXPONENTIAL, "1/ms")
        per_ms = per_ms if integration == "exponential" else 0
        made = assemble(
            bodies, elements, oil, exponential=per_ms, losses_by_element=losses_by_element
        )
        self.losses_by_element = losses_by_element
        self.bodies, self.elements, self.oil = made.bodies, made.elements, oil
        self.driver, self.integration = driver, integration
        self.steps_per_highest_period = steps_per_highest_period
        self.exponential_steps_per_ms = exponential_steps_per_ms
        operate = kernel_of(made, driver, [one.name for one in self.elements])
        super().__init__(made, operate, np.array([math.nan, LEAST_RATE]))
        self._output_names = tuple(one.name for one in self._made.outputs)
        self._ports = {one.name: made.kept[one.name] for one in elements if isinstance(one, Port)}
        self.references = speed_references(elements)
        self._continuous = np.array([one.place for one in self._made.continuous])
        self._rate_places = np.array([one.rate for one in self._made.continuous])
        self._events = np.array([one.place for one in self._made.events], dtype=int)

    def _given(self) -> dict[str, Any]:
        names = (
            *("bodies", "elements", "oil", "steps_per_highest_period", "driver", "integration"),
            *("exponential_steps_per_ms", "losses_by_element"),
        )
        return {name: getattr(self, name) for name in names}

    def changed(self, **changes: Any) -> Train:
        """Return a train, not yet at rest, with other arguments, such as its `elements`."""
        return Train(**(self._given() | changes))

    @property
    def _least_rate(self) -> float:
        return float(self._beside[1])

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
            Of every port [N.m]. The first bodies of `speeds` bear what they leave, as many as can
            turn independently. Others of `references` than those of the ports, by their names.
        oil_temperature : float
            [K]

        Raises
        ------
        ParameterError
            A speed or torque is missing or out of range.
        ConvergenceError
            No static equilibrium is found.
        """
        wanted, trial, work = self._wanted(speeds), self._trial, self._work
        trial[:] = 0.0
        self._put(torques, oil_temperature)
        work[: wanted.size] = wanted
        per_period, temperature = float(self.steps_per_highest_period), float(oil_temperature)
        status = int(self._call(START, trial, per_period, temperature=temperature))
        if status != OK:
            self._refuse(status, speeds)
        self._put({**self.references, **torques}, oil_temperature)
        self._state[:] = trial
        self._beside[:] = temperature, work[0]

    def step(self, h: float, torques: Mapping[str, float], oil_temperature: float) -> None:
        """Advance by `h` [s] under torques [N.m] or `references` [rad/s], and oil temperature [K].

        Raises
        ------
        ParameterError
            A torque is missing or out of range.
        StepError
            The step cannot be made; the train is then as before.
        """
        check_within("step size", h, 1e-9, 0.1, "s")
        self._temperature()
        self._trial[:] = self._state
        self._put(torques, oil_temperature)
        self._march(h, float(oil_temperature))
        self._beside[0] = oil_temperature

    def outputs(self) -> dict[str, float]:
        """Return all outputs in the present state, SI units, by name, see `output_records`.

        Powers are means over the last step of at least 1e-7 s; before the first one, those now.
        """
        names, (_, written) = self._output_names, self.written()
        at = outputs_at(self._made.sizes)
        return dict(zip(names, written[at : at + len(names)].tolist(), strict=True))

    def written(self) -> tuple[Array, Array]:
        """Return the state and what WRITE of `train_kernel` leaves, for kernels of outputs."""
        self._call(WRITE, self._state)
        return self._state, self._work

    def exceeded(self) -> dict[str, str]:
        """Return all quantities that are out of range now: a sentence for each, by its output.

        Tables and formulas are extrapolated there.
        """
        found, left = self.outputs(), {}
        for element in self.elements:
            for one in element.ranges():
                named = one._replace(output=f"{element.name}.{one.output}")
                value = found[named.output]
                if value != 0.0 and not one.low <= value <= one.high:
                    left[named.output] = named.sentence(value)
        return left

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
        return self._call(ENERGY, self._state)

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
        return self._rates(self._state)

    @property
    def continuous_names(self) -> tuple[str, ...]:
        """Names of the states for another integrator: integrated and free, then load levels."""
        return tuple(one.record.name for one in self._made.continuous)

    @property
    def continuous(self) -> Array:
        """The present values of `continuous_names`, in SI units."""
        return self._state[self._continuous]

    def derivative(self, continuous: Array) -> Array:
        """Return d/dt of the continuous states at these values, for any other integrator.

        Torques, oil temperature and all that changes at events alone are those of the train, which
        stays as it is.

        Parameters
        ----------
        continuous : ndarray of shape (len(continuous_names),)

        Raises
        ------
        StepError
            The values are not finite or beyond what the model has a meaning for.
        """
        return self._exchanged(self._at(continuous))[self._rate_places]

    def indicators(self, continuous: Array) -> Array:
        """Return the indicators whose change of sign needs a call of `event`.

        The arguments and errors are those of `derivative`; `assembly.events` has names and words.
        """
        return self._exchanged(self._at(continuous))[self._events]

    def event(self, continuous: Array) -> Array:
        """Go on from these values with what an event changes there; return them as they now are.

        To be called after each step of another integrator, as friction of films is renewed so many
        times in a mesh period and gears change flanks. Errors as in `derivative`.
        """
        s = self._at(continuous)
        self._accept(self._call(EVENT, s))
        self._state[:] = s
        return self.continuous

    def _at(self, continuous: Array) -> Array:
        wanted = self._continuous.shape
        if np.shape(continuous) != wanted:
            raise ParameterError(
                f"continuous must have the shape {wanted}, got {np.shape(continuous)}. "
                "continuous_names has their order."
            )
        s = self._state.copy()
        s[self._continuous] = continuous
        return s

    def modes(self) -> tuple[Array, Array]:
        """Return undamped natural frequencies [Hz] about the present state, rising, and shapes.

        Returns
        -------
        tuple of ndarray
            Frequencies, shape (m,), rigid rotations as 0; shapes, (free coordinates, m), each of
            modal mass 1 kg. A body on an `Orbit` has its motion in space, with its carrier.
        """
        mobility = np.concatenate([body.mobility for body in self.bodies])
        squares, shapes = np.linalg.eig(self._stiffness())
        order = np.argsort(squares.real)
        shapes = self._in_space(shapes[:, order].real, mobility > 0.0)
        mobility = mobility[mobility > 0.0]
        shapes /= np.sqrt((shapes**2 / mobility[:, None]).sum(axis=0))
        frequencies = np.sqrt(np.maximum(squares.real[order], 0.0)) / (2.0 * np.pi)
        return frequencies, shapes

    def _in_space(self, shapes: Array, free: Flags) -> Array:
        """Return shapes of the free coordinates with the turning of carriers in those carried."""
        names = [f"{body.name}.{one}" for body in self.bodies for one in COORDINATES]
        row = {name: i for i, name in enumerate(np.array(names)[free])}
        whole = shapes.copy()
        for one in self.elements:
            if isinstance(one, Orbit) and f"{one.carrier}.rz" in row:
                turned = one.radius * shapes[row[f"{one.carrier}.rz"]]
                angle = one.azimuth + self.state(f"{one.carrier}.rz")
                whole[row[f"{one.body}.x"]] -= math.sin(angle) * turned
                whole[row[f"{one.body}.y"]] += math.cos(angle) * turned
        return whole

    def _put(self, torques: Mapping[str, float], oil_temperature: float) -> None:
        """Check the inputs, and put the torques into the trial."""
        speeds = {name: torques[name] for name in self.references if name in torques}
        torques = {name: one for name, one in torques.items() if name not in speeds}
        missing = sorted(set(self._ports) ^ set(torques))
        if missing:
            raise ParameterError(
                f"torques must be given for every port, which are {', '.join(self._ports)}; "
                f"wrong is {missing[0]}."
            )
        for name, torque in torques.items():
            check_within(f"torque of {name}", torque, -MOST_TORQUE, MOST_TORQUE, "N.m")
        self.oil.check_temperature(oil_temperature, "oil_temperature")
        for name, speed in speeds.items():
            check_within(name, speed, -MAX_SPEED, MAX_SPEED, "rad/s")
            self._trial[self.place_of_input(name)] = speed
        for name, torque in torques.items():
            self._trial[self._ports[name]] = torque

    def place_of_input(self, name: str) -> int:
        """Return the place in the state of the torque of a port, or of one of `references`."""
        port, _, reference = name.partition(".")
        return self._made.kept[port] + (REFERENCE if reference else 0)

    def _wanted(self, speeds: Mapping[str, float]) -> Array:
        """Return what START takes: the body that bears the rest, then the speed of each or NaN."""
        names = [body.name for body in self.bodies]
        wanted = np.full(1 + len(names), math.nan)
        for name, speed in speeds.items():
            if name not in names:
                raise ParameterError(
                    f"speeds must name bodies of the train, got {name!r}. There are "
                    f"{', '.join(one.name for one in self.bodies if not isinstance(one, Hidden))}."
                )
            check_within(f"speed of {name}", speed, -MAX_SPEED, MAX_SPEED, "rad/s")
            wanted[1 + names.index(name)] = speed
        if not speeds:
            raise ParameterError("speeds must name at least one body of the train, got none.")
        wanted[0] = names.index(next(iter(speeds)))
        return wanted

    def _refuse(self, status: int, speeds: Mapping[str, float]) -> NoReturn:
        """Raise the error of a start that left its number in the work array."""
        number, place = self._work[1:3].tolist()
        if status == LOOSE:
            raise ParameterError(
                f"speeds must fix all bodies that turn, got those of {', '.join(speeds)}, which "
                f"leave {', '.join(self._loose(speeds))} free. Give {number:g} more, or connect "
                "the bodies."
            )
        if status == APART:
            given = (f"{one} {v:.6g} rad/s ({rads_to_rpm(v):.6g} rpm)" for one, v in speeds.items())
            raise ParameterError(
                f"speeds must fit together through meshes and shafts, got {', '.join(given)}, "
                f"which are {number:.3g} rad/s ({rads_to_rpm(number):.3g} rpm) apart. Give one of "
                "them; a body that holds rz does not turn."
            )
        if status == NO_REST:
            where = self._made.names[int(place)]
            if ".modes_" in where:
                where = f"the modes of {whole(where)}"
            free = self._free_motions()
            raise ConvergenceError(
                f"no static equilibrium: nothing holds {', '.join(free)}. Give a support there."
                if free
                else f"no static equilibrium: forces on {where} are out by {number:g} N or N.m. "
                "Reduce the torques, stiffen the supports, or give every body that may move along "
                "or about an axis a support there."
            )
        raise ConvergenceError(
            "natural frequencies at rest are not finite numbers. Check masses and stiffness."
        )
