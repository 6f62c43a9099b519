"""Designs: which values the varied parameters take at each point."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal, get_args

import numpy as np
from scipy.stats import norm, qmc

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

Value = float | int | str
Point = dict[str, Value]
Method = Literal["lhs", "sobol", "random"]

METHODS: tuple[str, ...] = get_args(Method)
MOST_POINTS = 1_000_000


@dataclass(frozen=True, slots=True)
class Axis:
    """A parameter with a list of values; all axes of a design are combined with each other.

    Parameters
    ----------
    key : str
        Name of the parameter.
    values : tuple of float, int or str

    Examples
    --------
    >>> Axis("oil.temperature_degc", (40.0, 80.0)).values
    (40.0, 80.0)
    """

    key: str
    values: tuple[Value, ...]

    def __post_init__(self) -> None:
        if not self.values or len(set(self.values)) < len(self.values):
            raise ParameterError(
                f"{self.key} must have one or more different values, got {self.values}."
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """A parameter with a distribution, from which samples are taken.

    Parameters
    ----------
    key : str
        Name of the parameter.
    low, high : float
        Limits; no sample is outside them. They may be infinite for a normal distribution.
    mean, deviation : float, optional
        Mean and standard deviation of a normal distribution before it is cut off at the limits.
        None: all values between the limits are equally likely.

    Examples
    --------
    >>> Spread(key="oil.temperature_degc", low=40.0, high=80.0).quantile(np.array([0.25]))
    array([50.])
    """

    key: str
    low: float
    high: float
    mean: float | None = None
    deviation: float | None = None

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise ParameterError(
                f"The upper end of {self.key} must be above the lower, {self.low:g}, "
                f"got {self.high:g}."
            )

    def quantile(self, share: Array) -> Array:
        """Return the values below which the `share` of all samples lies, shape as given."""
        if self.mean is None or self.deviation is None:
            return np.asarray(self.low + share * (self.high - self.low))
        ends = norm.cdf([self.low, self.high], self.mean, self.deviation)
        cut = ends[0] + share * (ends[1] - ends[0])
        return np.asarray(norm.ppf(cut, self.mean, self.deviation))


@dataclass(frozen=True, slots=True)
class Sampling:
    """How samples are taken from the spreads of a design.

    Parameters
    ----------
    method : {"lhs", "sobol", "random"}
        Latin hypercube, scrambled Sobol sequence, or independent random numbers.
    count : int
        Number of samples; a power of two for sobol.
    seed : int
        Seed of the random numbers.

    Examples
    --------
    >>> Sampling("sobol", 4).shares(1).shape
    (4, 1)
    """

    method: Method
    count: int
    seed: int = 1

    def __post_init__(self) -> None:
        check_option("the design", self.method, METHODS)
        check_within("the number of samples", self.count, 1, MOST_POINTS)
        check_within("--seed", self.seed, 0, 2**32 - 1)
        if self.method == "sobol" and self.count & (self.count - 1):
            below = 1 << (self.count.bit_length() - 1)
            raise ParameterError(
                f"A Sobol design must have a power of two of samples, got {self.count}. Take "
                f"{below} or {2 * below}, or a Latin hypercube, lhs:{self.count}."
            )

    def shares(self, dimensions: int) -> Array:
        """Return samples between 0 and 1, shape (count, dimensions)."""
        rng = np.random.default_rng(self.seed)
        if self.method == "random":
            return rng.random((self.count, dimensions))
        kind = qmc.Sobol if self.method == "sobol" else qmc.LatinHypercube
        return np.asarray(kind(dimensions, seed=rng).random(self.count))


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """All points of a variation: every combination of the axes, each with all samples.

    All combinations have the same samples, so that differences between combinations do not come
    from different samples. The points of one combination follow each other; the last axis changes
    first.

    Parameters
    ----------
    axes : tuple of Axis
    spreads : tuple of Spread
    sampling : Sampling, optional
        Needed with spreads, and only then.

    Examples
    --------
    >>> design = Design(
    ...     axes=(Axis("oil.temperature_degc", (40.0, 80.0)),),
    ...     spreads=(Spread(key="gear_set.backlash_um", low=100.0, high=200.0),),
    ...     sampling=Sampling("lhs", 3),
    ... )
    >>> design.size, design.point(3)["oil.temperature_degc"]
    (6, 80.0)
    """

    axes: tuple[Axis, ...] = ()
    spreads: tuple[Spread, ...] = ()
    sampling: Sampling | None = field(default=None)

    def __post_init__(self) -> None:
        twice = sorted({key for key in self.keys if self.keys.count(key) > 1})
        if twice:
            raise ParameterError(
                f"{', '.join(twice)} must be varied only once, got it twice. "
                "Remove one --vary of it."
            )
        if not self.keys:
            raise ParameterError(
                "A variation needs a parameter to vary, got none. Give --vary, for instance "
                "--vary pinion.bearing.preload_n=2000:6000:1000."
            )
        if self.spreads and self.sampling is None:
            raise ParameterError(
                f"{self.spreads[0].key} has a range without steps, so the design must say how to "
                "sample it. Give --design lhs:200, or first:last:step."
            )
        if self.sampling is not None and not self.spreads:
            raise ParameterError(
                f"A design {self.sampling.method}:{self.sampling.count} needs ranges to sample, "
                "got none. Give --vary KEY=low:high or KEY=value+-width, or --scatter with a file "
                "that has [tolerances]."
            )
        check_within("the number of points", self.size, 1, MOST_POINTS)

    @property
    def keys(self) -> tuple[str, ...]:
        """Names of all varied parameters, axes first."""
        return (*(axis.key for axis in self.axes), *(one.key for one in self.spreads))

    @property
    def samples(self) -> int:
        """Samples of each combination of the axes; 1 without spreads."""
        return 1 if self.sampling is None else self.sampling.count

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(self.shape) * self.samples

    def point(self, number: int) -> Point:
        """Return the values at a point by their keys."""
        combination, sample = divmod(number, self.samples)
        places = np.unravel_index(combination, self.shape) if self.shape else ()
        values: Point = {
            axis.key: axis.values[int(place)] for axis, place in zip(self.axes, places, strict=True)
        }
        if self.spreads:
            row = sampled(self)[sample]
            values |= {one.key: float(value) for one, value in zip(self.spreads, row, strict=True)}
        return values

    def column(self, key: str) -> Array:
        """Return the values of one key at all points, shape (size,); for texts their numbers."""
        for place, axis in enumerate(self.axes):
            if axis.key == key:
                texts = isinstance(axis.values[0], str)
                values = np.arange(len(axis.values)) if texts else np.array(axis.values, float)
                inner = math.prod(self.shape[place + 1 :]) * self.samples
                outer = math.prod(self.shape[:place])
                return np.tile(np.repeat(values, inner), outer)
        at = [one.key for one in self.spreads].index(key)
        return np.tile(sampled(self)[:, at], math.prod(self.shape))


@lru_cache(maxsize=4)
def sampled(design: Design) -> Array:
    """Return the samples of a design's spreads, shape (samples, spreads)."""
    if design.sampling is None:
        return np.zeros((1, 0))
    shares = design.sampling.shares(len(design.spreads))
    columns = [one.quantile(shares[:, i]) for i, one in enumerate(design.spreads)]
    values = np.stack(columns, axis=1)
    values.setflags(write=False)
    return values
