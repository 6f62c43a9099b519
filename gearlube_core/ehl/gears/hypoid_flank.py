"""One tooth pair's contact through its engagement: load, radii and motion over time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import EllipticParaboloid
from gearlube_core.errors import ParameterError


class FlankInstant(NamedTuple):
    """The contact at one time; vectors in the axes of its ellipse, x the minor one."""

    time: float  # [s]
    angle: float  # of the pinion [rad]
    phase: float  # [mesh periods]
    load: float  # [N]
    R_x: float  # [m]
    R_y: float  # [m]
    entrainment: tuple[float, float]  # [m/s]
    sliding: tuple[float, float]  # of the pinion's surface over the gear's [m/s]

    @property
    def psi(self) -> float:
        """Return the angle of entrainment from the minor axis [rad]."""
        return math.atan2(self.entrainment[1], self.entrainment[0])

    @property
    def chi(self) -> float:
        """Return the angle of sliding from the minor axis towards the major one [rad]."""
        return math.atan2(self.sliding[1], self.sliding[0])

    @property
    def speed(self) -> float:
        """Return the entrainment speed [m/s]."""
        return math.hypot(*self.entrainment)

    @property
    def slip(self) -> float:
        """Return the sliding speed [m/s]."""
        return math.hypot(*self.sliding)

    @property
    def gap(self) -> EllipticParaboloid:
        """Return the gap of the undeformed flanks."""
        return EllipticParaboloid(self.R_x, self.R_y)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlankCycle:
    """Contact of one tooth pair over the loaded part of its engagement, N times.

    Parameters
    ----------
    time, angle, phase : ndarray, shape (N,)
        Time [s], pinion angle [rad] and phase [mesh periods]; all rise.
    load : ndarray, shape (N,)
        Normal to the flanks [N], above zero.
    R_x, R_y : ndarray, shape (N,)
        Relative radii along the minor and the major axis of the contact ellipse [m].
    entrainment : ndarray, shape (N, 2)
        Mean surface velocity against the point of contact [m/s], above zero along x and not
        below along y.
    sliding : ndarray, shape (N, 2)
        Velocity of the pinion's surface over the gear's [m/s].

    Raises
    ------
    ParameterError
        A shape differs or a value is out of range.

    Notes
    -----
    Axes turn and move with the ellipse. Between times everything is linear.
    """

    time: Array
    angle: Array
    phase: Array
    load: Array
    R_x: Array
    R_y: Array
    entrainment: Array
    sliding: Array

    def __post_init__(self) -> None:
        count = self.time.size
        if count < 2:
            raise ParameterError(f"a flank's cycle must have at least 2 times, got {count}.")
        for name in self.__dataclass_fields__:
            values = getattr(self, name)
            shape = (count, 2) if name in ("entrainment", "sliding") else (count,)
            if values.shape != shape or not np.isfinite(values).all():
                raise ParameterError(
                    f"{name} of a flank's cycle must be finite and of shape {shape}, got shape "
                    f"{values.shape}."
                )
        for name in ("time", "angle", "phase"):
            if not (np.diff(getattr(self, name)) > 0.0).all():
                raise ParameterError(f"{name} of a flank's cycle must rise.")
        for name, unit in (("load", "N"), ("R_x", "m"), ("R_y", "m")):
            lowest = float(getattr(self, name).min())
            if not lowest > 0.0:
                raise ParameterError(
                    f"{name} of a flank's cycle must be above 0 {unit}, got {lowest:g} {unit}. "
                    "Leave times without contact out."
                )
        u, v = self.entrainment.min(axis=0)
        if not (u > 0.0 and v >= 0.0):
            raise ParameterError(
                "entrainment of a flank's cycle must be above 0 m/s along x and not below along "
                f"y, got down to {u:g} and {v:g} m/s. Turn the axes."
            )

    def at(self, time: float) -> FlankInstant:
        """Return the contact at a time [s]; held outside the cycle."""

        def value(values: Array) -> float:
            return float(np.interp(time, self.time, values))

        return FlankInstant(
            time,
            value(self.angle),
            value(self.phase),
            value(self.load),
            value(self.R_x),
            value(self.R_y),
            (value(self.entrainment[:, 0]), value(self.entrainment[:, 1])),
            (value(self.sliding[:, 0]), value(self.sliding[:, 1])),
        )

    def instants(self) -> list[FlankInstant]:
        """Return the contact at all times of the cycle."""
        return [self.at(float(time)) for time in self.time]
