"""Two pitch cones that touch at one mean point with tooth directions that match."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scipy.optimize import brentq

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.blank.hypoid_blank import TEETH

_METRES = "Give metres, not millimetres."
_RADIANS = "Give radians."


@dataclass(frozen=True, slots=True, kw_only=True)
class CutterHead:
    """Cutter head with blade groups on one circle.

    Parameters
    ----------
    radius : float
        Cutter radius r_c0 [m].
    blade_groups : int
        Number of blade groups z_0 [-]; 0 is face milling: the gear stands still in the cut.
    """

    radius: float
    blade_groups: int

    def __post_init__(self) -> None:
        check_within("radius", self.radius, 1e-3, 2.0, "m", _METRES)
        check_within("blade_groups", self.blade_groups, 0, 50, cure="Face milling has 0.")

    def lead_angle(self, normal_module: float) -> float:
        """Return the lead angle nu [rad]: sin nu = z_0 m_mn / (2 r_c0).

        Parameters
        ----------
        normal_module : float
            Mean normal module m_mn [m].

        References
        ----------
        [iso_23509 (176)].
        """
        sine = self.blade_groups * normal_module / (2.0 * self.radius)
        check_within(
            "blade_groups normal_module / (2 radius)", sine, 0.0, 0.99, cure="Enlarge the cutter."
        )
        return math.asin(sine)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothTrace:
    """Extended epicycloid (face hobbing) or circle (face milling) through the mean point.

    The gear rolls in its pitch plane as a crown gear of z_2 / sin(delta_2) teeth; the cutter rolls
    outside it and its blade passes the mean point at the spiral angle asked for.

    Parameters
    ----------
    cutter : CutterHead
    crown_teeth : float
        Teeth of the crown gear z_2 / sin(delta_2) [-].
    mean_cone_distance : float
        Cone distance of the mean point R_m2 [m].
    mean_spiral_angle : float
        Spiral angle there [rad].

    References
    ----------
    [iso_23509 6.2.2] [iso_23509 7.6].
    """

    cutter: CutterHead
    crown_teeth: float
    mean_cone_distance: float
    mean_spiral_angle: float

    def __post_init__(self) -> None:
        check_within("crown_teeth", self.crown_teeth, 3.0, 1e4)
        check_within("mean_cone_distance", self.mean_cone_distance, 1e-4, 5.0, "m", _METRES)
        check_within("mean_spiral_angle", self.mean_spiral_angle, -1.4, 1.4, "rad", "Give radians.")

    @property
    def normal_module(self) -> float:
        """Mean normal module m_mn [m]."""
        return 2.0 * self.mean_cone_distance * math.cos(self.mean_spiral_angle) / self.crown_teeth

    @property
    def lead_angle(self) -> float:
        """Lead angle of the cutter nu [rad], [iso_23509 (35)]."""
        return self.cutter.lead_angle(self.normal_module)

    @property
    def centre_angle(self) -> float:
        """Angle at the mean point from cutter centre to gear apex [rad], [iso_23509 (36)]."""
        return 0.5 * math.pi - self.mean_spiral_angle + self.lead_angle

    @property
    def centre_distance(self) -> float:
        """Distance of the gear apex from the cutter centre rho_P0 [m].

        [iso_23509 (37)] [iso_23509 (177)]
        """
        r, big_r = self.cutter.radius, self.mean_cone_distance
        return math.sqrt(big_r**2 + r**2 - 2.0 * big_r * r * math.cos(self.centre_angle))

    @property
    def base_radius(self) -> float:
        """Radius of the fixed circle of the epicycloid rho_b [m], [iso_23509 (178)]."""
        return self.centre_distance / (1.0 + self.cutter.blade_groups / self.crown_teeth)

    @property
    def curvature_radius(self) -> float:
        """Radius of curvature at the mean point rho_mbeta [m]: [iso_23509 (38)], (39)."""
        along = self.mean_cone_distance * math.cos(self.mean_spiral_angle)
        cosine = along / self.base_radius
        # the normal of the trace must pass the fixed circle, or the blade never swings through
        check_within("R_m2 cos(beta_m2) / rho_b", cosine, -1.0, 1.0, cure="Enlarge the cutter.")
        tan_eta = math.tan(math.acos(cosine))
        tan_spiral, tan_lead = math.tan(self.mean_spiral_angle), math.tan(self.lead_angle)
        return along * (tan_spiral + tan_eta / (1.0 + tan_lead * (tan_spiral + tan_eta)))

    def spiral_angle(self, cone_distance: float) -> float:
        """Return the spiral angle of the trace at another cone distance [rad].

        Parameters
        ----------
        cone_distance : float
            Within the reach of the cutter, |rho_P0 - r_c0| to rho_P0 + r_c0 [m].

        Raises
        ------
        ParameterError
            Where the trace does not reach.

        References
        ----------
        [iso_23509 (189)] to (192).
        """
        p, r = self.centre_distance, self.cutter.radius
        if not abs(p - r) < cone_distance < p + r:
            raise ParameterError(
                f"cone_distance must be within {abs(p - r):g} to {p + r:g} m, the reach of the "
                f"cutter, got {cone_distance:g} m. Take a point of the face width."
            )
        cosine = (cone_distance**2 + p**2 - r**2) / (2.0 * cone_distance * p)
        sine = math.sqrt(1.0 - cosine**2)
        return math.atan((cone_distance - self.base_radius * cosine) / (self.base_radius * sine))


@dataclass(frozen=True, slots=True, kw_only=True)
class PitchCones:
    """Pitch cones of a bevel or hypoid pair at the mean point.

    Parameters
    ----------
    pinion_teeth, gear_teeth : int
        Teeth z_1, z_2 [-].
    offset, shaft_angle : float
        Offset a [m] and shaft angle Sigma [rad].
    pinion_pitch_angle, gear_pitch_angle : float
        delta_1, delta_2 [rad].
    pinion_mean_cone_distance, gear_mean_cone_distance : float
        R_m1, R_m2 [m].
    pinion_spiral_angle, gear_spiral_angle : float
        beta_m1, beta_m2 [rad]; a positive offset makes the pinion's the larger one.

    Notes
    -----
    The constructor takes any numbers, printed ones too; `touching` finds cones that do touch.

    References
    ----------
    [iso_23509 6] [iso_23509 7.2].
    """

    pinion_teeth: int
    gear_teeth: int
    offset: float
    shaft_angle: float
    pinion_pitch_angle: float
    gear_pitch_angle: float
    pinion_mean_cone_distance: float
    gear_mean_cone_distance: float
    pinion_spiral_angle: float
    gear_spiral_angle: float

    def __post_init__(self) -> None:
        for name in ("pinion_teeth", "gear_teeth"):
            check_within(name, getattr(self, name), TEETH.low, TEETH.high)
        check_within("offset", self.offset, 0.0, 1.0, "m", _METRES)
        check_within("shaft_angle", self.shaft_angle, 0.2, 2.9, "rad", _RADIANS)
        for name in ("pinion_pitch_angle", "gear_pitch_angle"):
            check_within(name, getattr(self, name), 0.01, 1.56, "rad", _RADIANS)
        for name in ("pinion_mean_cone_distance", "gear_mean_cone_distance"):
            check_within(name, getattr(self, name), 1e-4, 5.0, "m", _METRES)
        for name in ("pinion_spiral_angle", "gear_spiral_angle"):
            check_within(name, getattr(self, name), -1.4, 1.4, "rad", _RADIANS)

    @classmethod
    def touching(
        cls,
        *,
        pinion_teeth: int,
        gear_teeth: int,
        offset: float,
        shaft_angle: float,
        gear_pitch_angle: float,
        gear_pitch_radius: float,
        gear_spiral_angle: float | None = None,
        pinion_spiral_angle: float | None = None,
    ) -> PitchCones:
        """Return the pair that touches the given gear cone, with one spiral angle given.

        One free number is left in a pair of touching cones, here the gear's pitch angle; the
        methods of ISO 23509 differ in what they choose it by.

        Parameters
        ----------
        pinion_teeth, gear_teeth : int
        offset, shaft_angle : float
            [m], [rad].
        gear_pitch_angle, gear_pitch_radius : float
            Of the gear at the mean point [rad], [m].
        gear_spiral_angle, pinion_spiral_angle : float, optional
            Exactly one of them [rad].

        Raises
        ------
        ParameterError
            For none or two spiral angles, or when no pinion cone touches.

        References
        ----------
        [iso_23509 (90)] [iso_23509 (91)] [iso_23509 (93)] [iso_23509 (94)] [iso_23509 (95)]
        [iso_23509 (113)], solved together.
        """
        if (gear_spiral_angle is None) == (pinion_spiral_angle is None):
            raise ParameterError(
                "Give exactly one of gear_spiral_angle and pinion_spiral_angle, got "
                f"{gear_spiral_angle} and {pinion_spiral_angle}. The offset fixes the other."
            )
        gear_spiral = 0.0 if gear_spiral_angle is None else gear_spiral_angle
        check_within("gear_pitch_angle", gear_pitch_angle, 0.01, 1.56, "rad", _RADIANS)
        check_within("gear_pitch_radius", gear_pitch_radius, 1e-4, 5.0, "m", _METRES)
        check_within("offset", offset, 0.0, gear_pitch_radius, "m", "Reduce offset.")
        sin2, cos2 = math.sin(gear_pitch_angle), math.cos(gear_pitch_angle)
        sin_s, cos_s = math.sin(shaft_angle), math.cos(shaft_angle)

        def state(zeta: float) -> tuple[float, float, float]:
            delta1 = math.asin(math.cos(zeta) * sin_s * cos2 - cos_s * sin2)
            # 1 is reached by rounding where the pinion's generator turns across the gear's
            zeta_p = math.asin(min(1.0, math.sin(zeta) * sin_s / math.cos(delta1)))
            if pinion_spiral_angle is not None:
                return delta1, pinion_spiral_angle, pinion_spiral_angle - zeta_p
            return delta1, gear_spiral + zeta_p, gear_spiral

        def misfit(zeta: float) -> float:
            delta1, beta1, beta2 = state(zeta)
            pinion = math.cos(beta2) * pinion_teeth / gear_teeth * cos2 / math.cos(delta1)
            reach = math.sin(zeta) * (math.cos(beta1) + pinion)
            return reach - offset / gear_pitch_radius * math.cos(beta1)

        zeta = brentq(misfit, 0.0, math.asin(offset / gear_pitch_radius), xtol=1e-15)
        delta1, beta1, beta2 = state(zeta)
        radius1 = gear_pitch_radius * pinion_teeth / gear_teeth * math.cos(beta2) / math.cos(beta1)
        check_within("pinion_pitch_angle", delta1, 0.01, 1.56, "rad", "Change gear_pitch_angle.")
        return cls(
            pinion_teeth=pinion_teeth,
            gear_teeth=gear_teeth,
            offset=offset,
            shaft_angle=shaft_angle,
            pinion_pitch_angle=delta1,
            gear_pitch_angle=gear_pitch_angle,
            pinion_mean_cone_distance=radius1 / math.sin(delta1),
            gear_mean_cone_distance=gear_pitch_radius / sin2,
            pinion_spiral_angle=beta1,
            gear_spiral_angle=beta2,
        )

    @property
    def pinion_pitch_radius(self) -> float:
        """Mean pitch radius of the pinion [m]."""
        return self.pinion_mean_cone_distance * math.sin(self.pinion_pitch_angle)

    @property
    def gear_pitch_radius(self) -> float:
        """Mean pitch radius of the gear [m]."""
        return self.gear_mean_cone_distance * math.sin(self.gear_pitch_angle)

    @property
    def normal_module(self) -> float:
        """Mean normal module m_mn [m], [iso_23509 (116)]."""
        return 2.0 * self.gear_pitch_radius * math.cos(self.gear_spiral_angle) / self.gear_teeth

    @property
    def crown_teeth(self) -> float:
        """Teeth of the gear's crown gear z_2 / sin(delta_2) [-], [iso_23509 (34)]."""
        return self.gear_teeth / math.sin(self.gear_pitch_angle)

    @property
    def _reach(self) -> float:
        """Gear pitch radius and the pinion's seen along its cone normal [m]."""
        cosines = math.cos(self.gear_pitch_angle) / math.cos(self.pinion_pitch_angle)
        return self.gear_pitch_radius + self.pinion_pitch_radius * cosines

    @property
    def axial_offset_angle(self) -> float:
        """Offset angle in the pinion's axial plane zeta_m [rad], [iso_23509 (113)]."""
        sine = check_within("offset / reach", self.offset / self._reach, 0.0, 1.0)
        return math.asin(sine)

    @property
    def offset_angle(self) -> float:
        """Offset angle in the pitch plane zeta_mp [rad], [iso_23509 (114)]."""
        sine = math.sin(self.axial_offset_angle) * math.sin(self.shaft_angle)
        return math.asin(sine / math.cos(self.pinion_pitch_angle))

    @property
    def _gear_axial_distance(self) -> float:
        departure = math.tan(self.shaft_angle - 0.5 * math.pi)
        along = self.pinion_pitch_radius * math.sin(self.gear_pitch_angle)
        tilted = math.cos(self.axial_offset_angle) * departure * self._reach
        return along / math.cos(self.pinion_pitch_angle) - tilted

    @property
    def gear_apex(self) -> float:
        """Gear pitch apex beyond the crossing point t_z2 [m]: [iso_23509 (129)], (131)."""
        along = self.gear_mean_cone_distance * math.cos(self.gear_pitch_angle)
        return along - self._gear_axial_distance

    @property
    def pinion_apex(self) -> float:
        """Pinion pitch apex beyond the crossing point t_z1 [m]: [iso_23509 (130)], (131)."""
        departure = self.shaft_angle - 0.5 * math.pi
        across = self.gear_pitch_radius * math.cos(self.axial_offset_angle) * math.cos(departure)
        along = self.pinion_mean_cone_distance * math.cos(self.pinion_pitch_angle)
        return along - across + self._gear_axial_distance * math.sin(departure)

    @property
    def limit_pressure_angle(self) -> float:
        """Limit pressure angle alpha_lim [rad], [iso_23509 (32)] [iso_23509 (117)].

        At this inclination of the flank the lines of contact gather at the mean point; the
        effective angles of both flanks count from it.
        """
        r1, r2 = self.pinion_mean_cone_distance, self.gear_mean_cone_distance
        tan1, tan2 = math.tan(self.pinion_pitch_angle), math.tan(self.gear_pitch_angle)
        arms = r1 * math.sin(self.pinion_spiral_angle) - r2 * math.sin(self.gear_spiral_angle)
        across = math.cos(self.offset_angle) * (r1 * tan1 + r2 * tan2)
        return -math.atan(tan1 * tan2 * arms / across)

    @property
    def limit_curvature(self) -> float:
        """Lengthwise curvature of the limit flank 1 / rho_lim [1/m], [iso_23509 (33)].

        It is the curvature of the flank's normal section; the curvature of the trace in the pitch
        plane is 1 / cos(alpha_lim) times as much. The standard compares the two as they are.
        """
        r1, r2 = self.pinion_mean_cone_distance, self.gear_mean_cone_distance
        beta1, beta2 = self.pinion_spiral_angle, self.gear_spiral_angle
        difference = math.tan(beta1) - math.tan(beta2)
        if difference <= 0.0:
            raise ParameterError(
                "The limit curvature needs a pinion spiral angle above the gear's, got "
                f"{beta1:g} and {beta2:g} rad. Give an offset above 0."
            )
        alpha = self.limit_pressure_angle
        cones = math.tan(beta1) / (r1 * math.tan(self.pinion_pitch_angle)) + math.tan(beta2) / (
            r2 * math.tan(self.gear_pitch_angle)
        )
        traces = 1.0 / (r1 * math.cos(beta1)) - 1.0 / (r2 * math.cos(beta2))
        return math.cos(alpha) * (traces - math.tan(alpha) * cones) / difference
