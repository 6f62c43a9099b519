"""Lengthwise tooth trace of a face-hobbed or face-milled gear in its pitch plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError

_METRES = "Give metres, not millimetres."


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
