"""Common factors of pitting and bending of cylindrical and bevel gears; N, mm, MPa, um."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.rating.gears import Gears, RatedGear, StrengthRating
from gearlube_core.rating.life import Line, strength, strength_line
from gearlube_core.rating.pairs import MM, MPA, UM, Factors, Pair, both, said

_LAYERS = {"nitrided": 0.1005, "through_hardened": 0.0014}  # rho' [mm], from memory
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
    gears: Gears, oil_viscosity: float, speed: float, radius: float, further: float
) -> tuple[tuple[Line, Line], Factors, tuple[str, ...]]:
    """Return sigma_HG over cycles [Pa], its factors, and what is missing.

    At few cycles Z_L, Z_v, Z_R and Z_W fade out to 1; Z_X is 1. Source: [iso_6336_2].
    """
    softer = MPA * min(g.contact_limit for g in gears)
    C = min(max(softer / 4375.0 + 0.6357, 0.83), 0.91)
    Z_L = C + 4.0 * (1.0 - C) / (1.2 + 134.0 / (1e6 * oil_viscosity)) ** 2
    Z_v = C + 0.02 + 2.0 * (0.98 - C) / math.sqrt(0.8 + 32.0 / speed)
    R_z10 = 0.5 * UM * sum(g.flank_roughness for g in gears) * (10.0 / radius) ** (1.0 / 3.0)
    Z_R = (3.0 / R_z10) ** min(max(0.32 - 2e-4 * softer, 0.08), 0.15)
    Z_W, missing = _work_hardening(gears, radius, 1e6 * oil_viscosity * speed)
    found: Factors = {"Z_L": Z_L, "Z_v": Z_v, "Z_R": Z_R, "Z_W": Z_W}

    def line(gear: RatedGear, Z_W: float) -> Line:
        limit = gear.contact_limit * further
        return strength_line(gear.contact_life, limit, Z_L * Z_v * Z_R * Z_W)

    return both(line, gears, Z_W), found, missing


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
    if soft_one.brinell is None:
        needed = "brinell of the through-hardened gear is needed for the work hardening factor"
        return (1.0, 1.0), (f"{needed}, got none: Z_W is 1",)
    R_z = UM * hard.flank_roughness
    R_zH = R_z * (10.0 / radius) ** 0.33 * (hard.flank_roughness / soft_one.flank_roughness) ** 0.66
    R_zH = min(max(R_zH / (film / 1500.0) ** 0.33, 3.0), 16.0)
    hardness = min(max(soft_one.brinell, 130.0), 470.0)
    Z_W = (1.2 - (hardness - 130.0) / 1700.0) * (3.0 / R_zH) ** 0.15
    memory = ("the equivalent roughness of work hardening, R_zH, is a formula from memory",)
    return ((Z_W, 1.0) if which == 0 else (1.0, Z_W)), memory


class ToothForm(NamedTuple):
    """Form of a tooth root."""

    Y_F: float
    Y_S: float
    q_s: float
    s_Fn: float  # in normal modules
    h_Fe: float
    rho_F: float


def tooth_form(
    z: float, alpha: float, rho: float, depth: float, shift: float, *, addendum: float,
    thickness: float = 0.0, left: float = 0.0, contact_ratio: float = 1.0,
) -> ToothForm:  # fmt: skip
    """Return the form of a spur tooth in the normal section; lengths in normal modules.

    Source: [iso_6336_3], [iso_10300_3]. ParameterError where the root has no tangent at 30 degrees.

    Parameters
    ----------
    z, alpha
        Virtual teeth and pressure angle [-], [rad].
    rho, depth, left
        Of the tool: tip radius, addendum, protuberance less the grinding stock.
    shift, thickness, addendum
        Of the tooth: x or x_h, x_s, height of its tip above the reference circle.
    contact_ratio
        epsilon_alpha n, for load at the outer point of single contact; 1: at the tip.
    """
    G = rho - depth + shift
    E = math.pi / 4.0 - thickness - depth * math.tan(alpha)
    E += (left - (1.0 - math.sin(alpha)) * rho) / math.cos(alpha)
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
    reach = 0.5 * math.sqrt((z + 2.0 * addendum) ** 2 - d_b**2)
    d_e = 2.0 * math.hypot(reach - step, 0.5 * d_b)
    a_e = math.acos(min(d_b / d_e, 1.0))
    half = (math.pi / 2.0 + 2.0 * (shift * math.tan(alpha) + thickness)) / z
    turn = half + math.tan(alpha) - alpha - math.tan(a_e) + a_e
    a_F = a_e - turn
    arm = (math.cos(turn) - math.sin(turn) * math.tan(a_F)) * d_e
    h = 0.5 * (arm - z * math.cos(math.pi / 3.0 - th) - G / math.cos(th) + rho)
    Y_F = 6.0 * h * math.cos(a_F) / (s_Fn**2 * math.cos(alpha))
    L, q_s = s_Fn / h, s_Fn / (2.0 * rho_F)
    Y_S = (1.2 + 0.13 * L) * min(max(q_s, 1.0), 8.0) ** (1.0 / (1.21 + 2.3 / L))
    return ToothForm(Y_F, Y_S, q_s, s_Fn, h, rho_F)


def _root_factors(gear: RatedGear, q_s: float, module: float) -> dict[str, float]:
    """Return the factors of sigma_FG [-] of the notch parameter and the module [mm].

    All count at any number of cycles, on the safe side where they are below 1; [iso_6336_3].
    """
    layer = _LAYERS.get(gear.steel, _HARD_LAYER)
    rho = layer if gear.slip_layer is None else MM * gear.slip_layer
    notch = (1.0 + math.sqrt(0.2 * rho * (1.0 + 2.0 * q_s))) / (1.0 + math.sqrt(1.2 * rho))
    most, less, power = _ROUGH_NITRIDED if gear.steel == "nitrided" else _ROUGH
    rough = most - less * (min(max(UM * gear.root_roughness, 1.0), 40.0) + 1.0) ** power
    most, slope, least = _SIZE.get(gear.treatment, _HARD_SIZE)
    size = min(max(most - slope * module, least), 1.0)
    return {"Y_drelT": notch, "Y_RrelT": rough, "Y_X": size, "Y_M": gear.mean_stress}


def strength_rating(
    gears: Gears, cycles: Pair, K: Mapping[str, float], forms: tuple[ToothForm, ToothForm], *,
    sigma_H0: float, sigma_F: float, module: float, film: tuple[float, float, float, float],
    found: Factors, outside: tuple[str, ...], standard: str,
    Z_BD: Pair = (1.0, 1.0), Y_B: Pair = (1.0, 1.0),
) -> StrengthRating:  # fmt: skip
    """Return the rating of nominal stresses [MPa] with load factors.

    sigma_F is F/(b m_n) with the Y factors of both members. `film` is the viscosity at 40 degC
    [m2/s], the speed of Z_v [m/s], the relative radius of curvature at the pitch point [mm], and
    the product of factors that the standard has besides.
    """
    shock = K["K_A"] * K["K_gam"]
    stress = sigma_H0 * math.sqrt(shock * K["K_v"] * K["K_Hb"] * K["K_Ha"]) / MPA
    sigma_F0 = both(lambda form, rim: sigma_F * form.Y_F * form.Y_S * rim, forms, Y_B)
    loads = shock * K["K_v"] * K["K_Fb"] * K["K_Fa"] / MPA
    contact, of_film, missing = _contact_lines(gears, *film)
    q_s = both(lambda form: form.q_s, forms)
    roots = both(lambda g, q: _root_factors(g, q, module), gears, q_s)
    first, second = (form._asdict() | root for form, root in zip(forms, roots, strict=True))
    limits = both(lambda g, root: 2.0 * g.bending_limit * math.prod(root.values()), gears, roots)
    bending = both(lambda g, limit: strength_line(g.bending_life, limit, 1.0), gears, limits)
    R_z = both(lambda g: UM * g.root_roughness, gears)
    from_memory = [g.slip_layer is None and g.steel in _LAYERS for g in gears]
    notched = said(
        *((1.0 <= q < 8.0, f"notch parameter q_s within 1 to 8, got {q:.2f}") for q in q_s),
        *((one <= 40.0, f"root roughness R_z up to 40 um, got {one:.0f} um") for one in R_z),
        (not any(from_memory), "the slip layer rho' of this steel is from memory; give slip_layer"),
    )
    return StrengthRating(
        contact_stress=both(lambda Z_B: Z_B * stress, Z_BD),
        bending_stress=both(lambda s: s * loads, sigma_F0),
        contact_lines=contact,
        bending_lines=bending,
        cycles=cycles,
        factors={
            **K, **found, "sigma_H0": sigma_H0, "Z_BD": Z_BD, "Y_B": Y_B, "sigma_F0": sigma_F0,
            **{name: (first[name], second[name]) for name in first}, **of_film,
            "Z_NT": both(lambda g, n: strength(g.contact_life, n), gears, cycles),
            "Y_NT": both(lambda g, n: strength(g.bending_life, n), gears, cycles),
        },
        outside=outside + missing + notched,
        standard=standard,
    )  # fmt: skip
