"""By how much each uncertain input of a loss map moves the loss, and what figures call it."""

from __future__ import annotations

import numpy as np
import xarray as xr

_INPUT_WORDS = {"eyring_stress": "Eyring stress", "alpha": "pressure-viscosity coefficient"}
_LEAST_SWING = 5e-4  # mean share of the loss that an input moves, below which it has no effect


def mean_swings(dataset: xr.Dataset) -> dict[str, float]:
    """Return by what share each uncertain input alone moves the loss torque, largest first."""
    share = dataset["swing"] / dataset["loss_torque"]
    mean = share.mean([d for d in share.dims if d != "input"]).values
    names = [str(one) for one in dataset["input"].values]
    return {names[i]: float(mean[i]) for i in np.argsort(mean)[::-1]}


def moving_inputs(dataset: xr.Dataset) -> tuple[dict[str, float], list[str]]:
    """Return `mean_swings` of the inputs that move the loss, and the names of those that do not.

    If none does, all are in the first.
    """
    swings = mean_swings(dataset)
    moving = {name: swing for name, swing in swings.items() if swing >= _LEAST_SWING}
    return (moving, [name for name in swings if name not in moving]) if moving else (swings, [])


def input_words(name: str) -> str:
    """Return what figures and tables call an uncertain input.

    >>> input_words("alpha"), input_words("bearing_drag")
    ('pressure-viscosity coefficient', 'bearing drag')
    """
    return _INPUT_WORDS.get(name, name.replace("_", " "))
