"""Pitting and bending strength of bevel and hypoid gears by ISO 10300:2023, method B1.

Calculated as implemented here, from published worked examples; check a design against the standard.
Inside, formulas of the standard are in N, mm, MPa, um; what goes in and comes out is in SI.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated

from gearlube_core.checks import check_positive
from gearlube_core.number import Checked, Number, Positive
from gearlube_core.rating.iso_6336 import (
    GearMaterial,
    LoadFactors,
    Pair,
    StrengthRating,
    ToothQuality,
    tooth_form,
)
from gearlube_core.rating.life import BENDING, PITTING, life_factor

_MM, _MPA, _UM = 1e3, 1e-6, 1e6
_SINGLE, _MESH = 14.0, 20.0  # stiffnesses of teeth, N/(mm um)
_CROWNING = {"low": 3.0, "high": 1.5}  # exponents of the load along the path of contact


@dataclass(frozen=True, kw_only=True)
class BevelMesh(Checked):
    """Geometry of a bevel or hypoid pair as ISO 23509 names it, one flank; lengths m, angles rad.

    Parameters
    ----------
    teeth
        z1, z2.
    offset
        a [m]; 0 of bevel gears.
    face_width
        b2 of the wheel [m].
    normal_module
        m_mn, at mid-face [m].
    pitch_diameter, pitch_angle, spiral_angle
        d_m, delta and beta_m of pinion and wheel.
    pressure_angle, limit_angle, effective_angle
        alpha_n of this flank, alpha_lim, alpha_e.
    addendum, dedendum
        h_am, h_fm at mid-face [m].
    addendum_shift, thickness_shift
        x_hm of the pinion, x_sm of pinion and wheel [-].
    offset_angle, axial_offset_angle
        zeta_mp in the pitch plane, zeta_m.
    cutter_radius
        r_c0 [m]; 0: not known.
    effective_width
        Share of the face that bears load [-].
    """

    teeth: Pair
    face_width: Annotated[float, Positive("m", "Give metres, not millimetres.")]
    normal_module: Annotated[float, Positive("m", "Give metres, not millimetres.")]
    pitch_diameter: Pair
    pitch_angle: Pair
    spiral_angle: Pair
    pressure_angle: float
    effective_angle: float
    addendum: Pair
    dedendum: Pair
    limit_angle: float = 0.0
    addendum_shift: float = 0.0
    thickness_shift: Pair = (0.0, 0.0)
    offset: float = 0.0
    offset_angle: float = 0.0
    axial_offset_angle: float = 0.0
    cutter_radius: float = 0.0
    tool_radius: Pair = (0.25, 0.25)  # of the cutter's edge, normal modules
    effective_width: Annotated[float, Number("1", 0.3, 1.0, "0.85 if not known.")] = 0.85

    @cached_property
    def virtual(self) -> VirtualGears:
        """Virtual cylindrical gears and their contact lines."""
        return _virtual_gears(self)


@dataclass(frozen=True, kw_only=True)
class VirtualGears:
    """Virtual cylindrical gears of method B1; mm, rad."""

    helix: float
    base_helix: float
    transverse_angle: float
    module: float  # normal, m_mn
    diameter: Pair
    base_diameter: Pair
    tip_diameter: Pair
    teeth: Pair
    contact_ratio: float
    overlap_ratio: float
    face_width: float  # b_v
    line_length: float  # of the middle contact line
    line_areas: tuple[float, float, float]  # load of the lines at tip, middle and root
    radius: float  # rho_rel, normal to the contact line

    @property
    def sharing(self) -> float:
        """Z_LS [-]."""
        return math.sqrt(self.line_areas[1] / sum(self.line_areas))


def _virtual_gears(g: BevelMesh, crowning: str = "low") -> VirtualGears:
    beta = 0.5 * (g.spiral_angle[0] + g.spiral_angle[1])
    m, b = _MM * g.normal_module, _MM * g.face_width
    d_m = _MM * g.pitch_diameter[0], _MM * g.pitch_diameter[1]
    alpha = math.atan(math.tan(g.effective_angle) / math.cos(beta))
    base_helix = math.asin(math.sin(beta) * math.cos(g.effective_angle))
    d = [one / math.cos(delta) for one, delta in zip(d_m, g.pitch_angle, strict=True)]
    d_b = [one * math.cos(alpha) for one in d]
    d_a = [one + 2.0 * _MM * h for one, h in zip(d, g.addendum, strict=True)]
    pitch = math.pi * m * math.cos(alpha) / math.cos(beta)
    path = 0.5 * sum(
        math.sqrt(a * a - c * c) - e * math.sin(alpha) for a, c, e in zip(d_a, d_b, d, strict=True)
    )
    eps_a = path / pitch
    # face width in the plane of the virtual gears
    borne, turned = b * g.effective_width, 0.5 * g.offset_angle
    skew = math.atan(math.sin(g.pitch_angle[1]) * math.tan(g.axial_offset_angle)) - turned
    width = borne / math.cos(turned) - path * math.cos(alpha) * math.tan(turned)
    width /= 1.0 - math.tan(skew) * math.tan(turned)
    full = b * width / borne
    eps_b = width * math.sin(beta) / (math.pi * m)
    shear = math.tan(math.atan(math.tan(skew) / math.cos(alpha)))
    slope = shear + math.tan(base_helix)
    cos_b = math.cos(base_helix)
    late = (pitch - 0.5 * pitch * eps_a) * cos_b * (1.0 - eps_b) if eps_b < 1.0 else 0.0
    largest = 0.5 * cos_b * (path + width * abs(slope))

    def length(f: float) -> float:
        """Return the contact line at a distance f from the middle, within the zone of action."""
        across = f * math.sin(base_helix) + 0.5 * width
        ends = []
        for sign in (1.0, -1.0):
            x = f * cos_b + math.tan(base_helix) * across
            x = (x + sign * 0.5 * (path + sign * width * shear)) / slope if slope else 0.0
            ends.append(min(max(x, 0.0), width))
        bare = abs(ends[0] - ends[1]) / cos_b
        inner = math.sqrt(max(1.0 - (f / largest) ** 2, 0.0))
        return bare * (1.0 - inner * (1.0 - math.sqrt(width / full)))

    exponent = _CROWNING[crowning]
    places = (-late + pitch * cos_b, -late, -late - pitch * cos_b)
    areas = [
        max(0.25 * math.pi * length(f) * (1.0 - abs(f / largest) ** exponent), 0.0) for f in places
    ]
    tangent = math.tan(beta) * math.sin(g.effective_angle)
    cone = [0.5 * one / math.sin(delta) for one, delta in zip(d_m, g.pitch_angle, strict=True)]
    curved = sum(1.0 / (R * math.tan(delta)) for R, delta in zip(cone, g.pitch_angle, strict=True))
    curved *= math.cos(g.spiral_angle[0]) * math.cos(g.spiral_angle[1]) / math.cos(g.offset_angle)
    lift = math.cos(g.pressure_angle) * (math.tan(g.pressure_angle) - math.tan(g.limit_angle))
    radius = abs((lift + math.tan(g.offset_angle) * tangent) / curved)
    return VirtualGears(
        helix=beta,
        base_helix=base_helix,
        transverse_angle=alpha,
        module=m,
        diameter=(d[0], d[1]),
        base_diameter=(d_b[0], d_b[1]),
        tip_diameter=(d_a[0], d_a[1]),
        teeth=(d[0] * math.cos(beta) / m, d[1] * math.cos(beta) / m),
        contact_ratio=eps_a,
        overlap_ratio=eps_b,
        face_width=full,
        line_length=length(places[1]),
        line_areas=(areas[0], areas[1], areas[2]),
        radius=radius / (1.0 + tangent**2),
    )


def bevel_rating(
    mesh: BevelMesh,
    *,
    pinion_torque: float,
    pinion_speed: float,
    cycles: Pair,
    materials: tuple[GearMaterial, GearMaterial],
    quality: tuple[ToothQuality, ToothQuality],
    oil_viscosity: float,
    factors: LoadFactors | None = None,
    density: float = 7860.0,
    modulus: float = 206e9,
    poisson_ratio: float = 0.3,
) -> StrengthRating:
    """Return stress and strength of both members at one load; arguments as `cylindrical_rating`.

    Notes
    -----
    Source: [iso_10300_2] [iso_10300_3], edition 2023: Z_KP 1.2 in the strength, where edition 2014
    had Z_K 0.85 in the stress. Wheels without generation (formate) have another Y_Fa than here.
    """
    check_positive("pinion_torque", pinion_torque, "N.m", "Give its amount for either flank.")
    check_positive("pinion_speed", pinion_speed, "rad/s", "1000 rpm is 104.7 rad/s.")
    given, v = factors or LoadFactors(face=1.65), mesh.virtual
    d_m = _MM * mesh.pitch_diameter[0], _MM * mesh.pitch_diameter[1]
    F_mt = 2e3 * pinion_torque / d_m[0]
    F_n = F_mt / (math.cos(mesh.pressure_angle) * math.cos(mesh.spiral_angle[0]))
    F_vmt = F_mt * math.cos(v.helix) / math.cos(mesh.spiral_angle[0])
    speed = 5e-4 * pinion_speed * d_m[0]
    speed_2 = speed * math.cos(mesh.spiral_angle[0]) / math.cos(mesh.spiral_angle[1])
    K = _load_factors(mesh, given, materials, quality, F_vmt, pinion_speed, density * 1e-9)
    # pitting
    alpha, eps_a, eps_b = v.transverse_angle, v.contact_ratio, v.overlap_ratio
    F_1 = eps_a if eps_b >= 1.0 else 2.0 + (eps_a - 2.0) * eps_b
    F_2 = eps_a if eps_b >= 1.0 else 2.0 * eps_a - 2.0 + (2.0 - eps_a) * eps_b
    reach = [
        math.sqrt((a / c) ** 2 - 1.0) for a, c in zip(v.tip_diameter, v.base_diameter, strict=True)
    ]
    Z_MB = math.tan(alpha) / math.sqrt(
        (reach[0] - F_1 * math.pi / v.teeth[0]) * (reach[1] - F_2 * math.pi / v.teeth[1])
    )
    Z_E = math.sqrt(_MPA * modulus / (2.0 * math.pi * (1.0 - poisson_ratio**2)))
    sigma_H0 = math.sqrt(F_n / (v.line_length * v.radius)) * Z_MB * v.sharing * Z_E
    sigma_H = sigma_H0 * math.sqrt(K["K_A"] * K["K_v"] * K["K_Hb"] * K["K_Ha"])
    limits = _MPA * materials[0].contact_limit, _MPA * materials[1].contact_limit
    softer = min(limits)
    nu40 = 1e6 * oil_viscosity
    C = min(max(softer / 4375.0 + 0.6357, 0.83), 0.91)
    Z_L = C + 4.0 * (1.0 - C) / (1.2 + 134.0 / nu40) ** 2
    Z_v = C + 0.02 + 2.0 * (0.98 - C) / math.sqrt(0.8 + 32.0 / speed_2)
    R_z = 0.5 * _UM * sum(q.flank_roughness for q in quality) * (10.0 / v.radius) ** (1.0 / 3.0)
    Z_R = (3.0 / R_z) ** min(max(0.32 - 2e-4 * softer, 0.08), 0.15)
    Z_Hyp = _sliding_factor(mesh, speed, speed_2)
    Z_NT = [float(life_factor(PITTING[one.treatment], n)) for one, n in zip(materials, cycles)]
    sigma_HG = [
        limit * Z * Z_L * Z_v * Z_R * 1.2 * Z_Hyp for limit, Z in zip(limits, Z_NT, strict=True)
    ]
    # breakage
    Y_eps = 0.625 if eps_b >= 1.0 else (0.25 + 0.75 / eps_a) * (1.0 - eps_b) + 0.625 * eps_b
    Y_BS, Y_LS = _bevel_spiral_factor(mesh), v.sharing**2
    bending: dict[str, list[float]] = {}
    for k, (one, q, n) in enumerate(zip(materials, quality, cycles, strict=True)):
        Y_Fa, Y_Sa, q_s = _tooth_form(mesh, k)
        root = _UM * q.root_roughness
        rho = 0.1005 if one.treatment.startswith("nitr") else 0.0030
        strength = {
            "Y_NT": float(life_factor(BENDING[one.treatment], n)),
            "Y_drelT": (1.0 + math.sqrt(0.2 * rho * (1.0 + 2.0 * q_s)))
            / (1.0 + math.sqrt(1.2 * rho)),
            "Y_RrelT": 1.674 - 0.529 * (max(root, 1.0) + 1.0) ** 0.1,
            "Y_X": min(max(1.05 - 0.01 * v.module, 0.80), 1.0),
        }
        stress = F_vmt / (v.face_width * v.module) * Y_Fa * Y_Sa * Y_eps * Y_BS * Y_LS
        values = {
            "Y_Fa": Y_Fa, "Y_Sa": Y_Sa, **strength, "sigma_F0": stress,
            "sigma_F": stress * K["K_A"] * K["K_v"] * K["K_Fb"] * K["K_Fa"],
            "sigma_FG": 2.0 * _MPA * one.bending_limit * math.prod(strength.values()),
        }  # fmt: skip
        for name, value in values.items():
            bending.setdefault(name, []).append(value)
    si = 1.0 / _MPA
    return StrengthRating(
        contact_stress=(si * sigma_H, si * sigma_H),
        contact_strength=(si * sigma_HG[0], si * sigma_HG[1]),
        bending_stress=(si * bending["sigma_F"][0], si * bending["sigma_F"][1]),
        bending_strength=(si * bending["sigma_FG"][0], si * bending["sigma_FG"][1]),
        cycles=cycles,
        factors={
            "F_mt": F_mt,
            "F_n": F_n,
            "eps_va": eps_a,
            "eps_vb": eps_b,
            "l_bm": v.line_length,
            "rho_rel": v.radius,
            **K,
            "Z_MB": Z_MB,
            "Z_LS": v.sharing,
            "Z_E": Z_E,
            "sigma_H0": sigma_H0,
            "Z_L": Z_L,
            "Z_v": Z_v,
            "Z_R": Z_R,
            "Z_Hyp": Z_Hyp,
            "Z_KP": 1.2,
            "Z_NT": (Z_NT[0], Z_NT[1]),
            "Y_eps": Y_eps,
            "Y_BS": Y_BS,
            "Y_LS": Y_LS,
            **{name: (one[0], one[1]) for name, one in bending.items()},
        },  # fmt: skip
        outside=_outside(mesh),
        edition="ISO 10300-2, -3:2023, method B1",
    )


def _outside(g: BevelMesh) -> tuple[str, ...]:
    v, degrees = g.virtual, [math.degrees(one) for one in g.spiral_angle]
    mean = 0.5 * sum(degrees)
    limits = (
        (v.contact_ratio < 2.0, f"virtual contact ratio below 2, got {v.contact_ratio:.3f}"),
        (mean <= 45.0, f"mean spiral angle up to 45 deg, got {mean:.1f} deg"),
        (
            g.effective_angle <= math.radians(30.0),
            f"effective pressure angle up to 30 deg, got {math.degrees(g.effective_angle):.1f} deg",
        ),
        (
            g.face_width <= 13.0 * g.normal_module,
            f"face width up to 13 normal modules, got {g.face_width / g.normal_module:.1f}",
        ),
    )
    return tuple(text for holds, text in limits if not holds)


def _load_factors(
    g: BevelMesh,
    given: LoadFactors,
    materials: tuple[GearMaterial, GearMaterial],
    quality: tuple[ToothQuality, ToothQuality],
    F_vmt: float,
    pinion_speed: float,
    density: float,
) -> dict[str, float | Pair]:
    v = g.virtual
    f_p = _UM * max(q.pitch_deviation for q in quality)
    f_p -= min(0.075 * f_p, 3.0)
    w = F_vmt * given.application / v.face_width
    m_1, m_2 = (
        math.pi * density * (_MM * d) ** 2 / (8.0 * math.cos(g.effective_angle) ** 2)
        for d in g.pitch_diameter
    )
    n_E1 = 3e4 / (math.pi * g.teeth[0]) * math.sqrt(_MESH * (1.0 / m_1 + 1.0 / m_2))
    N = pinion_speed * 30.0 / math.pi / n_E1
    e = v.contact_ratio + v.overlap_ratio
    C_12 = 0.32 + (0.57 / (e - 0.3) if e > 2.0 else 0.34)
    C_3 = 0.096 / (e - 1.56) if e > 2.0 else 0.23
    K_v = given.dynamic or 1.0 + N * (f_p * _SINGLE / w * C_12 + C_3)
    K_Hb = given.face
    K_F0 = 1.0
    if g.cutter_radius > 0.0:
        R_m2 = 0.5 * g.pitch_diameter[1] / math.sin(g.pitch_angle[1])
        if g.cutter_radius <= R_m2:
            q = 0.279 / math.log10(math.sin(g.spiral_angle[1]))
            K_F0 = min(max(0.211 * (g.cutter_radius / R_m2) ** q + 0.789, 1.0), 1.15)
    X = _MESH * f_p / (w * K_v * K_Hb)
    K_Ha = 0.5 * e * (0.9 + 0.4 * X) if e <= 2.0 else 0.9 + 0.4 * math.sqrt(2.0 * (e - 1.0) / e) * X
    relative = 2.0 * abs(g.offset) / g.pitch_diameter[1]
    K_Ha = given.transverse or max(K_Ha - (K_Ha - 1.0) * min(relative, 0.1) / 0.1, 1.0)
    return {
        "K_A": given.application, "K_v": K_v, "N": N, "K_Hb": K_Hb,
        "K_Fb": given.face_root or K_Hb / K_F0, "K_F0": K_F0, "K_Ha": K_Ha,
        "K_Fa": given.transverse_root or K_Ha,
    }  # fmt: skip


def _sliding_factor(g: BevelMesh, v_1: float, v_2: float) -> float:
    """Return Z_Hyp [-] from speeds at the mean point [m/s]."""
    b_1, b_2 = g.spiral_angle
    along = v_1 * math.sin(b_1) + v_2 * math.sin(b_2)
    high = 2.0 * v_1 * math.cos(b_1) * math.sin(g.pressure_angle)
    if g.offset == 0.0:
        return 1.0
    line = math.atan(math.tan(g.virtual.helix) * math.sin(g.effective_angle))
    normal = math.hypot(along, high) * math.cos(math.atan2(along, high) - line)
    parallel = (v_1 * math.sin(b_1) - v_2 * math.sin(b_2)) * math.cos(line)
    return min(max(1.0 - 0.3 * (parallel / normal - 0.15), 0.6), 1.0)


def _bevel_spiral_factor(g: BevelMesh) -> float:
    v = g.virtual
    b_a = v.face_width / math.cos(v.helix)
    l_bb = v.line_length * math.cos(v.base_helix) / math.cos(v.helix)
    height = _MM * (sum(g.addendum) + sum(g.dedendum))
    x = 2.0 * b_a / height
    a = -0.0182 * x * x + 0.4736 * x - 0.32
    b = -0.0032 * x * x + 0.0526 * x + 0.712
    c = -0.0050 * x * x + 0.0850 * x + 0.54
    return a / c * (l_bb / b_a - 1.05 * b) ** 2 + 1.0


def _tooth_form(g: BevelMesh, k: int) -> tuple[float, float, float]:
    """Return Y_Fa, Y_Sa and q_s of pinion (0) or wheel (1), load at the tip; in normal modules."""
    v, alpha = g.virtual, g.effective_angle
    rho, x_s = g.tool_radius[k], g.thickness_shift[k]
    x_h = g.addendum_shift if k == 0 else -g.addendum_shift
    h_a0 = 1.25
    E = (math.pi / 4.0 - x_s) - h_a0 * math.tan(alpha)
    E -= rho * (1.0 - math.sin(alpha)) / math.cos(alpha)
    z_n = v.teeth[k] / (math.cos(v.base_helix) ** 2 * math.cos(v.helix))
    Y_F, Y_S, q_s = tooth_form(
        z_n, alpha, E, rho - h_a0 + x_h, rho,
        tip_diameter=z_n + 2.0 * _MM * g.addendum[k] / v.module,
        contact_ratio=1.0,
        thickness_angle=(math.pi / 2.0 + 2.0 * (x_h * math.tan(alpha) + x_s)) / z_n,
    )  # fmt: skip
    return Y_F * math.cos(alpha) / math.cos(g.pressure_angle), Y_S, q_s
