"""Macro geometry of a pair of external helical or spur gears."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import ContactPlane
from gearlube_core.helical_geometry.tooth_limits import (
    USUAL_FILLET,
    InvoluteStart,
    RackTool,
    check_clearance,
    check_reach,
    check_tip,
    involute_start,
    largest_fillet,
    profile_shift_sum,
    tip_thickness,
)
from gearlube_core.number import Number, Positive, check_fields

_METRES = "Give metres, not millimetres."
_TEETH = Number("1", 5, 1000)
LARGEST_SHIFT = 2.0  # x of a gear
_ROUNDED_SHIFTS = 2e-3  # normal modules of backlash that shifts of three decimals leave at most
Shifts = tuple[float, float]


_RADII = ("reference", "base", "tip", "root")


class _Member(NamedTuple):
    role: str
    reference: float  # radii [m]
    base: float
    tip: float
    root: float
    shift: float  # [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalPair:
    """External involute gears on parallel axes; helix angle zero makes them spur gears.

    Parameters
    ----------
    name : str
        Name of the pair in results.
    pinion_teeth, gear_teeth : int
        [-]
    normal_module : float
        [m]
    normal_pressure_angle : float
        Of the basic rack [rad].
    helix_angle : float
        At the reference cylinder [rad], 0 to 45 degrees. The hand is that of docs/conventions.md;
        mirror z for the other.
    centre_distance : float
        [m]
    pinion_tip_radius, gear_tip_radius : float
        [m]
    pinion_root_radius, gear_root_radius : float
        [m]; elasticity of the teeth, tip clearance and undercut depend on them.
    face_width : float
        Common to both members [m].
    backlash : float, optional
        Normal backlash along the line of action [m]; left out: what given profile shifts leave,
        which is the least, or none.
    profile_shift : tuple of float or None
        x1, x2 [-]; None for one: what the other leaves of `profile_shift_sum`; for both:
        `guessed_shifts`.
    fillet_factor : float
        Corner radius of the tool, or fillet radius of the basic rack, in normal modules [-].

    Raises
    ------
    ParameterError
        A field out of range, or members that do not mesh.

    Notes
    -----
    Transverse quantities carry the index t, those at the working pitch circles w.
    Source: [he_2007 sec. 3]
    """

    name: str
    pinion_teeth: Annotated[int, _TEETH]
    gear_teeth: Annotated[int, _TEETH]
    normal_module: Annotated[float, Number("m", 1e-4, 0.1, _METRES)]
    normal_pressure_angle: Annotated[
        float, Number("rad", math.radians(10.0), math.radians(35.0), "Give radians.")
    ]
    helix_angle: Annotated[float, Number("rad", 0.0, math.radians(45.0), "Give radians.")]
    centre_distance: float
    pinion_tip_radius: float
    gear_tip_radius: float
    pinion_root_radius: float
    gear_root_radius: float
    face_width: Annotated[float, Positive("m", _METRES)]
    backlash: float = math.nan
    profile_shift: tuple[float | None, float | None] = (None, None)
    fillet_factor: Annotated[float, Number("1", 0.0, 1.0, "0.25 to 0.4 is usual.")] = USUAL_FILLET

    def __post_init__(self) -> None:
        check_fields(self)
        smallest = self.pinion_base_radius + self.gear_base_radius
        check_within(
            "centre_distance", self.centre_distance, 1.0001 * smallest, 1.3 * smallest, "m",
            "It must exceed the sum of the base radii, by about 10 percent.",
        )  # fmt: skip
        for member in ("pinion", "gear"):
            base, tip, root = (getattr(self, f"{member}_{kind}_radius") for kind in _RADII[1:])
            check_within(f"{member}_tip_radius", tip, base, 2.0 * base, "m", _METRES)
            check_within(f"{member}_root_radius", root, 0.3 * base, tip, "m", _METRES)
        self._check_backlash()
        if self.contact_start < 0.0 or self.contact_end > self.tangent_length:
            raise ParameterError(
                "Contact must lie between the tangent points of the base circles, 0 to "
                f"{1e3 * self.tangent_length:.4g} mm, got {1e3 * self.contact_start:.4g} to "
                f"{1e3 * self.contact_end:.4g} mm. Reduce the tip radii: the teeth interfere."
            )
        self.remarks()
        if not self.transverse_contact_ratio + self.overlap_ratio > 1.0:
            undercut = any(start.undercut for start in self.involute_starts)
            raise ParameterError(
                "the total contact ratio must exceed 1, got "
                f"{self.transverse_contact_ratio + self.overlap_ratio:.4g}. Use longer teeth or a "
                f"wider face{', or more teeth, which are undercut' if undercut else ''}."
            )

    def _check_backlash(self) -> None:
        """Complete the backlash; raise ParameterError where it contradicts the profile shifts."""
        if math.isnan(self.backlash):
            object.__setattr__(self, "backlash", max(self.backlash_of_shifts, 0.0))
        check_within("backlash", self.backlash, 0.0, self.normal_module, "m", _METRES)
        for role, x in zip(("pinion", "gear"), self.profile_shifts, strict=True):
            if self.profile_shift != (None, None):
                what = f"profile shift coefficient x of the {role}"
                check_within(what, x, -LARGEST_SHIFT, LARGEST_SHIFT)
        left, rounding = self.backlash_of_shifts, _ROUNDED_SHIFTS * self.normal_module
        if left < -rounding:
            raise ParameterError(
                "The profile shifts must leave a normal backlash of at least 0 mm at the centre "
                f"distance, got {1e3 * left:.4g} mm: the teeth jam. x1 + x2 must be at most "
                f"{self.profile_shift_sum:.4f}, got {sum(self.profile_shifts):.4f}. Increase the "
                "centre distance or reduce a profile shift."
            )
        if self.backlash < left - rounding:
            raise ParameterError(
                f"backlash must be at least the {1e3 * left:.4g} mm that the profile shifts leave "
                f"at the centre distance, got {1e3 * self.backlash:.4g} mm. Leave it out, or "
                "correct a profile shift or the centre distance."
            )

    def remarks(self) -> list[str]:
        """Return warnings about the teeth, one sentence each: roots, tips, undercut.

        Raises
        ------
        ParameterError
            Tips that cut into the mate's root, are pointed or run into the mate's fillet.
        """
        m, members, found = self.normal_module, self._members, list[str]()
        for own, mate in (members, members[::-1]):
            found += check_clearance(
                own.role, self.centre_distance - mate.tip - own.root, m,
                f"Increase the centre distance, or reduce the {mate.role}'s tip diameter or the "
                f"{own.role}'s root diameter.",
            )  # fmt: skip
        reached = (self.tip_start, self.tangent_length - self.tip_end)
        for own, arc, reach in zip(members, self.tooth_thickness, reached, strict=True):
            top = tip_thickness(own.reference, arc, own.tip, self.transverse_pressure_angle)
            lead = math.atan(math.tan(self.helix_angle) * own.tip / own.reference)
            cure = f"Reduce the {own.role}'s tip diameter, profile shift or pressure angle."
            found += check_tip(own.role, top * math.cos(lead), m, cure)
            found += check_reach(own.role, own.base, reach, self._rack(own), m)
        return found

    @property
    def transverse_pressure_angle(self) -> float:
        """Of the rack in the transverse plane [rad]: tan(alpha_t) = tan(alpha_n)/cos(beta)."""
        return math.atan(math.tan(self.normal_pressure_angle) / math.cos(self.helix_angle))

    @property
    def transverse_module(self) -> float:
        """Reference diameter over teeth [m]."""
        return self.normal_module / math.cos(self.helix_angle)

    @property
    def pinion_base_radius(self) -> float:
        """[m]."""
        return self._base_radius(self.pinion_teeth)

    @property
    def gear_base_radius(self) -> float:
        """[m]."""
        return self._base_radius(self.gear_teeth)

    def _base_radius(self, teeth: int) -> float:
        return 0.5 * teeth * self.transverse_module * math.cos(self.transverse_pressure_angle)

    @property
    def pinion_reference_radius(self) -> float:
        """[m]."""
        return 0.5 * self.pinion_teeth * self.transverse_module

    @property
    def gear_reference_radius(self) -> float:
        """[m]."""
        return 0.5 * self.gear_teeth * self.transverse_module

    @property
    def _members(self) -> tuple[_Member, _Member]:
        """Radii of pinion and gear."""
        first, second = (
            _Member._make([role, *(getattr(self, f"{role}_{r}_radius") for r in _RADII), shift])
            for role, shift in zip(("pinion", "gear"), self.profile_shifts, strict=True)
        )
        return first, second

    @property
    def profile_shift_sum(self) -> float:
        """x1 + x2 that meshes without backlash at the centre distance [-]."""
        return profile_shift_sum(
            self.pinion_teeth + self.gear_teeth, self.normal_pressure_angle,
            self.transverse_pressure_angle, self.working_pressure_angle,
        )  # fmt: skip

    @property
    def guessed_shifts(self) -> Shifts:
        """x1, x2 [-]: their sum from the centre distance, their difference from the tips.

        Both addenda are taken as alike, h_a = r_a - r - x m_n, so that
        x1 - x2 = [(r_a1 - r_1) - (r_a2 - r_2)]/m_n.
        """
        addendum_1 = self.pinion_tip_radius - self.pinion_reference_radius
        addendum_2 = self.gear_tip_radius - self.gear_reference_radius
        difference = (addendum_1 - addendum_2) / self.normal_module
        total = self.profile_shift_sum
        return 0.5 * (total + difference), 0.5 * (total - difference)

    @property
    def profile_shifts(self) -> Shifts:
        """x1, x2 [-], as given, completed or guessed."""
        x1, x2 = self.profile_shift
        if x1 is None and x2 is None:
            return self.guessed_shifts
        total = self.profile_shift_sum
        return (
            total - (x2 or 0.0) if x1 is None else x1,
            total - (x1 or 0.0) if x2 is None else x2,
        )

    @property
    def backlash_of_shifts(self) -> float:
        """Normal backlash [m] of teeth as thick as given profile shifts make them; else 0.

        2 m_n sin(alpha_n) (X - x1 - x2), with X = `profile_shift_sum`; [iso_21771].
        """
        if None in self.profile_shift:
            return 0.0
        short = self.profile_shift_sum - sum(self.profile_shifts)
        return 2.0 * self.normal_module * math.sin(self.normal_pressure_angle) * short

    @property
    def tooth_thickness(self) -> Shifts:
        """s_t of pinion and gear: transverse arcs on the reference circles [m]; [iso_21771].

        m_n (pi/2 + 2 x tan(alpha_n))/cos(beta), less half of the backlash beyond
        `backlash_of_shifts` on each member.
        """
        tangent, cos = math.tan(self.normal_pressure_angle), math.cos(self.helix_angle)
        thinner = 0.5 * (self.backlash - self.backlash_of_shifts)
        thinner /= math.cos(self.normal_pressure_angle)
        x1, x2 = (0.5 * math.pi + 2.0 * x * tangent for x in self.profile_shifts)
        return (self.normal_module * x1 - thinner) / cos, (self.normal_module * x2 - thinner) / cos

    def _rack(self, member: _Member) -> RackTool:
        """Return the hob without protuberance that leaves the root circle of a member."""
        depth, m = member.reference - member.root, self.normal_module
        limit = largest_fillet(m, self.normal_pressure_angle, depth + member.shift * m)
        return RackTool(
            radius=member.reference,
            pressure_angle=self.normal_pressure_angle,
            helix_angle=self.helix_angle,
            depth=depth,
            fillet=min(self.fillet_factor * m, limit),
        )

    @property
    def involute_starts(self) -> tuple[InvoluteStart, InvoluteStart]:
        """Where the involutes of pinion and gear begin, cut by a hob without protuberance."""
        first, second = (involute_start(self._rack(member)) for member in self._members)
        return first, second

    @property
    def ratio(self) -> float:
        """Teeth of the gear over teeth of the pinion [-]."""
        return self.gear_teeth / self.pinion_teeth

    @property
    def working_pressure_angle(self) -> float:
        """Transverse, at the working pitch circles [rad]: cos = sum of base radii over C."""
        return math.acos((self.pinion_base_radius + self.gear_base_radius) / self.centre_distance)

    @property
    def base_helix_angle(self) -> float:
        """beta_b [rad]: tan(beta_b) = tan(beta) cos(alpha_t)."""
        return math.atan(math.tan(self.helix_angle) * math.cos(self.transverse_pressure_angle))

    @property
    def base_pitch(self) -> float:
        """Transverse base pitch [m], lambda of He et al. 2007."""
        return 2.0 * math.pi * self.pinion_base_radius / self.pinion_teeth

    @property
    def tangent_length(self) -> float:
        """Distance of the base circles' tangent points along the line of action [m]."""
        return self.centre_distance * math.sin(self.working_pressure_angle)

    @property
    def tip_start(self) -> float:
        """Where the gear's tip enters the line of action [m]; [jamali_2015 (2.3)]."""
        return self.tangent_length - math.sqrt(self.gear_tip_radius**2 - self.gear_base_radius**2)

    @property
    def tip_end(self) -> float:
        """Where the pinion's tip leaves the line of action [m]; [jamali_2015 (2.2)]."""
        return math.sqrt(self.pinion_tip_radius**2 - self.pinion_base_radius**2)

    @property
    def contact_start(self) -> float:
        """Where contact begins: x of A [m], at the gear's tip or above the pinion's undercut."""
        start = self.involute_starts[0]
        return max(self.tip_start, start.roll) if start.undercut else self.tip_start

    @property
    def contact_end(self) -> float:
        """Where contact ends: x of D [m], at the pinion's tip or above the gear's undercut."""
        start = self.involute_starts[1]
        return (
            min(self.tip_end, self.tangent_length - start.roll) if start.undercut else self.tip_end
        )

    @property
    def pitch_point(self) -> float:
        """Where sliding reverses: x of P [m], also the pinion's transverse radius there."""
        return self.pinion_base_radius * math.tan(self.working_pressure_angle)

    @property
    def transverse_contact_ratio(self) -> float:
        """epsilon_alpha [-]."""
        return (self.contact_end - self.contact_start) / self.base_pitch

    @property
    def overlap_ratio(self) -> float:
        """epsilon_beta [-]."""
        return self.face_width * math.tan(self.base_helix_angle) / self.base_pitch

    @property
    def total_contact_ratio(self) -> float:
        """epsilon_gamma [-]."""
        return self.transverse_contact_ratio + self.overlap_ratio

    @property
    def mean_contact_length(self) -> float:
        """Mean total length of the contact lines over a mesh period [m]: eps_alpha W/cos(b)."""
        return self.transverse_contact_ratio * self.face_width / math.cos(self.base_helix_angle)

    @property
    def plane(self) -> ContactPlane:
        """Plane of contact for the contact-line kernels."""
        b = self.base_helix_angle
        return ContactPlane(
            A=self.contact_start,
            D=self.contact_end,
            P=self.pitch_point,
            W=self.face_width,
            x_g=self.tangent_length,
            pitch=self.base_pitch,
            sin_b=math.sin(b),
            cos_b=math.cos(b),
            r_bp=self.pinion_base_radius,
            r_bg=self.gear_base_radius,
        )

    def mesh_frequency(self, pinion_speed: float) -> float:
        """Return the mesh frequency [Hz] at a pinion speed [rad/s]."""
        return self.pinion_teeth * pinion_speed / (2.0 * math.pi)
