"""Films in a report: over the roughness, and those of the model of solved films."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import usable_words
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import MOST_OUTSIDE, FilmModel

FULL_FILM, MIXED = 3.0, 1.0  # between full film, mixed and mostly dry contact
_RUBBING = ("friction_viscous", "friction_boundary")  # losses that the model bounds
_ATTRIBUTE = "film_model_"  # of a dataset, with the kind of contact


def film_ratio_level(ratio: float) -> str:
    """Return how a finding with this film ratio is shown: good, note or warning."""
    return GOOD if ratio >= FULL_FILM else NOTE if ratio >= MIXED else WARNING


def film_ratio_words(ratio: float) -> str:
    """Return a sentence on what carries the load.

    Examples
    --------
    >>> film_ratio_words(0.4)
    'Below 1 asperities are in contact over much of the flank: watch wear.'
    """
    if ratio >= FULL_FILM:
        return f"Above {FULL_FILM:g}: full film."
    if ratio >= MIXED:
        return f"Below {FULL_FILM:g} the highest asperities are in contact: mixed lubrication."
    return f"Below {MIXED:g} asperities are in contact over much of the flank: watch wear."


def hot_film(
    hottest: xr.DataArray,
    oil_end: float,
    where: Callable[[xr.DataArray], str],
    axes: Mapping[str, str] | None = None,
) -> list[Finding]:
    """Return the finding of films hotter than the oil data; may be empty.

    Parameters
    ----------
    hottest : DataArray
        Temperature of the hottest film at each point [degC]; nan where there is none.
    oil_end : float
        Highest temperature of the oil data [degC]; nan if it is not known.
    where : callable
        Returns where a point is, from its element of `hottest`.
    axes : mapping
        Unit of each dimension of `hottest`, to say for which part of it films are usable.
    """
    beyond = hottest > oil_end
    if not beyond.any():
        return []
    worst = hottest.isel(hottest.argmax(list(hottest.dims), skipna=True))  # type: ignore[arg-type]
    share = 100.0 * float(beyond.sum() / hottest.notnull().sum())
    grid = [(hottest[name].values, unit) for name, unit in (axes or {}).items()]
    return [
        Finding(
            WARNING,
            f"Flank films are hotter than the oil data, which end at {oil_end:.0f} °C, at "
            f"{share:.0f} % of the points.",
            "There film and friction are extrapolated by the same laws of the oil. The hottest is "
            f"at {where(worst)}: {float(worst):.0f} °C by these laws, which is no prediction. "
            + (usable_words(~beyond.transpose(*axes).values, grid) if axes else ""),
        )
    ]


def film_model_attributes(models: Mapping[str, FilmModel]) -> dict[str, str]:
    """Return what a dataset has about the film models that were taken, by kind of contact."""
    return {f"{_ATTRIBUTE}{kind}": model.words for kind, model in models.items()}


def solved_films(
    bound: float,
    share_outside: float,
    outside_at: str,
    effect: str = "",
    model: str = "",
    where: str = "",
) -> Finding:
    """Return the finding of a run with `film.model = solved`.

    Parameters
    ----------
    bound
        The model's 95 % bound of the flanks' friction loss over that loss [-]; nan if none holds.
    share_outside
        Share of the flanks' load outside the model's domain that decides about a warning [-].
    outside_at
        What `share_outside` is, "at most 3 % of the flanks' load, at 40 km/h".
    effect
        A sentence on what the bound does to another result.
    model
        The model in words, of `film_model_attributes`.
    where
        At which part of the points, " at 3 of 4 points"; empty for all.
    """
    loss = "the flanks' friction loss" + " there" * bool(where)
    headline = (
        f"Films and friction of the flanks are those of solved films{where} (film.model = solved). "
        f"{_bounded(bound, loss)}"
    )
    return _finding(headline, share_outside, outside_at, effect, model)


def solved_rollers(
    bound: float, share_outside: float, outside_at: str, effect: str = "", model: str = ""
) -> Finding:
    """Return the finding of a run whose bearings have the law solved_films.

    Parameters
    ----------
    bound
        The model's 95 % bound of the bearings' drag loss over that loss [-].
    share_outside, outside_at, effect, model
        As in `solved_films`, of the rollers.
    """
    headline = (
        "Films and rolling friction of the rollers are those of solved films (bearing_torque_loss "
        "= solved_films). " + _bounded(bound, "the bearings' drag loss")
    )
    return _finding(headline, share_outside, outside_at, effect, model)


def formulas_stand_in(what: str, outside: Array, speed: Array) -> list[Finding]:
    """Return the finding of points whose load lies too far outside the film model; may be empty.

    Parameters
    ----------
    what
        What is by the formulas there, "Losses".
    outside : ndarray of shape (..., speeds)
        Share of the load outside the model's domain [-].
    speed : ndarray of shape (speeds,)
        [rpm]
    """
    beyond = outside > MOST_OUTSIDE
    if not beyond.any():
        return []
    at = speed[beyond.reshape(-1, speed.size).any(axis=0)]
    return [
        Finding(
            WARNING,
            f"{what} are by formulas and not by solved films at {beyond.sum()} of {beyond.size} "
            f"points, at {at.min():.0f} to {at.max():.0f} rpm: the film model covers only "
            f"{_covered(outside[beyond])} of the load there, less than "
            f"{_covered(np.array([MOST_OUTSIDE]))}.",
            "Formulas lose up to four times as much as solved films: a step of the numbers between "
            "such points and others is one of the models. Train a film model for this oil and "
            "these speeds, or take film.model formula for all points.",
        )
    ]


def points_beyond(outside: xr.DataArray, points: str = "points") -> str:
    """Return at how many points more load is outside than counts as solved films; may be empty."""
    beyond, known = outside.values > MOST_OUTSIDE, int(outside.notnull().sum())
    if not beyond.any():
        return ""
    return (
        f"; more than {100.0 * MOST_OUTSIDE:g} % at {beyond.sum()} of {known} {points}, where the "
        f"model covers {_covered(outside.values[beyond])} of the load. Their losses are in part "
        "those of formulas, their error bars those of formulas, and they are not in the bound"
    )


def covered_alone(bound: Array | float, outside: Array | float) -> Array:
    """Return bounds of a film model where it covers the load; nan where formulas take part."""
    return np.where(np.asarray(outside) > MOST_OUTSIDE, np.nan, bound)


def covered_share(bound: xr.DataArray, loss: xr.DataArray) -> float:
    """Return the sum of bounds over that of the losses where they are known [-]; nan if nowhere."""
    covered = float(loss.where(bound.notnull()).sum())
    return float(bound.sum()) / covered if covered > 0.0 else float("nan")


def _covered(share_outside: Array) -> str:
    shares = [f"{100.0 * (1.0 - one):.3g}" for one in (share_outside.max(), share_outside.min())]
    return f"{' to '.join(dict.fromkeys(shares))} %"


def _bounded(bound: float, loss: str) -> str:
    if np.isnan(bound):
        return "The model covers too little of the load for its bound."
    return f"The model's 95 % bound is {100.0 * bound:.1f} % of {loss}."


def _finding(
    headline: str, share_outside: float, outside_at: str, effect: str, model: str
) -> Finding:
    detail = [
        effect,
        f"Outside the model's domain formulas are used: {outside_at}.",
        "The bound leaves out how uncertain the oil's data are.",
        f"Model: {model}." if model else "",
    ]
    return Finding(
        NOTE if share_outside <= MOST_OUTSIDE else WARNING,
        headline,
        " ".join(one for one in detail if one),
    )


def model_of(dataset: xr.Dataset, kind: str) -> str:
    """Return the words on the film model of a kind of contact; empty where none was taken."""
    return str(dataset.attrs.get(f"{_ATTRIBUTE}{kind}", ""))


def bearing_drag(loss: xr.DataArray) -> xr.DataArray:
    """Return the drag loss of the bearings, of losses by `source`."""
    return loss.sel(source="bearing_torque")


def flank_friction(loss: xr.DataArray) -> xr.DataArray:
    """Return the loss by friction of the flanks, of losses by `source`."""
    rubbing = [one for one in loss["source"].values if str(one) in _RUBBING]
    return loss.sel(source=rubbing).sum("source")


def efficiency_error(dataset: xr.Dataset) -> str:
    """Return a sentence on the largest `efficiency_bound` of a run; empty where none is known."""
    if "efficiency_bound" not in dataset:
        return ""
    most = float(np.fmax.reduce(dataset["efficiency_bound"].values, axis=None))
    if not np.isfinite(most):
        return ""
    return f"That is at most {quantity_text(100.0 * most, '%', 2)} of efficiency."
