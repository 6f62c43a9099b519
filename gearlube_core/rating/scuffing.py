"""Scuffing of cylindrical gears by ISO/TS 6336-20 (flash) and -21 (integral temperature)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError
from gearlube_core.rating.contact_temperature import STEEL_EFFUSIVITY
from gearlube_core.rating.flank_load import FlankLoad
from gearlube_core.rating.pairs import MM, UM, said
from gearlube_core.units import ZERO_CELSIUS

_FRICTION = "the friction of this method is a formula from memory; give friction"
_TORQUE = "the torque of the load stage, 3.726 S^2 N.m, is from memory; give test_torque"


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


def _common(load: FlankLoad) -> tuple[dict[str, float], float]:
    """Return X_M, X_ab, and v^0.5/a^0.25 in N, mm, MPa, and the load stage."""
    stage, pair = load.oil.load_stage, load.pair
    if stage is None:
        raise ParameterError(
            "load_stage of the oil must be given for scuffing, got none. Take the failure load "
            "stage of the FZG test A/8.3/90 from its data sheet."
        )
    alpha_t, alpha_w = pair.transverse_pressure_angle, pair.working_pressure_angle
    angle = math.sin(alpha_w) * math.cos(pair.normal_pressure_angle)
    angle = (angle * math.cos(pair.base_helix_angle)) ** 0.25
    return {
        "X_M": (1e6 * load.E_r) ** 0.25 / (STEEL_EFFUSIVITY / MM),
        "X_ab": 1.22 * angle / math.sqrt(math.cos(alpha_t) * math.cos(alpha_w)),
        "speed": math.sqrt(load.v) / (MM * pair.centre_distance) ** 0.25,
    }, stage


def _outside(load: FlankLoad, *more: tuple[bool, str]) -> tuple[str, ...]:
    helix, e = math.degrees(load.pair.helix_angle), load.pair.transverse_contact_ratio
    return said(
        (helix <= 30.0, f"helix angle up to 30 deg, got {helix:.1f} deg"),
        (e <= 2.0, f"transverse contact ratio up to 2, got {e:.3f}"),
        (load.v < 80.0, f"pitch line speed below 80 m/s, got {load.v:.1f} m/s"),
        *more,
    )


def flash_rating(
    load: FlankLoad, *, friction: float | None = None, structure: float = 1.0, paths: float = 1.0
) -> ScuffingRating:
    """Return the safety against scuffing by the greatest flash temperature, ISO/TS 6336-20.

    theta_fl = mu X_M X_G (X w)^0.75 v^0.5/a^0.25
    theta_M = theta_oil + 0.47 X_S X_mp mean(theta_fl),  theta_B = theta_M + max(theta_fl)
    theta_S = 80 + (0.85 + 1.4 X_W) X_L S^2,  X_L = eta^-0.05

    One worked example, met within 6 %. ParameterError where the oil has no load stage.
    Source: [iso_6336_20].

    `friction` is mu_m [-], None: 0.06 (w/(v_g rho))^0.2 X_L X_R, whose X_R is not checked against
    the source. `structure` is X_W [-]: 1 case-hardened; 0.45 austenitic, 1.25 phosphated, 1.5
    nitrided, which are not checked against the source. `paths` is X_mp, of several meshes [-].

    >>> round(flash_rating(FlankLoad.example()).safety, 1)
    3.4
    """
    (c, stage), path, u, oil = _common(load), load.path, load.pair.ratio, load.oil
    X_L = (1e3 * oil.viscosity(oil.temperature)) ** -0.05
    given = friction is not None
    if friction is None:
        X_R = (UM * sum(g.flank_roughness for g in load.gears) / 8.0) ** 0.25
        friction = 0.060 * (load.w / (load.rolling * load.rho_C)) ** 0.2 * X_L * X_R
    g = path.gamma
    X_G = 0.51 * c["X_ab"] * math.sqrt(u + 1.0) * np.abs(np.sqrt(1.0 + g) - np.sqrt(1.0 - g / u))
    X_G = X_G / ((1.0 + g) * (u - g)) ** 0.25
    flash = friction * c["X_M"] * X_G * (path.share * load.w) ** 0.75 * c["speed"]
    mean, most = float(np.trapezoid(flash, g) / (g[-1] - g[0])), float(flash.max())
    bulk = oil.temperature + 0.47 * oil.supply * paths * mean
    limit = 80.0 + (0.85 + 1.4 * structure) * X_L * stage**2 + ZERO_CELSIUS
    return ScuffingRating(
        temperature=bulk + most, limit=limit, bulk=bulk,
        safety=(limit - oil.temperature) / (bulk + most - oil.temperature),
        friction=friction, gamma=float(g[flash.argmax()]),
        factors={**c, "X_L": X_L, "theta_fl": most, "theta_flm": mean},
        outside=_outside(load, (given, _FRICTION)),
        standard="ISO/TS 6336-20:2017, method B",
    )  # fmt: skip


def integral_rating(
    load: FlankLoad, *, effective_relief: float, tip_relief: float = 0.0,
    pinion_drives: bool = True, relative_structure: float = 1.0,
) -> ScuffingRating:  # fmt: skip
    """Return the safety against scuffing by the integral temperature, ISO/TS 6336-21.

    theta_flaint = mu X_M X_BE X_ab (K_B w)^0.75 v^0.5/a^0.25 X_eps/(X_Q X_Ca)
    theta_int = theta_oil + (0.7 X_S + 1.5) theta_flaint
    theta_Sint = 80 + (0.23 X_L + 0.3 X_WrelT (100/nu40)^0.02) T1T

    X_eps of contact ratios of a member above 1, and X_Q, are not checked against the source; the
    flanks are run in. ParameterError where the oil has no load stage. Source: [iso_6336_21].

    `effective_relief` is C_eff, the deflection of the teeth, F_t K_A/(b c_gamma), `tip_relief` C_a
    of the member that counts [m]. X_Q depends on whether the pinion drives; `relative_structure`
    is X_WrelT [-].

    >>> round(integral_rating(FlankLoad.example(), effective_relief=1e-5).safety, 1)
    2.7
    """
    check_positive("effective_relief", effective_relief, "m", "45 um is 4.5e-5 m.")
    (c, stage), path, u, oil = _common(load), load.path, load.pair.ratio, load.oil
    first, second = float(path.pinion_radius[-1]), float(path.gear_radius[-1])
    X_BE = 0.51 * math.sqrt(u + 1.0) * (math.sqrt(first) - math.sqrt(second / u))
    X_BE /= (first * second) ** 0.25
    e1, e2 = load.tip_contact_ratios
    X_eps = _contact_ratio_factor(e1, e2)
    X_Q = min(max(1.4 - 4.0 / 15.0 * (e2 / e1 if pinion_drives else e1 / e2), 0.6), 1.0)
    r, e = min(tip_relief / effective_relief, 1.0), max(e1, e2)
    X_Ca = 1.0 + (0.06 + 0.18 * r) * e + (0.02 + 0.69 * r) * e * e
    flash = load.mean_friction * c["X_M"] * abs(X_BE) * c["X_ab"] * c["speed"]
    flash *= (load.w * load.helical_factor) ** 0.75 * X_eps / (X_Q * X_Ca)
    bulk = oil.temperature + 0.7 * oil.supply * flash
    torque = oil.test_torque or 3.726 * stage**2
    X_W = relative_structure * (1e-4 / oil.viscosity_40) ** 0.02
    limit = 80.0 + (0.23 * oil.lubricant_factor + 0.3 * X_W) * torque + ZERO_CELSIUS
    return ScuffingRating(
        temperature=bulk + 1.5 * flash, limit=limit, bulk=bulk,
        safety=(limit - ZERO_CELSIUS) / (bulk + 1.5 * flash - ZERO_CELSIUS),
        friction=load.mean_friction, gamma=math.nan,
        factors={
            **c, "X_R": load.roughness_factor, "K_Bg": load.helical_factor, "X_BE": X_BE,
            "X_eps": X_eps, "X_Q": X_Q, "X_Ca": X_Ca, "theta_flaint": flash,
        },
        outside=_outside(load, (oil.test_torque is not None, _TORQUE)),
        standard="ISO/TS 6336-21:2017, method B",
    )  # fmt: skip


def _contact_ratio_factor(e1: float, e2: float) -> float:
    """Return X_eps of the tip contact ratios of pinion and gear [-]."""
    e = e1 + e2
    if e < 1.0:
        terms = e1 * e1 + e2 * e2
    elif e < 2.0 and max(e1, e2) < 1.0:
        terms = 0.70 * (e1 * e1 + e2 * e2) - 0.22 * e + 0.52 - 0.60 * e1 * e2
    else:
        high, low = max(e1, e2), min(e1, e2)
        of_both = (0.18, 0.70, 0.82, 0.52, 0.30) if e < 2.0 else (0.44, 0.59, 0.30, 0.30, 0.15)
        a, b, c, d, f = of_both
        terms = a * high * high + b * low * low + c * high - d * low - f * e1 * e2
    return terms / (2.0 * e * e1)
