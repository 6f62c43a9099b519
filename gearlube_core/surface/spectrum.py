"""Power spectra and autocorrelations of profiles and maps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.ndimage import map_coordinates

from gearlube_core.arrays import Array
from gearlube_core.surface.heights import HeightMap, Profile

CORRELATION_LEVEL = 0.2  # [iso_25178_2], [iso_21920_2]: default of the autocorrelation length


class Spectrum(NamedTuple):
    """One-sided power spectral density: its sum times the frequency step is the mean square."""

    frequency: Array  # (m,) [1/m], from 0
    density: Array  # (m,) [m^3]


def profile_spectrum(profile: Profile) -> Spectrum:
    """Return the power spectral density of a profile less its mean.

    A profile that is not periodic is tapered by a Hann window first, whose loss is made good on
    average.
    """
    return _spectrum(profile.height[:, None], profile.spacing, tapered=not profile.periodic)


def map_spectrum(surface: HeightMap, axis: int) -> Spectrum:
    """Return the mean power spectral density of a map's sections along x (0) or y (1).

    The mean of the whole map is taken off, not that of each section.
    """
    sections = np.moveaxis(surface.height, axis, 0)
    return _spectrum(sections, surface.spacing[axis], tapered=not surface.periodic[axis])


def wavelength_holding(spectrum: Spectrum, share: float) -> float:
    """Return the wavelength [m] so that all longer waves hold a share of the mean square."""
    power = np.cumsum(spectrum.density[1:])
    first = int(np.searchsorted(power, share * power[-1] * (1.0 - 1e-12)))
    return float(1.0 / spectrum.frequency[1:][min(first, power.size - 1)])


def profile_autocorrelation(profile: Profile) -> Array:
    """Return the autocorrelation (m,) [-] of a profile at distances of 0, 1, 2 ... spacings.

    To half the length; where the profile is not periodic, each distance is a mean over the
    points that have it.
    """
    heights = profile.height[:, None]
    return _autocorrelation(heights, (profile.periodic, True))[: profile.height.size // 2 + 1, 0]


def map_autocorrelation(surface: HeightMap) -> Array:
    """Return the autocorrelation (nx, ny) [-] of a map at distances to half its sides.

    Index (i, j) belongs to i spacings along x and j along y; those of the second half are
    negative, as of a Fourier transform.
    """
    return _autocorrelation(surface.height, surface.periodic)


def correlation_length(correlation: Array, spacing: float, level: float) -> float:
    """Return the first distance [m] at which a correlation falls to a level, else NaN.

    Between points it is taken as straight.
    """
    below = np.flatnonzero(correlation <= level)
    if below.size == 0 or below[0] == 0:
        return float("nan")
    k = int(below[0])
    before, after = correlation[k - 1], correlation[k]
    return float(spacing * (k - 1 + (before - level) / (before - after)))


def directional_length(
    correlation: Array, spacing: tuple[float, float], direction: float, level: float
) -> float:
    """Return the first distance [m] at which a map's correlation falls to a level, else NaN.

    Parameters
    ----------
    correlation
        As of `map_autocorrelation`.
    spacing
        Along x and y [m].
    direction
        From x towards y [rad].
    level
        [-].
    """
    along = np.array([np.cos(direction), np.sin(direction)])
    reach = [
        0.5 * count * step / max(abs(part), 1e-12)
        for count, step, part in zip(correlation.shape, spacing, along, strict=True)
    ]
    # the projected spacing: along an axis the points themselves
    step = 1.0 / float(np.hypot(*(along / np.array(spacing))))
    distance = step * np.arange(int(min(reach) / step) + 1)
    places = np.outer(along / np.array(spacing), distance)
    values = map_coordinates(correlation, places, order=1, mode="grid-wrap")
    return correlation_length(values, step, level)


def _spectrum(sections: Array, spacing: float, *, tapered: bool) -> Spectrum:
    count = sections.shape[0]
    window = np.ones(count)
    if tapered:
        window = np.hanning(count + 1)[:-1]
        window = window / np.sqrt(np.mean(window**2))
    waves = np.fft.rfft((sections - sections.mean()) * window[:, None], axis=0)
    power = np.mean(np.abs(waves) ** 2, axis=1) * spacing / count
    both = slice(1, -1) if count % 2 == 0 else slice(1, None)
    power[both] *= 2.0  # each with its negative frequency
    return Spectrum(np.asarray(np.fft.rfftfreq(count, spacing)), np.asarray(power))


def _autocorrelation(height: Array, periodic: tuple[bool, bool]) -> Array:
    deviation = height - height.mean()
    padded = tuple(n if closed else 2 * n for n, closed in zip(height.shape, periodic, strict=True))
    waves = np.fft.rfft2(deviation, padded)
    sums = np.fft.irfft2(np.abs(waves) ** 2, padded)
    for axis, (count, closed) in enumerate(zip(height.shape, periodic, strict=True)):
        distance = np.abs(np.rint(np.fft.fftfreq(count) * count)).astype(int)
        signs = np.rint(np.fft.fftfreq(count) * count).astype(int)
        sums = sums.take(signs % padded[axis], axis=axis)
        pairs = np.full(count, count) if closed else count - distance
        sums = sums / pairs.reshape((-1, 1) if axis == 0 else (1, -1))
    return np.asarray(sums / sums[0, 0])
