"""Macro geometry of a pair of external helical or spur gears."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import ContactPlane

_METRES = "Give metres, not millimetres."
_LARGEST_HELIX = math.radians(45.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalPair:
    """External involute gears on parallel axes; helix angle zero makes them spur gears.

    Parameters
    ----------
    name : str
        Label of results.
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
        [m]; only the teeth's elasticity depends on them.
    face_width : float
        Common to both members [m].
    backlash : float
        Normal backlash along the line of action [m].

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
    pinion_teeth: int
    gear_teeth: int
    normal_module: float
    normal_pressure_angle: float
    helix_angle: float
    centre_distance: float
    pinion_tip_radius: float
    gear_tip_radius: float
    pinion_root_radius: float
    gear_root_radius: float
    face_width: float
    backlash: float = 0.0

    def __post_init__(self) -> None:
        for name in ("pinion_teeth", "gear_teeth"):
            check_within(name, getattr(self, name), 5, 1000)
        check_within("normal_module", self.normal_module, 1e-4, 0.1, "m", _METRES)
        low, high = math.radians(10.0), math.radians(35.0)
        check_within(
            "normal_pressure_angle", self.normal_pressure_angle, low, high, "rad", "Give radians."
        )
        check_within("helix_angle", self.helix_angle, 0.0, _LARGEST_HELIX, "rad", "Give radians.")
        check_positive("face_width", self.face_width, "m", _METRES)
        check_within("backlash", self.backlash, 0.0, self.normal_module, "m", _METRES)
        smallest = self.pinion_base_radius + self.gear_base_radius
        check_within(
            "centre_distance", self.centre_distance, 1.0001 * smallest, 1.3 * smallest, "m",
            "It must exceed the sum of the base radii, by about 10 percent.",
        )  # fmt: skip
        for member in ("pinion", "gear"):
            tip, root = (
                getattr(self, f"{member}_tip_radius"),
                getattr(self, f"{member}_root_radius"),
            )
            base = getattr(self, f"{member}_base_radius")
            check_within(f"{member}_tip_radius", tip, base, 2.0 * base, "m", _METRES)
            check_within(f"{member}_root_radius", root, 0.3 * base, tip, "m", _METRES)
        if self.contact_start < 0.0 or self.contact_end > self.tangent_length:
            raise ParameterError(
                "Contact must lie between the tangent points of the base circles, 0 to "
                f"{1e3 * self.tangent_length:.4g} mm, got {1e3 * self.contact_start:.4g} to "
                f"{1e3 * self.contact_end:.4g} mm. Reduce the tip radii: the teeth interfere."
            )
        if not self.transverse_contact_ratio + self.overlap_ratio > 1.0:
            raise ParameterError(
                "the total contact ratio must exceed 1, got "
                f"{self.transverse_contact_ratio + self.overlap_ratio:.4g}. "
                "Use longer teeth or a wider face."
            )

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
    def contact_start(self) -> float:
        """Where the gear's tip enters the line of action: x of A [m]; [jamali_2015 (2.3)]."""
        return self.tangent_length - math.sqrt(self.gear_tip_radius**2 - self.gear_base_radius**2)

    @property
    def contact_end(self) -> float:
        """Where the pinion's tip leaves the line of action: x of D [m]; [jamali_2015 (2.2)]."""
        return math.sqrt(self.pinion_tip_radius**2 - self.pinion_base_radius**2)

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
