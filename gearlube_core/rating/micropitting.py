"""Micropitting by ISO/TS 6336-22: specific film thickness, and that of the C-GF test gear."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive
from gearlube_core.rating.contact_temperature import STEEL_EFFUSIVITY
from gearlube_core.rating.flank_load import FlankLoad
from gearlube_core.rating.pairs import MM, MPA, said

_Number = Array | float
_T_38 = 311.0  # K
# alpha at 38 degC [1/Pa] over a power of eta in Pa.s; not checked but of mineral oil
_ALPHA = {"mineral": (2.657e-8, 0.1348), "pao": (1.466e-8, 0.0507), "pag": (1.392e-8, 0.1572)}
MARGIN = 1.4  # of the test gear's specific film
_MODULUS = 226.374e9  # E_r of steel [Pa]
# point A of the test gears C-GF at 2250 1/min: radius [m], speeds [m/s], line load over the torque
# of the pinion [1/m2], R_a [m]
TEST_POINT = (3.8998e-3, (1.0538, 4.7835), 236.3e3 / 265.1, 0.5e-6)


class FilmPoints(NamedTuple):
    """Films along the path of contact."""

    film: Array  # h_Y [m]
    specific: Array  # lambda_GF,Y [-]
    pressure: Array  # p_dyn [Pa]
    temperature: Array  # T_B,Y in the contact [K]


def specific_film(
    radius: _Number, pressure: _Number, speeds: tuple[_Number, _Number], *,
    viscosity: Callable[[float], float], bulk: _Number, friction: _Number, roughness: float,
    oil: str = "mineral", contact: _Number | None = None, modulus: float = _MODULUS,
) -> FilmPoints:  # fmt: skip
    """Return film and specific film at points of a flank.

    h = 1600 rho G^0.6 U^0.7 W^-0.13 S^0.22,  lambda = h/R_a

    Compare only with a permissible value of the same film formula. Source: [iso_6336_22].

    Parameters
    ----------
    radius, pressure
        rho_n, relative radius of curvature normal to the flank [m]. Hertz pressure with all load
        factors [Pa]: of method B, or solved over the flank, A.
    speeds
        Of pinion and gear along the profile [m/s].
    viscosity
        eta [Pa.s] of a temperature [K], such as `lambda T: oil.state(T).eta0` of a `Lubricant`.
    bulk, contact
        T_M of the teeth, T_B in the contact [K]; None: by the flash formula of the standard.
    friction, roughness
        mu_m [-]; R_a, mean of both flanks [m].
    oil
        "mineral"; "pao", "pag", whose alpha is not checked against the source.
    modulus
        E_r [Pa].

    Examples
    --------
    >>> found = specific_film(
    ...     37.122e-3, 1014.7e6, (5.11, 9.03), viscosity=lambda T: 25.2e-3, bulk=358.15,
    ...     friction=0.0, roughness=0.6e-6,
    ... )
    >>> round(float(found.specific), 2)
    1.27
    """
    check_option("oil", oil, _ALPHA)
    rho, p = np.asarray(radius, dtype=float), np.asarray(pressure, dtype=float)
    u1, u2 = (np.asarray(one, dtype=float) for one in speeds)
    T_M = np.asarray(bulk, dtype=float)
    takes = STEEL_EFFUSIVITY * (np.sqrt(u1) + np.sqrt(u2))
    heat = np.asarray(friction) * p * np.abs(u1 - u2) / takes
    rise = 0.5 * math.sqrt(math.pi) * heat * np.sqrt(8.0 * rho * p / modulus)
    T_B = T_M + rise if contact is None else np.asarray(contact, dtype=float)
    factor, power = _ALPHA[oil]
    eta = np.vectorize(viscosity, otypes=[float])
    alpha_38 = factor * eta(_T_38) ** power

    def alpha(T: Array) -> Array:
        return alpha_38 * (1.0 + 516.0 * (1.0 / T - 1.0 / _T_38))

    eta_M = eta(T_M)
    G = alpha(T_M) * modulus
    U = eta_M * (u1 + u2) / (2.0 * modulus * rho)
    W = 2.0 * math.pi * (p / modulus) ** 2
    S = alpha(T_B) * eta(T_B) / (alpha(T_M) * eta_M)
    h = 1.6 * rho * G**0.6 * U**0.7 * W**-0.13 * S**0.22  # 1600 um of a radius in mm
    return FilmPoints(h, h / roughness, p, T_B)


class MicropittingRating(NamedTuple):
    """Safety against micropitting, by the standard's formulas as implemented here."""

    gamma: Array  # places on the path of contact, 0 at the pitch point
    points: FilmPoints
    permissible: float  # lambda_GFP [-]
    outside: tuple[str, ...]
    standard: str

    @property
    def safety(self) -> float:
        """S_lambda [-]; the standard gives no least one."""
        return float(self.points.specific.min()) / self.permissible


def permissible_film(
    test_torque: float, *, bulk: float, contact: float, material: float = 1.0, **film: Any
) -> float:
    """Return lambda_GFP = 1.4 W_W lambda_GFT of the C-GF test gear at its failure stage [-].

    `test_torque` is T1 of that stage, 265.1 at stage 10 [N.m]; `bulk` and `contact` are T_M and T_B
    at point A, as the test of the oil has them [K]; `material` is W_W [-]: 1 case-hardened pair,
    0.75 with a through-hardened gear; `film` is viscosity and oil of `specific_film`.
    For a film by another law, solve `TEST_POINT` with that law. Source: [iso_6336_22].

    >>> def eta(temperature):
    ...     return 1e-3 * math.exp(1200.0 / (temperature - 180.0) - 3.5)
    >>> round(permissible_film(265.1, bulk=400.85, contact=524.85, viscosity=eta), 2)
    0.13
    """
    radius, speeds, load, roughness = TEST_POINT
    line_load = load * check_positive("test_torque", test_torque, "N.m", "265.1 N.m is stage 10.")
    pressure = math.sqrt(_MODULUS * line_load / (2.0 * math.pi * radius))
    given = {"bulk": bulk, "contact": contact, "friction": 0.0, "roughness": roughness, **film}
    found = specific_film(radius, pressure, speeds, **given)
    return MARGIN * material * float(found.specific)


def micropitting_rating(
    load: FlankLoad, *, permissible: float,
    bulk: float | None = None, friction: float | None = None, contact: float | None = None,
) -> MicropittingRating:  # fmt: skip
    """Return the specific film along the path of contact by method B, and its safety.

    p = Z_E (F_t X/(b rho_n cos(alpha_t)))^(1/2) (K_A K_gamma K_v K_H beta K_H alpha)^(1/2)

    Load of flanks without modification. Source: [iso_6336_22]. `permissible` is lambda_GFP, see
    `permissible_film` [-]; bulk, friction and contact are as of `specific_film`, None: by the
    standard's formulas.

    >>> round(micropitting_rating(FlankLoad.example(), permissible=0.3).safety, 1)
    0.4
    """
    check_positive("permissible", permissible, "", "0.1 to 0.5 is usual.")
    pair, path = load.pair, load.path
    r1, r2 = path.pinion_radius, path.gear_radius
    cos_b, turn = math.cos(pair.base_helix_angle), 1e-3 * load.pinion_speed
    rho = r1 * r2 / (r1 + r2) / cos_b
    pressure = load.w * path.share / (rho * math.cos(pair.transverse_pressure_angle))
    points = specific_film(
        rho / MM, np.sqrt(load.E_r / (2.0 * math.pi) * pressure) / MPA,
        (turn * r1, turn / pair.ratio * r2), viscosity=load.oil.viscosity,
        bulk=load.bulk_temperature if bulk is None else bulk,
        friction=load.mean_friction if friction is None else friction,
        roughness=0.5e-6 * sum(g.R_a for g in load.gears),
        oil=load.oil.kind, contact=contact, modulus=load.E_r / MPA,
    )  # fmt: skip
    helix, angle = math.degrees(pair.helix_angle), math.degrees(pair.normal_pressure_angle)
    m, e = MM * pair.normal_module, pair.transverse_contact_ratio
    e_n = e / cos_b**2
    outside = said(
        (3.0 <= m <= 11.0, f"module within 3 to 11 mm, got {m:.2f} mm"),
        (8.0 <= load.v <= 60.0, f"pitch line speed within 8 to 60 m/s, got {load.v:.1f} m/s"),
        (helix <= 25.0, f"helix angle up to 25 deg, got {helix:.1f} deg"),
        (angle <= 25.0, f"normal pressure angle up to 25 deg, got {angle:.1f} deg"),
        (e_n < 2.5, f"virtual contact ratio below 2.5, got {e_n:.2f}"),
        (e <= 2.0 or pair.overlap_ratio >= 1.0, f"spur contact ratio up to 2, got {e:.2f}"),
    )
    standard = "ISO/TS 6336-22:2018, method B"
    return MicropittingRating(path.gamma, points, permissible, outside, standard)
