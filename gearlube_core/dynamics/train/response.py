"""Vibration of a train that a transmission error of one mesh excites, by its modes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.train.element import BODY_STATES, N_COORDINATES, RATE, RZ
from gearlube_core.dynamics.train.march import RATES, RENEW, WRITE, work_size
from gearlube_core.dynamics.train.model import Train
from gearlube_core.dynamics.train.outputs import outputs_at
from gearlube_core.errors import ParameterError

_STEP = 1e-9  # m and rad, of central differences; flanks at rest are pressed by some 1e-5


def frequency_response(
    train: Train,
    mesh: str,
    outputs: Sequence[str],
    frequencies: Sequence[float] | Array,
    damping_ratio: float = 0.02,
) -> Any:
    """Return how outputs vibrate about the present state over a sinusoidal transmission error.

    Parameters
    ----------
    train : Train
        At rest under load, turning: flanks that touch stay in contact, the others apart.
    mesh : str
        A mesh of it, whose own state is its `rotation`.
    outputs : sequence of str
        Of the train, such as forces of bearings.
    frequencies : sequence of float
        [Hz]
    damping_ratio : float
        Half of the loss factor of all stiffness, 0 to 1. Dampers of the elements are left out, and
        gyroscopic moments.

    Returns
    -------
    ndarray of complex, shape (frequencies, outputs)
        Amplitude of each output in its unit over that of the error, which counts as one more gap
        along the transmission error [m].

    Raises
    ------
    ParameterError
        There is no such mesh or output, or a number is out of range.

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
    check_within("damping_ratio", damping_ratio, 0.0, 1.0)
    made, names = train.assembly, [one.name for one in train.output_records]
    for name in outputs:
        if name not in names:
            raise ParameterError(f"outputs must be those of the train, got {name!r}.")
    own = f"{mesh}.rotation"
    if own not in made.names:
        there = [one.removesuffix(".rotation") for one in made.names if one.endswith(".rotation")]
        raise ParameterError(f"mesh must be one of {', '.join(there) or 'none'}, got {mesh!r}.")
    chosen = [names.index(name) for name in outputs]
    work, state = np.zeros(work_size(made.sizes)), train.get_state()[: made.sizes.states]
    given = train._temperature(), made.numbers, made.memory, made.plan, 0.0, 0.0, work

    def rates(s: Array) -> Array:
        for operation in (RENEW, RATES):
            train.operate(operation, s, *given)
        return work[: made.sizes.integrated].copy()

    def written(s: Array) -> Array:
        train.operate(RENEW, s, *given)
        train.operate(WRITE, s, *given)
        return work[outputs_at(made.sizes) :][chosen].copy()

    mobility = np.concatenate([body.mobility for body in train.bodies])
    free = np.flatnonzero(mobility)
    places = free // N_COORDINATES * BODY_STATES + free % N_COORDINATES
    first_own = BODY_STATES * len(train.bodies)
    of_own = np.arange(first_own, first_own + made.sizes.own)
    related = _relations(rates, state, places, of_own, len(train.bodies))
    error = made.names.index(own)

    def moved(place: int | None, owns: Array | float, along: Any) -> Array:
        """Return the change of the outputs and of accelerations over a move."""
        both = []
        for side in (1.0, -1.0):
            s = state.copy()
            if place is not None and place % BODY_STATES != RZ:  # phases of meshes stay
                s[place] += side * _STEP
            s[along] += side * _STEP * owns
            both.append(np.concatenate([written(s), rates(s)[places + RATE]]))
        return (both[0] - both[1]) / (2.0 * _STEP)

    n = len(outputs)
    by_error = -moved(None, 1.0, error)
    over = np.array([moved(int(at), related[:, j], of_own)[:n] for j, at in enumerate(places)]).T
    found, shapes = train.modes()
    omega, own_omega = 2.0 * np.pi * np.asarray(frequencies, float), 2.0 * np.pi * found
    stiff = 1.0 + 2j * damping_ratio
    pushed = stiff * (shapes.T @ (by_error[n:] / mobility[free]))
    below = stiff * own_omega**2 - omega[:, None] ** 2
    return (pushed / below) @ (over @ shapes).T + by_error[:n]


def _relations(rates: Any, state: Array, places: Any, of_own: Any, bodies: int) -> Array:
    """Return the rates of own states over those of the coordinates, shape (own, coordinates)."""
    still = state.copy()
    for body in range(bodies):
        first = BODY_STATES * body + RATE
        still[first : first + N_COORDINATES] = 0.0
    found = np.zeros((of_own.size, places.size))
    for j, at in enumerate(places):
        s = still.copy()
        s[at + RATE] = 1.0
        found[:, j] = rates(s)[of_own]
    return found
