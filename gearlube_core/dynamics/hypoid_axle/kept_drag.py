"""Drag of the rollers, kept in the state and followed linearly while little changes.

The laws that take each roller by itself cost as much as some integrator steps, and depend on where
the shafts stand in their bearings, on speed and on oil alone. So the drag of both shafts is kept
with its slopes, and evaluated again when a shaft has moved, or speed or oil have changed. Slopes
are renewed by what a change has done; the first ones take an evaluation each.
"""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import RollerFilms
from gearlube_core.dynamics.hypoid_axle.bearing_drag import (
    BearingDrag,
    axle_raceways,
    bearing_drag,
)
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import AxleParameters
from gearlube_core.dynamics.hypoid_axle.state import (
    N_CONTINUOUS,
    U_G,
    U_P,
    W_G,
    W_P,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# places of what is kept: 1 where it is, oil temperature of then [K], bound [W]; of each shaft
# its torque [N m], displacements [um] and speed [rad/s] of then, and slopes over their reaches
_KNOWN, _OIL, _BOUND, _SHAFTS = range(4)
_N = 4  # displacements and speed
_TORQUE, _THEN, _SLOPES = 0, 1, 1 + _N
_N_SHAFT = 1 + 2 * _N
# what asks for another evaluation: a move of 0.3 um bends the drag of a roller under 15 um by 1e-4
_REACH = 0.3  # um
_SPEED_REACH = 0.02  # of 1 rad/s more than the speed
_OIL_REACH = 0.02  # K, as for the nodes of `roller_nodes`


@kernel
def _change(s: Array, kept: Array, shaft: int, i: int) -> float:
    """Return how far number `i` of a shaft is from where it was, over its reach."""
    u, w = (U_P, W_P) if shaft == 0 else (U_G, W_G)
    then = kept[_SHAFTS + shaft * _N_SHAFT + _THEN + i]
    if i == _N - 1:
        return (s[w] - then) / (_SPEED_REACH * (1.0 + abs(then)))
    return (s[u + i] - then) / _REACH


@kernel
def _moved(s: Array, i: int, moved: Array) -> None:
    """Write the state with number `i` of both shafts changed by its reach."""
    for j in range(N_CONTINUOUS):
        moved[j] = s[j]
    if i == _N - 1:
        moved[W_P] += _SPEED_REACH * (1.0 + abs(s[W_P]))
        moved[W_G] += _SPEED_REACH * (1.0 + abs(s[W_G]))
    else:
        moved[U_P + i] += _REACH
        moved[U_G + i] += _REACH


@kernel
def drag_near(s: Array, kept: Array) -> BearingDrag:
    """Return the drag in the state `s` by what is kept, linear about it."""
    pinion = kept[_SHAFTS + _TORQUE]
    gear = kept[_SHAFTS + _N_SHAFT + _TORQUE]
    for i in range(_N):
        pinion += kept[_SHAFTS + _SLOPES + i] * _change(s, kept, 0, i)
        gear += kept[_SHAFTS + _N_SHAFT + _SLOPES + i] * _change(s, kept, 1, i)
    return BearingDrag(pinion, gear, kept[_BOUND])


@kernel
def drag_holds(s: Array, temperature: float, kept: Array) -> bool:
    """Return whether what is kept was found near the state `s`, at about this oil [K]."""
    holds = kept[_KNOWN] == 1.0 and abs(temperature - kept[_OIL]) <= _OIL_REACH
    for i in range(_N):
        largest = max(abs(_change(s, kept, 0, i)), abs(_change(s, kept, 1, i)))
        holds = holds and largest <= 1.0
    return holds


@kernel
def renew_drag(
    s: Array, oil: LubricantState, p: AxleParameters, films: RollerFilms, kept: Array, moved: Array
) -> float:
    """Evaluate the drag in the state `s` and keep it; return how many evaluations that took.

    Parameters
    ----------
    s : ndarray of shape (N_STATE,)
    oil, p, films
        As in `bearing_drag.axle_raceways`.
    kept : ndarray of shape (N_DRAG,)
        Zeros: nothing is kept.
    moved : ndarray of shape (N_STATE,)
        Work space.

    Notes
    -----
    S + (y - S d) d^T/(d^T d), with slopes S over the step d that has been made and the change y of
    the torque. Source: [broyden_1965], method 1.
    """
    drag = bearing_drag(s, oil, p, axle_raceways(s, oil, p, films))
    evaluations = 1.0
    for shaft in range(2):
        at = _SHAFTS + shaft * _N_SHAFT
        torque = drag.pinion if shaft == 0 else drag.gear
        square, missed = 0.0, torque - kept[at + _TORQUE]
        for i in range(_N):
            step = _change(s, kept, shaft, i)
            square += step * step
            missed -= kept[at + _SLOPES + i] * step
        if kept[_KNOWN] == 1.0 and square > 0.25:
            for i in range(_N):
                kept[at + _SLOPES + i] += missed * _change(s, kept, shaft, i) / square
    if kept[_KNOWN] == 0.0:
        evaluations += _N
        for i in range(_N):
            _moved(s, i, moved)
            there = bearing_drag(moved, oil, p, axle_raceways(moved, oil, p, films))
            kept[_SHAFTS + _SLOPES + i] = there.pinion - drag.pinion
            kept[_SHAFTS + _N_SHAFT + _SLOPES + i] = there.gear - drag.gear
    kept[_KNOWN], kept[_OIL], kept[_BOUND] = 1.0, oil.temperature, drag.bound
    kept[_SHAFTS + _TORQUE] = drag.pinion
    kept[_SHAFTS + _N_SHAFT + _TORQUE] = drag.gear
    for i in range(3):
        kept[_SHAFTS + _THEN + i] = s[U_P + i]
        kept[_SHAFTS + _N_SHAFT + _THEN + i] = s[U_G + i]
    kept[_SHAFTS + _THEN + 3] = s[W_P]
    kept[_SHAFTS + _N_SHAFT + _THEN + 3] = s[W_G]
    return evaluations
