"""Statistics of profiles [iso_21920_2] and maps [iso_25178_2], by their standard names."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import HeightMap, Profile, Surface
from gearlube_core.surface.spectrum import (
    CORRELATION_LEVEL,
    correlation_length,
    directional_length,
    map_autocorrelation,
    profile_autocorrelation,
)

_SECTIONS = 5  # over which Rz is a mean
_DIRECTIONS = 180
_SLOPE = (45.0, -9.0, 1.0)  # of seven points, over 60 spacings


@dataclass(frozen=True, slots=True, kw_only=True)
class ProfileStatistics:
    """Statistics of a roughness profile about its mean.

    Parameters
    ----------
    length, spacing
        [m].
    Ra, Rq, Rp, Rv, Rt
        Arithmetic and root mean square, highest peak, deepest valley, their sum [m].
    Rz
        Mean peak to valley of five equal sections [m].
    Rsk, Rku
        Skewness and kurtosis [-]; 0 and 3 of normally distributed heights.
    Rdq
        Root mean square slope, from seven points [-].
    steepest
        Largest slope between neighbours [-].
    Ral
        Autocorrelation length, to 0.2 [m]; NaN if it is not reached.
    mean_wavelength
        2 pi Rq/Rdq [m].
    """

    length: float
    spacing: float
    Ra: float
    Rq: float
    Rp: float
    Rv: float
    Rt: float
    Rz: float
    Rsk: float
    Rku: float
    Rdq: float
    steepest: float
    Ral: float
    mean_wavelength: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MapStatistics:
    """Statistics of a roughness map about its mean.

    Parameters
    ----------
    lengths, spacing
        Along x and y [m].
    Sa, Sq, Sp, Sv, Sz
        Arithmetic and root mean square, highest peak, deepest valley, their sum [m].
    Ssk, Sku
        Skewness and kurtosis [-].
    Sdq
        Root mean square gradient, from seven points along each side [-].
    steepest
        Largest slope between neighbours along x or y [-].
    Sal
        Autocorrelation length: the shortest over all directions, to 0.2 [m].
    Str
        Shortest over longest [-]; 0 where a direction does not fall to 0.2 inside the map.
    fastest_direction
        Of Sal, from x towards y [rad].
    correlation_lengths
        Along x and y, to 0.2 [m]; NaN if it is not reached.
    mean_wavelengths
        2 pi Sq over the rms slope along x and y [m]; infinite where there is none.
    """

    lengths: tuple[float, float]
    spacing: tuple[float, float]
    Sa: float
    Sq: float
    Sp: float
    Sv: float
    Sz: float
    Ssk: float
    Sku: float
    Sdq: float
    steepest: float
    Sal: float
    Str: float
    fastest_direction: float
    correlation_lengths: tuple[float, float]
    mean_wavelengths: tuple[float, float]


def skewness_kurtosis(height: Array) -> tuple[float, float]:
    """Return skewness and kurtosis [-] of heights about their mean.

    mean z^3/(mean z^2)^(3/2), mean z^4/(mean z^2)^2 [iso_21920_2]
    """
    deviation = height - height.mean()
    deviation = deviation / np.sqrt(np.mean(deviation**2))
    return float(np.mean(deviation**3)), float(np.mean(deviation**4))


def profile_statistics(profile: Profile) -> ProfileStatistics:
    """Return height and slope statistics (Ra, Rq, ...) of a levelled, filtered profile.

    Raises
    ------
    ParameterError
        The profile is flat.

    Examples
    --------
    >>> x = 1e-6 * np.arange(200.0)
    >>> wave = Profile(height=1e-7 * np.sin(2e4 * math.pi * x), spacing=1e-6, periodic=True)
    >>> round(1e9 * profile_statistics(wave).Ra, 1)  # 2/pi of the amplitude
    63.6
    """
    height = profile.height - profile.height.mean()
    rq = _rms(profile, height)
    skewness, kurtosis = skewness_kurtosis(height)
    slope, steepest = _slopes(height, profile.spacing, 0, profile.periodic)
    sections = np.array_split(height, min(_SECTIONS, height.size))
    return ProfileStatistics(
        length=profile.length,
        spacing=profile.spacing,
        Ra=float(np.abs(height).mean()),
        Rq=rq,
        Rp=float(height.max()),
        Rv=float(-height.min()),
        Rt=float(np.ptp(height)),
        Rz=float(np.mean([np.ptp(one) for one in sections])),
        Rsk=skewness,
        Rku=kurtosis,
        Rdq=slope,
        steepest=steepest,
        Ral=correlation_length(
            profile_autocorrelation(profile), profile.spacing, CORRELATION_LEVEL
        ),
        mean_wavelength=2.0 * math.pi * rq / slope,
    )


def map_statistics(surface: HeightMap) -> MapStatistics:
    """Return height and slope statistics (Sa, Sq, ...) of a levelled, filtered map.

    Raises
    ------
    ParameterError
        The map is flat.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(0.02 * math.pi * np.arange(100))
    >>> height = wave[:, None] * np.ones(100)
    >>> crests = HeightMap(height=height, spacing=(1e-6, 1e-6), periodic=(True, True))
    >>> round(map_statistics(crests).Sku, 6), map_statistics(crests).Str  # crests have no end
    (1.5, 0.0)
    """
    height = surface.height - surface.height.mean()
    sq = _rms(surface, height)
    skewness, kurtosis = skewness_kurtosis(height)
    sides = [_slopes(height, surface.spacing[k], k, surface.periodic[k]) for k in range(2)]
    slopes, steepest = zip(*sides, strict=True)
    correlation = map_autocorrelation(surface)

    def length(direction: float) -> float:
        return directional_length(correlation, surface.spacing, direction, CORRELATION_LEVEL)

    directions = math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    lengths = np.array([length(one) for one in directions])
    reached = np.isfinite(lengths)
    fastest = int(np.nanargmin(lengths)) if reached.any() else 0
    return MapStatistics(
        lengths=surface.lengths,
        spacing=surface.spacing,
        Sa=float(np.abs(height).mean()),
        Sq=sq,
        Sp=float(height.max()),
        Sv=float(-height.min()),
        Sz=float(np.ptp(height)),
        Ssk=skewness,
        Sku=kurtosis,
        Sdq=math.hypot(*slopes),
        steepest=max(steepest),
        Sal=float(lengths[fastest]),
        Str=float(lengths[fastest] / lengths.max()) if reached.all() else 0.0,
        fastest_direction=float(directions[fastest]),
        correlation_lengths=(length(0.0), length(0.5 * math.pi)),
        mean_wavelengths=_wavelengths(sq, slopes),
    )


def _wavelengths(sq: float, slopes: tuple[float, ...]) -> tuple[float, float]:
    # slopes of rounding are none
    along_x, along_y = (
        2.0 * math.pi * sq / one if one > 1e-9 * max(slopes) else math.inf for one in slopes
    )
    return along_x, along_y


def _rms(surface: Surface, height: Array) -> float:
    rms = float(np.sqrt(np.mean(height**2)))
    if rms <= 1e-12 * float(np.abs(surface.height).max()):
        raise ParameterError(
            f"{surface.name} must have different heights, got a flat surface, whose statistics "
            "have no meaning."
        )
    return rms


def _slopes(height: Array, spacing: float, axis: int, periodic: bool) -> tuple[float, float]:
    """Return rms slope from seven points and the largest slope between neighbours."""
    along = np.moveaxis(height, axis, 0)
    if periodic:
        wide = len(_SLOPE)
        along = np.concatenate([along[-wide:], along, along[:wide]])
    if along.shape[0] > 2 * len(_SLOPE):
        middle = slice(len(_SLOPE), along.shape[0] - len(_SLOPE))
        total = np.zeros_like(along[middle])
        for k, weight in enumerate(_SLOPE, 1):
            ahead = along[middle.start + k : middle.stop + k]
            total += weight * (ahead - along[middle.start - k : middle.stop - k])
        slope = total / (60.0 * spacing)
    else:
        slope = np.gradient(along, spacing, axis=0)
    steepest = float(np.abs(np.diff(along, axis=0)).max()) / spacing
    return float(np.sqrt(np.mean(slope**2))), steepest
