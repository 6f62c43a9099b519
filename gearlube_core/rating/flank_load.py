"""A cylindrical pair under load in an oil, for scuffing and micropitting by ISO/TS 6336."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.number import Checked, Number, Positive
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.rating.gears import Gears, RatedGear, StrengthRating
from gearlube_core.rating.pairs import MM, Pair
from gearlube_core.rating.strength import elasticity_factor

_BUTTRESS = 1.3  # load at the ends of helical contact lines over that in the middle
_BUTTRESS_WIDTH = 0.2  # over sin(beta_b), in Gamma; not checked against the source
_SPUR_ENDS = 1.0 / 3.0  # share of the load at the ends of the path


@dataclass(frozen=True, kw_only=True)
class FlankOil(Checked):
    """An oil and its supply.

    Parameters
    ----------
    temperature, supply
        Before the mesh; X_S: 1 in a bath; by a jet 1.2, submerged 0.2, not checked against the
        source.
    viscosity, viscosity_40
        Function that returns the dynamic viscosity [Pa.s] at a temperature [K]; the kinematic one
        at 40 degC.
    load_stage, test_torque
        Failure load stage of the FZG test A/8.3/90; None: not known, no scuffing. Torque of its
        pinion; None: 3.726 N.m times the square of the stage.
    kind, lubricant_factor
        "mineral"; "pao" or "pag", whose alpha is not checked against the source. X_L of friction.

    Examples
    --------
    >>> oil = FlankOil.of(Lubricant.named("fva_3"), temperature=353.15, load_stage=12)
    >>> round(1e3 * oil.viscosity(oil.temperature), 1)
    17.1
    """

    temperature: Annotated[float, Number("K", 200.0, 500.0, "80 degC is 353.15 K.")]
    viscosity: Callable[[float], float]
    viscosity_40: Annotated[float, Number("m2/s", 1e-6, 5e-3, "220 mm2/s is 2.2e-4 m2/s.")]
    load_stage: Annotated[float | None, Number("1", 1.0, 20.0, "12 is usual.")] = None
    test_torque: Annotated[float | None, Positive("N.m", "534.5 N.m is stage 12.")] = None
    kind: Literal["mineral", "pao", "pag"] = "mineral"
    lubricant_factor: Annotated[float, Number("1", 0.3, 1.5, "1 of mineral oil.")] = 1.0
    supply: Annotated[float, Number("1", 0.1, 2.0, "1 in a bath.")] = 1.0

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        if not callable(self.viscosity):
            raise ParameterError(
                f"viscosity must be a function of the temperature, got {self.viscosity!r}. Write "
                "lambda T: 0.03, or take FlankOil.of."
            )

    @classmethod
    def of(cls, oil: Lubricant, **given: Any) -> FlankOil:
        """Return the viscosities of an oil of the library, with other fields as given."""
        nu = oil.state(313.15).nu
        return cls(viscosity=lambda T: oil.state(T).eta0, viscosity_40=nu, **given)


class PathPoints(NamedTuple):
    """Points of the path of contact from A to E."""

    gamma: Array  # Gamma: -1 at the tangent point of the pinion, 0 at the pitch point
    pinion_radius: Array  # of curvature, transverse [mm]
    gear_radius: Array
    share: Array  # X, load over that of the whole width


@dataclass(frozen=True, kw_only=True)
class FlankLoad(Checked):
    """Load data for scuffing and micropitting of a cylindrical pair.

    Geometry; gears with roughness and moduli; oil. The line load is F_t/b without load factors, the
    load factor K_A K_gamma K_v K_H beta K_H alpha.

    >>> round(FlankLoad.example().mean_friction, 3)
    0.067
    """

    pair: HelicalPair
    gears: Gears
    oil: FlankOil
    line_load: Annotated[float, Positive("N/m", "100 N/mm is 1e5 N/m.")]
    load_factor: Annotated[float, Positive("1", "1 without.")]
    pinion_speed: Annotated[float, Positive("rad/s", "1000 rpm is 104.7 rad/s.")]

    @classmethod
    def of(
        cls, rating: StrengthRating, pair: HelicalPair, gears: Gears, oil: FlankOil
    ) -> FlankLoad:
        """Return the load of a rating of the pair, with its factors."""
        K = math.prod(rating.number(name) for name in ("K_A", "K_gam", "K_v", "K_Hb", "K_Ha"))
        return cls(
            pair=pair, gears=gears, oil=oil, load_factor=K,
            line_load=rating.number("F_t") / pair.face_width,
            pinion_speed=rating.number("v") / pair.pinion_reference_radius,
        )  # fmt: skip

    @classmethod
    def example(cls) -> FlankLoad:
        """Return shipped spur gears in FVA 3 at 90 degC under 300 N/mm, for a first try."""
        gear = RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
        return cls(
            pair=HelicalGearFile.named("he_2007").helical_pair(), gears=(gear, gear),
            oil=FlankOil.of(Lubricant.named("fva_3"), temperature=363.0, load_stage=12.0),
            line_load=2e5, load_factor=1.5, pinion_speed=200.0,
        )  # fmt: skip

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        e = self.pair.transverse_contact_ratio
        check_within("transverse contact ratio", e, 1.0, 4.0, "", "Use longer teeth.")

    @property
    def w(self) -> float:
        """w_Bt, with all load factors [N/mm]."""
        return 1e-3 * self.line_load * self.load_factor

    @property
    def v(self) -> float:
        """Speed at the working pitch circles [m/s]."""
        return self.pinion_speed * self.pair.centre_distance / (self.pair.ratio + 1.0)

    @property
    def rho_C(self) -> float:
        """Relative radius of curvature at the pitch point, normal to the flank [mm]."""
        first, whole = MM * self.pair.pitch_point, MM * self.pair.tangent_length
        return first * (whole - first) / whole / math.cos(self.pair.base_helix_angle)

    @property
    def E_r(self) -> float:
        """Reduced modulus [MPa]."""
        return 2.0 * math.pi * elasticity_factor(self.gears) ** 2

    @property
    def tip_contact_ratios(self) -> Pair:
        """eps_1 and eps_2, of recess at the pinion's tip and of approach [-]."""
        pair = self.pair
        ends = pair.contact_end - pair.pitch_point, pair.pitch_point - pair.contact_start
        return ends[0] / pair.base_pitch, ends[1] / pair.base_pitch

    @property
    def rolling(self) -> float:
        """Sum of the tangential speeds at the pitch point [m/s]."""
        return 2.0 * self.v * math.sin(self.pair.working_pressure_angle)

    @property
    def helical_factor(self) -> float:
        """K_B gamma [-]."""
        e = min(max(self.pair.total_contact_ratio, 2.0), 3.5)
        return 1.0 + 0.2 * math.sqrt((e - 2.0) * (5.0 - e))

    @property
    def roughness_factor(self) -> float:
        """X_R [-], of R_a."""
        return 2.2 * (0.5 * sum(g.R_a for g in self.gears) / self.rho_C) ** 0.25

    @property
    def mean_friction(self) -> float:
        """mu_m = 0.045 (w K_B gamma/(v_g rho))^0.2 eta^-0.05 X_R X_L [-]; [iso_6336_21]."""
        eta = 1e3 * self.oil.viscosity(self.oil.temperature)
        mu = 0.045 * (self.w * self.helical_factor / (self.rolling * self.rho_C)) ** 0.2
        return mu * eta**-0.05 * self.roughness_factor * self.oil.lubricant_factor

    @property
    def bulk_temperature(self) -> float:
        """T_M of the teeth [K], where no thermal model has it, without tip relief; [iso_6336_22].

        T_M = T_oil + 7400 (P mu H_v/(a b))^0.72 X_S/1.2, P in kW, a and b in mm
        H_v = (1 - eps_a + eps_1^2 + eps_2^2)(1/z1 + 1/z2) pi/cos(beta_b)
        """
        pair, (e1, e2) = self.pair, self.tip_contact_ratios
        H_v = (1.0 - e1 - e2 + e1 * e1 + e2 * e2) * math.pi / math.cos(pair.base_helix_angle)
        H_v *= 1.0 / pair.pinion_teeth + 1.0 / pair.gear_teeth
        # the power over the face width [kW/mm]
        power = 1e-6 * self.line_load * self.pinion_speed * pair.pinion_reference_radius
        heat = power * self.mean_friction * H_v / (MM * pair.centre_distance)
        return self.oil.temperature + 7400.0 * heat**0.72 * self.oil.supply / 1.2

    @cached_property
    def path(self) -> PathPoints:
        """The path of contact with the load of flanks without modification.

        Spur: 1/3 at A rising to 2/3 at B, 1 from B to D. Helical: 1/eps_alpha, 1.3 times as much at
        the ends. An overlap below 1 is interpolated.
        """
        pair = self.pair
        x = MM * np.linspace(pair.contact_start, pair.contact_end, 201)
        pitch, whole = MM * pair.pitch_point, MM * pair.tangent_length
        gamma = x / pitch - 1.0
        B = MM * (pair.contact_end - pair.base_pitch)
        D = MM * (pair.contact_start + pair.base_pitch)
        ends = [x[0], min(B, D), max(B, D), x[-1]]
        spur = np.interp(x, ends, [_SPUR_ENDS, 2.0 * _SPUR_ENDS, 2.0 * _SPUR_ENDS, _SPUR_ENDS])
        spur = np.where((x >= ends[1]) & (x <= ends[2]), 1.0 if B <= D else 0.5, spur)
        width = max(_BUTTRESS_WIDTH * math.sin(pair.base_helix_angle), 1e-9)
        edge = np.minimum(gamma - gamma[0], gamma[-1] - gamma)
        butt = 1.0 + (_BUTTRESS - 1.0) * np.clip(1.0 - edge / width, 0.0, 1.0)
        part = min(pair.overlap_ratio, 1.0)
        share = (1.0 - part) * spur + part * butt / pair.transverse_contact_ratio
        return PathPoints(gamma, x, whole - x, share)
