"""Generated roughness, periodic along each side, with the statistics that are asked for.

A spectrum is found whose autocorrelation falls as asked inside the band of waves. Random phases
give it heights; those are then moved in turn to Johnson's distribution, by their order, and back
to the spectrum, by their phases [schreiber_schmitz_1996], until skewness and kurtosis are met.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.surface.generator_request import (
    RoughnessRequest,
    check_fits,
    check_reachable,
    johnson_transform,
    normal_scores,
)
from gearlube_core.surface.heights import MICROMETRE, HeightMap, Profile, S, check_plausible
from gearlube_core.surface.spectrum import directional_length
from gearlube_core.surface.statistics import skewness_kurtosis

_LENGTH_STEPS, _LENGTH_MET = 200, 1e-4  # relative
_FEWEST_WAVES = 3
_MOMENT_STEPS, _GAIN = 200, 0.5
_SKEWNESS_MET, _KURTOSIS_MET = 1e-3, 1e-3  # kurtosis: of its value
_REFUSED = 20.0  # times these


def asked_lengths(request: RoughnessRequest, *, lone: bool) -> tuple[float, ...]:
    """Return the asked correlation lengths [m]: across, and along unless it is a lone profile."""
    across = request.correlation_length
    return (across,) if lone else (across, request.correlation_length_along or across)


def wave_amplitudes(
    request: RoughnessRequest,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    band: tuple[float, float],
) -> tuple[Array, list[float]]:
    """Return amplitudes of waves (nx, ny//2 + 1) and the correlation lengths they give [m].

    The parameters of the spectrum are changed until its autocorrelation, in the band and on the
    grid, falls to the level at the asked lengths.

    Parameters
    ----------
    request
        What the surface is to be.
    shape
        (nx, ny); ny is 1 of a profile.
    spacing
        Along x and y [m].
    band
        Shortest and longest wave [m].

    Raises
    ------
    ParameterError
        A length does not fit the period or the band, or the band holds fewer than three waves.
    """
    lone = shape[1] == 1
    asked = asked_lengths(request, lone=lone)
    level, lay = request.correlation_level, request.lay if not lone else 0.0
    lowest = band[0] * math.acos(level) / (2.0 * math.pi)
    # across the crests, and along them
    directions = (-lay, 0.5 * math.pi - lay)[: len(asked)]
    for name, length, direction in zip(("", "_along"), asked, directions, strict=False):
        check_reachable(length, lowest, band[0])
        reach = min(
            (
                count * one / max(abs(part), 1e-12)
                for count, one, part in zip(
                    shape, spacing, (math.cos(direction), math.sin(direction)), strict=True
                )
                if count > 1
            ),
        )
        check_fits(f"correlation_length{name}", length, reach)
    density, inside = _spectral_shape(request.autocorrelation, lay, shape, spacing, band)
    parameters = np.array(asked)
    best: tuple[float, list[float]] = (math.inf, [math.nan for _ in asked])
    for _ in range(_LENGTH_STEPS):
        power = np.where(inside, density(parameters), 0.0)
        correlation = np.fft.irfft2(power, shape)
        correlation = correlation / correlation[0, 0]
        steps = (spacing[0], spacing[1] if not lone else 1.0)
        got = [directional_length(correlation, steps, one, level) for one in directions]
        ratio = np.array(asked) / np.where(np.isfinite(got), got, np.inf)
        error = float(np.abs(ratio - 1.0).max())
        best = min(best, (error, got))
        if error < _LENGTH_MET:
            return np.sqrt(power), got
        # a length that is not reached inside the period is far too long
        parameters = parameters * np.clip(ratio, 0.5, 2.0)
        if not ((parameters / asked) > 1e-6).all() or not ((parameters / asked) < 1e6).all():
            break
    wish, met = (
        " and ".join(f"{one / MICROMETRE:.4g}" for one in lengths) for lengths in (asked, best[1])
    )
    raise ParameterError(
        f"correlation_length must be one that waves of {band[0] / MICROMETRE:.4g} to "
        f"{band[1] / MICROMETRE:.4g} um can have, got {wish} um; the nearest found is {met} um. "
        "Ask for that, widen the band, lengthen the period or take the other autocorrelation."
    )


def _spectral_shape(
    kind: str,
    lay: float,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    band: tuple[float, float],
) -> tuple[Callable[[Array], Array], Array]:
    """Return the density of waves for parameters (lengths), and which waves are in the band."""
    fx = np.fft.fftfreq(shape[0], spacing[0])[:, None]
    fy = np.fft.rfftfreq(shape[1], spacing[1] if shape[1] > 1 else 1.0)[None, :]
    across = 2.0 * math.pi * (fx * math.cos(lay) - fy * math.sin(lay))
    along = 2.0 * math.pi * (fx * math.sin(lay) + fy * math.cos(lay))
    frequency = np.hypot(fx, fy)
    slack = 1e-9
    inside = (frequency >= (1.0 - slack) / band[1]) & (frequency <= (1.0 + slack) / band[0])
    # a wave of two spacings has no phase
    for axis, count in enumerate(shape):
        if count > 1 and count % 2 == 0:
            inside[(slice(None),) * axis + (count // 2,)] = False
    if inside.sum() < _FEWEST_WAVES:
        raise ParameterError(
            f"The band must hold at least {_FEWEST_WAVES} waves, got {int(inside.sum())} between "
            f"{band[0] / MICROMETRE:.4g} and {band[1] / MICROMETRE:.4g} um. Take a longer period "
            "or a wider band."
        )

    def density(lengths: Array) -> Array:
        square = (across * lengths[0]) ** 2
        if lengths.size > 1:
            square = square + (along * lengths[1]) ** 2
        if kind == "gaussian":
            return np.asarray(np.exp(-0.25 * square))
        return np.asarray((1.0 + square) ** (-0.5 * (lengths.size + 1)))

    return density, inside


@dataclass(frozen=True, slots=True, kw_only=True)
class Reached:
    """One statistic of a generated surface.

    Parameters
    ----------
    name, unit
        Name of the statistic and its unit, "m" or "1".
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
        Each statistic that was asked for.
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
        Statistics that the surface should have.
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
        Statistics that the surface should have.
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
    amplitude: Array, shape: tuple[int, int], request: RoughnessRequest, random: np.random.Generator
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
