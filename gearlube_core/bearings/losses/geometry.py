"""Geometry of a tapered roller bearing for its losses, checked before anything is computed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from gearlube_core.bearings.losses.catalogue import (
    F0_TAPERED_OIL_BATH,
    F1_TAPERED,
    SERIES_NAMES,
)
from gearlube_core.bearings.losses.physical_loss import LossParameters
from gearlube_core.bearings.losses.rib import (
    RIB_BOUNDARY_FRICTION,
    RIB_END_RADIUS,
    RIB_ROUGHNESS,
    RIB_SHARE_B,
    RIB_SHARE_C,
    RibParameters,
)
from gearlube_core.bearings.roller_contact import N_LINE
from gearlube_core.bearings.roller_stiffness import palmgren_roller_stiffness
from gearlube_core.bearings.tapered_roller_bearing import (
    DIAMETER,
    LOAD_FACTOR,
    RIB_FRICTION,
    ROLLER,
    ROLLERS,
    ROUGHNESS,
    VISCOUS_FACTOR,
    TaperedRollerBearing,
)
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.checks import check_option
from gearlube_core.contact.solid import (
    STEEL_MOHAMMADPOUR_2015,
    Solid,
    reduced_modulus,
    solid_parameters,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film.point_film import film_geometry
from gearlube_core.number import Checked, Number, Positive, check_fields

APEX_TOLERANCE = 0.05  # of the roller radius: angles and diameters are printed to about 1 %
_DEG = math.pi / 180.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Rib(Checked):
    """The rib of the inner ring that guides the large ends of the rollers.

    Parameters
    ----------
    contact_height
        e, of the contact above the race of the inner ring, square to it [m].
    end_radius
        Of the sphere of the roller end over its distance from the apex, 0.5 to 0.99 [-].
    roughness
        Composite rms of rib and roller end [m].
    share_b, share_c
        B and C of the asperity share exp(-B Lambda^C) [-].
    boundary_friction
        Of the asperities [-].
    """

    contact_height: Annotated[float, Positive("m", "2.5 mm is 0.0025 m.")]
    end_radius: Annotated[float, Number("1", 0.5, 0.99)] = RIB_END_RADIUS
    roughness: Annotated[float, ROUGHNESS] = RIB_ROUGHNESS
    share_b: Annotated[float, Number("1", 0.1, 10.0)] = RIB_SHARE_B
    share_c: Annotated[float, Number("1", 0.1, 3.0)] = RIB_SHARE_C
    boundary_friction: Annotated[float, RIB_FRICTION] = RIB_BOUNDARY_FRICTION


@dataclass(frozen=True, kw_only=True)
class BearingGeometry:
    """Geometry of a tapered roller bearing, for `bearing_loss`; rows share the load equally.

    Parameters
    ----------
    bore_diameter, outside_diameter : float
        Boundary dimensions d, D [m].
    pitch_diameter : float
        Diameter of the circle through the middles of the rollers [m].
    roller_diameter, roller_length : float
        Diameter at mid-length; effective length [m].
    n_rollers : int
        Number of rollers in one row, 3 to 40.
    outer_angle, inner_angle : float
        Half the cone angles of the races of outer and inner ring [rad].
    rib : Rib
    rows : int
        Number of rows, 1 to 4, each with the same share of the load.
    series : str
        Series in the catalogue: 302, 303, 313, 320X, 322 or other.
    roughness : float
        Composite rms roughness of roller and race [m].
    f0, f1 : float
        Viscous and load factor of `drag_torque` [-].
    rolling_scale : float, optional
        Measured rolling torque divided by the computed one; None: not calibrated [-].
    solid : Solid
        Material of rollers and races.

    Raises
    ------
    ParameterError
        The rollers overlap, rollers and races have no common apex, or the rings do not hold the
        rollers.

    Examples
    --------
    >>> outer = math.radians(15.64)
    >>> bearing = BearingGeometry(
    ...     bore_diameter=0.08, outside_diameter=0.14, pitch_diameter=0.1085, n_rollers=16,
    ...     roller_diameter=0.017, roller_length=0.0227, rib=Rib(contact_height=0.0025),
    ...     outer_angle=outer, inner_angle=closing_inner_angle(0.1085, 0.017, outer),
    ... )
    >>> round(math.degrees(bearing.inner_angle), 2)
    11.44
    """

    bore_diameter: Annotated[float, DIAMETER]
    outside_diameter: Annotated[float, DIAMETER]
    pitch_diameter: Annotated[float, DIAMETER]
    roller_diameter: Annotated[float, ROLLER]
    roller_length: Annotated[float, ROLLER]
    n_rollers: Annotated[int, ROLLERS]
    outer_angle: Annotated[
        float, Number("rad", math.radians(5.0), math.radians(45.0), "15 deg is 0.2618 rad.")
    ]
    inner_angle: float
    rib: Rib
    rows: Annotated[int, Number("1", 1, 4)] = 1
    series: str = "other"
    roughness: Annotated[float, ROUGHNESS] = 0.16e-6
    f0: Annotated[float, VISCOUS_FACTOR] = F0_TAPERED_OIL_BATH
    f1: Annotated[float, LOAD_FACTOR] = F1_TAPERED
    rolling_scale: Annotated[float | None, Number("1", 0.05, 5.0)] = None
    solid: Solid = STEEL_MOHAMMADPOUR_2015

    def __post_init__(self) -> None:
        check_fields(self)
        check_option("series", self.series, SERIES_NAMES)
        self._check_rollers()
        self._check_apex()

    def _check_rollers(self) -> None:
        mm = 1e3
        room = self.pitch_diameter * math.sin(math.pi / self.n_rollers)
        if self.roller_diameter > room:
            most = math.floor(
                math.pi / math.asin(min(1.0, self.roller_diameter / self.pitch_diameter))
            )
            raise ParameterError(
                f"The rollers overlap: {self.n_rollers} rollers on a pitch diameter of "
                f"{mm * self.pitch_diameter:.4g} mm leave room for {mm * room:.4g} mm for each, "
                f"got rollers of {mm * self.roller_diameter:.4g} mm; at most {most} fit."
            )
        across = self.roller_diameter * math.cos(self.outer_angle)
        if not (
            self.bore_diameter < self.pitch_diameter - across
            and self.pitch_diameter + across < self.outside_diameter
        ):
            raise ParameterError(
                f"The rollers must lie between bore and outside diameter, got races of about "
                f"{mm * (self.pitch_diameter - across):.4g} and "
                f"{mm * (self.pitch_diameter + across):.4g} mm between "
                f"{mm * self.bore_diameter:.4g} and {mm * self.outside_diameter:.4g} mm. Check "
                "pitch_diameter and roller_diameter."
            )
        if self.rib.contact_height > self.roller_diameter:
            raise ParameterError(
                f"contact_height must be below the roller diameter, "
                f"{mm * self.roller_diameter:.4g} mm, got {mm * self.rib.contact_height:.4g} mm."
            )

    def _check_apex(self) -> None:
        outer, inner = self.outer_angle / _DEG, self.inner_angle / _DEG
        closing = closing_inner_angle(self.pitch_diameter, self.roller_diameter, self.outer_angle)
        cure = (
            f"With this outer angle and these diameters the inner race has {closing / _DEG:.2f} "
            "deg; leave the inner angle out to take it."
        )
        if not 0.0 < self.inner_angle < self.outer_angle:
            raise ParameterError(
                f"The angle of the inner race must lie between 0 and that of the outer race, "
                f"{outer:.4g} deg, got {inner:.4g} deg: the rollers would taper towards the wrong "
                f"side. {cure}"
            )
        found = 0.5 * self.pitch_diameter / math.sin(self.mean_angle) * math.tan(self.half_cone)
        radius = 0.5 * self.roller_diameter
        if abs(found - radius) > APEX_TOLERANCE * radius:
            raise ParameterError(
                f"Rollers and races must share their apex within {100 * APEX_TOLERANCE:g} % of the "
                f"roller radius, {1e3 * radius:.4g} mm, got {1e3 * found:.4g} mm from the angles "
                f"{outer:.4g} and {inner:.4g} deg. {cure}"
            )

    @property
    def mean_angle(self) -> float:
        """Angle between the axes of roller and bearing [rad]."""
        return 0.5 * (self.outer_angle + self.inner_angle)

    @property
    def half_cone(self) -> float:
        """Half the cone angle of the rollers [rad]."""
        return 0.5 * (self.outer_angle - self.inner_angle)

    @property
    def race_radii(self) -> tuple[float, float]:
        """Distance of the inner and the outer contact from the axis of the bearing [m]."""
        across = 0.5 * self.roller_diameter * math.cos(self.mean_angle)
        return 0.5 * self.pitch_diameter - across, 0.5 * self.pitch_diameter + across

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed, the outer ring at rest [-]."""
        return self.race_radii[0] / self.pitch_diameter

    @property
    def mean_ratio(self) -> float:
        """Mean surface speed of both raceway contacts over shaft speed, R_i R_o/(R_i + R_o) [m]."""
        inner, outer = self.race_radii
        return inner * outer / (inner + outer)

    def dry_rollers(self) -> TaperedRollerParameters:
        """Return the rollers for `ring_loads`: no film, no preload, no loss."""
        inner, outer = self.race_radii
        return TaperedRollerBearing(
            bore_diameter=self.bore_diameter,
            outside_diameter=self.outside_diameter,
            inner_race_diameter=2.0 * inner,
            # the transverse gap is D cos g; the axle's model wants room for a whole roller
            outer_race_diameter=max(2.0 * outer, 2.0 * inner + self.roller_diameter),
            roller_diameter=self.roller_diameter,
            roller_length=self.roller_length,
            n_rollers=self.n_rollers,
            stiffness_constant=palmgren_roller_stiffness(self.roller_length),
            exponent=N_LINE,
            contact_angle=self.outer_angle,
            loss=0.0,
            approach="full",
            film="off",
            solid=self.solid,
            series=self.series,
            f0=self.f0,
            f1=self.f1,
        ).parameters()

    def parameters(self) -> LossParameters:
        """Return the floats for `physical_loss`, of one row."""
        ratio = self.roller_diameter * math.cos(self.mean_angle) / self.pitch_diameter
        radius = 0.5 * self.roller_diameter
        return LossParameters(
            n_rollers=float(self.n_rollers),
            length=float(self.roller_length),
            diameter=float(self.roller_diameter),
            pitch=float(self.pitch_diameter),
            cage_ratio=self.cage_ratio,
            mean_ratio=self.mean_ratio,
            R_inner=radius * (1.0 - ratio),
            R_outer=radius * (1.0 + ratio),
            inner_share=math.cos(2.0 * self.half_cone),
            rib_share=math.sin(2.0 * self.half_cone),
            reduced_modulus=reduced_modulus(self.solid, self.solid),
            roughness=float(self.roughness),
            rolling_scale=1.0 if self.rolling_scale is None else float(self.rolling_scale),
            rib=self._rib_parameters(),
            solid=solid_parameters(self.solid, self.solid),
        )

    def _rib_parameters(self) -> RibParameters:
        # Roller against inner ring: a turn about the line of contact with the race of the inner
        # ring, (1 - cage ratio) w sin(g)/sin(b). The rib slides with e times that.
        relative = 1.0 - self.cage_ratio
        height = self.rib.contact_height
        sliding = height * relative * math.sin(self.mean_angle) / math.sin(self.half_cone)
        large_end = self.race_radii[0] + 0.5 * self.roller_length * math.sin(self.inner_angle)
        radius = large_end + height * math.cos(self.inner_angle)
        surface = relative * radius  # of the rib, seen from the cage
        # A rib square to the race is a hollow cone whose normals meet in the apex.
        distance = radius / math.sin(self.inner_angle)
        sphere = self.rib.end_radius * distance
        along = 1.0 / (1.0 / sphere - 1.0 / distance)
        R_e, side_flow = film_geometry(sphere, along, 0.5 * math.pi)
        return RibParameters(
            sliding_ratio=sliding,
            mean_ratio=surface - 0.5 * sliding,
            R_meridian=sphere,
            R_sliding=along,
            R_e=R_e,
            side_flow=side_flow,
            roughness=float(self.rib.roughness),
            share_b=float(self.rib.share_b),
            share_c=float(self.rib.share_c),
            boundary_friction=float(self.rib.boundary_friction),
            reduced_modulus=reduced_modulus(self.solid, self.solid),
        )


def closing_inner_angle(pitch_diameter: float, roller_diameter: float, outer_angle: float) -> float:
    """Return the angle of the inner race with which rollers and races share one apex [rad].

    tan(b) = (D/d_m) sin(a_o - b),  a_i = a_o - 2 b

    Parameters
    ----------
    pitch_diameter, roller_diameter
        d_m, D [m].
    outer_angle
        a_o [rad].
    """
    from scipy.optimize import brentq  # not needed to read a file

    ratio = roller_diameter / pitch_diameter
    half = brentq(
        lambda b: math.tan(b) - ratio * math.sin(outer_angle - b), 0.0, outer_angle, xtol=1e-14
    )
    return outer_angle - 2.0 * float(half)
