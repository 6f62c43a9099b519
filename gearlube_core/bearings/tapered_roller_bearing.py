"""A tapered roller bearing: geometry, stiffness and preload."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, Literal

from gearlube_core.bearings.bearing_type import Bearing
from gearlube_core.bearings.losses.catalogue import (
    F0_TAPERED_OIL_BATH,
    F1_TAPERED,
    OTHER_SERIES,
    SERIES,
    SERIES_NAMES,
)
from gearlube_core.bearings.losses.rib import RIB_BOUNDARY_FRICTION, RIB_HEIGHT, RIB_ROUGHNESS
from gearlube_core.bearings.parameters import FILM_FLOOR_APPROACH, ROLLERS_MAX
from gearlube_core.bearings.roller_contact import N_LINE, contact_angle_terms, preload_approach
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.solid import (
    STEEL_MOHAMMADPOUR_2015,
    Solid,
    pi_contact_modulus,
    reduced_modulus,
)
from gearlube_core.errors import ParameterError
from gearlube_core.film.mostofi_gohar_1983 import (
    COEFFICIENT,
    LOAD_EXPONENT,
    MATERIAL_EXPONENT,
    SPEED_EXPONENT,
    SQUEEZE_SHARE,
)
from gearlube_core.number import Number

Approach = Literal["full", "as_printed"]
Film = Literal["squeeze", "steady", "off"]

HYSTERETIC_LOSS = 0.009  # 1, [mohammadpour_2015 (25)], after [dietl_2000]
CONTACT_ANGLE_COMPLETED = math.radians(15.0)  # not in the paper; common for axle bearings
LARGEST_FIT = 100e-6  # m
_LINES = "For lines n = 10/9 and kn is in N/m^(10/9)."
DIAMETER = Number("m", 5e-3, 2.0, "83.7 mm is 0.0837 m.")  # of a ring, or of a race
ROLLER = Number("m", 2e-3, 0.5, "12.7 mm is 0.0127 m.")
ROLLERS = Number("1", 3, ROLLERS_MAX)
VISCOUS_FACTOR, LOAD_FACTOR = (
    Number("1", 0.0, 100.0, fmi="f0"), Number("1", 0.0, 0.1, fmi="f1"),
)  # fmt: skip
RIB_FRICTION = Number("1", 0.0, 0.5)
ROUGHNESS = Number("m", 1e-9, 1e-5, "0.24 um is 2.4e-7 m.")  # of two surfaces, rms
PRELOAD = Number(
    "N", 0.0, 1e5, "Preload cannot pull; give 0 N for line-to-line bearings.", fmi="preload"
)


@dataclass(frozen=True, kw_only=True)
class TaperedRollerBearing(Bearing, name="tapered_roller", text="tapered rollers with films"):
    """A tapered roller bearing of the axle model, mounted as an opposed pair on each shaft.

    Parameters
    ----------
    bore_diameter, outside_diameter : float
        Boundary dimensions, which set the drag [m].
    inner_race_diameter, outer_race_diameter, roller_diameter, roller_length : float
        Dimensions at the middle of the rollers [m].
    n_rollers : int
        Number of rollers, 3 to 40.
    stiffness_constant : float
        kn of the contact inner race - roller - outer race [N/m^n].
    exponent : float
        n of load = kn approach^n; 10/9 for line contacts, 1.5 for point contacts [-].
    contact_angle : float
        Contact angle, called L in the equations; 0 for a cylindrical roller bearing [rad].
    loss : float
        Hysteresis loss coefficient in [mohammadpour_2015 (25)] [-].
    approach : {"full", "as_printed"}
        "as_printed" halves the displacement in [mohammadpour_2015 (26)], as the paper prints it,
        and lets rollers pull.
    film : {"squeeze", "steady", "off"}
        Film of [mohammadpour_2015 (27)] with its squeeze factor, without it, or dry rollers.
    solid : Solid
        Material of rollers and races.
    f0, f1 : float
        Viscous and load factor of the drag torque, see `losses.catalogue` [-].
    preload : float or None
        Axial force on each bearing of the pair at standstill [N].
    interference : float or None
        Approach of every roller at standstill, negative for a clearance [m]. Give it or `preload`,
        because each follows from the other.
    series : str
        Series in the catalogue, for the drag by SKF: one of `SERIES_NAMES`.
    rib_height : float, optional
        Height of the contact between roller ends and rib above the inner race [m], for drag torques
        from rolling; None: 0.15 roller diameters, assumed; 0: no rib.
    rib_boundary_friction : float
        Friction coefficient of the asperities between roller ends and rib [-].
    rib_roughness : float
        Composite rms roughness of roller ends and rib [m].

    Examples
    --------
    >>> bearing = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0)
    >>> round(bearing.cage_ratio, 4)  # cage speed over shaft speed
    0.3987
    """

    bore_diameter: Annotated[float, DIAMETER]
    outside_diameter: Annotated[float, DIAMETER]
    inner_race_diameter: Annotated[float, DIAMETER]
    outer_race_diameter: Annotated[float, DIAMETER]
    roller_diameter: Annotated[float, ROLLER]
    roller_length: Annotated[float, ROLLER]
    n_rollers: Annotated[int, ROLLERS]
    stiffness_constant: Annotated[float, Number("N/m^n", 1e6, 1e14, _LINES)]
    exponent: Annotated[float, Number("1", 1.0, 2.0, _LINES)]
    contact_angle: Annotated[
        float, Number("rad", 0.0, math.radians(45.0), "15 deg is 0.2618 rad.", fmi="contact_angle")
    ]
    loss: Annotated[float, Number("1", 0.0, 1.0)]
    approach: Approach
    film: Film
    solid: Solid
    f0: Annotated[float, VISCOUS_FACTOR]
    f1: Annotated[float, LOAD_FACTOR]
    preload: Annotated[float | None, PRELOAD] = None
    interference: float | None = None
    series: str = "other"
    rib_height: float | None = None
    rib_boundary_friction: Annotated[float, RIB_FRICTION] = RIB_BOUNDARY_FRICTION
    rib_roughness: Annotated[float, ROUGHNESS] = RIB_ROUGHNESS

    def __post_init__(self) -> None:
        super().__post_init__()
        check_option("series", self.series, SERIES_NAMES)
        room = self.inner_race_diameter + self.roller_diameter
        cure = "The roller must fit between the races."
        check_within(
            "outer_race_diameter", self.outer_race_diameter, room, DIAMETER.high, "m", cure
        )
        cure = "It is the outside of the outer ring."
        low, high = self.bore_diameter, DIAMETER.high
        check_within("outside_diameter", self.outside_diameter, low, high, "m", cure)
        if self.n_rollers != int(self.n_rollers):
            raise ParameterError(f"n_rollers must be a whole number, got {self.n_rollers:g}.")
        cure = "It is below the roller diameter; 0 m is no rib."
        if self.rib_height is not None:
            check_within("rib_height", self.rib_height, 0.0, self.roller_diameter, "m", cure)
        self._check_fit()

    def _check_fit(self) -> None:
        if self.preload is not None and self.interference is not None:
            raise ParameterError(
                "preload and interference both set the approach of the rollers at standstill, got "
                f"{self.preload:g} N and {self.interference:g} m. Give one of them."
            )
        if self.preload and self.contact_angle == 0.0:
            raise ParameterError(
                "An axial preload needs a contact angle above 0 rad, got 0 rad with "
                f"{self.preload:g} N. Use with_interference for cylindrical rollers."
            )
        if self.interference is not None:
            cure = "10 um is 1e-5 m."
            check_within("interference", self.interference, -LARGEST_FIT, LARGEST_FIT, "m", cure)

    @classmethod
    def mohammadpour_2015(
        cls,
        *,
        approach: Approach = "full",
        film: Film = "squeeze",
        contact_angle: float = CONTACT_ANGLE_COMPLETED,
    ) -> TaperedRollerBearing:
        """Return the bearing of [mohammadpour_2015 Table A2], without preload or fit.

        Notes
        -----
        Completed, as the paper does not give it: the contact angle. The races and the roller of
        Table A2 (50 + 2 x 12.7 = 75.4 mm) are those of a cylindrical roller bearing. The unit of
        its stiffness is printed N/m and can only be N/m^(10/9). Its "radial interface" of 10 um
        and the preload of 2500 or 6000 N in the text are alternatives: 10 um is 1391 N on each
        roller, an axial preload of 4320 N at 15 degrees.
        """
        return cls(
            bore_diameter=40e-3,
            outside_diameter=83.7e-3,
            inner_race_diameter=50e-3,
            outer_race_diameter=75.4e-3,
            roller_diameter=12.7e-3,
            roller_length=22e-3,
            n_rollers=12,
            stiffness_constant=5e8,
            exponent=N_LINE,
            contact_angle=contact_angle,
            loss=HYSTERETIC_LOSS,
            approach=approach,
            film=film,
            solid=STEEL_MOHAMMADPOUR_2015,
            f0=F0_TAPERED_OIL_BATH,
            f1=F1_TAPERED,
        )

    def with_preload(self, preload: float) -> TaperedRollerBearing:
        """Return this bearing with the axial preload [N] on either side of the shaft."""
        return replace(self, preload=preload)

    def with_interference(self, interference: float) -> TaperedRollerBearing:
        """Return this bearing with all rollers pressed in by `interference` [m]."""
        return replace(self, interference=interference)

    def with_clearance(self, clearance: float) -> TaperedRollerBearing:
        """Return this bearing with the gap `clearance` [m] at every roller at rest."""
        return replace(self, interference=-clearance)

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed without slip, ri/(ri + ro) [-]."""
        return self.inner_race_diameter / (self.inner_race_diameter + self.outer_race_diameter)

    @property
    def rest_approach(self) -> float:
        """Approach of every roller at rest, without film [m]; negative for a clearance.

        F0 = N kn d^n sin L solved for d, or the interference.
        """
        if self.preload is None:
            return 0.0 if self.interference is None else float(self.interference)
        return preload_approach(
            float(self.preload),
            float(self.n_rollers),
            math.sin(self.contact_angle),
            float(self.stiffness_constant),
            float(self.exponent),
        )

    def preload_force(self) -> float:
        """Return the axial force of either bearing at rest [N]."""
        if self.preload is not None:
            return float(self.preload)
        approach = max(self.rest_approach, 0.0)
        w = self.stiffness_constant * approach**self.exponent
        return self.n_rollers * w * math.sin(self.contact_angle)

    @property
    def entraining_radius(self) -> float:
        """Mean entraining speed of the contacts over shaft speed, ri ro/(ri + ro) [m]."""
        return 0.5 * self.cage_ratio * self.outer_race_diameter

    def film_constant(self) -> float:
        """Return H at the floor load of the kernels over (eta0 u)^0.647 alpha^0.46 [SI].

        H = r 13.924 W^-0.045 U^0.647 G^0.46 (1 - 0.75), [mohammadpour_2015 (27)].
        """
        if self.film == "off":
            return 0.0
        r = 0.5 * self.roller_diameter
        E_r = pi_contact_modulus(self.solid, self.solid)
        w_floor = self.stiffness_constant * FILM_FLOOR_APPROACH**self.exponent
        load = (w_floor / (E_r * r * r)) ** LOAD_EXPONENT
        rest = (1.0 / (E_r * r)) ** SPEED_EXPONENT * E_r**MATERIAL_EXPONENT
        return float(r * COEFFICIENT * (1.0 - SQUEEZE_SHARE) * load * rest)

    def parameters(self) -> TaperedRollerParameters:
        """Return the floats for the kernels."""
        R1, S1 = SERIES.get(self.series, OTHER_SERIES)
        sin_contact, cos_contact, axial_factor = contact_angle_terms(float(self.contact_angle))
        return TaperedRollerParameters(
            kn=float(self.stiffness_constant),
            n=float(self.exponent),
            n_rollers=float(self.n_rollers),
            sin_contact=sin_contact,
            cos_contact=cos_contact,
            interference=self.rest_approach,
            cage_ratio=self.cage_ratio,
            loss=float(self.loss),
            approach_factor=0.5 if self.approach == "as_printed" else 1.0,
            clip=0.0 if self.approach == "as_printed" else 1.0,
            film_constant=self.film_constant(),
            film_speed_radius=self.entraining_radius,
            squeeze=1.0 if self.film == "squeeze" else 0.0,
            mean_diameter=0.5 * (self.bore_diameter + self.outside_diameter),
            ring_section=float(self.outside_diameter - self.bore_diameter),
            skf_rolling=R1,
            skf_sliding=S1,
            f0=float(self.f0),
            f1=float(self.f1),
            axial_factor=axial_factor,
            roller_length=float(self.roller_length),
            roller_radius=0.5 * float(self.roller_diameter),
            inner_radius=0.5 * float(self.inner_race_diameter),
            outer_radius=0.5 * float(self.outer_race_diameter),
            reduced_modulus=reduced_modulus(self.solid, self.solid),
            rib_height=float(
                RIB_HEIGHT * self.roller_diameter if self.rib_height is None else self.rib_height
            ),
            rib_friction=float(self.rib_boundary_friction),
            rib_roughness=float(self.rib_roughness),
            conductivity=float(self.solid.conductivity),
            density=float(self.solid.density),
            heat_capacity=float(self.solid.heat_capacity),
            contact_angle=float(self.contact_angle),
        )
