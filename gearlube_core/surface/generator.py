"""Generated roughness, periodic along each side, with the statistics that are asked for.

A spectrum is found whose autocorrelation falls as asked inside the band of waves. Random phases
give it heights; those are then moved in turn to Johnson's distribution, by their order, and back
to the spectrum, by their phases [schreiber_schmitz_1996], until skewness and kurtosis are met.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Generic

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.generator_spectrum import asked_lengths, wave_amplitudes
from gearlube_core.surface.heights import MICROMETRE, HeightMap, Profile, S, check_plausible
from gearlube_core.surface.johnson_1949 import johnson_transform, normal_scores
from gearlube_core.surface.statistics import skewness_kurtosis

_MOMENT_STEPS, _GAIN = 200, 0.5
_SKEWNESS_MET, _KURTOSIS_MET = 1e-3, 1e-3  # kurtosis: of its value
_REFUSED = 20.0  # times these


@dataclass(frozen=True, slots=True, kw_only=True)
class Reached:
    """One statistic of a generated surface.

    Parameters
    ----------
    name, unit
        "m" or "1".
    asked, reached
        [unit].
    """

    name: str
    unit: str
    asked: float
    reached: float


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Generated(Generic[S]):
    """A generated surface, and what it is against what was asked.

    Parameters
    ----------
    surface
        Periodic profile or map, its mean zero.
    statistics
        Each asked one.
    band
        Shortest and longest wave that it holds [m].
    notes
        Limits of use, in words; often none.
    """

    surface: S
    statistics: tuple[Reached, ...]
    band: tuple[float, float]
    notes: tuple[str, ...]


def generated_profile(
    request: RoughnessRequest, period: float, count: int, random: np.random.Generator
) -> Generated[Profile]:
    """Return a random periodic profile with the wanted statistics.

    Parameters
    ----------
    request
        Wanted statistics.
    period
        Length of a period [m].
    count
        Number of points in a period, at least 16.
    random
        Random number generator; the same state gives the same profile.

    Raises
    ------
    ParameterError
        The band holds no wave, or heights with such a spectrum cannot have these statistics.

    Examples
    --------
    >>> import numpy as np
    >>> asked = RoughnessRequest(arithmetic_mean=3.1e-7, correlation_length=8e-6, skewness=-0.5)
    >>> made = generated_profile(asked, 1e-3, 1024, np.random.default_rng(1))
    >>> round(1e6 * float(abs(made.surface.height).mean()), 6)
    0.31
    """
    shape, spacing = (_checked_count(count), 1), (period / count, math.inf)
    height, statistics, band, notes = _generated(request, shape, spacing, random)
    made = Profile(height=height[:, 0], spacing=spacing[0], periodic=True, name="generated profile")
    check_plausible(made)
    return Generated(surface=made, statistics=statistics, band=band, notes=notes)


def generated_map(
    request: RoughnessRequest,
    periods: tuple[float, float],
    counts: tuple[int, int],
    random: np.random.Generator,
) -> Generated[HeightMap]:
    """Return a random map with the wanted statistics, periodic along x and y.

    Parameters
    ----------
    request
        Wanted statistics.
    periods
        Lengths of a period along x and y [m].
    counts
        Numbers of points in a period along x and y, at least 16.
    random
        Random number generator; the same state gives the same map.

    Raises
    ------
    ParameterError
        As for a profile.

    Examples
    --------
    >>> asked = RoughnessRequest(
    ...     root_mean_square=2e-7, correlation_length=8e-6, correlation_length_along=2e-5
    ... )
    >>> made = generated_map(asked, (1e-4, 1e-4), (64, 64), np.random.default_rng(1))
    >>> round(1e6 * float(made.surface.height.std()), 6)
    0.2
    """
    shape = (_checked_count(counts[0]), _checked_count(counts[1]))
    spacing = (periods[0] / counts[0], periods[1] / counts[1])
    height, statistics, band, notes = _generated(request, shape, spacing, random)
    made = HeightMap(height=height, spacing=spacing, periodic=(True, True), name="generated map")
    check_plausible(made)
    return Generated(surface=made, statistics=statistics, band=band, notes=notes)


_Parts = tuple[Array, tuple[Reached, ...], tuple[float, float], tuple[str, ...]]


def _checked_count(count: int) -> int:
    if count < 16:
        raise ParameterError(
            f"count must be at least 16 points in a period, got {count}. Take a finer spacing."
        )
    return count


def _generated(
    request: RoughnessRequest,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    random: np.random.Generator,
) -> _Parts:
    lone = shape[1] == 1  # a profile
    sides = spacing[:1] if lone else spacing
    shortest, notes = request.resolved_shortest(max(sides))
    periods = [count * one for count, one in zip(shape, sides, strict=False)]
    longest = max(periods) if request.longest_wave is None else request.longest_wave
    if longest > max(periods) * (1.0 + 1e-9):
        raise ParameterError(
            f"longest_wave must be at most the longest period, {max(periods) / MICROMETRE:.4g} um, "
            f"got {longest / MICROMETRE:.4g} um. Leave it out for the longest that fits."
        )
    amplitude, lengths = wave_amplitudes(request, shape, spacing, (shortest, longest))
    height = _with_moments(amplitude, shape, request, random)
    mean, rms = float(np.abs(height).mean()), float(np.sqrt(np.mean(height**2)))
    if request.arithmetic_mean is not None:
        factor = request.arithmetic_mean / mean
        first = Reached(
            name="arithmetic mean", unit="m", asked=request.arithmetic_mean, reached=factor * mean
        )
    else:
        factor = (request.root_mean_square or 0.0) / rms
        first = Reached(
            name="root mean square",
            unit="m",
            asked=request.root_mean_square or 0.0,
            reached=factor * rms,
        )
    skewness, kurtosis = skewness_kurtosis(height)
    names = ("correlation length across", "correlation length along")
    asked = asked_lengths(request, lone=lone)
    statistics = (
        first,
        Reached(name="skewness", unit="1", asked=request.skewness, reached=skewness),
        Reached(name="kurtosis", unit="1", asked=request.kurtosis, reached=kurtosis),
        *(
            Reached(name=name, unit="m", asked=wish, reached=got)
            for name, wish, got in zip(names, asked, lengths, strict=False)
        ),
    )
    return factor * height, statistics, (shortest, longest), notes


def _with_moments(
    amplitude: Array,
    shape: tuple[int, int],
    request: RoughnessRequest,
    random: np.random.Generator,
) -> Array:
    """Return heights with these amplitudes whose skewness and kurtosis are those asked."""
    asked = np.array([request.skewness, request.kurtosis])
    met = np.array([_SKEWNESS_MET, _KURTOSIS_MET * request.kurtosis])
    height = _in_spectrum(random.standard_normal(shape), amplitude, shape)
    scores, target = normal_scores(height.size), asked.copy()
    best, nearest, transform = height, math.inf, None
    for step in range(_MOMENT_STEPS):
        got = np.array(skewness_kurtosis(height))
        error = float(np.abs((asked - got) / met).max())
        if error < nearest:
            best, nearest = height, error
        if nearest <= 1.0:
            return best
        if step > 0:  # before, nothing was lost to the spectrum
            target = _possible(target + _GAIN * (asked - got))
        try:
            transform = johnson_transform(float(target[0]), float(target[1]), transform)
        except ParameterError:
            break  # the spectrum pulls the heights to what no distribution has
        ranked = np.empty(height.size)
        ranked[np.argsort(height, axis=None)] = transform(scores)
        height = _in_spectrum(ranked.reshape(shape), amplitude, shape)
    if nearest > _REFUSED:
        skewness, kurtosis = skewness_kurtosis(best)
        raise ParameterError(
            f"Skewness {asked[0]:g} and kurtosis {asked[1]:g} must be possible with this "
            f"spectrum; the nearest found is {skewness:.3g} and {kurtosis:.3g}. Ask for that, "
            "widen the band of waves or take a longer period."
        )
    return best


def _possible(moments: Array) -> Array:
    skewness = float(np.clip(moments[0], -8.0, 8.0))
    return np.array([skewness, np.clip(moments[1], skewness**2 + 1.1, 200.0)])


def _in_spectrum(height: Array, amplitude: Array, shape: tuple[int, int]) -> Array:
    waves = np.fft.rfft2(height)
    size = np.abs(waves)
    turned = np.where(size > 0.0, waves / np.where(size > 0.0, size, 1.0), 1.0)
    return np.asarray(np.fft.irfft2(amplitude * turned, shape))
