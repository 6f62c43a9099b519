"""Scuffing of cylindrical gears by ISO/TS 6336-20 (flash) and -21 (integral temperature)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.number import Checked, Number, Positive
from gearlube_core.rating.gears import MM, UM, Gears, Pair, said
from gearlube_core.rating.strength import elasticity_factor

_ZERO = 273.15  # K
_EFFUSIVITY = 13.78  # B_M of steel [N/(mm s^0.5 K)]
_BUTTRESS = 1.3  # load at the ends of helical contact lines over that in the middle
_BUTTRESS_WIDTH = 0.2  # over sin(beta_b), in Gamma; not checked against the source
_SPUR_ENDS = 1.0 / 3.0  # share of the load at the ends of the path


class PathPoints(NamedTuple):
    """Points of the path of contact of a cylindrical pair; N, mm."""

    gamma: Array  # Gamma: -1 at the tangent point of the pinion, 0 at the pitch point
    pinion_radius: Array  # of curvature, transverse [mm]
    gear_radius: Array
    share: Array  # X_Gamma, load over that of the whole width


def path_points(pair: HelicalPair, points: int = 201) -> PathPoints:
    """Return the path of contact from A to E with the load without profile modification.

    Spur: 1/3 at A rising to 2/3 at B, 1 from B to D. Helical: 1/eps_alpha, 1.3 times as much at the
    ends. An overlap below 1 is interpolated.
    """
    x = MM * np.linspace(pair.contact_start, pair.contact_end, points)
    pitch, whole = MM * pair.pitch_point, MM * pair.tangent_length
    gamma = x / pitch - 1.0
    B = MM * (pair.contact_end - pair.base_pitch)
    D = MM * (pair.contact_start + pair.base_pitch)
    ends = [x[0], min(B, D), max(B, D), x[-1]]
    top = 1.0 if B <= D else 0.5
    spur = np.interp(x, ends, [_SPUR_ENDS, 2.0 * _SPUR_ENDS, 2.0 * _SPUR_ENDS, _SPUR_ENDS])
    spur = np.where((x >= ends[1]) & (x <= ends[2]), top, spur)
    width = max(_BUTTRESS_WIDTH * math.sin(pair.base_helix_angle), 1e-9)
    edge = np.minimum(gamma - gamma[0], gamma[-1] - gamma)
    butt = 1.0 + (_BUTTRESS - 1.0) * np.clip(1.0 - edge / width, 0.0, 1.0)
    part = min(pair.overlap_ratio, 1.0)
    share = (1.0 - part) * spur + part * butt / pair.transverse_contact_ratio
    return PathPoints(gamma, x, whole - x, share)


def tip_contact_ratios(pair: HelicalPair) -> Pair:
    """Return eps_1 and eps_2: of recess at the pinion's tip and of approach [-]."""
    recess, approach = pair.contact_end - pair.pitch_point, pair.pitch_point - pair.contact_start
    return recess / pair.base_pitch, approach / pair.base_pitch


@dataclass(frozen=True, kw_only=True)
class ScuffingOil(Checked):
    """An oil and its supply.

    Parameters
    ----------
    temperature
        Before the mesh [K].
    viscosity
        Dynamic, at it [Pa.s].
    load_stage
        Failure load stage of the FZG test A/8.3/90 [-].
    test_torque
        Of its pinion [N.m]; None: 3.726 N.m times the square of the stage.
    viscosity_40
        Kinematic, at 40 degC [m2/s].
    lubricant_factor
        X_L: of friction by -21, about 1 of mineral oil [-]; that of -20 is eta^-0.05.
    supply
        X_S [-]: 1 in a bath; by a jet 1.2, submerged 0.2, not checked against the source.

    Examples
    --------
    >>> oil = ScuffingOil(temperature=353.0, viscosity=30e-3, viscosity_40=2.2e-4, load_stage=12)
    >>> oil.supply
    1.0
    """

    temperature: Annotated[float, Number("K", 200.0, 500.0, "80 degC is 353.15 K.")]
    viscosity: Annotated[float, Positive("Pa.s", "30 mPa.s is 0.03 Pa.s.")]
    viscosity_40: Annotated[float, Number("m2/s", 1e-6, 5e-3, "220 mm2/s is 2.2e-4 m2/s.")]
    load_stage: Annotated[float, Number("1", 1.0, 20.0, "12 is usual.")]
    test_torque: Annotated[float | None, Positive("N.m", "534.5 N.m is stage 12.")] = None
    lubricant_factor: Annotated[float, Number("1", 0.3, 1.5, "1 of mineral oil.")] = 1.0
    supply: Annotated[float, Number("1", 0.1, 2.0, "1 in a bath.")] = 1.0


class ScuffingRating(NamedTuple):
    """Safety against scuffing by one method, of its formulas as implemented here."""

    temperature: float  # greatest contact or integral temperature [K]
    limit: float  # scuffing temperature of the method [K]
    bulk: float  # theta_M [K]
    safety: float  # S_B or S_int [-]
    friction: float  # mu_m [-]
    gamma: float  # place of the greatest temperature; nan of the integral method
    factors: dict[str, float]
    outside: tuple[str, ...]
    standard: str


def _common(pair: HelicalPair, gears: Gears, speed: float) -> dict[str, float]:
    """Return what both methods take; N, mm, MPa."""
    alpha_t, alpha_w = pair.transverse_pressure_angle, pair.working_pressure_angle
    angle = math.sin(alpha_w) * math.cos(pair.normal_pressure_angle)
    angle = (angle * math.cos(pair.base_helix_angle)) ** 0.25
    rho_1, rho_2 = MM * pair.pitch_point, MM * (pair.tangent_length - pair.pitch_point)
    return {
        "X_M": (2e6 * math.pi * elasticity_factor(gears) ** 2) ** 0.25 / _EFFUSIVITY,
        "X_ab": 1.22 * angle / math.sqrt(math.cos(alpha_t) * math.cos(alpha_w)),
        "v": speed * pair.centre_distance / (pair.ratio + 1.0),
        "rho_C": rho_1 * rho_2 / (rho_1 + rho_2) / math.cos(pair.base_helix_angle),
        "a": MM * pair.centre_distance,
    }


def _outside(pair: HelicalPair, v: float) -> tuple[str, ...]:
    helix, e = math.degrees(pair.helix_angle), pair.transverse_contact_ratio
    return said(
        (helix <= 30.0, f"helix angle up to 30 deg, got {helix:.1f} deg"),
        (1.0 <= e <= 2.0, f"transverse contact ratio within 1 to 2, got {e:.3f}"),
        (v < 80.0, f"pitch line speed below 80 m/s, got {v:.1f} m/s"),
    )


def flash_rating(
    pair: HelicalPair,
    gears: Gears,
    oil: ScuffingOil,
    *,
    line_load: float,
    pinion_speed: float,
    friction: float | None = None,
    structure: float = 1.0,
    paths: float = 1.0,
) -> ScuffingRating:
    """Return the safety against scuffing by the greatest flash temperature, ISO/TS 6336-20.

    theta_fl = mu X_M X_G (X_Gamma w)^0.75 v^0.5/a^0.25
    theta_M = theta_oil + 0.47 X_S X_mp mean(theta_fl),  theta_B = theta_M + max(theta_fl)
    theta_S = 80 + (0.85 + 1.4 X_W) X_L S^2

    Parameters
    ----------
    pair, gears, oil
        Geometry, roughness and moduli, oil.
    line_load
        w_Bt = F_t/b K_A K_gamma K_v K_H beta K_H alpha [N/m].
    pinion_speed
        [rad/s]
    friction
        mu_m [-]; None: 0.06 (w/(v_g rho))^0.2 X_L X_R, whose X_R is not checked against the source.
    structure
        X_W [-]: 1 case-hardened; 0.45 austenitic, 1.25 phosphated, 1.5 nitrided, which are not
        checked against the source.
    paths
        X_mp, of several meshes [-].

    Notes
    -----
    One worked example, met within 6 %. Source: [iso_6336_20].

    Examples
    --------
    >>> import gearlube as gl
    >>> pair = gl.HelicalGearFile.named("he_2007").helical_pair()
    >>> gear = gl.RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
    >>> oil = gl.ScuffingOil(temperature=363.0, viscosity=15e-3, viscosity_40=1e-4, load_stage=12)
    >>> found = gl.flash_rating(pair, (gear, gear), oil, line_load=2e5, pinion_speed=200.0)
    >>> round(found.safety, 1)
    4.9
    """
    w = 1e-3 * check_positive("line_load", line_load, "N/m", "100 N/mm is 1e5 N/m.")
    check_positive("pinion_speed", pinion_speed, "rad/s", "1000 rpm is 104.7 rad/s.")
    c, path, u = _common(pair, gears, pinion_speed), path_points(pair), pair.ratio
    X_L = (1e3 * oil.viscosity) ** -0.05
    if friction is None:
        rolling = 2.0 * c["v"] * math.sin(pair.working_pressure_angle)
        X_R = (UM * sum(g.flank_roughness for g in gears) / 8.0) ** 0.25
        friction = 0.060 * (w / (rolling * c["rho_C"])) ** 0.2 * X_L * X_R
    g = path.gamma
    X_G = 0.51 * c["X_ab"] * math.sqrt(u + 1.0) * np.abs(np.sqrt(1.0 + g) - np.sqrt(1.0 - g / u))
    X_G = X_G / ((1.0 + g) * (u - g)) ** 0.25
    flash = friction * c["X_M"] * X_G * (path.share * w) ** 0.75 * c["v"] ** 0.5 / c["a"] ** 0.25
    mean = float(np.trapezoid(flash, g) / (g[-1] - g[0]))
    bulk = oil.temperature + 0.47 * oil.supply * paths * mean
    most = bulk + float(flash.max())
    limit = 80.0 + (0.85 + 1.4 * structure) * X_L * oil.load_stage**2 + _ZERO
    return ScuffingRating(
        most, limit, bulk, (limit - oil.temperature) / (most - oil.temperature), friction,
        float(g[flash.argmax()]), {**c, "X_L": X_L, "theta_fl": float(flash.max()),
        "theta_flm": mean}, _outside(pair, c["v"]), "ISO/TS 6336-20:2017, method B",
    )  # fmt: skip


def mean_friction(
    pair: HelicalPair, gears: Gears, *, line_load: float, v: float, rho_C: float, eta: float
) -> tuple[float, float, float]:
    """Return mu without X_L, and X_R and K_B gamma; rho_C in mm. Source: [iso_6336_21]."""
    e = pair.total_contact_ratio
    helical = min(max(e, 2.0), 3.5)
    K = 1.0 + 0.2 * math.sqrt((helical - 2.0) * (5.0 - helical))
    X_R = 2.2 * (0.5 * sum(g.R_a for g in gears) / rho_C) ** 0.25
    rolling = 2.0 * v * math.sin(pair.working_pressure_angle)
    mu = 0.045 * (1e-3 * line_load * K / (rolling * rho_C)) ** 0.2
    return mu * (1e3 * eta) ** -0.05 * X_R, X_R, K


def integral_rating(
    pair: HelicalPair,
    gears: Gears,
    oil: ScuffingOil,
    *,
    line_load: float,
    pinion_speed: float,
    effective_relief: float,
    tip_relief: float = 0.0,
    pinion_drives: bool = True,
    relative_structure: float = 1.0,
) -> ScuffingRating:
    """Return the safety against scuffing by the integral temperature, ISO/TS 6336-21.

    theta_flaint = mu X_M X_BE X_ab (K_B w)^0.75 v^0.5/a^0.25 X_eps/(X_Q X_Ca)
    theta_int = theta_oil + (0.7 X_S + 1.5) theta_flaint
    theta_Sint = 80 + (0.23 X_L + 0.3 X_WrelT (100/nu40)^0.02) T1T

    Parameters
    ----------
    pair, gears, oil, line_load, pinion_speed
        As of `flash_rating`.
    effective_relief
        C_eff, deflection of the teeth: F_t K_A/(b c_gamma) [m].
    tip_relief
        C_a of the member that counts [m].
    pinion_drives
        Whether the pinion drives, of which the meshing factor X_Q depends.
    relative_structure
        X_WrelT [-].

    Notes
    -----
    X_eps of contact ratios of a member above 1, and X_Q, are not checked against the source; the
    flanks are run in. Source: [iso_6336_21].

    Examples
    --------
    >>> import gearlube as gl
    >>> pair = gl.HelicalGearFile.named("he_2007").helical_pair()
    >>> gear = gl.RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
    >>> oil = gl.ScuffingOil(temperature=363.0, viscosity=15e-3, viscosity_40=1e-4, load_stage=12)
    >>> found = gl.integral_rating(
    ...     pair, (gear, gear), oil, line_load=2e5, pinion_speed=200.0, effective_relief=1e-5
    ... )
    >>> round(found.safety, 1)
    3.1
    """
    check_positive("line_load", line_load, "N/m", "100 N/mm is 1e5 N/m.")
    check_positive("effective_relief", effective_relief, "m", "45 um is 4.5e-5 m.")
    c, path, u = _common(pair, gears, pinion_speed), path_points(pair, 2), pair.ratio
    mu, X_R, K = mean_friction(
        pair, gears, line_load=line_load, v=c["v"], rho_C=c["rho_C"], eta=oil.viscosity
    )
    mu *= oil.lubricant_factor
    first, second = float(path.pinion_radius[1]), float(path.gear_radius[1])
    X_BE = 0.51 * math.sqrt(u + 1.0) * (math.sqrt(first) - math.sqrt(second / u))
    X_BE /= (first * second) ** 0.25
    e1, e2 = tip_contact_ratios(pair)
    X_eps = contact_ratio_factor(e1, e2)
    approach = (e2 / e1) if pinion_drives else (e1 / e2)
    X_Q = min(max(1.4 - 4.0 / 15.0 * approach, 0.6), 1.0)
    r, e = min(tip_relief / effective_relief, 1.0), max(e1, e2)
    X_Ca = 1.0 + (0.06 + 0.18 * r) * e + (0.02 + 0.69 * r) * e * e
    load = (1e-3 * line_load * K) ** 0.75 * math.sqrt(c["v"]) / c["a"] ** 0.25
    flash = mu * c["X_M"] * abs(X_BE) * c["X_ab"] * load * X_eps / (X_Q * X_Ca)
    bulk = oil.temperature + 0.7 * oil.supply * flash
    torque = oil.test_torque or 3.726 * oil.load_stage**2
    X_W = relative_structure * (1e-4 / oil.viscosity_40) ** 0.02
    limit = 80.0 + (0.23 * oil.lubricant_factor + 0.3 * X_W) * torque + _ZERO
    most = bulk + 1.5 * flash
    return ScuffingRating(
        most, limit, bulk, (limit - _ZERO) / (most - _ZERO), mu, math.nan,
        {**c, "X_R": X_R, "K_Bg": K, "X_BE": X_BE, "X_eps": X_eps, "X_Q": X_Q, "X_Ca": X_Ca,
         "eps_1": e1, "eps_2": e2, "theta_flaint": flash},
        _outside(pair, c["v"]), "ISO/TS 6336-21:2017, method B",
    )  # fmt: skip


def contact_ratio_factor(e1: float, e2: float) -> float:
    """Return X_eps of the tip contact ratios of pinion and gear [-]; source [iso_6336_21].

    Examples
    --------
    >>> round(contact_ratio_factor(0.852, 0.611), 4)
    0.2628
    """
    e = e1 + e2
    if e < 1.0:
        terms = e1 * e1 + e2 * e2
    elif e < 2.0 and max(e1, e2) < 1.0:
        terms = 0.70 * (e1 * e1 + e2 * e2) - 0.22 * e + 0.52 - 0.60 * e1 * e2
    else:
        high, low = max(e1, e2), min(e1, e2)
        a, b, c, d, f = (
            (0.18, 0.70, 0.82, 0.52, 0.30) if e < 2.0 else (0.44, 0.59, 0.30, 0.30, 0.15)
        )
        terms = a * high * high + b * low * low + c * high - d * low - f * e1 * e2
    return terms / (2.0 * e * e1)
