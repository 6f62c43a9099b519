"""Pitting and bending strength of bevel and hypoid gears by ISO 10300:2023, method B1.

Calculated as implemented here, from published worked examples; check a design against the standard.
Inside, formulas are in N, mm, MPa, um; what goes in and comes out is in SI.
"""

from __future__ import annotations

import math

from gearlube_core.errors import ParameterError
from gearlube_core.rating import load_factors as loads
from gearlube_core.rating.bevel_mesh import BevelMesh, VirtualGears
from gearlube_core.rating.gears import Gears, LoadFactors, StrengthRating, check_load
from gearlube_core.rating.pairs import MM, Pair, both, said
from gearlube_core.rating.strength import ToothForm, elasticity_factor, strength_rating, tooth_form

_SINGLE, _MESH = 14.0, 20.0  # stiffnesses of teeth c', c_gamma [N/(mm um)]
_TOOL = 1.25  # h_a0, normal modules
_Z_KP = 1.2


def bevel_rating(
    mesh: BevelMesh, gears: Gears, factors: LoadFactors, *,
    pinion_torque: float, pinion_speed: float, cycles: Pair, oil_viscosity: float,
) -> StrengthRating:  # fmt: skip
    """Return stress and strength of both members at one load; arguments as `cylindrical_rating`.

    Source: [iso_10300_2] [iso_10300_3], edition 2023: Z_KP 1.2 in the strength, where edition 2014
    had Z_K 0.85 in the stress. A gear without generation (formate) has another Y_Fa than here.
    Z_Hyp is quoted from memory; it meets two printed values.

    >>> import gearlube as gl
    >>> mesh = gl.rating.BevelMesh.of_blank(gl.HypoidGearFile.named("mohammadpour_2015").blank())
    >>> gear = gl.rating.RatedGear(
    ...     treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.8e8
    ... )
    >>> rating = gl.rating.bevel_rating(
    ...     mesh, (gear, gear), gl.rating.LoadFactors(face=1.65),
    ...     pinion_torque=200.0, pinion_speed=125.7, cycles=(5e7, 2e7), oil_viscosity=150e-6,
    ... )
    >>> round(rating.contact_safety[0], 1), rating.standard
    (1.5, 'ISO 10300-1, -2, -3:2023, method B1')
    """
    check_load(pinion_torque, pinion_speed, cycles, oil_viscosity)
    v, spirals, alpha = mesh.virtual, mesh.spirals, mesh.pressure_angle
    F_mt = 2e3 * pinion_torque / mesh.diameters[0]
    F_n = F_mt / (math.cos(alpha) * math.cos(spirals[0]))
    F_vmt = F_mt * math.cos(v.helix) / math.cos(spirals[0])
    K = _load_factors(mesh, gears, factors, F_vmt, pinion_speed)
    Z_MB, Z_E = _middle_factor(v), elasticity_factor(gears)
    v_1 = 5e-4 * pinion_speed * mesh.diameters[0]
    v_2 = v_1 * math.cos(spirals[0]) / math.cos(spirals[1])
    Z_Hyp = _sliding_factor(mesh, v_1, v_2) if mesh.cones.offset else 1.0
    part = min(v.overlap_ratio, 1.0)
    Y = {
        "Y_eps": (0.25 + 0.75 / v.contact_ratio) * (1.0 - part) + 0.625 * part,
        "Y_BS": _spiral_factor(mesh),
        "Y_LS": v.sharing**2,
    }
    rim = min(one.rim_ratio for one in gears)
    spiral, angle = math.degrees(0.5 * sum(spirals)), math.degrees(mesh.effective_angle)
    wide = mesh.face_width / mesh.cones.normal_module
    return strength_rating(
        gears, cycles, K, both(lambda k: _tooth_form(mesh, k), (0, 1)),
        sigma_H0=math.sqrt(F_n / (v.line_length * v.radius)) * Z_MB * v.sharing * Z_E,
        sigma_F=F_vmt / (v.face_width * v.module) * math.prod(Y.values()),
        module=v.module,
        film=(oil_viscosity, v_2, v.radius, _Z_KP * Z_Hyp),
        found={
            "F_mt": F_mt, "F_n": F_n, "eps_va": v.contact_ratio, "eps_vb": v.overlap_ratio,
            "b_vv": v.face_width, "l_bm": v.line_length, "rho_rel": v.radius, "Z_MB": Z_MB,
            "Z_LS": v.sharing, "Z_E": Z_E, "Z_Hyp": Z_Hyp, "Z_KP": _Z_KP, **Y,
        },
        outside=said(
            (v.contact_ratio < 2.0, f"virtual contact ratio below 2, got {v.contact_ratio:.3f}"),
            (spiral <= 45.0, f"mean spiral angle up to 45 deg, got {spiral:.1f} deg"),
            (angle <= 30.0, f"effective pressure angle up to 30 deg, got {angle:.1f} deg"),
            (wide <= 13.0, f"face width up to 13 normal modules, got {wide:.1f}"),
            (K["N"] <= 0.75, f"speed up to 0.75 of resonance for a checked K_v, got {K['N']:.2f}"),
            (rim >= 1.2, f"thickness of the rim from 1.2 tooth depths on, got {rim:.2f}"),
            (mesh.flank == "drive", "the formulas of the coast flank are from memory"),
        ),
        standard="ISO 10300-1, -2, -3:2023, method B1",
    )  # fmt: skip


def _load_factors(
    g: BevelMesh, gears: Gears, given: LoadFactors, F_vmt: float, pinion_speed: float
) -> dict[str, float]:
    v, e = g.virtual, g.virtual.contact_ratio + g.virtual.overlap_ratio
    f_p = loads.effective_deviations(gears)[0]
    w = F_vmt * given.shock / v.face_width
    cos = math.cos(g.effective_angle)  # mean of both flanks
    masses = both(
        lambda one, d: math.pi / 8.0 * 1e-9 * one.density * (d / cos) ** 2,
        gears, g.diameters,
    )  # fmt: skip
    n_E1, N = loads.resonance(g.cones.pinion_teeth, masses, _MESH, pinion_speed)
    B = f_p * _SINGLE / w
    K_v = given.dynamic or loads.dynamic_factor(N, e, (B, B, 1.0), (0.75, 1.25))
    K_F0, R = 1.0, g.cones.gear_mean_cone_distance
    if g.cutter_radius is not None and g.cutter_radius <= R and g.spirals[1] > 0.0:
        q = 0.279 / math.log10(math.sin(g.spirals[1]))
        K_F0 = min(max(0.211 * (g.cutter_radius / R) ** q + 0.789, 1.0), 1.15)
    K = loads.transverse_factor(e, _MESH * f_p / (w * K_v * given.face))
    relative = 2.0 * MM * g.cones.offset / g.diameters[1]
    K_Ha = given.transverse or max(K - (K - 1.0) * min(relative, 0.1) / 0.1, 1.0)
    return {
        "K_A": given.application, "K_gam": given.mesh_load, "n_E1": n_E1, "N": N, "K_v": K_v,
        "K_Hb": given.face, "K_F0": K_F0, "K_Fb": given.face_root or given.face / K_F0,
        "K_Ha": K_Ha, "K_Fa": given.transverse_root or K_Ha,
    }  # fmt: skip


def _middle_factor(v: VirtualGears) -> float:
    """Return Z_MB, of the middle of the zone of action [-]."""
    part, alpha = min(v.overlap_ratio, 1.0), v.transverse_angle
    inner = 2.0 + (v.contact_ratio - 2.0) * part
    outer = 2.0 * v.contact_ratio - 2.0 + (2.0 - v.contact_ratio) * part
    reach = both(
        lambda d_a, d: math.sqrt((d_a / (d * math.cos(alpha))) ** 2 - 1.0),
        v.tip_diameter, v.diameter,
    )  # fmt: skip
    square = (reach[0] - inner * math.pi / v.teeth[0]) * (reach[1] - outer * math.pi / v.teeth[1])
    if not square > 0.0:
        raise ParameterError(
            "The middle of contact must lie between the base circles of the virtual gears, got "
            f"virtual teeth {v.teeth[0]:.1f} and {v.teeth[1]:.1f} with a contact ratio of "
            f"{v.contact_ratio:.2f}. Check addenda and pressure angle."
        )
    return math.tan(alpha) / math.sqrt(square)


def _sliding_factor(g: BevelMesh, v_1: float, v_2: float) -> float:
    """Return Z_Hyp from speeds at the mean point [m/s]."""
    (b_1, b_2), line = g.spirals, math.atan(g.virtual.line_tangent)
    along = v_1 * math.sin(b_1) + v_2 * math.sin(b_2)
    high = 2.0 * v_1 * math.cos(b_1) * math.sin(g.pressure_angle)
    across = math.hypot(along, high) * math.cos(math.atan2(along, high) - line)
    parallel = (v_1 * math.sin(b_1) - v_2 * math.sin(b_2)) * math.cos(line)
    return min(max(1.0 - 0.3 * (parallel / across - 0.15), 0.6), 1.0)


def _spiral_factor(g: BevelMesh) -> float:
    """Return Y_BS of the inclined contact line [-]."""
    v = g.virtual
    b_a = v.face_width / math.cos(v.helix)
    l_bb = v.line_length * math.cos(v.base_helix) / math.cos(v.helix)
    x = 2.0 * b_a / (MM * (sum(g.addendum) + sum(g.dedendum)))
    a = -0.0182 * x * x + 0.4736 * x - 0.32
    b = -0.0032 * x * x + 0.0526 * x + 0.712
    c = -0.0050 * x * x + 0.0850 * x + 0.54
    return a / c * (l_bb / b_a - 1.05 * b) ** 2 + 1.0


def _tooth_form(g: BevelMesh, k: int) -> ToothForm:
    """Return the form of pinion (0) or gear (1), load at the tip."""
    v, sign = g.virtual, (1.0, -1.0)[k]
    form = tooth_form(
        v.teeth[k] / (math.cos(v.base_helix) ** 2 * math.cos(v.helix)), g.effective_angle,
        g.tool_radius[k], _TOOL, sign * g.addendum_shift,
        addendum=MM * g.addendum[k] / v.module, thickness=g.thickness_shift[k],
    )  # fmt: skip
    # the form divides by the cosine of the effective angle, Y_Fa by that of the flank's own
    own = math.cos(g.effective_angle) / math.cos(g.pressure_angle)
    return form._replace(Y_F=form.Y_F * own)
