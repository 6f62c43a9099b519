"""Error bars of a loss map: uncertain data drawn again and again, how much each moves the loss."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.arrays import Array, Flags
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.uncertain import UPPER_END, changed_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.progress import Progress, no_progress

_INPUT_WORDS = {"eyring_stress": "Eyring stress", "alpha": "pressure-viscosity coefficient"}
_LEAST_SWING = 5e-4  # mean share of the loss that an input moves, below which it has no effect
_ANGLES = 8  # within 4e-4 of 256, far below any spread
_BOUNDS = (2.5, 97.5)  # percent


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
    """Return the name of an uncertain input in figures and tables.

    >>> input_words("alpha"), input_words("bearing_drag")
    ('pressure-viscosity coefficient', 'bearing drag')
    """
    return _INPUT_WORDS.get(name, name.replace("_", " "))


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """Spread of the total loss; arrays over (temperature, speed, torque).

    Parameters
    ----------
    low, high : ndarray
        Between these lie 95 % of the draws [W].
    swing : ndarray of shape (inputs, temperatures, speeds, torques)
        Half the difference of the total loss with one input at its upper and at its lower end,
        the others at their values [W]; upper and lower are the factor's, see `Uncertain`.
    """

    low: Array
    high: Array
    swing: Array


def spread_of(settings: LossMapSettings, progress: Progress = no_progress) -> Spread:
    """Return the spread of the total loss by the uncertain data of the settings.

    Each draw holds for the whole map: a wrong viscosity is wrong everywhere. Where the
    axle or a draw leaves the film model of the flanks, a draw changes the losses by the ratio that
    the formulas give: no bar mixes both models.
    """
    rows, count = _rows(settings), len(settings.uncertain)
    usual, inside = _power(settings, settings.axle)
    solved = settings.axle.film == "solved"
    formulas = _power(settings, replace(settings.axle, film="formula"))[0] if solved else usual
    totals = np.empty((len(rows), *settings.shape))
    for k, row in enumerate(rows):
        progress(k / len(rows), f"error bars, {k + 1} of {len(rows)}")
        axle, scale = _drawn(settings, row)
        power, still = (usual, inside) if axle is settings.axle else _power(settings, axle)
        left = ~(inside & still)
        if solved and axle is not settings.axle and left.any():
            by = _power(settings, replace(axle, film="formula"))[0][left]
            ratio = np.divide(by, formulas[left], out=np.ones_like(by), where=formulas[left] > 0.0)
            power[left] = usual[left] * ratio
        totals[k] = power @ scale
    swing = 0.5 * np.abs(totals[:count] - totals[count : 2 * count])
    low, high = np.percentile(totals[2 * count :], _BOUNDS, axis=0)
    return Spread(low=low, high=high, swing=swing)


def check_draws(settings: LossMapSettings) -> None:
    """Raise ParameterError where a draw leaves the limits of an input; nothing is computed."""
    if settings.draws:
        for row in _rows(settings):
            _drawn(settings, row)


def _rows(settings: LossMapSettings) -> Array:
    """Return standard normals of every input, (2 inputs + draws, inputs).

    One input alone at its upper end, then at its lower, for each; then the draws.
    """
    count = len(settings.uncertain)
    rng = np.random.default_rng(settings.seed)
    normals = rng.standard_normal((settings.draws, count))
    return np.concatenate([np.eye(count) * UPPER_END, np.eye(count) * -UPPER_END, normals])


def _drawn(settings: LossMapSettings, row: Array) -> tuple[HypoidAxleParameters, Array]:
    """Return the axle with its inputs at these normals, and factors of its losses.

    A law that is known to a factor scales what the axle loses.
    """
    axle, scale = settings.axle, np.ones(len(LOSS_SOURCES))
    for one, normal in zip(settings.uncertain, row, strict=True):
        axle = changed_axle(one, axle, float(normal), scale)
    return axle, scale


def _power(settings: LossMapSettings, axle: HypoidAxleParameters) -> tuple[Array, Flags]:
    """Return the losses by source of an axle on the grid of the settings [W].

    And where solved films of the flanks cover enough of the load; nowhere with the formulas.
    """
    solved = axle.film == "solved"
    torques, speeds, temperatures = settings.grid
    found = axle_losses(
        axle,
        torques=torques,
        speeds=speeds,
        temperatures=temperatures,
        angles=_ANGLES,
        extremes=solved,
    )
    inside = np.zeros(settings.shape, dtype=bool)
    if solved:
        inside = np.asarray(found.share_outside <= MOST_OUTSIDE)
    return found.power, inside
