"""A small net as one flat array of numbers: layout and kernel.

Two hidden layers of softly bounded units x/(1 + x^2)^(1/2), smooth at any order and cheaper than
tanh; a straight part; two outputs.
"""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.film_model.groups import N_GROUPS, THIN, FilmGroups
from gearlube_core.kernels.jit import kernel

WIDTH = 24  # units of a hidden layer
N_OUTPUTS = 2

_SHARPNESS, _RATE, _THICKNESS = (
    FilmGroups._fields.index(name) for name in ("sharpness", "rate", "thickness")
)
_ROUNDING = 0.3  # of the sharpness about its end, over which corrections come to rest
_OVER_RATE = 0.345  # of the thickness over the rate: films grow with the power 0.69 of speed

# places in the array of numbers
LOW = 0  # domain of each group
HIGH = LOW + N_GROUPS
SHIFT = HIGH + N_GROUPS  # group - shift, times scale: input of the net
SCALE = SHIFT + N_GROUPS
FIRST = SCALE + N_GROUPS  # (groups, width), by group
FIRST_OFFSET = FIRST + N_GROUPS * WIDTH
SECOND = FIRST_OFFSET + WIDTH  # (width, width), by unit of the first layer
SECOND_OFFSET = SECOND + WIDTH * WIDTH
STRAIGHT = SECOND_OFFSET + WIDTH  # (outputs, groups)
LAST = STRAIGHT + N_OUTPUTS * N_GROUPS  # (outputs, width)
LAST_OFFSET = LAST + N_OUTPUTS * WIDTH
BOUNDS = LAST_OFFSET + N_OUTPUTS  # of film and friction [-]
MODULUS = BOUNDS + N_OUTPUTS  # E* that the model was trained with [Pa]
RAMP = MODULUS + 1  # width of the border of the domain over the domain's [-]
N_NUMBERS = RAMP + 1
SCRATCH = N_NUMBERS  # groups and two rows of units, overwritten by every call
UNITS = SCRATCH + N_GROUPS + 2 * WIDTH  # WIDTH, see `new_scratch`
N_ARRAY = UNITS + 1


def new_scratch() -> Array:
    """Return the part of the numbers behind those of the model, shape (N_ARRAY - N_NUMBERS,).

    Its last number is WIDTH. A compiler that knows WIDTH writes out each of the 24 units; if it
    reads it in a run it works on several units at once, in half the time.
    """
    scratch = np.zeros(N_ARRAY - N_NUMBERS)
    scratch[UNITS - SCRATCH] = WIDTH
    return scratch


@kernel
def smooth_step(t: float) -> float:
    """Return 0 up to t = 0 and 1 from t = 1 on, smooth once between."""
    t = min(max(t, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


@kernel
def take_groups(numbers: Array, g: FilmGroups) -> None:
    """Write the groups into the scratch of the numbers, shape (N_ARRAY,)."""
    numbers[SCRATCH] = g.pressure
    numbers[SCRATCH + 1] = g.ellipse
    numbers[SCRATCH + 2] = g.psi
    numbers[SCRATCH + 3] = g.slide_roll
    numbers[SCRATCH + 4] = g.delta
    numbers[SCRATCH + 5] = g.sharpness
    numbers[SCRATCH + 6] = g.shape
    numbers[SCRATCH + 7] = g.stress
    numbers[SCRATCH + 8] = g.limited
    numbers[SCRATCH + 9] = g.rate
    numbers[SCRATCH + 10] = g.peclet
    numbers[SCRATCH + 11] = g.cooling
    numbers[SCRATCH + 12] = g.warmth
    numbers[SCRATCH + 13] = g.conductivity
    numbers[SCRATCH + 14] = g.capacity
    numbers[SCRATCH + 15] = g.heat
    numbers[SCRATCH + 16] = g.thickness


@kernel
def _thicken(numbers: Array) -> None:
    # films thinner than the domain's: corrections of a film that is thick enough at the same
    # pressure, with the viscosity that it takes; smooth once
    beyond = numbers[SCRATCH + _SHARPNESS] - numbers[HIGH + _SHARPNESS] + 0.5 * _ROUNDING
    if beyond > 0.0:
        back = 0.5 * beyond * beyond / _ROUNDING if beyond < _ROUNDING else beyond - 0.5 * _ROUNDING
        numbers[SCRATCH + _SHARPNESS] -= back
        numbers[SCRATCH + _THICKNESS] += back / THIN
        numbers[SCRATCH + _RATE] += back / THIN / _OVER_RATE


@kernel
def share_outside(numbers: Array) -> float:
    """Return 0 inside the domain, rising smoothly to 1 one border's width outside.

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        Their scratch has the groups. Where a group lies beyond the border it is moved back to it:
        nothing of the model is used there. Thin films are inside: there the references hold but for
        a factor, and the corrections are those of the thinnest films of the domain.
    """
    _thicken(numbers)
    inside = 1.0
    for i in range(N_GROUPS):
        low, high = numbers[LOW + i], numbers[HIGH + i]
        border = numbers[RAMP] * (high - low)
        group = numbers[SCRATCH + i]
        excess = max(low - group, group - high) / border
        if excess > 0.0:
            inside *= 1.0 - smooth_step(excess)
            numbers[SCRATCH + i] = min(max(group, low - border), high + border)
    return 1.0 - inside


@kernel
def _bound_units(units: Array) -> None:
    for j in range(units.size):
        units[j] /= math.sqrt(1.0 + units[j] * units[j])


@kernel
def net_outputs(numbers: Array) -> tuple[float, float]:
    """Return both outputs of the net for the groups in the scratch.

    Parameters
    ----------
    numbers : ndarray, shape (N_ARRAY,)
        Weights, and behind them the scratch, whose rows of units this call overwrites.
    """
    width = int(numbers[UNITS])
    at_first = SCRATCH + N_GROUPS
    at_second = at_first + WIDTH
    first = numbers[at_first : at_first + width]
    second = numbers[at_second : at_second + width]
    first_offset = numbers[FIRST_OFFSET : FIRST_OFFSET + width]
    second_offset = numbers[SECOND_OFFSET : SECOND_OFFSET + width]
    for j in range(width):
        first[j] = first_offset[j]
        second[j] = second_offset[j]
    y_0, y_1 = numbers[LAST_OFFSET], numbers[LAST_OFFSET + 1]
    for i in range(N_GROUPS):
        x = (numbers[SCRATCH + i] - numbers[SHIFT + i]) * numbers[SCALE + i]
        y_0 += numbers[STRAIGHT + i] * x
        y_1 += numbers[STRAIGHT + N_GROUPS + i] * x
        at = FIRST + i * WIDTH
        row = numbers[at : at + width]
        for j in range(width):
            first[j] += row[j] * x
    _bound_units(first)
    for i in range(WIDTH):
        x = first[i]
        at = SECOND + i * WIDTH
        row = numbers[at : at + width]
        for j in range(width):
            second[j] += row[j] * x
    _bound_units(second)
    for j in range(WIDTH):
        y_0 += numbers[LAST + j] * second[j]
        y_1 += numbers[LAST + WIDTH + j] * second[j]
    return y_0, y_1
