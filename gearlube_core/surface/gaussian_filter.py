"""Levelling, Gaussian filters [iso_16610_21] [iso_16610_61] and running-in of heights."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Generic

import numpy as np
from numpy.polynomial import legendre
from scipy.signal import oaconvolve

from gearlube_core.arrays import Array
from gearlube_core.checks import check_finite, check_option, check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import MICROMETRE, Profile, S, Surface

_HIGHEST = 8  # degree; more is the work of a filter
_MOST = 0.5  # of the points: beyond, no peaks are cut but the surface
ALPHA = math.sqrt(math.log(2.0) / math.pi)  # half of the amplitude passes at the cut-off
ENDS = ("regression", "cut")
_ROUNDING = 1e-6  # of a spacing
_REACH = 1.0  # cut-offs to each side; beyond, the weights are below 1e-6 of the largest


def levelled(surface: S, degree: int = 1) -> S:
    """Return a surface without its form: its least-squares polynomial is subtracted.

    Parameters
    ----------
    surface
        Measured profile or map.
    degree
        Degree of the polynomial, to 8. 0: the mean; 1: a line or plane; of a map in x and y
        together. Along periodic sides the degree is always 0, because they have no slope.

    Raises
    ------
    ParameterError
        The degree is no whole number from 0 to 8, or there are too few points for it.

    Examples
    --------
    >>> slope = Profile(height=1e-8 * np.arange(50.0), spacing=1e-6)
    >>> bool(abs(levelled(slope).height).max() < 1e-18)
    True
    """
    if isinstance(degree, bool) or degree not in range(_HIGHEST + 1):
        raise ParameterError(
            f"degree must be a whole number within 0 to {_HIGHEST}, got {degree!r}. Use a filter "
            "to remove waviness."
        )
    height = surface.height
    if min(height.shape) <= degree:
        raise ParameterError(
            f"{surface.name}: degree must be below the {min(height.shape)} points along a side, "
            f"got {degree}."
        )
    if isinstance(surface, Profile):
        basis = _basis(height.size, 0 if surface.periodic else degree)
        return replace(surface, height=height - basis @ (basis.T @ height))
    along_x, along_y = (
        _basis(count, 0 if closed else degree)
        for count, closed in zip(height.shape, surface.periodic, strict=True)
    )
    weights = along_x.T @ height @ along_y
    powers = np.add.outer(np.arange(weights.shape[0]), np.arange(weights.shape[1]))
    weights[powers > degree] = 0.0
    return replace(surface, height=height - along_x @ weights @ along_y.T)


def _basis(count: int, degree: int) -> Array:
    """Return orthonormal polynomials (count, degree + 1) at even points."""
    legendres = legendre.legvander(np.linspace(-1.0, 1.0, count), degree)
    return np.asarray(np.linalg.qr(legendres)[0])


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class RunIn(Generic[S]):
    """A surface after its peaks were cut.

    Parameters
    ----------
    surface
        Its mean is zero again.
    height
        At which the peaks were cut, above the mean of before [m].
    share
        Of the points that were above it [-].
    removed
        Mean height of the removed material [m].
    """

    surface: S
    height: float
    share: float
    removed: float


def peaks_cut(surface: S, height: float) -> RunIn[S]:
    """Return a surface whose peaks are cut off flat at a height, as a model of running-in.

    This is no simulation of wear: real running-in rounds the peaks and bends material aside. The
    cuts have edges, which add shorter waves than before. Filter them with lambda_s if the grid is
    too coarse for them.

    Parameters
    ----------
    surface
        Levelled profile or map.
    height
        Height of the cut [m] above the mean; a value below 0 is below the mean.

    Raises
    ------
    ParameterError
        More than half of the points would be cut.

    Examples
    --------
    >>> from gearlube_core.surface.heights import Profile
    >>> profile = Profile(height=1e-7 * np.sin(np.arange(500.0)), spacing=1e-5)
    >>> round(peaks_cut(profile, 0.5e-7).share, 2)  # a third of a sine
    0.33
    """
    check_finite("height", height, "m")
    deviation = surface.height - surface.height.mean()
    share = float(np.mean(deviation > height))
    if share > _MOST:
        raise ParameterError(
            f"height must cut at most {100.0 * _MOST:g} % of the points of {surface.name}, from "
            f"{np.quantile(deviation, 1.0 - _MOST) / MICROMETRE:.3g} um on, got "
            f"{height / MICROMETRE:.3g} um, which cuts {100.0 * share:.3g} %."
        )
    cut = np.minimum(deviation, height)
    removed = -float(cut.mean())
    return RunIn(
        surface=replace(surface, height=cut + removed), height=height, share=share, removed=removed
    )


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class Filtered(Generic[S]):
    """Roughness of a surface with the cut-offs that made it.

    Parameters
    ----------
    roughness
        Waves from lambda_s to lambda_c.
    waviness
        Waves longer than lambda_c; zero without it.
    cutoff_long, cutoff_short
        lambda_c, lambda_s [m]; None: not applied.
    ends
        How ends that are not periodic were treated.
    """

    roughness: S
    waviness: S
    cutoff_long: float | None
    cutoff_short: float | None
    ends: str


def filtered(
    surface: S,
    *,
    cutoff_long: float | None = None,
    cutoff_short: float | None = None,
    ends: str = "regression",
) -> Filtered[S]:
    """Return roughness and waviness of a surface, separated by Gaussian filters with two cut-offs.

    Along periodic sides the filter is applied to the waves themselves. A map is filtered along x
    and y in turn, which is the areal filter, because the Gaussian is a product.

    Parameters
    ----------
    surface
        Levelled profile or map.
    cutoff_long
        lambda_c [m]: longer waves count as waviness. None: all are kept.
    cutoff_short
        lambda_s [m]: shorter waves count as noise. None: all are kept.
    ends
        Treatment of the ends of sides that are not periodic. regression: near an end a line is
        fitted with the Gaussian's weights, so that all points are kept; cut: half a cut-off is
        dropped at each end.

    Raises
    ------
    ParameterError
        The long cut-off does not exceed the short one, one is longer than half the surface
        along an open side, or the short one is below two spacings.

    Examples
    --------
    >>> x = 1e-6 * np.arange(200.0)
    >>> wave = Profile(height=1e-7 * np.cos(2e4 * math.pi * x), spacing=1e-6, periodic=True)
    >>> kept = filtered(wave, cutoff_long=1e-4)  # half of a wave of the cut-off
    >>> round(1e9 * float(kept.roughness.height[0]), 6)
    50.0
    """
    check_option("ends", ends, ENDS)
    _check_cutoffs(surface, cutoff_long, cutoff_short)
    primary = surface if cutoff_short is None else _smoothed(surface, cutoff_short)
    if cutoff_long is None:
        waviness = replace(surface, height=np.zeros_like(surface.height))
    else:
        waviness = _smoothed(primary, cutoff_long)
    roughness = replace(primary, height=primary.height - waviness.height)
    if ends == "cut":
        dropped = 0.5 * (cutoff_long or cutoff_short or 0.0)
        roughness, waviness = _cut(roughness, dropped), _cut(waviness, dropped)
    return Filtered(
        roughness=roughness,
        waviness=waviness,
        cutoff_long=cutoff_long,
        cutoff_short=cutoff_short,
        ends=ends,
    )


def _sides(surface: Surface) -> list[tuple[float, bool, float]]:
    """Return spacing, whether periodic, and length of each side."""
    if isinstance(surface, Profile):
        return [(surface.spacing, surface.periodic, surface.length)]
    return list(zip(surface.spacing, surface.periodic, surface.lengths, strict=True))


def _check_cutoffs(surface: Surface, long: float | None, short: float | None) -> None:
    for name, cutoff in (("cutoff_long", long), ("cutoff_short", short)):
        if cutoff is not None:
            check_positive(name, cutoff, "m")
    for spacing, periodic, length in _sides(surface):
        for name, cutoff in (("cutoff_long", long), ("cutoff_short", short)):
            if cutoff is not None and not periodic and cutoff > 0.5 * length:
                raise ParameterError(
                    f"{name} must be at most half the length of {surface.name}, "
                    f"{0.5 * length / MICROMETRE:.4g} um, got {cutoff / MICROMETRE:.4g} um. "
                    "Measure a longer profile or take a shorter cut-off."
                )
        if short is not None and short < 2.0 * spacing:
            raise ParameterError(
                f"cutoff_short must be at least two spacings of {surface.name}, "
                f"{2.0 * spacing / MICROMETRE:.4g} um, got {short / MICROMETRE:.4g} um. "
                "Measure finer (the standard asks for five) or take a longer cut-off."
            )
    if long is not None and short is not None and long <= short:
        raise ParameterError(
            f"cutoff_long must exceed cutoff_short, {short / MICROMETRE:.4g} um, got "
            f"{long / MICROMETRE:.4g} um. Typical values are 800 and 2.5 um."
        )


def _smoothed(surface: S, cutoff: float) -> S:
    height = surface.height
    for axis, (spacing, periodic, _) in enumerate(_sides(surface)):
        along = np.moveaxis(height, axis, -1)
        smooth = _periodic if periodic else _regression
        height = np.moveaxis(smooth(along, spacing, cutoff), -1, axis)
    return replace(surface, height=height)


def _periodic(height: Array, spacing: float, cutoff: float) -> Array:
    count = height.shape[-1]
    frequency = np.fft.rfftfreq(count, spacing)
    kept = np.exp(-math.pi * (ALPHA * cutoff * frequency) ** 2)
    return np.asarray(np.fft.irfft(kept * np.fft.rfft(height), count))


def _regression(height: Array, spacing: float, cutoff: float) -> Array:
    """Fit a line around each point with the Gaussian's weights; inside it is the mean line."""
    reach = math.ceil(_REACH * cutoff / spacing)
    # centred in units of the cut-off, so that the sums are of one size
    place = np.arange(-reach, reach + 1) * spacing / cutoff
    weight = np.exp(-math.pi * (place / ALPHA) ** 2)
    ones = np.ones((1,) * (height.ndim - 1) + height.shape[-1:])
    shape = (1,) * (height.ndim - 1) + place.shape

    def summed(values: Array, weights: Array) -> Array:
        # correlation: the kernel is turned round
        turned = weights[::-1].reshape(shape)
        full = np.asarray(oaconvolve(values, turned, mode="full", axes=-1))
        return full[..., reach : reach + values.shape[-1]]

    w0, w1, w2 = (summed(ones, weight * place**k) for k in range(3))
    z0, z1 = (summed(height, weight * place**k) for k in range(2))
    return np.asarray((w2 * z0 - w1 * z1) / (w0 * w2 - w1 * w1))


def _cut(surface: S, dropped: float) -> S:
    height = surface.height
    for axis, (spacing, periodic, _) in enumerate(_sides(surface)):
        points = 0 if periodic else math.ceil(dropped / spacing - _ROUNDING)
        height = height.take(range(points, height.shape[axis] - points), axis=axis)
    return replace(surface, height=height)
