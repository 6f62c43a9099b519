"""Pitting and bending strength of cylindrical gears by the formulas of ISO 6336, method B.

Calculated as implemented here, from published worked examples; check a design against the standard.
Inside, formulas of the standard are in N, mm, MPa, um; what goes in and comes out is in SI.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated

from scipy.optimize import brentq

from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.iso_6336_stiffness import (
    iso_stiffness,
    rack_dedendum_of,
    virtual_teeth,
)
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.number import Checked, Number
from gearlube_core.rating.life import BENDING, PITTING, TREATMENTS, life_factor

EDITIONS = ("2006", "2019")
Pair = tuple[float, float]  # of pinion and gear
_MM, _MPA, _UM = 1e3, 1e-6, 1e6


@dataclass(frozen=True, slots=True, kw_only=True)
class GearMaterial(Checked):
    """Strength of a gear material; ISO 6336-5 has such numbers, or a test.

    Parameters
    ----------
    treatment
        One of `TREATMENTS`.
    contact_limit
        sigma_H lim [Pa].
    bending_limit
        Nominal stress sigma_F lim [Pa].
    brinell
        Of a soft wheel that meshes with a hard pinion [-]; 0: no work hardening.
    """

    treatment: str
    contact_limit: Annotated[float, Number("Pa", 1e8, 3e9, "1500 MPa is 1.5e9 Pa.")]
    bending_limit: Annotated[float, Number("Pa", 2e7, 1e9, "430 MPa is 4.3e8 Pa.")]
    brinell: Annotated[float, Number("1", 0.0, 800.0, "130 to 470 is usual.")] = 0.0

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        check_option("treatment", self.treatment, TREATMENTS)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToothQuality(Checked):
    """Deviations and roughness of one gear.

    Parameters
    ----------
    pitch_deviation, profile_deviation
        Of a single pitch f_pb and of the profile form f_f alpha [m].
    flank_roughness, root_roughness
        Mean peak to valley R_z [m].
    """

    pitch_deviation: Annotated[float, Number("m", 0.0, 2e-3, "13 um is 1.3e-5 m.")] = 10e-6
    profile_deviation: Annotated[float, Number("m", 0.0, 2e-3, "13 um is 1.3e-5 m.")] = 12e-6
    flank_roughness: Annotated[float, Number("m", 1e-7, 2e-4, "6 um is 6e-6 m.")] = 5e-6
    root_roughness: Annotated[float, Number("m", 1e-7, 4e-4, "20 um is 2e-5 m.")] = 20e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadFactors(Checked):
    """Load factors of ISO 6336-1; None: by its formulas.

    Parameters
    ----------
    application, mesh_load
        K_A and K_gamma [-].
    dynamic, transverse, transverse_root
        K_v, K_H alpha, K_F alpha [-].
    face, face_root
        K_H beta, K_F beta [-]: greatest over mean line load; K_F beta from K_H beta if left out.
    """

    application: Annotated[float, Number("1", 0.1, 10.0, "1 to 2 is usual.")] = 1.0
    mesh_load: Annotated[float, Number("1", 1.0, 2.0, "1 with one path of power.")] = 1.0
    dynamic: float | None = None
    face: Annotated[float, Number("1", 1.0, 10.0, "1.05 to 1.5 is usual.")] = 1.15
    face_root: float | None = None
    transverse: float | None = None
    transverse_root: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StrengthRating:
    """Stresses and strengths [Pa] of pinion and gear against pitting and tooth breakage.

    Parameters
    ----------
    contact_stress, contact_strength, bending_stress, bending_strength
        sigma_H, sigma_HG, sigma_F, sigma_FG [Pa].
    cycles
        Of load on a tooth [-].
    factors
        All that they are from, by the standard's symbols, of the mesh or of pinion and gear; in
        N, mm, MPa, um.
    outside
        Limits of the method that the gears exceed, in words.
    edition
        Of the standard, with the letter of its method.
    """

    contact_stress: Pair
    contact_strength: Pair
    bending_stress: Pair
    bending_strength: Pair
    cycles: Pair
    factors: dict[str, float | Pair] = field(repr=False)
    outside: tuple[str, ...]
    edition: str = "ISO 6336-1, -2, -3:2006, method B"

    @property
    def contact_safety(self) -> Pair:
        """S_H [-]."""
        return _over(self.contact_strength, self.contact_stress)

    @property
    def bending_safety(self) -> Pair:
        """S_F [-]."""
        return _over(self.bending_strength, self.bending_stress)


def _over(above: Pair, below: Pair) -> Pair:
    return above[0] / below[0], above[1] / below[1]


def cylindrical_rating(
    pair: HelicalPair,
    *,
    pinion_torque: float,
    pinion_speed: float,
    cycles: Pair,
    materials: tuple[GearMaterial, GearMaterial],
    quality: tuple[ToothQuality, ToothQuality],
    oil_viscosity: float,
    factors: LoadFactors | None = None,
    tip_relief: float | None = None,
    bore: Pair = (0.0, 0.0),
    density: float = 7850.0,
    modulus: float = 206e9,
    poisson_ratio: float = 0.3,
) -> StrengthRating:
    """Return stress and strength of both members at one load.

    Parameters
    ----------
    pair
        Tool and dedendum of its rack follow from its root radii and `fillet_factor`.
    pinion_torque, pinion_speed
        [N.m], [rad/s], both above 0.
    cycles
        Of load on a tooth of pinion and gear [-].
    materials, quality
        Of pinion and gear.
    oil_viscosity
        At 40 degC [m2/s].
    factors
        None: K_H beta 1.15, others by formulas.
    tip_relief
        C_a of both members together [m]; None: what running-in takes off.
    bore
        Inner diameters of the bodies [m].
    density, modulus, poisson_ratio
        Of both gears [kg/m3], [Pa], [-].

    Raises
    ------
    ParameterError

    Notes
    -----
    Source: [iso_6336_1] [iso_6336_2] [iso_6336_3], checked with [iso_tr_6336_30 example 1]. The
    work hardening Z_W is without its factor of roughness; Z_X is 1. At few cycles Z_L, Z_v, Z_R and
    Z_W fade out to 1.

    Examples
    --------
    See `gearlube damage`.
    """
    check_positive("pinion_torque", pinion_torque, "N.m", "Give its amount for either flank.")
    check_positive("pinion_speed", pinion_speed, "rad/s", "1000 rpm is 104.7 rad/s.")
    check_within("oil_viscosity", oil_viscosity, 1e-6, 5e-3, "m2/s", "220 mm2/s is 2.2e-4 m2/s.")
    given = factors or LoadFactors()
    z = pair.pinion_teeth, pair.gear_teeth
    u = pair.ratio
    d1 = 2.0 * _MM * pair.pinion_reference_radius
    b, m_n = _MM * pair.face_width, _MM * pair.normal_module
    F_t = 2e3 * pinion_torque / d1
    n1 = pinion_speed * 30.0 / math.pi
    v = pinion_speed * pair.pinion_reference_radius
    w = F_t * given.application * given.mesh_load / b
    iso = iso_stiffness(pair, line_load=1e3 * w, modulus=(modulus, modulus))
    c_single, c_mesh = 1e-9 * iso.single, 1e-9 * iso.mesh
    eps_a, eps_b = pair.transverse_contact_ratio, pair.overlap_ratio
    limits = _MPA * materials[0].contact_limit, _MPA * materials[1].contact_limit

    K_v = given.dynamic
    dynamics: dict[str, float | Pair] = {}
    if K_v is None:
        relief = _UM * tip_relief if tip_relief is not None else _run_in_relief(limits)
        inner = _MM * bore[0], _MM * bore[1]
        K_v, dynamics = _dynamic_factor(
            pair, quality, materials, w=w, n1=n1, c_single=c_single, c_mesh=c_mesh,
            relief=relief, inner=inner, density=density * 1e-9,
        )  # fmt: skip
    K_Hb = given.face
    r = max(3.0, pair.face_width / (pair.pinion_tip_radius - pair.pinion_root_radius))
    K_Fb = given.face_root or K_Hb ** (r * r / (1.0 + r + r * r))
    Z_eps = _contact_ratio_factor(eps_a, eps_b)
    K_Ha, K_Fa = _transverse_factors(
        pair, quality, materials, load=w * K_v * K_Hb, c_mesh=c_mesh, Z_eps=Z_eps
    )
    K_Ha, K_Fa = given.transverse or K_Ha, given.transverse_root or K_Fa
    common = given.application * given.mesh_load * K_v

    # pitting
    alpha_t, alpha_w = pair.transverse_pressure_angle, pair.working_pressure_angle
    Z_H = math.sqrt(
        2.0 * math.cos(pair.base_helix_angle) * math.cos(alpha_w)
        / (math.cos(alpha_t) ** 2 * math.sin(alpha_w))
    )  # fmt: skip
    Z_E = math.sqrt(_MPA * modulus / (2.0 * math.pi * (1.0 - poisson_ratio**2)))
    Z_beta = 1.0 / math.sqrt(math.cos(pair.helix_angle))
    sigma_H0 = Z_H * Z_E * Z_eps * Z_beta * math.sqrt(F_t * (u + 1.0) / (d1 * b * u))
    Z_BD = _single_contact_factors(pair)
    stress = sigma_H0 * math.sqrt(common * K_Hb * K_Ha)
    sigma_H = Z_BD[0] * stress, Z_BD[1] * stress
    nu40 = 1e6 * oil_viscosity
    rho_red = 1.0 / sum(1.0 / (_MM * r_b * math.tan(alpha_w)) for r_b in _base_radii(pair))
    R_z10 = 0.5 * _UM * sum(q.flank_roughness for q in quality) * (10.0 / rho_red) ** (1.0 / 3.0)
    softer = min(limits)
    C = min(max(softer / 4375.0 + 0.6357, 0.83), 0.91)
    Z_L = C + 4.0 * (1.0 - C) / (1.2 + 134.0 / nu40) ** 2
    Z_v = C + 0.02 + 2.0 * (0.98 - C) / math.sqrt(0.8 + 32.0 / v)
    Z_R = (3.0 / R_z10) ** min(max(0.32 - 2e-4 * softer, 0.08), 0.15)
    Z_W = _work_hardening(materials)
    Z_NT, sigma_HG = [], []
    for one, limit, n, hardened in zip(materials, limits, cycles, Z_W, strict=True):
        knots = PITTING[one.treatment]
        Z_NT.append(float(life_factor(knots, n)))
        share = math.log(n / knots[0][0]) / math.log(knots[1][0] / knots[0][0])
        influence = (Z_L * Z_v * Z_R * hardened) ** min(max(share, 0.0), 1.0)
        sigma_HG.append(limit * Z_NT[-1] * influence)

    # breakage
    teeth = [_tooth_form(pair, member) for member in (0, 1)]
    Y_beta = 1.0 - min(eps_b, 1.0) * min(math.degrees(pair.helix_angle), 30.0) / 120.0
    by_member: dict[str, list[float]] = {}
    for one, q, n, (Y_F, Y_S, q_s) in zip(materials, quality, cycles, teeth, strict=True):
        rounding = _notch_depth(one)
        R_z = _UM * q.root_roughness
        values = {
            "Y_F": Y_F,
            "Y_S": Y_S,
            "sigma_F0": F_t / (b * m_n) * Y_F * Y_S * Y_beta,
            "Y_NT": float(life_factor(BENDING[one.treatment], n)),
            "Y_drelT": (1.0 + math.sqrt(0.2 * rounding * (1.0 + 2.0 * q_s)))
            / (1.0 + math.sqrt(1.2 * rounding)),
            "Y_RrelT": 1.674 - 0.529 * (max(R_z, 1.0) + 1.0) ** 0.1,
            "Y_X": _size_factor(one, m_n),
        }
        values["sigma_F"] = values["sigma_F0"] * common * K_Fb * K_Fa
        strength = 2.0 * _MPA * one.bending_limit
        for name in ("Y_NT", "Y_drelT", "Y_RrelT", "Y_X"):
            strength *= values[name]
        values["sigma_FG"] = strength
        for name, value in values.items():
            by_member.setdefault(name, []).append(value)
    found: dict[str, float | Pair] = {
        "F_t": F_t, "v": v, "c'": c_single, "c_ga": c_mesh, "eps_a": eps_a, "eps_b": eps_b,
        "K_A": given.application, "K_gam": given.mesh_load, "K_v": K_v, "K_Hb": K_Hb,
        "K_Fb": K_Fb, "K_Ha": K_Ha, "K_Fa": K_Fa, "Z_H": Z_H, "Z_E": Z_E, "Z_eps": Z_eps,
        "Z_beta": Z_beta, "Z_BD": Z_BD, "sigma_H0": sigma_H0, "Z_L": Z_L, "Z_v": Z_v, "Z_R": Z_R,
        "Z_W": Z_W, "Z_NT": (Z_NT[0], Z_NT[1]), "Y_beta": Y_beta, **dynamics,
        **{name: (one[0], one[1]) for name, one in by_member.items()},
    }  # fmt: skip
    si = 1.0 / _MPA
    return StrengthRating(
        contact_stress=(si * sigma_H[0], si * sigma_H[1]),
        contact_strength=(si * sigma_HG[0], si * sigma_HG[1]),
        bending_stress=(si * by_member["sigma_F"][0], si * by_member["sigma_F"][1]),
        bending_strength=(si * by_member["sigma_FG"][0], si * by_member["sigma_FG"][1]),
        cycles=cycles,
        factors=found,
        outside=_outside(pair, v) + iso.outside,
    )


def _outside(pair: HelicalPair, v: float) -> tuple[str, ...]:
    eps, helix = pair.transverse_contact_ratio, math.degrees(pair.helix_angle)
    limits = (
        (1.0 < eps < 2.5, f"transverse contact ratio within 1 to 2.5, got {eps:.3f}"),
        (helix <= 30.0, f"helix angle up to 30 deg, got {helix:.1f} deg"),
        (v <= 60.0, f"pitch line speed up to 60 m/s, got {v:.1f} m/s"),
    )
    return tuple(text for holds, text in limits if not holds)


def _base_radii(pair: HelicalPair) -> Pair:
    return pair.pinion_base_radius, pair.gear_base_radius


def _run_in_relief(limits: Pair) -> float:
    """Return C_ay [um], the mean of both members."""
    return 0.5 * sum((limit / 97.0 - 18.45) ** 2 / 18.0 + 1.5 for limit in limits)


def _left(deviation: float, material: GearMaterial) -> float:
    """Return a deviation [um] after running-in."""
    if material.treatment == "through_hardened":
        return deviation * (1.0 - min(160.0 / (_MPA * material.contact_limit), 1.0))
    return deviation - min(0.075 * deviation, 3.0)


def _worst(
    quality: tuple[ToothQuality, ToothQuality], materials: tuple[GearMaterial, GearMaterial]
) -> tuple[float, float]:
    """Return the larger pitch and profile deviations of both members [um], run in."""
    both = list(zip(quality, materials, strict=True))
    pitch = max(_left(_UM * q.pitch_deviation, one) for q, one in both)
    return pitch, max(_left(_UM * q.profile_deviation, one) for q, one in both)


def _dynamic_factor(
    pair: HelicalPair,
    quality: tuple[ToothQuality, ToothQuality],
    materials: tuple[GearMaterial, GearMaterial],
    *,
    w: float,
    n1: float,
    c_single: float,
    c_mesh: float,
    relief: float,
    inner: Pair,
    density: float,
) -> tuple[float, dict[str, float | Pair]]:
    mean = [
        _MM * (pair.pinion_tip_radius + pair.pinion_root_radius),
        _MM * (pair.gear_tip_radius + pair.gear_root_radius),
    ]
    solid = [density * (1.0 - (i / d) ** 4) for i, d in zip(inner, mean, strict=True)]
    base = 2.0 * _MM * pair.pinion_base_radius
    inverse = 1.0 / solid[0] + 1.0 / (solid[1] * pair.ratio**2)
    m_red = math.pi / 8.0 * (mean[0] / base) ** 2 * mean[0] ** 2 / inverse
    n_E1 = 3e4 / (math.pi * pair.pinion_teeth) * math.sqrt(c_mesh / (m_red * 1e-0))
    N = n1 / n_E1
    pitch, profile = _worst(quality, materials)
    B_p, B_f, B_k = c_single * pitch / w, c_single * profile / w, abs(1.0 - c_single * relief / w)
    e = pair.total_contact_ratio
    C_1, C_2, C_3, C_4, C_5, C_6 = 0.32, 0.34, 0.23, 0.90, 0.47, 0.47
    if e > 2.0:
        C_2, C_3 = 0.57 / (e - 0.3), 0.096 / (e - 1.56)
        C_4, C_6 = (0.57 - 0.05 * e) / (e - 1.44), 0.12 / (e - 1.74)
    C_7 = 0.75 if e <= 1.5 else 0.125 * math.sin(math.pi * (e - 2.0)) + 0.875 if e <= 2.5 else 1.0
    N_S = 0.85 if w >= 100.0 else 0.5 + 0.35 * math.sqrt(w / 100.0)
    resonant = 1.0 + C_1 * B_p + C_2 * B_f + C_4 * B_k
    above = C_5 * B_p + C_6 * B_f + C_7
    if N <= N_S:
        K_v = 1.0 + N * (C_1 * B_p + C_2 * B_f + C_3 * B_k)
    elif N <= 1.15:
        K_v = resonant
    else:
        K_v = above + max(1.5 - N, 0.0) / 0.35 * (resonant - above)
    return K_v, {"m_red": m_red, "n_E1": n_E1, "N": N, "B_p": B_p, "B_f": B_f, "B_k": B_k}


def _transverse_factors(
    pair: HelicalPair,
    quality: tuple[ToothQuality, ToothQuality],
    materials: tuple[GearMaterial, GearMaterial],
    *,
    load: float,
    c_mesh: float,
    Z_eps: float,
) -> Pair:
    X = c_mesh * max(_worst(quality, materials)) / load
    e, e_a = pair.total_contact_ratio, pair.transverse_contact_ratio
    K = 0.5 * e * (0.9 + 0.4 * X) if e <= 2.0 else 0.9 + 0.4 * math.sqrt(2.0 * (e - 1.0) / e) * X
    most_H, most_F = e / (e_a * Z_eps**2), e / (0.25 * e_a + 0.75)
    return min(max(K, 1.0), max(most_H, 1.0)), min(max(K, 1.0), max(most_F, 1.0))


def _contact_ratio_factor(eps_a: float, eps_b: float) -> float:
    if eps_b >= 1.0:
        return math.sqrt(1.0 / eps_a)
    return math.sqrt((4.0 - eps_a) / 3.0 * (1.0 - eps_b) + eps_b / eps_a)


def _single_contact_factors(pair: HelicalPair) -> Pair:
    """Return Z_B and Z_D [-], for the inner points of single contact of pinion and gear."""
    r1 = math.sqrt((pair.pinion_tip_radius / pair.pinion_base_radius) ** 2 - 1.0)
    r2 = math.sqrt((pair.gear_tip_radius / pair.gear_base_radius) ** 2 - 1.0)
    p1, p2 = 2.0 * math.pi / pair.pinion_teeth, 2.0 * math.pi / pair.gear_teeth
    more, tangent = pair.transverse_contact_ratio - 1.0, math.tan(pair.working_pressure_angle)
    M1 = tangent / math.sqrt((r1 - p1) * (r2 - more * p2))
    M2 = tangent / math.sqrt((r2 - p2) * (r1 - more * p1))
    line = max(1.0 - pair.overlap_ratio, 0.0)
    return max(1.0, 1.0 + line * (M1 - 1.0)), max(1.0, 1.0 + line * (M2 - 1.0))


def _work_hardening(materials: tuple[GearMaterial, GearMaterial]) -> Pair:
    """Return Z_W of pinion and gear: a soft wheel that a hard pinion hardens."""
    pinion, gear = materials
    if pinion.treatment == "through_hardened" or gear.treatment != "through_hardened":
        return 1.0, 1.0
    if not gear.brinell:
        return 1.0, 1.0
    return 1.0, 1.2 - (min(max(gear.brinell, 130.0), 470.0) - 130.0) / 1700.0


def _notch_depth(material: GearMaterial) -> float:
    """Return the slip layer rho' [mm] of case hardened or nitrided steel; of others as theirs."""
    return 0.1005 if material.treatment in ("nitrided", "nitrocarburised") else 0.0030


def _size_factor(material: GearMaterial, m_n: float) -> float:
    if material.treatment == "through_hardened":
        return min(max(1.03 - 0.006 * m_n, 0.85), 1.0)
    return min(max(1.05 - 0.01 * m_n, 0.80), 1.0)


def _tooth_form(pair: HelicalPair, member: int) -> tuple[float, float, float]:
    """Return Y_F, Y_S and q_s of the pinion (0) or the gear (1)."""
    m = pair.normal_module
    z_n, x = virtual_teeth(pair)[member], pair.profile_shifts[member]
    tip = (pair.pinion_tip_radius, pair.gear_tip_radius)[member]
    reference = (pair.pinion_reference_radius, pair.gear_reference_radius)[member]
    h_fP, rho, alpha = (
        rack_dedendum_of(pair)[member],
        pair.fillet_factor,
        pair.normal_pressure_angle,
    )
    E = math.pi / 4.0 - h_fP * math.tan(alpha) - (1.0 - math.sin(alpha)) * rho / math.cos(alpha)
    eps_n = pair.transverse_contact_ratio / math.cos(pair.base_helix_angle) ** 2
    return tooth_form(
        z_n, alpha, E, rho - h_fP + x, rho,
        tip_diameter=z_n + 2.0 * (tip - reference) / m,
        contact_ratio=eps_n,
        thickness_angle=(math.pi / 2.0 + 2.0 * x * math.tan(alpha)) / z_n,
    )  # fmt: skip


def tooth_form(
    z_n: float,
    alpha: float,
    E: float,
    G: float,
    rho: float,
    *,
    tip_diameter: float,
    contact_ratio: float,
    thickness_angle: float,
) -> tuple[float, float, float]:
    """Return Y_F, Y_S and q_s of a virtual spur tooth; lengths in normal modules.

    Parameters
    ----------
    z_n, alpha
        Virtual teeth and pressure angle [rad].
    E, G, rho
        Auxiliary sizes of the rack and its edge radius.
    tip_diameter
        d_an.
    contact_ratio
        Load at the outer point of single contact; 1: at the tip.
    thickness_angle
        Half of the angle of the tooth at the reference circle [rad].

    Raises
    ------
    ParameterError
        The root has no 30 degree tangent.

    Notes
    -----
    Source: [iso_6336_3] [iso_10300_3].
    """
    H = 2.0 / z_n * (math.pi / 2.0 - E) - math.pi / 3.0
    try:
        theta = brentq(lambda t: t - 2.0 * G / z_n * math.tan(t) + H, 0.0, 0.49 * math.pi)
    except ValueError as error:
        raise ParameterError(
            f"The root of a tooth must have a 30 degree tangent, got none with {z_n:.1f} virtual "
            "teeth. Check teeth, profile shift and tool: the formulas of the standard end here."
        ) from error
    s_Fn = z_n * math.sin(math.pi / 3.0 - theta)
    s_Fn += math.sqrt(3.0) * (G / math.cos(theta) - rho)
    rho_F = rho + 2.0 * G * G / (math.cos(theta) * (z_n * math.cos(theta) ** 2 - 2.0 * G))
    d_bn, step = z_n * math.cos(alpha), math.pi * math.cos(alpha) * (contact_ratio - 1.0)
    d_en = 2.0 * math.hypot(0.5 * math.sqrt(tip_diameter**2 - d_bn**2) - step, 0.5 * d_bn)
    a_en = math.acos(min(d_bn / d_en, 1.0))
    g_e = thickness_angle + math.tan(alpha) - alpha - math.tan(a_en) + a_en
    a_Fen = a_en - g_e
    arm = (math.cos(g_e) - math.sin(g_e) * math.tan(a_Fen)) * d_en
    h_Fe = 0.5 * (arm - z_n * math.cos(math.pi / 3.0 - theta) - G / math.cos(theta) + rho)
    Y_F = 6.0 * h_Fe * math.cos(a_Fen) / (s_Fn**2 * math.cos(alpha))
    L, q_s = s_Fn / h_Fe, s_Fn / (2.0 * rho_F)
    Y_S = (1.2 + 0.13 * L) * min(max(q_s, 1.0), 8.0) ** (1.0 / (1.21 + 2.3 / L))
    return Y_F, Y_S, q_s
