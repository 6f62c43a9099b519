"""Spectrum of a generated surface: waves of a band that correlate as asked."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.surface.generator_request import (
    RoughnessRequest,
    check_fits,
    check_reachable,
)
from gearlube_core.surface.heights import MICROMETRE
from gearlube_core.surface.spectrum import directional_length

_LENGTH_STEPS, _LENGTH_MET = 200, 1e-4  # relative
_FEWEST_WAVES = 3


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
