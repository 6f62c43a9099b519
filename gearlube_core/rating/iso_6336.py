"""Pitting and bending strength of cylindrical gears by the formulas of ISO 6336, method B.

Calculated as implemented here, from published worked examples; check a design against the standard.
Inside, formulas are in N, mm, MPa, um; what goes in and comes out is in SI.
"""

from __future__ import annotations

import math

from gearlube_core.checks import check_option, check_within
from gearlube_core.helical_geometry import iso_6336_stiffness as teeth
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.rating import load_factors as loads
from gearlube_core.rating.gears import Gears, LoadFactors, RatedGear, StrengthRating, check_load
from gearlube_core.rating.pairs import MM, MPA, UM, Pair, both, said
from gearlube_core.rating.strength import ToothForm, elasticity_factor, strength_rating, tooth_form

EDITIONS = ("2006", "2019")


def cylindrical_rating(
    pair: HelicalPair, gears: Gears, factors: LoadFactors, *,
    pinion_torque: float, pinion_speed: float, cycles: Pair, oil_viscosity: float,
    tip_relief: float | None = None, blank_factor: float = 1.0,
    modified: float = 1.2, accurate: bool = False, edition: str = "2006",
) -> StrengthRating:  # fmt: skip
    """Return stress and strength of both members at one load.

    Source: [iso_6336_1] [iso_6336_2] [iso_6336_3], checked with [iso_tr_6336_30 example 1].
    ParameterError where the teeth or the load are none that the formulas hold for.

    Parameters
    ----------
    pair, gears, factors
        External gears, of which tool and dedendum of the rack follow from root radii and
        `fillet_factor`; their material; K factors.
    pinion_torque, pinion_speed
        [N.m], [rad/s], both above 0.
    cycles, oil_viscosity
        Of load on a tooth of pinion and gear [-]; at 40 degC [m2/s].
    tip_relief, blank_factor
        C_a of both members together [m], None: what running-in takes off; C_R of the gear bodies
        [-], see `iso_stiffness`.
    modified
        f_ZCa of edition 2019 [-]: 1 for flanks modified by a solved distribution, 1.07 otherwise
        modified, 1.2 unmodified.
    accurate
        Whether quality 4 or better lets deep teeth share the load: Y_DT below 1.
    edition
        "2006" or "2019"; its Z_B, Y_beta, f_eps, and Y_DT are not checked against the source.

    Examples
    --------
    >>> import gearlube as gl
    >>> pair = gl.HelicalGearFile.named("he_2007").helical_pair()
    >>> gear = gl.rating.RatedGear(
    ...     treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8
    ... )
    >>> rating = gl.rating.cylindrical_rating(
    ...     pair, (gear, gear), gl.rating.LoadFactors(face=1.1),
    ...     pinion_torque=300.0, pinion_speed=200.0, cycles=(5e7, 5e7), oil_viscosity=100e-6,
    ... )
    >>> round(rating.contact_safety[0], 2), rating.standard
    (1.4, 'ISO 6336-1, -2, -3:2006, method B')
    """
    check_load(pinion_torque, pinion_speed, cycles, oil_viscosity)
    check_option("edition", edition, EDITIONS)
    cure = "The formulas need single or double contact of teeth: use longer teeth."
    e_a, helix = pair.transverse_contact_ratio, math.degrees(pair.helix_angle)
    check_within("transverse contact ratio", e_a, 1.0, 4.0, "", cure)
    d1, b = 2.0 * MM * pair.pinion_reference_radius, MM * pair.face_width
    m_n, u = MM * pair.normal_module, pair.ratio
    F_t, v = 2e3 * pinion_torque / d1, pinion_speed * pair.pinion_reference_radius
    w = F_t * factors.shock / b
    moduli = both(lambda g: g.modulus, gears)
    iso = teeth.iso_stiffness(pair, line_load=1e3 * w, modulus=moduli, blank_factor=blank_factor)
    limits = both(lambda g: MPA * g.contact_limit, gears)
    run_in = 0.5 * sum((limit / 97.0 - 18.45) ** 2 / 18.0 + 1.5 for limit in limits)  # C_ay
    relief = run_in if tip_relief is None else UM * tip_relief
    Z, Z_BD = _contact_factors(pair, edition, modified)
    Z_E, per_area = elasticity_factor(gears), F_t * (u + 1.0) / (d1 * b * u)
    e_b, e_n = min(pair.overlap_ratio, 1.0), e_a / math.cos(pair.base_helix_angle) ** 2
    Y_beta, f_eps = 1.0 - e_b * min(helix, 30.0) / 120.0, 1.0
    if edition == "2019":
        Y_beta /= math.cos(pair.helix_angle) ** 3
        deep_spur = e_b == 0.0 and e_n >= 2.0
        f_eps = 0.7 if deep_spur else math.sqrt(1.0 - e_b + e_b / e_n)
    Y_DT = min(max(2.366 - 0.666 * e_n, 0.7), 1.0) if accurate and e_n > 2.05 else 1.0
    K = _load_factors(pair, gears, factors, iso, w, pinion_speed, relief, Z["Z_eps"])
    rims = both(lambda g: g.rim_ratio, gears)
    bases = pair.pinion_base_radius, pair.gear_base_radius
    curvature = sum(1.0 / math.tan(pair.working_pressure_angle) / r for r in bases)
    return strength_rating(
        gears, cycles, K, both(lambda gear, k: _tooth_form(pair, gear, k, f_eps), gears, (0, 1)),
        sigma_H0=Z["Z_H"] * Z_E * Z["Z_eps"] * Z["Z_beta"] * math.sqrt(per_area),
        sigma_F=F_t / (b * m_n) * Y_beta * Y_DT,
        module=m_n,
        film=(oil_viscosity, v, MM / curvature, 1.0),
        found={
            "F_t": F_t, "v": v, "c'": 1e-9 * iso.single, "c_ga": 1e-9 * iso.mesh, **Z, "Z_E": Z_E,
            "Y_beta": Y_beta, "Y_DT": Y_DT,
        },
        outside=said(
            (e_a < 2.5, f"transverse contact ratio below 2.5, got {e_a:.3f}"),
            (helix <= 30.0, f"helix angle up to 30 deg, got {helix:.1f} deg"),
            (v <= 60.0, f"pitch line speed up to 60 m/s, got {v:.1f} m/s"),
        ) + iso.outside,
        standard=f"ISO 6336-1, -2, -3:{edition}, method B",
        Z_BD=Z_BD,
        Y_B=both(lambda one: 1.0 if one >= 1.2 else 1.6 * math.log(2.242 / one), rims),
    )  # fmt: skip


def _load_factors(
    pair: HelicalPair, gears: Gears, given: LoadFactors, iso: teeth.IsoStiffness, w: float,
    pinion_speed: float, relief: float, Z_eps: float,
) -> dict[str, float]:  # fmt: skip
    c_single, c_mesh = 1e-9 * iso.single, 1e-9 * iso.mesh
    mean = (MM * (pair.pinion_tip_radius + pair.pinion_root_radius),
            MM * (pair.gear_tip_radius + pair.gear_root_radius))  # fmt: skip
    size = math.pi / 8.0 * mean[0] ** 4 / (2.0 * MM * pair.pinion_base_radius) ** 2
    masses = both(
        lambda g, d, u: 1e-9 * g.density * (1.0 - (MM * g.bore / d) ** 4) * size * u * u,
        gears, mean, (1.0, pair.ratio),
    )  # fmt: skip
    n_E1, N = loads.resonance(pair.pinion_teeth, masses, c_mesh, pinion_speed)
    pitch, profile, larger = loads.effective_deviations(gears)
    B_p, B_f, B_k = c_single * pitch / w, c_single * profile / w, abs(1.0 - c_single * relief / w)
    e, e_a = pair.total_contact_ratio, pair.transverse_contact_ratio
    end = 0.85 if w >= 100.0 else 0.5 + 0.35 * math.sqrt(w / 100.0)
    K_v = given.dynamic or loads.dynamic_factor(N, e, (B_p, B_f, B_k), (end, 1.15))
    r = max(3.0, pair.face_width / (pair.pinion_tip_radius - pair.pinion_root_radius))
    K_Fb = given.face_root or given.face ** (r * r / (1.0 + r + r * r))
    K = max(loads.transverse_factor(e, c_mesh * larger / (w * K_v * given.face)), 1.0)
    most_H, most_F = e / (e_a * Z_eps**2), e / (0.25 * e_a + 0.75)
    return {
        "eps_a": e_a, "eps_b": pair.overlap_ratio, "n_E1": n_E1, "N": N, "B_p": B_p, "B_f": B_f,
        "B_k": B_k, "K_A": given.application, "K_gam": given.mesh_load, "K_v": K_v,
        "K_Hb": given.face, "K_Fb": K_Fb,
        "K_Ha": given.transverse or min(K, max(most_H, 1.0)),
        "K_Fa": given.transverse_root or min(K, max(most_F, 1.0)),
    }  # fmt: skip


def _contact_factors(
    pair: HelicalPair, edition: str, modified: float
) -> tuple[dict[str, float], Pair]:
    """Return Z_H, Z_eps, Z_beta, and Z_B with Z_D of the inner points of single contact."""
    e_a, e_b = pair.transverse_contact_ratio, min(pair.overlap_ratio, 1.0)
    alpha_t, alpha_w = pair.transverse_pressure_angle, pair.working_pressure_angle
    tangent = math.tan(alpha_w)
    Z_H = math.sqrt(2.0 * math.cos(pair.base_helix_angle) / tangent) / math.cos(alpha_t)
    Z_eps = math.sqrt(max(4.0 - e_a, 0.0) / 3.0 * (1.0 - e_b) + e_b / e_a)
    r1 = math.sqrt((pair.pinion_tip_radius / pair.pinion_base_radius) ** 2 - 1.0)
    r2 = math.sqrt((pair.gear_tip_radius / pair.gear_base_radius) ** 2 - 1.0)
    p1, p2 = 2.0 * math.pi / pair.pinion_teeth, 2.0 * math.pi / pair.gear_teeth
    M1 = tangent / math.sqrt((r1 - p1) * (r2 - (e_a - 1.0) * p2))
    M2 = tangent / math.sqrt((r2 - p2) * (r1 - (e_a - 1.0) * p1))
    helical = math.sqrt(modified) if edition == "2019" else 1.0

    def single(M: float) -> float:
        return max(1.0, M - e_b * (M - helical)) if M > 1.0 else max(1.0, 1.0 + e_b * (helical - 1))

    Z_beta = 1.0 / math.sqrt(math.cos(pair.helix_angle))
    return {"Z_H": Z_H, "Z_eps": Z_eps, "Z_beta": Z_beta}, both(single, (M1, M2))


def _tooth_form(pair: HelicalPair, gear: RatedGear, member: int, f_eps: float) -> ToothForm:
    tip = (pair.pinion_tip_radius, pair.gear_tip_radius)[member]
    reference = (pair.pinion_reference_radius, pair.gear_reference_radius)[member]
    form = tooth_form(
        teeth.virtual_teeth(pair)[member], pair.normal_pressure_angle, pair.fillet_factor,
        teeth.rack_dedendum_of(pair)[member], pair.profile_shifts[member],
        addendum=(tip - reference) / pair.normal_module,
        left=gear.protuberance / pair.normal_module,
        contact_ratio=pair.transverse_contact_ratio / math.cos(pair.base_helix_angle) ** 2,
    )  # fmt: skip
    return form._replace(Y_F=form.Y_F * f_eps)
