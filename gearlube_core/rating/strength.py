"""What pitting and bending of cylindrical and bevel gears share; N, mm, MPa, um."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.rating.gears import (
    MM,
    MPA,
    UM,
    Factors,
    Gears,
    Pair,
    RatedGear,
    StrengthRating,
    both,
    said,
)
from gearlube_core.rating.life import Line, strength, strength_line

_LAYERS = {"nitrided": 0.1005, "through_hardened": 0.0014}  # rho' [mm]
_HARD_LAYER = 0.0030
# factor, constant and exponent of Y_R rel T
_ROUGH, _ROUGH_NITRIDED = (1.674, 0.529, 0.1), (4.299, 3.259, 0.0058)
_SIZE = {"through_hardened": (1.03, 0.006, 0.85)}  # Y_X: at 0, per mm of module, least
_HARD_SIZE = (1.05, 0.01, 0.80)


def elasticity_factor(gears: Gears) -> float:
    """Return Z_E [MPa^0.5]."""
    softness = sum((1.0 - g.poisson_ratio**2) / (MPA * g.modulus) for g in gears)
    return math.sqrt(1.0 / (math.pi * softness))


def _contact_lines(
    gears: Gears, *, oil_viscosity: float, speed: float, radius: float, further: float = 1.0
) -> tuple[tuple[Line, Line], Factors, tuple[str, ...]]:
    """Return sigma_HG over cycles [Pa], its factors, and what is missing.

    At few cycles Z_L, Z_v, Z_R and Z_W fade out to 1; Z_X is 1. Source: [iso_6336_2].

    Parameters
    ----------
    oil_viscosity, speed
        At 40 degC [m2/s]; of Z_v [m/s].
    radius
        Relative radius of curvature at the pitch point [mm].
    further
        Product of factors that the standard has besides [-].
    """
    softer = MPA * min(g.contact_limit for g in gears)
    C = min(max(softer / 4375.0 + 0.6357, 0.83), 0.91)
    Z_L = C + 4.0 * (1.0 - C) / (1.2 + 134.0 / (1e6 * oil_viscosity)) ** 2
    Z_v = C + 0.02 + 2.0 * (0.98 - C) / math.sqrt(0.8 + 32.0 / speed)
    R_z10 = 0.5 * UM * sum(g.flank_roughness for g in gears) * (10.0 / radius) ** (1.0 / 3.0)
    Z_R = (3.0 / R_z10) ** min(max(0.32 - 2e-4 * softer, 0.08), 0.15)
    Z_W, missing = _work_hardening(gears, radius, 1e6 * oil_viscosity * speed)
    film = Z_L * Z_v * Z_R

    def line(gear: RatedGear, hardened: float) -> Line:
        limit = gear.contact_limit * further
        return strength_line(gear.contact_life, limit, film * hardened)

    lines = line(gears[0], Z_W[0]), line(gears[1], Z_W[1])
    return lines, {"Z_L": Z_L, "Z_v": Z_v, "Z_R": Z_R, "Z_W": Z_W}, missing


def _work_hardening(gears: Gears, radius: float, film: float) -> tuple[Pair, tuple[str, ...]]:
    """Return Z_W of both members: the soft one gains where the other is hard and smooth.

    Its equivalent roughness R_zH, 3 to 16 um, is from memory, and the rating says so; `film` is the
    viscosity at 40 degC times the speed [mm2/s m/s].
    """
    soft = [g.treatment == "through_hardened" for g in gears]
    if soft[0] == soft[1]:
        return (1.0, 1.0), ()
    which = soft.index(True)
    soft_one, hard = gears[which], gears[1 - which]
    hardness = soft_one.brinell
    if hardness is None:
        return (1.0, 1.0), (
            "brinell of the through-hardened gear is needed for the work hardening factor, got "
            "none: Z_W is 1",
        )
    R_z = UM * hard.flank_roughness
    R_zH = R_z * (10.0 / radius) ** 0.33 * (hard.flank_roughness / soft_one.flank_roughness) ** 0.66
    R_zH = min(max(R_zH / (film / 1500.0) ** 0.33, 3.0), 16.0)
    Z_W = (1.2 - (min(max(hardness, 130.0), 470.0) - 130.0) / 1700.0) * (3.0 / R_zH) ** 0.15
    said_of = ("the equivalent roughness of work hardening, R_zH, is a formula from memory",)
    return ((Z_W, 1.0) if which == 0 else (1.0, Z_W)), said_of


class ToothForm(NamedTuple):
    """Form of a tooth root."""

    Y_F: float
    Y_S: float
    q_s: float
    s_Fn: float  # in normal modules
    h_Fe: float
    rho_F: float


def tooth_form(
    z: float,
    alpha: float,
    E: float,
    G: float,
    rho: float,
    *,
    tip_diameter: float,
    half_angle: float,
    contact_ratio: float = 1.0,
) -> ToothForm:
    """Return the form of a spur tooth in the normal section; lengths in normal modules.

    Parameters
    ----------
    z, alpha
        Virtual teeth and pressure angle [-], [rad].
    E, G, rho
        Auxiliary sizes of the tool and its tip radius.
    tip_diameter
        d_an.
    half_angle
        Half of the angle of the tooth at its reference circle [rad].
    contact_ratio
        epsilon_alpha n, for load at the outer point of single contact; 1: at the tip.

    Raises
    ------
    ParameterError
        The root has no tangent at 30 degrees.

    Notes
    -----
    Source: [iso_6336_3], [iso_10300_3].
    """
    H = 2.0 / z * (math.pi / 2.0 - E) - math.pi / 3.0
    try:
        th = brentq(lambda t: t - 2.0 * G / z * math.tan(t) + H, 0.0, 0.49 * math.pi)
    except ValueError as error:
        raise ParameterError(
            f"The root of a tooth must have a 30 degree tangent, got none with {z:.1f} virtual "
            "teeth. Check teeth, profile shift and tool: the formulas end here."
        ) from error
    s_Fn = z * math.sin(math.pi / 3.0 - th) + math.sqrt(3.0) * (G / math.cos(th) - rho)
    rho_F = rho + 2.0 * G * G / (math.cos(th) * (z * math.cos(th) ** 2 - 2.0 * G))
    d_b, step = z * math.cos(alpha), math.pi * math.cos(alpha) * (contact_ratio - 1.0)
    d_e = 2.0 * math.hypot(0.5 * math.sqrt(tip_diameter**2 - d_b**2) - step, 0.5 * d_b)
    a_e = math.acos(min(d_b / d_e, 1.0))
    turn = half_angle + math.tan(alpha) - alpha - math.tan(a_e) + a_e
    a_F = a_e - turn
    arm = (math.cos(turn) - math.sin(turn) * math.tan(a_F)) * d_e
    h = 0.5 * (arm - z * math.cos(math.pi / 3.0 - th) - G / math.cos(th) + rho)
    Y_F = 6.0 * h * math.cos(a_F) / (s_Fn**2 * math.cos(alpha))
    L, q_s = s_Fn / h, s_Fn / (2.0 * rho_F)
    Y_S = (1.2 + 0.13 * L) * min(max(q_s, 1.0), 8.0) ** (1.0 / (1.21 + 2.3 / L))
    return ToothForm(Y_F, Y_S, q_s, s_Fn, h, rho_F)


def _bending_lines(
    gears: Gears, q_s: Pair, module: float
) -> tuple[tuple[Line, Line], Factors, tuple[str, ...]]:
    """Return sigma_FG over cycles [Pa], its factors, and where they leave their range.

    All factors count at any number of cycles, on the safe side where they are below 1; q_s is the
    notch parameter, the module [mm]. Source: [iso_6336_3].
    """

    def notch(gear: RatedGear, q: float) -> float:
        layer = _LAYERS.get("nitrided" if gear.nitrided else gear.treatment, _HARD_LAYER)
        rho = layer if gear.slip_layer is None else MM * gear.slip_layer
        return (1.0 + math.sqrt(0.2 * rho * (1.0 + 2.0 * q))) / (1.0 + math.sqrt(1.2 * rho))

    def rough(gear: RatedGear, _: float) -> float:
        most, less, power = _ROUGH_NITRIDED if gear.nitrided else _ROUGH
        return most - less * (min(max(UM * gear.root_roughness, 1.0), 40.0) + 1.0) ** power

    def size(gear: RatedGear, _: float) -> float:
        most, slope, least = _SIZE.get(gear.treatment, _HARD_SIZE)
        return min(max(most - slope * module, least), 1.0)

    Y_drelT, Y_RrelT, Y_X = (both(one, gears, q_s) for one in (notch, rough, size))
    Y_M = gears[0].mean_stress, gears[1].mean_stress
    lines = []
    for gear, *factors in zip(gears, Y_drelT, Y_RrelT, Y_X, Y_M, strict=True):
        limit = 2.0 * gear.bending_limit * math.prod(factors)
        lines.append(tuple((n, limit * life) for n, life in gear.bending_life))
    outside = said(
        *((1.0 <= q < 8.0, f"notch parameter q_s within 1 to 8, got {q:.2f}") for q in q_s),
        *(
            (R_z <= 40.0, f"root roughness R_z up to 40 um, got {R_z:.0f} um")
            for R_z in both(lambda g: UM * g.root_roughness, gears)
        ),
        (
            all(
                g.slip_layer is not None or not (g.nitrided or g.treatment in _LAYERS)
                for g in gears
            ),
            "the slip layer rho' of this steel is from memory; give slip_layer",
        ),
    )
    found: Factors = {"Y_drelT": Y_drelT, "Y_RrelT": Y_RrelT, "Y_X": Y_X, "Y_M": Y_M}
    return (lines[0], lines[1]), found, outside


def strength_rating(
    gears: Gears,
    cycles: Pair,
    K: Mapping[str, float],
    *,
    sigma_H0: float,
    Z_BD: Pair,
    sigma_F: float,
    Y_F: Pair,
    forms: tuple[ToothForm, ToothForm],
    Y_B: Pair,
    module: float,
    film: Mapping[str, float],
    found: Factors,
    outside: tuple[str, ...],
    standard: str,
) -> StrengthRating:
    """Return the rating of nominal stresses [MPa], load factors and conditions of the film.

    sigma_F is F/(b m_n) with the Y factors of both members; `film` is as for the contact strength.
    """
    shock = K["K_A"] * K["K_gam"]
    stress = sigma_H0 * math.sqrt(shock * K["K_v"] * K["K_Hb"] * K["K_Ha"]) / MPA
    sigma_F0 = both(lambda Y, form, rim: sigma_F * Y * form.Y_S * rim, Y_F, forms, Y_B)
    loads = shock * K["K_v"] * K["K_Fb"] * K["K_Fa"] / MPA
    contact, strength_H, missing = _contact_lines(gears, **film)
    bending, strength_F, notched = _bending_lines(gears, both(lambda f: f.q_s, forms), module)
    form = {
        name: (getattr(forms[0], name), getattr(forms[1], name)) for name in ToothForm._fields[1:]
    }
    return StrengthRating(
        contact_stress=both(lambda Z_B: Z_B * stress, Z_BD),
        bending_stress=both(lambda s: s * loads, sigma_F0),
        contact_lines=contact,
        bending_lines=bending,
        cycles=cycles,
        factors={
            **K, **found, "sigma_H0": sigma_H0, "Z_BD": Z_BD, "Y_F": Y_F, **form, "Y_B": Y_B,
            "sigma_F0": sigma_F0, **strength_H, **strength_F,
            "Z_NT": both(lambda g, n: strength(g.contact_life, n), gears, cycles),
            "Y_NT": both(lambda g, n: strength(g.bending_life, n), gears, cycles),
        },
        outside=outside + missing + notched,
        standard=standard,
    )  # fmt: skip
