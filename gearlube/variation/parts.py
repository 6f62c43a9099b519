"""Thousands of parts by a model trained on the points of a variation, and how good it is."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from importlib import import_module
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from scipy.stats import binomtest, bootstrap, sobol_indices

from gearlube.variation.design import Design, Sampling
from gearlube.variation.summary import varies
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.extras import extra_package

LEAST_RUNS = 40
_HELD_OUT = 0.3  # share of the full runs that only check
_FOLDS = 5
_SOBOL = 1024  # samples of each of d + 2 sets
_CONFIDENCE = 0.95
METHODS = {
    "share_sobol": "Sobol on the quick model",
    "share_regression": "regression on the full runs",
}


def check_parts(design: Design, parts: int) -> None:
    """Raise ParameterError where a design cannot train a quick model for so many parts."""
    check_within("--parts", parts, 100, 100_000)
    quick_model(1)
    least = _least_runs(len(design.spreads))
    if not design.spreads or design.samples < least:
        raise ParameterError(
            f"--parts needs at least {least} samples to train and check a model, got "
            f"{design.samples if design.spreads else 0}. Give --design lhs:200, with --tolerances, "
            "--scatter or ranges to sample."
        )
    if design.size > design.samples:
        several = next(axis for axis in design.axes if len(axis.values) > 1)
        raise ParameterError(
            f"--parts needs one value of {several.key}, got {len(several.values)}. Run each alone "
            "with its own --out."
        )


def _least_runs(inputs: int) -> int:
    return max(LEAST_RUNS, 3 * (inputs + 1))


class Share(NamedTuple):
    """A share of parts [-] and the ends of its interval of 95 % confidence."""

    value: float
    low: float
    high: float


def counted_share(above: int, of: int) -> Share:
    """Return the share of a count, with the interval of [wilson_1927].

    Examples
    --------
    >>> [round(one, 4) for one in counted_share(0, 200)]
    [0.0, 0.0, 0.0188]
    """
    ends = binomtest(above, of).proportion_ci(_CONFIDENCE, "wilson")
    return Share(above / of, float(ends.low), float(ends.high))


def share_above(limit: float, parts: Array, errors: Array, seed: int = 1) -> Share:
    """Return the share of parts above a limit, with the error of sample and quick model.

    P = mean over e of P(quick + e > limit): each predicted part may miss its full run by any of
    the errors that runs not seen before showed. Their number limits what is known: the mean is
    resampled. Distances of this interval and of that of [wilson_1927] for the parts are joined in
    quadrature.

    Parameters
    ----------
    limit : float
    parts : ndarray
        Predicted, of many parts.
    errors : ndarray of shape (n,)
        Full run less quick model, of runs that it has not seen.
    seed : int
        Seed of the random resampling.

    Examples
    --------
    >>> found = share_above(899.5, np.arange(1000.0), np.zeros(60))
    >>> [round(one, 3) for one in found]
    [0.1, 0.083, 0.12]
    """
    ordered = np.sort(parts)
    each = 1.0 - np.searchsorted(ordered, limit - errors, side="right") / parts.size
    value = float(each.mean())
    low = high = value
    if np.ptp(each) > 0.0:
        found = bootstrap((each,), np.mean, confidence_level=_CONFIDENCE, rng=seed)
        low, high = found.confidence_interval
    counted = counted_share(round(value * parts.size), parts.size)
    down = np.hypot(value - low, value - counted.low)
    up = np.hypot(high - value, counted.high - value)
    return Share(value, max(0.0, float(value - down)), min(1.0, float(value + up)))


def regression_shares(inputs: Array, values: Array) -> Array:
    """Return how much of the variance follows a parabola in each input alone [-], (d,).

    Least squares of y = c + sum_j (a_j x_j + b_j x_j^2). The whole is the sum of these variances
    and that of the rest, which has what inputs do together.

    Parameters
    ----------
    inputs : ndarray of shape (n, d)
    values : ndarray of shape (n,)

    Examples
    --------
    >>> x = np.random.default_rng(1).standard_normal((4000, 2))
    >>> regression_shares(x, 1.0 + 2.0 * x[:, 0] + x[:, 1] ** 2).round(1)  # 4 and 2 of 6
    array([0.7, 0.3])
    """
    x = (inputs - inputs.mean(axis=0)) / inputs.std(axis=0)
    columns = np.column_stack([np.ones(len(x)), x, x**2])
    found = np.linalg.lstsq(columns, values, rcond=None)[0]
    linear, square = found[1:].reshape(2, -1)
    own = (linear * x + square * x**2).var(axis=0)
    rest = values - columns @ found
    return np.asarray(own / (own.sum() + rest @ rest / max(1, rest.size - found.size)))


def quick_model(inputs: int) -> Any:
    """Return an untrained Gaussian process of so many inputs: a plane, smooth bends, and noise.

    Raises
    ------
    ParameterError
        scikit-learn is not installed.
    """
    gaussian = extra_package("sklearn.gaussian_process", "film-model", "A quick model is trained")
    kernels = import_module("sklearn.gaussian_process.kernels")
    bend = kernels.ConstantKernel(1.0, (1e-3, 1e3)) * kernels.RBF(
        np.full(inputs, 3.0), (0.3, 300.0)
    )
    line = kernels.DotProduct(1.0, (1e-3, 1e3))
    kernel = line + bend + kernels.WhiteKernel(0.1, (1e-6, 10.0))
    return import_module("sklearn.pipeline").make_pipeline(
        import_module("sklearn.preprocessing").StandardScaler(),
        gaussian.GaussianProcessRegressor(kernel, normalize_y=True),
    )


def scattered_parts(
    results: xr.Dataset,
    design: Design,
    *,
    parts: int,
    limits: Mapping[str, float] | None = None,
    seed: int = 1,
) -> xr.Dataset:
    """Return the distribution over many parts, its check by full runs, and what each input pays.

    Parameters
    ----------
    results : xarray.Dataset
        Full runs of the design, from `open_variation`.
    design : Design
        One value of each axis, and samples.
    parts : int
        Number of parts to predict, 100 to 100,000.
    limits : mapping, optional
        Limit of a quantity in its unit.
    seed : int
        Seed of the random parts.

    Returns
    -------
    xarray.Dataset
        By `quantity`, those that the study shows or that have a limit, if they vary: `predicted`
        parts; `full` runs; `quick`, the model's answers for the last 30 % of the runs, which it has
        not seen, NaN for those that trained it; `bias` with its standard error, `rms` error and
        `coverage` by these, the share within its `bar` of 95 %; `share_sobol` (total effects on
        the quick model, [saltelli_2010]) and `share_regression` by input; with a limit
        `share_above` and `share_of_runs`, that of the full runs alone, by `end`: value, low, high.

    Raises
    ------
    ParameterError
        Too few runs finished to train and check a model.

    Notes
    -----
    The bar is the 95 % quantile of the errors of five models, each trained without a fifth of the
    runs that train [vovk_2005].
    """
    limits = limits or {}
    wanted = dict.fromkeys([*map(str, results.attrs["shown"]), *limits])
    finite = {name: results[name].values[np.isfinite(results[name].values)] for name in wanted}
    names = [name for name, values in finite.items() if values.size and varies(values)]
    keys = [one.key for one in design.spreads]
    inputs = np.stack([results[key].values for key in keys], axis=1)
    drawn = Design(spreads=design.spreads, sampling=Sampling("random", parts, seed + 1))
    many = np.stack([drawn.column(key) for key in keys], axis=1)
    found: dict[str, list[Any]] = {}
    for name in names:
        limit = limits.get(name, np.nan)
        one = _quantity(name, inputs, results[name].values, many, design, limit, seed)
        for key, value in one.items():
            found.setdefault(key, []).append(value)
    dims = {"predicted": "part", "full": "run", "quick": "run"}
    dims |= dict.fromkeys(METHODS, "input") | dict.fromkeys(("share_above", "share_of_runs"), "end")
    return xr.Dataset(
        {
            key: (["quantity", *([dims[key]] if key in dims else [])], np.array(values))
            for key, values in found.items()
        },
        coords={"quantity": names, "input": keys, "end": list(Share._fields)},
        attrs={"title": results.attrs["title"], "parts": parts},
    )


def _quantity(
    name: str,
    inputs: Array,
    full: Array,
    many: Array,
    design: Design,
    limit: float,
    seed: int,
) -> dict[str, Any]:
    """Return the variables of `scattered_parts` for one quantity."""
    good = np.isfinite(full)
    least = _least_runs(inputs.shape[1])
    if good.sum() < least:
        raise ParameterError(
            f"A quick model of {name} needs at least {least} finished runs, got {good.sum()}. "
            "points.csv says why runs failed; take more samples: --design lhs:200."
        )
    checks = good & (np.arange(full.size) >= (1.0 - _HELD_OUT) * full.size)
    trains = good & ~checks
    selection = import_module("sklearn.model_selection")
    with warnings.catch_warnings():
        # inputs without effect end at a bound of their length, which is right
        warnings.simplefilter("ignore", import_module("sklearn.exceptions").ConvergenceWarning)
        model = quick_model(inputs.shape[1]).fit(inputs[trains], full[trains])
        folds = selection.KFold(_FOLDS, shuffle=True, random_state=seed)
        left_out = selection.cross_val_predict(
            quick_model(inputs.shape[1]), inputs[trains], full[trains], cv=folds
        )
    bar = np.quantile(np.abs(left_out - full[trains]), _CONFIDENCE, method="higher")
    quick = np.full(full.size, np.nan)
    quick[checks] = model.predict(inputs[checks])
    parts = model.predict(many)
    miss = (quick - full)[checks]
    sobol = np.full(len(design.spreads), 1.0)  # of one input it has all, and scipy fails
    if len(design.spreads) > 1:
        sobol = sobol_indices(
            func=lambda table: model.predict(table.T),
            n=_SOBOL,
            dists=[SimpleNamespace(ppf=one.quantile) for one in design.spreads],
            rng=seed,
        ).total_order
    above = of_runs = Share(np.nan, np.nan, np.nan)
    if np.isfinite(limit):
        above = share_above(limit, parts, -miss, seed)
        of_runs = counted_share(int((full > limit).sum()), int(good.sum()))
    return {
        "predicted": parts,
        "full": full,
        "quick": quick,
        "bar": bar,
        "bias": miss.mean(),
        "bias_error": miss.std(ddof=1) / np.sqrt(miss.size),
        "rms": np.sqrt(np.mean(miss**2)),
        "scatter": full[good].std(ddof=1),
        "coverage": np.mean(np.abs(miss) <= bar),
        "share_sobol": np.clip(sobol, 0.0, None),
        "share_regression": regression_shares(inputs[good], full[good]),
        "limit": limit,
        "share_above": above,
        "share_of_runs": of_runs,
    }
