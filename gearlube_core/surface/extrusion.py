"""A periodic profile drawn out along a lay so that it repeats over a width [jamali_2015 7.6]."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import CubicSpline

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import (
    MICROMETRE,
    NODES_PER_WAVE,
    HeightMap,
    Profile,
    check_closed,
    check_plausible,
)
from gearlube_core.surface.spectrum import profile_spectrum, wavelength_holding
from gearlube_core.units import DEGREE, MILLIMETRE

MEASURED = ("along_x", "across_lay")
_WAVES_SHOWN = 0.99  # of the mean square
_CLOSED = 1e-6  # rad, and of a width
_ROUNDING = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Lay:
    """Direction in which a periodic profile is extended over a width, so that the surface repeats.

    tan(beta) = n L_x/L_y if the profile is a section along x, as in [jamali_2015 7.6];
    sin(beta) = n L_x/L_y if it was measured across the lay.

    Parameters
    ----------
    period
        L_x of the profile [m].
    width
        L_y, after which the surface repeats along y [m].
    turns
        n: number of periods by which a crest moves along x over the width; below 0: in the other
        direction.
    measured
        Direction in which the profile was measured: along_x or across_lay.

    Raises
    ------
    ParameterError
        A length is not above zero, n is no whole number, or the sine exceeds 1.

    Examples
    --------
    >>> round(Lay(period=149e-6, width=1e-3, turns=1).angle * 180.0 / math.pi, 3)
    8.475
    """

    period: float
    width: float
    turns: int
    measured: str = "along_x"

    def __post_init__(self) -> None:
        check_positive("period", self.period, "m")
        check_positive("width", self.width, "m")
        check_option("measured", self.measured, MEASURED)
        if isinstance(self.turns, bool) or self.turns != int(self.turns):
            raise ParameterError(
                f"turns must be a whole number, got {self.turns!r}. Only then does the surface "
                "repeat over the width."
            )
        most = self.width / self.period
        if self.measured == "across_lay" and abs(self.turns) >= most:
            raise ParameterError(
                f"turns must be below width/period = {most:.4g} for a profile measured across "
                f"its lay, got {self.turns}. Take fewer turns or a wider surface."
            )

    @property
    def angle(self) -> float:
        """Angle beta of the crests, from y towards x [rad]."""
        share = self.turns * self.period / self.width
        return math.atan(share) if self.measured == "along_x" else math.asin(share)

    @classmethod
    def nearest(cls, period: float, width: float, angle: float, measured: str = "along_x") -> Lay:
        """Return the lay that closes with the angle nearest to `angle` [rad]."""
        base = cls(period=period, width=width, turns=0, measured=measured)
        slope = math.tan(angle) if measured == "along_x" else math.sin(angle)
        first = round(slope * width / period)
        near = []
        for turns in (first - 1, first, first + 1):
            if measured == "along_x" or abs(turns) * period < width:
                near.append(cls(period=period, width=width, turns=turns, measured=measured))
        return min(near or [base], key=lambda one: abs(one.angle - angle))

    @classmethod
    def closing(cls, period: float, width: float, angle: float, measured: str = "along_x") -> Lay:
        """Return the lay of an angle [rad] that closes within 1e-6 rad.

        Raises
        ------
        ParameterError
            It does not close; the message offers the nearest angle and the period and the width
            that would close.
        """
        lay = cls.nearest(period, width, angle, measured)
        if abs(lay.angle - angle) <= _CLOSED:
            return lay
        slope = abs(math.tan(angle) if measured == "along_x" else math.sin(angle))
        turns = max(abs(lay.turns), 1)
        fitting = turns * period / slope if slope > 0.0 else width
        raise ParameterError(
            f"lay must be an angle that closes over {width / MILLIMETRE:.4g} mm with a period of "
            f"{period / MICROMETRE:.5g} um, got {angle / DEGREE:.4f} deg. Nearest is "
            f"{lay.angle / DEGREE:.4f} deg ({lay.turns} turns); or take a width of "
            f"{fitting / MILLIMETRE:.5g} mm, or a period of "
            f"{slope * width / turns / MICROMETRE:.5g} um."
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class ExtrudedProfile:
    """Surface made from a periodic profile, extended along a lay, for films that vary along y.

    z(x, y) = p(x - y tan(beta)), or p(x cos(beta) - y sin(beta)), with p a periodic spline.

    Parameters
    ----------
    profile
        Profile that repeats along x.
    lay
        Lay with the same period.

    Raises
    ------
    ParameterError
        The profile is not periodic, its ends do not meet, it is too steep, or the periods differ.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(0.02 * math.pi * np.arange(100))
    >>> profile = Profile(height=wave, spacing=1e-6, periodic=True)
    >>> lay = Lay(period=profile.length, width=1e-3, turns=1)
    >>> drawn = ExtrudedProfile(profile=profile, lay=lay)
    >>> round(1e9 * float(drawn(np.array(2.5e-5), np.array(1e-3))), 6)
    100.0
    """

    profile: Profile
    lay: Lay
    _spline: CubicSpline = field(init=False, repr=False)

    def __post_init__(self) -> None:
        profile = self.profile
        check_closed(profile)
        check_plausible(profile)
        if abs(profile.length - self.lay.period) > _CLOSED * self.lay.period:
            raise ParameterError(
                f"lay.period must be that of {profile.name}, {profile.length / MICROMETRE:.5g} "
                f"um, got {self.lay.period / MICROMETRE:.5g} um."
            )
        x = profile.spacing * np.arange(profile.height.size + 1)
        closed = np.append(profile.height, profile.height[0])
        object.__setattr__(self, "_spline", CubicSpline(x, closed, bc_type="periodic"))

    @property
    def period_x(self) -> float:
        """Period along x [m]."""
        if self.lay.measured == "along_x":
            return self.profile.length
        return self.profile.length / math.cos(self.lay.angle)

    def __call__(self, x: Array, y: Array) -> Array:
        """Return the heights [m] at points (x, y) [m], of any place, shaped as both together."""
        period = self.period_x
        # whole turns first, so that a period farther the same heights come out
        turns = x / period - self.lay.turns * (y / self.lay.width)
        return np.asarray(self._spline((turns - np.floor(turns)) * self.profile.length))

    def check_serves(self, x: Array, y: Array, nodes: float = NODES_PER_WAVE) -> None:
        """Refuse a grid x, y [m] with fewer nodes a wave than `nodes`.

        The wave is the one so that it and all longer ones hold 99 % of the mean square.
        """
        share = self.profile.length / self.period_x
        wave = wavelength_holding(profile_spectrum(self.profile), _WAVES_SHOWN)
        slopes = (share, share * self.lay.turns * self.period_x / self.lay.width)
        for axis, slope, places in zip("xy", slopes, (x, y), strict=True):
            if slope == 0.0:
                continue
            limit = wave / abs(slope) / nodes
            got = float(np.diff(places).max())
            if got > limit * (1.0 + _ROUNDING):
                raise ParameterError(
                    f"The grid must have {nodes:g} nodes a wave along {axis}, a step of at most "
                    f"{limit / MICROMETRE:.4g} um for {self.profile.name}, got "
                    f"{got / MICROMETRE:.4g} um. Take more nodes, or filter short waves out."
                )

    def over(self, length: float, counts: tuple[int, int]) -> HeightMap:
        """Return the heights over `length` [m] along x and the width, on (nx, ny) points.

        Raises
        ------
        ParameterError
            The length is no multiple of the period along x, or there are too few points for the
            waves.
        """
        check_divides("length", length, self.period_x)
        dx, dy = length / counts[0], self.lay.width / counts[1]
        x, y = (
            dx * np.arange(counts[0], dtype=np.float64),
            dy * np.arange(counts[1], dtype=np.float64),
        )
        self.check_serves(x, y)
        return HeightMap(
            height=self(x[:, None], y[None, :]),
            spacing=(dx, dy),
            periodic=(True, True),
            name=f"{self.profile.name} along its lay",
        )


def check_divides(name: str, length: float, period: float) -> int:
    """Return how many periods make a length; refuse one that they do not fill.

    Raises
    ------
    ParameterError
        The period does not divide the length.
    """
    check_positive(name, length, "m")
    count = round(length / period)
    if count < 1 or abs(length / period - count) > _CLOSED * count:
        nearest = max(count, 1)
        raise ParameterError(
            f"{name} must be a whole number of periods of {period / MICROMETRE:.6g} um, got "
            f"{length / MICROMETRE:.6g} um, {length / period:.4g} periods. Nearest are "
            f"{nearest * period / MICROMETRE:.6g} um, or a period of "
            f"{length / nearest / MICROMETRE:.6g} um."
        )
    return count


def periodic_section(profile: Profile, start: float, length: float) -> Profile:
    """Return a part of a profile that can be repeated, cut near a given place.

    Among the cuts within half a period of `start` the one is taken whose ends agree best in height
    and slope. Then the
    line that joins its ends is subtracted, so that their heights agree.

    Parameters
    ----------
    profile
        Profile whose slope was removed.
    start
        Where the part begins [m].
    length
        Period of the part [m], rounded to whole points of the profile.

    Raises
    ------
    ParameterError
        The profile is too short, or no cut can be closed.

    Examples
    --------
    >>> height = 1e-7 * np.random.default_rng(1).standard_normal(400)
    >>> part = periodic_section(Profile(height=height, spacing=1e-6), 1e-4, 1.5e-4)
    >>> part.periodic, part.height.size
    (True, 150)
    """
    spacing, height = profile.spacing, profile.height
    count = round(length / spacing)
    reach = round(0.5 * length / spacing)
    # a point to each side for the slopes
    first = max(round(start / spacing) - reach, 1)
    last = min(round(start / spacing) + reach, height.size - count - 2)
    if count < NODES_PER_WAVE or start < 0.0 or last < first:
        raise ParameterError(
            f"{profile.name}: a part must have at least {NODES_PER_WAVE:g} points and lie inside "
            f"0 to {profile.length / MICROMETRE:.5g} um, got {length / MICROMETRE:.4g} um from "
            f"{start / MICROMETRE:.4g} um, {count} points. Take another part or a longer profile."
        )
    begins = np.arange(first, last + 1)
    slopes = 0.5 * (height[2:] - height[:-2])  # of point k + 1
    jump = height[begins + count] - height[begins]
    kink = slopes[begins + count - 1] - slopes[begins - 1]
    best = int(begins[np.argmin(np.hypot(jump / height.std(), kink / slopes.std()))])
    part = height[best : best + count]
    rise = (height[best + count] - height[best]) * np.arange(count) / count
    closed = part - rise
    cut = Profile(
        height=closed - closed.mean(),
        spacing=length / count,
        periodic=True,
        name=f"{profile.name} from {best * spacing / MICROMETRE:.5g} um",
    )
    check_closed(cut)
    return cut
