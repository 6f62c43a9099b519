"""Pitch cones of a hypoid pair from design data: methods 1, 2 and 3 of ISO 23509.

A pair of touching cones (`PitchCones.touching`) has one free number, the gear's pitch angle. Each
method closes it by a condition on the cutter; the standard iterates to its own tolerance (1 % in
methods 1 and 2, 1e-4 R_m1 in method 3), here the condition is solved to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

from scipy.optimize import brentq

from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import FACE_WIDTH, TEETH
from gearlube_core.hypoid_geometry.blank.pitch_cones import CutterHead, PitchCones, ToothTrace
from gearlube_core.number import Checked, Number

_METRES = "Give metres, not millimetres."
_SEARCH_STEP = math.radians(0.5)
_SEARCH_REACH = 50
_CLOSED = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class HypoidDesign(Checked):
    """Design data that the methods share.

    Parameters
    ----------
    pinion_teeth, gear_teeth : int
        z_1, z_2 [-].
    offset : float
        a [m], above zero: without offset the cones follow from the teeth alone.
    shaft_angle : float
        Sigma [rad].
    gear_face_width : float
        b_2 [m].
    cutter : CutterHead
    """

    pinion_teeth: Annotated[int, TEETH]
    gear_teeth: Annotated[int, TEETH]
    offset: Annotated[float, Number("m", 1e-5, 1.0, _METRES)]
    shaft_angle: Annotated[float, Number("rad", 0.2, 2.9, "Give radians.")]
    gear_face_width: Annotated[float, FACE_WIDTH]
    cutter: CutterHead

    def cones(
        self,
        gear_pitch_angle: float,
        gear_pitch_radius: float,
        *,
        gear_spiral_angle: float | None = None,
        pinion_spiral_angle: float | None = None,
    ) -> PitchCones:
        """Return the touching cones of this design for one gear pitch cone."""
        return PitchCones.touching(
            pinion_teeth=self.pinion_teeth,
            gear_teeth=self.gear_teeth,
            offset=self.offset,
            shaft_angle=self.shaft_angle,
            gear_pitch_angle=gear_pitch_angle,
            gear_pitch_radius=gear_pitch_radius,
            gear_spiral_angle=gear_spiral_angle,
            pinion_spiral_angle=pinion_spiral_angle,
        )

    def gear_trace(self, cones: PitchCones) -> ToothTrace:
        """Return the lengthwise trace this design's cutter leaves on the gear."""
        return ToothTrace(
            cutter=self.cutter,
            crown_teeth=cones.crown_teeth,
            mean_cone_distance=cones.gear_mean_cone_distance,
            mean_spiral_angle=cones.gear_spiral_angle,
        )


def method_1(
    design: HypoidDesign, *, outer_pitch_diameter: float, pinion_spiral_angle: float
) -> PitchCones:
    """Return the cones whose limit curvature is the gear's lengthwise curvature.

    Parameters
    ----------
    design : HypoidDesign
    outer_pitch_diameter : float
        d_e2 [m].
    pinion_spiral_angle : float
        beta_Delta1 [rad], met exactly.

    Raises
    ------
    ConvergenceError
        When no gear pitch angle closes the condition.

    Notes
    -----
    The mean pitch radius comes from the first estimate of the gear's pitch angle, [iso_23509 (11)],
    and is kept: the mean point leaves mid-face by the error of that estimate.

    References
    ----------
    [iso_23509 6.2.2], formulas (8) to (41).
    """
    ratio = design.gear_teeth / design.pinion_teeth
    departure = design.shaft_angle - 0.5 * math.pi
    # 1.2 is the standard's guess of the hypoid dimension factor, [iso_23509 (11)]
    estimate = math.atan(ratio * math.cos(departure) / (1.2 * (1.0 - ratio * math.sin(departure))))
    radius = 0.5 * (outer_pitch_diameter - design.gear_face_width * math.sin(estimate))
    check_within("gear mean pitch radius", radius, 1e-4, 5.0, "m", _METRES)

    def cones(angle: float) -> PitchCones:
        return design.cones(angle, radius, pinion_spiral_angle=pinion_spiral_angle)

    return _closed(cones, lambda pair: curvature_misfit(design, pair), design)


def method_2(
    design: HypoidDesign, *, mean_pitch_diameter: float, gear_spiral_angle: float
) -> PitchCones:
    """Return the cones whose apexes lie on one line with the cutter centre.

    Parameters
    ----------
    design : HypoidDesign
    mean_pitch_diameter : float
        d_m2 [m].
    gear_spiral_angle : float
        beta_m2 [rad].

    Raises
    ------
    ConvergenceError
        When no gear pitch angle closes the condition.

    References
    ----------
    [iso_23509 6.2.3], formulas (42) to (83).
    """
    radius = 0.5 * mean_pitch_diameter

    def cones(angle: float) -> PitchCones:
        return design.cones(angle, radius, gear_spiral_angle=gear_spiral_angle)

    return _closed(cones, lambda pair: apex_misfit(design, pair), design)


def method_3(
    design: HypoidDesign, *, outer_pitch_diameter: float, gear_spiral_angle: float
) -> PitchCones:
    """Return the cones whose pinion cone distance meets the cutter condition of method 3.

    Parameters
    ----------
    design : HypoidDesign
    outer_pitch_diameter : float
        d_e2 [m].
    gear_spiral_angle : float
        beta_m2 [rad].

    Raises
    ------
    ConvergenceError
        When no gear pitch angle closes the condition.

    References
    ----------
    [iso_23509 6.2.4], formulas (84) to (109).
    """

    def cones(angle: float) -> PitchCones:
        radius = 0.5 * (outer_pitch_diameter - design.gear_face_width * math.sin(angle))
        return design.cones(angle, radius, gear_spiral_angle=gear_spiral_angle)

    return _closed(cones, lambda pair: cone_distance_misfit(design, pair), design)


def curvature_misfit(design: HypoidDesign, cones: PitchCones) -> float:
    """Return rho_mbeta / rho_lim - 1 [-], the closing condition of method 1, [iso_23509 (33)]."""
    return design.gear_trace(cones).curvature_radius * cones.limit_curvature - 1.0


def apex_misfit(design: HypoidDesign, cones: PitchCones) -> float:
    """Return R_m1,check / R_m1 - 1 [-], the closing condition of method 2, formulas (79) to (82).

    In the pitch plane R_m1,check is where the line from the gear's apex to the cutter centre cuts
    the pinion's generator.
    """
    trace = design.gear_trace(cones)
    across = design.cutter.radius * math.sin(trace.centre_angle)
    along = design.cutter.radius * math.cos(trace.centre_angle)
    angle = math.atan2(across, cones.gear_mean_cone_distance - along)
    check = cones.gear_mean_cone_distance * math.sin(angle) / math.sin(angle + cones.offset_angle)
    return check / cones.pinion_mean_cone_distance - 1.0


def cone_distance_misfit(design: HypoidDesign, cones: PitchCones) -> float:
    """Return R_m1 / R_m,int - 1 [-], the closing condition of method 3, formulas (98) to (106)."""
    beta1, beta2 = cones.pinion_spiral_angle, cones.gear_spiral_angle
    r_c, r_m2, nu = (
        design.cutter.radius,
        cones.gear_mean_cone_distance,
        design.gear_trace(cones).lead_angle,
    )
    theta = math.atan(math.sin(cones.gear_pitch_angle) * math.tan(cones.axial_offset_angle))
    sin_offset = math.sin(cones.offset_angle)
    a3 = r_c * math.cos(beta2 - nu) ** 2
    a4 = r_m2 * math.cos(beta2 + theta) * math.cos(beta2)
    a5 = sin_offset * math.cos(theta) * math.cos(nu)
    a6 = r_m2 * math.cos(beta2) + r_c * math.sin(nu)
    a7 = math.cos(beta1) * math.cos(beta2 + theta)
    a7 -= math.sin(beta2 + theta - nu) * sin_offset / math.cos(beta2 - nu)
    return cones.pinion_mean_cone_distance * (a5 * a6 + a3 * a7) / (a3 * a4) - 1.0


def _closed(
    cones: Callable[[float], PitchCones],
    misfit: Callable[[PitchCones], float],
    design: HypoidDesign,
) -> PitchCones:
    """Return the cones of zero misfit nearest to those of the pair without offset."""

    def residual(angle: float) -> float:
        try:
            return misfit(cones(angle))
        except ParameterError:
            return math.nan

    ratio = design.pinion_teeth / design.gear_teeth
    start = math.atan2(math.sin(design.shaft_angle), ratio + math.cos(design.shaft_angle))
    below = above = residual(start)
    for step in range(_SEARCH_REACH):
        low, high = start - step * _SEARCH_STEP, start + step * _SEARCH_STEP
        next_below, next_above = residual(low - _SEARCH_STEP), residual(high + _SEARCH_STEP)
        # nan fails both comparisons, so an angle without touching cones never makes a bracket
        for change, left in ((below * next_below, low - _SEARCH_STEP), (above * next_above, high)):
            if change <= 0.0:
                angle = brentq(residual, left, left + _SEARCH_STEP, xtol=1e-14)
                # a pole changes sign too
                if abs(residual(angle)) < _CLOSED:
                    return cones(angle)
        below, above = next_below, next_above
    raise ConvergenceError(
        f"No gear pitch angle within {math.degrees(_SEARCH_REACH * _SEARCH_STEP):g} deg of "
        f"{math.degrees(start):.1f} deg closes the cutter condition. Change the cutter radius, "
        "the offset or the spiral angle."
    )
