"""Vibration of a train that a mesh or a torque excites, by frequency."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ
from gearlube_core.dynamics.train.elements.orbit import Orbit
from gearlube_core.dynamics.train.march import RATES, RENEW, STIFFNESS, WRITE
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.errors import ParameterError

Places = npt.NDArray[np.signedinteger[Any]]
_STEP = 1e-9  # m and rad, of central differences; flanks at rest are pressed by some 1e-5
_RATE_STEP = 1e-6  # m/s and rad/s, likewise
_RIGID = 1e-9  # of the largest stiffness, below which nothing holds
_APPROACH = ("rotation", "transmission_error")  # own state of a mesh: how far flanks are pressed
_PERIODS, _SAMPLES = 32, 24  # of a mesh, in its sweep; samples of each
_MEANS, _ROUNDS = 24, 3  # states over which stiffness is averaged; corrections of deflections


def frequency_response(
    train: Train,
    source: str,
    outputs: Sequence[str],
    frequencies: Sequence[float] | Array,
    damping_ratio: float | None = 0.02,
) -> Any:
    """Return how outputs vibrate about the present state over a sinusoidal excitation.

    Parameters
    ----------
    train : Train
        At rest under load, turning: flanks that touch stay in contact, the others apart.
    source : str
        What excites it: a mesh by a transmission error, or a port, such as a motor, by the ripple
        of its torque.
    outputs : sequence of str
        Of the train, such as forces of bearings.
    frequencies : sequence of float
        [Hz]
    damping_ratio : float, optional
        Half of the loss factor of all stiffness, 0 to 1. Dampers of the elements are left out, and
        gyroscopic moments. None: both are those of the elements, and stiffness loses nothing.

    Returns
    -------
    ndarray of complex, shape (frequencies, outputs)
        Amplitude of each output in its unit over that of the error, which counts as one more gap
        along the transmission error [m], or over that of the torque [N.m].

    Raises
    ------
    ParameterError
        There is no such source or output, or a number is out of range.

    Notes
    -----
    Damping is that of complex stiffness: it acts on deflections. Viscous damping of modes would
    act on their motion too, which follows the error far below resonance without any deflection.
    A real error also turns the gear that carries it, by the load times its slope over the angle;
    that is left out here. It matters far below resonance alone.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
    >>> from gearlube_core.dynamics.train.elements.port import Port
    >>> from gearlube_core.dynamics.train.part import Body
    >>> from gearlube_core.oil.lubricant import Lubricant
    >>> gears = [Body.spinning("pinion", 1e-3), Body.spinning("wheel", 1e-2)]
    >>> mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=20, teeth_2=40,
    ...                 normal_module=5e-3, face_width=0.05, backlash=1e-4)
    >>> ports = [Port(name="motor", body="pinion"), Port(name="road", body="wheel")]
    >>> train = Train(gears, [mesh, *ports], Lubricant.named("mohammadpour_2015"))
    >>> train.initialise({"pinion": 100.0}, {"motor": 50.0, "road": 100.0}, 340.0)
    >>> load = frequency_response(train, "mesh", ["mesh.load"], [500.0])
    >>> round(1e-6 * float(abs(load[0, 0])), 2)  # N/um: what accelerates both gears
    3.2
    """
    if damping_ratio is not None:
        check_within("damping_ratio", damping_ratio, 0.0, 1.0)
    made = train.assembly
    meshes, ports = excited_meshes(train), list(train._ports)
    if source not in (*meshes, *ports):
        raise ParameterError(
            f"source must be one of {', '.join([*meshes, *ports]) or 'none'}, got {source!r}."
        )
    state = train.get_state()[: made.sizes.states]
    linear = _linear(train, outputs, [state])
    n, omega = len(outputs), 2.0 * np.pi * np.asarray(frequencies, float)
    if source in meshes:
        by_error = -linear.moved(state, meshes[source])
    else:
        by_error = np.concatenate([np.zeros(n), _by_torque(train, source, linear)])
    factor = 0.0 if damping_ratio is None else 2.0 * damping_ratio
    loaded = by_error[n:] * (1.0 + 1j * factor if source in meshes else 1.0)
    loss = None if damping_ratio is None else factor
    return linear.response(omega, loaded, by_error[:n], loss)


def order_response(
    train: Train,
    mesh: str,
    outputs: Sequence[str],
    speeds: Sequence[float] | Array,
    harmonics: int = 3,
) -> Any:
    """Return how outputs vibrate at the harmonics of a mesh, by its own swing of all forces.

    The forces are those of the train as all its bodies turn evenly with their mean deflections:
    swings of stiffness, of the load along the teeth, and of friction. Meshes of the same frequency
    act together.

    Parameters
    ----------
    train : Train
        At rest under load, turning; without bodies on an `Orbit`.
    mesh : str
    outputs : sequence of str
        Of the train, such as forces of bearings.
    speeds : sequence of float
        Over the present speed, above 0.
    harmonics : int
        Of the mesh frequency, 1 to 16.

    Returns
    -------
    ndarray of complex, shape (speeds, harmonics, outputs)
        Amplitudes in the unit of each output.

    Raises
    ------
    ParameterError
        There is no such mesh or output, a number is out of range, or bodies orbit.

    Notes
    -----
    Stiffness is the mean over mesh cycles, dampers and gyroscopic moments are those of the
    elements. Right to the first order of the swings: those of some 10 % of the stiffness give
    errors of some percent, and vibration of one frequency that another one makes is left out.

    Examples
    --------
    >>> from gearlube_core.dynamics.train.elements.gear_mesh import GearMesh
    >>> from gearlube_core.dynamics.train.elements.port import Port
    >>> from gearlube_core.dynamics.train.part import Body
    >>> from gearlube_core.oil.lubricant import Lubricant
    >>> gears = [Body.spinning("pinion", 1e-3), Body.spinning("wheel", 1e-2)]
    >>> mesh = GearMesh(name="mesh", first="pinion", second="wheel", teeth_1=20, teeth_2=40,
    ...                 normal_module=5e-3, face_width=0.05, backlash=1e-4, stiffness=5e8,
    ...                 stiffness_waves=(0.05, 0.0))
    >>> ports = [Port(name="motor", body="pinion"), Port(name="road", body="wheel")]
    >>> train = Train(gears, [mesh, *ports], Lubricant.named("mohammadpour_2015"))
    >>> train.initialise({"pinion": 100.0}, {"motor": 50.0, "road": 100.0}, 340.0)
    >>> fast = order_response(train, "mesh", ["mesh.load"], [1000.0])  # gears no longer follow
    >>> [round(float(one), 1) for one in (abs(fast[0, 0, 0]), 0.05 * 50.0 / 0.047)]
    [53.2, 53.2]
    """
    check_within("harmonics", harmonics, 1, 16)
    made, found = train.assembly, train.outputs()
    names = excited_meshes(train)
    if mesh not in names:
        raise ParameterError(f"mesh must be one of {', '.join(names) or 'none'}, got {mesh!r}.")
    orbiting = [one.body for one in train.elements if isinstance(one, Orbit)]
    if orbiting:
        raise ParameterError(
            f"order_response takes no bodies on carriers, got {orbiting[0]}. Run the train in time."
        )
    frequency = abs(found[f"{mesh}.frequency"])
    if frequency == 0.0:
        raise ParameterError(f"{mesh} must turn, got a mesh frequency of 0 Hz.")
    state, slope = train.get_state()[: made.sizes.states], train.rates()
    turning = [i for i, name in enumerate(made.names) if name.endswith((".rz", ".cage"))]
    times = np.arange(_PERIODS * _SAMPLES) / (_SAMPLES * frequency)
    window = np.hanning(times.size + 1)[:-1] / (0.5 * times.size)

    def turned(time: float) -> Array:
        s = state.copy()
        s[turning] += time * slope[turning]
        return s

    spread = np.linspace(0.0, times[-1], _MEANS, endpoint=False)
    linear = _linear(train, outputs, [turned(time) for time in spread])
    swings = np.empty((times.size, len(outputs) + linear.places.size))
    own_rates = np.empty((times.size, linear.own.size))
    for i in range(1 + _ROUNDS):
        for j, time in enumerate(times):
            swings[j] = linear.at(turned(time))
            own_rates[j] = _rates(train, turned(time))[linear.own]
        mean = window @ swings
        if i < _ROUNDS:  # deflections about which the mean forces balance
            moved = np.linalg.lstsq(linear.stiffness, mean[len(outputs) :], rcond=_RIGID)[0]
            state[linear.places] += np.where(linear.places % BODY_STATES == RZ, 0.0, moved)
            state[linear.own] += linear.related @ moved
    swings -= mean
    by_own = np.array([linear.moved(state, int(one)) for one in linear.own]).T
    factors = np.asarray(speeds, float)
    response = np.empty((factors.size, harmonics, len(outputs)), complex)
    for k in range(harmonics):
        omega = 2.0 * np.pi * (k + 1) * frequency
        turning_wave = 2.0 * window * np.exp(-1j * omega * times)
        # approach of flanks that is not by deflections: kinematic errors of the teeth
        wave = turning_wave @ swings + by_own @ (turning_wave @ own_rates) / (1j * omega)
        direct, pushed = np.split(wave, [len(outputs)])
        response[:, k] = linear.response(factors * omega, pushed, direct, None)
    return response


def excited_meshes(train: Train) -> dict[str, str]:
    """Return the meshes whose transmission error excites the train, with the own state of each."""
    ends = tuple(f".{one}" for one in _APPROACH)
    return {name.rpartition(".")[0]: name for name in train.state_names if name.endswith(ends)}


def mesh_loads(train: Train) -> dict[str, str]:
    """Return the output that is the normal load of each mesh."""
    names = dict.fromkeys(one.name for one in train.output_records)
    meshes = [one.removesuffix(".dte") for one in names if one.endswith(".dte")]
    both = ((mesh, f"{mesh}.{load}") for mesh in meshes for load in ("load", "force"))
    return {mesh: name for mesh, name in both if name in names}


class _Linear(NamedTuple):
    """A train about states: accelerations of its free coordinates and outputs, linear in both."""

    train: Train
    chosen: list[int]  # outputs
    places: Places  # of the free coordinates in the state
    own: Places  # likewise of the elements' own states
    related: Array  # these over the coordinates, (own, n)
    stiffness: Array  # M^-1 K, (n, n)
    damping: Array  # M^-1 D, with gyroscopic moments
    over: Array  # outputs over coordinates, (outputs, n)
    over_rates: Array

    def rates(self, s: Array, renewed: bool = True) -> Array:
        """Return accelerations of the free coordinates."""
        return np.asarray(_rates(self.train, s, renewed)[self.places + RATE])

    def at(self, s: Array) -> Array:
        """Return outputs and accelerations in a state."""
        made, work = self.train.assembly, self.train._work
        for operation in (RENEW, WRITE):
            self.train._call(operation, s, work=work)
        written = work[outputs_at(made.sizes) :][self.chosen].copy()
        return np.concatenate([written, self.rates(s)])

    def moved(self, state: Array, along: Any, by: Any = 1.0, step: float = _STEP) -> Array:
        """Return the change of outputs and accelerations over a move along own states."""
        places = self.train.assembly.names.index(along) if isinstance(along, str) else along
        both = []
        for side in (1.0, -1.0):
            s = state.copy()
            s[places] += side * step * by
            both.append(self.at(s))
        return np.asarray((both[0] - both[1]) / (2.0 * step))

    def response(self, omega: Array, pushed: Any, direct: Any, loss: float | None) -> Any:
        """Return outputs over frequencies [rad/s] by accelerations that push the coordinates.

        `loss` is the loss factor of all stiffness, instead of all dampers.
        """
        w = omega[:, None, None]
        dampers = 1j * loss * self.stiffness if loss is not None else 1j * w * self.damping
        whole = self.stiffness + dampers - w**2 * np.eye(self.places.size)
        motion = np.linalg.solve(whole, np.broadcast_to(pushed, whole.shape[:2])[..., None])
        outward = self.over + (1j * w * self.over_rates if loss is None else 0.0)
        return (outward @ motion)[..., 0] + direct


def _linear(train: Train, outputs: Sequence[str], states: Sequence[Array]) -> _Linear:
    """Return a train about the mean of states; raise ParameterError where an output is none."""
    made, names = train.assembly, [one.name for one in train.output_records]
    for name in outputs:
        if name not in names:
            raise ParameterError(f"outputs must be those of the train, got {name!r}.")
    mobility = np.concatenate([body.mobility for body in train.bodies])
    free = np.flatnonzero(mobility)
    places = free // N_COORDINATES * BODY_STATES + free % N_COORDINATES
    first = BODY_STATES * len(train.bodies)
    own = np.arange(first, first + made.sizes.own)
    related = _relations(train, states[0], places, own)
    nothing = np.zeros((0, 0))
    chosen = [names.index(name) for name in outputs]
    found = _Linear(train, chosen, places, own, related, nothing, nothing, nothing, nothing)
    n, m = len(outputs), places.size
    stiffness, by_rates, over = np.zeros((m, m)), np.zeros((n + m, m)), np.zeros((n, m))
    for state in states:
        train._call(STIFFNESS, state, work=train._work)
        stiffness += train._work[: m * m].reshape(m, m) / len(states)
        for j, at in enumerate(places):
            by_rates[:, j] += found.moved(state, at + RATE, step=_RATE_STEP) / len(states)
            # phases of meshes stay: what turns acts by the own states
            moving = own if at % BODY_STATES == RZ else np.append(own, at)
            by = related[:, j] if at % BODY_STATES == RZ else np.append(related[:, j], 1.0)
            over[:, j] += found.moved(state, moving, by)[:n] / len(states)
    return found._replace(
        stiffness=stiffness, damping=-by_rates[n:], over=over, over_rates=by_rates[:n]
    )


def _by_torque(train: Train, port: str, linear: _Linear) -> Array:
    """Return the accelerations by a torque of a port in its positive sense [1/(N.m)].

    What else depends on the torque, as the level of a mesh table, stays.
    """
    made, both = train.assembly, []
    at = [made.kept[port]]
    at += [made.names.index(lag) for lag in (f"{port}.mean_torque",) if lag in made.names]
    for side in (1.0, -1.0):
        s = train.get_state()[: made.sizes.states]
        train._call(RENEW, s)
        s[at] += side
        both.append(linear.rates(s, renewed=False))
    return np.asarray(0.5 * (both[0] - both[1]))


def _rates(train: Train, s: Array, renewed: bool = True) -> Array:
    """Return the rates of all integrated states."""
    for operation in (RENEW, RATES) if renewed else (RATES,):
        train._call(operation, s, work=train._work)
    return train._work[: train.assembly.sizes.integrated].copy()


def _relations(train: Train, state: Array, places: Any, of_own: Any) -> Array:
    """Return the rates of own states over those of the coordinates, shape (own, coordinates)."""
    still = state.copy()
    for body in range(len(train.bodies)):
        first = BODY_STATES * body + RATE
        still[first : first + N_COORDINATES] = 0.0
    found = np.zeros((of_own.size, places.size))
    for j, at in enumerate(places):
        s = still.copy()
        s[at + RATE] = 1.0
        found[:, j] = _rates(train, s)[of_own]
    return found
