"""Statements of Jamali 2015 on tip relief, lay and the data of his rough contacts."""

from __future__ import annotations

import math

import numpy as np

from docs.helical.cases import Evidence
from docs.helical.claims_thesis import DESIGNS, MODIFIED, PAIRS, SPEED, both, limits
from docs.helical.verdicts import Claim, Verdict, judge
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.lay_angle import equal_radius_line, lay_angle_limits, lay_angles
from gearlube_core.helical_geometry.meshing_steps import jamali_2015_steps
from gearlube_core.helical_geometry.sample_modifications import jamali_2015
from gearlube_core.helical_geometry.undeformed_gap import contact_line_gap


def relief_zones(_: Evidence) -> Verdict:
    """G9."""
    found = {}
    for d in DESIGNS:
        m = MODIFIED[d]
        found[d] = (
            1e3 * (m.pair.contact_end - m.contact_end),
            1e3 * (m.contact_start - m.pair.contact_start),
        )
    off = {d: max(abs(found[d][0] - 4.3), abs(found[d][1] - 4.4)) for d in DESIGNS}
    return Verdict(
        f"A {both(list(found['a']))}, B {both(list(found['b']))} mm",
        judge(max(off.values()) < 0.05, off["a"] < 0.2),
        "Eq. (2.14) and (2.15) are used as they stand. They equal the integral of "
        "r dr/sqrt(r^2 - r_b^2). No radius, angle or depth of Table 4.1 gives the printed pair of "
        "numbers, and 4.4 mm cannot be that of B.",
    )


def relief_starts(_: Evidence) -> Verdict:
    """G10."""
    found = []
    for step in (75, 300, 500):
        X = float(jamali_2015_steps("a").line(step))
        gap = contact_line_gap(jamali_2015("a", k=0.0), X, [0.0])
        found.append((1e3 * gap.pinion_relief_start, 1e3 * gap.gear_relief_start))
    got = np.array([found[0][1], found[1][0], found[1][1], found[2][0]])
    off = np.abs(got - [6.4, 18.5, -21.5, -6.3])
    return Verdict(
        ", ".join(f"{v:.2f}" for v in got) + " mm",
        judge(bool(off.max() < 0.05), bool(off.max() < 1.0)),
        "The last three are read where relief becomes apparent in a figure. They depend on z_p and "
        "z_w.",
    )


def side_faces(_: Evidence) -> Verdict:
    """G11."""
    found = {d: jamali_2015_steps(d).side_face_limits for d in DESIGNS}
    printed = {"a": (204, 370), "b": (180, 370)}
    gaps = [
        sign * (printed[d][end] - found[d][end])
        for d in DESIGNS
        for end, sign in ((0, 1.0), (1, -1.0))
    ]
    return Verdict(
        ", ".join(f"{d.upper()} {low:.1f} to {high:.1f}" for d, (low, high) in found.items()),
        judge(all(abs(g) < 0.5 for g in gaps), all(0.0 < g < 8.5 for g in gaps)),
        "The printed steps are read from pressures. At a tip the relief keeps the pressure off "
        "the last 0.3 mm, which are 8 steps.",
    )


def lay_range(_: Evidence) -> Verdict:
    """G12."""
    ends = np.array(limits("a"))
    angles = np.degrees(np.array(lay_angles(ends, PAIRS["a"], 1e-3)))
    off = np.abs(angles - [[4.6, 9.5], [9.5, 4.6]])
    return Verdict(
        f"theta_p {angles[0, 0]:.2f} to {angles[0, 1]:.2f}, theta_w {angles[1, 0]:.2f} to "
        f"{angles[1, 1]:.2f} deg",
        judge(bool(off.max() < 0.3)),
        "The tolerance is 0.3 deg, because s of the ends is read to 1 mm.",
    )


def lay_at_pitch_line(_: Evidence) -> Verdict:
    """G13."""
    exact = math.degrees(float(lay_angle_limits(0.0, PAIRS["a"]).pinion))
    chords = [math.degrees(float(v)) for v in lay_angles(0.0, PAIRS["a"])]
    return Verdict(
        f"{exact:.3f} deg, by chords of 1 mm {both(chords)}",
        judge(abs(exact - 7.08) < 0.05),
        "The angle is arctan(sin b tan(alpha_w)). No reading of the geometry gives 7.08 deg.",
    )


def relief_line(_: Evidence) -> Verdict:
    """G14."""
    angles = []
    for d in DESIGNS:
        m, X = MODIFIED[d], float(jamali_2015_steps(d).line(300))
        radius = m.pair.pinion_tip_radius - m.pinion.tip_relief.extent  # type: ignore[union-attr]
        y = contact_line_gap(m, X, [0.0]).pinion_relief_start + np.array([-1e-5, 1e-5])
        x = equal_radius_line(radius, y, X, m.pair, "pinion")
        angles.append(math.degrees(math.atan(float(np.diff(x)[0]) / 2e-5)))
    return Verdict(
        f"A / B: {both(angles)} deg",
        judge(all(abs(v - 8.5) < 0.1 for v in angles)),
        "This is at step 300, where the start of the pinion's relief crosses the contact line.",
    )


def table_7_1(_: Evidence) -> Verdict:
    """G15."""
    pair = PAIRS["a"]
    tan_t, plane = math.tan(pair.transverse_pressure_angle), pair.plane
    plane = plane._replace(x_g=(plane.r_bp + plane.r_bg) * tan_t, P=plane.r_bp * tan_t)
    got = line_kinematics(plane.P + 5.25e-3, SPEED, plane)
    at_text = line_kinematics(plane.P + 5.75e-3, SPEED, plane)
    R = 1e3 * got.R * plane.cos_b
    here = abs(got.slide_roll - 0.3632) < 5e-4 and abs(R - 14.0) < 0.05
    here = here and abs(got.entrainment - 6.71) < 0.005
    there = abs(at_text.slide_roll - 0.3632) < 5e-4
    return Verdict(
        f"at 5.25 mm {got.slide_roll:.4f}, {R:.2f} mm, {got.entrainment:.3f} m/s; at 5.75 mm "
        f"{at_text.slide_roll:.4f}",
        judge(here and there, here),
        "The printed numbers are those of s = 5.25 mm, with the reference pressure angle and the "
        "transverse radius.",
    )


_EXTRUSIONS = ((149.0, 8.5), (100.0, 5.7), (114.0, 6.5), (131.0, 7.5))  # um over 1 mm, deg


def extrusion(_: Evidence) -> Verdict:
    """G16."""
    angles = [math.degrees(math.atan(1e-3 * length)) for length, _printed in _EXTRUSIONS]
    off = max(abs(a - printed) for a, (_l, printed) in zip(angles, _EXTRUSIONS, strict=True))
    return Verdict(
        both(angles) + " deg",
        judge(off < 0.05),
        "The angle is arctan(L_x/L_y). L_x is the period already, so Delta of the printed formula "
        "is too much.",
    )


FLANKS = (
    Claim(
        "G9",
        "The zones of relief measure z_p = 4.3 mm on the pinion and z_w = 4.4 mm on the wheel",
        "fig. 4.6", "0.05; in part: 0.2 mm on A", relief_zones,
    ),
    Claim(
        "G10",
        "On the contact line relief starts at y = 6.4 mm at step 75, 18.5 and -21.5 mm at "
        "step 300, -6.3 mm at step 500",
        "sec. 5.2", "0.05; in part: 1 mm", relief_starts,
    ),
    Claim(
        "G11",
        "The side faces of the teeth end the contact in steps 204 to 370 on A and 180 to 370 "
        "on B",
        "sec. 5.3", "0.5; in part: 8 steps outside", side_faces,
    ),
    Claim(
        "G12",
        "The angle of the lay goes from 4.6 to 9.5 deg on the pinion and from 9.5 to 4.6 deg "
        "on the wheel",
        "sec. 7.3, fig. 7.4", "0.3 deg", lay_range,
    ),
    Claim(
        "G13", "At the pitch line the angle of the lay is 7.08 deg",
        "sec. 7.3", "0.05 deg", lay_at_pitch_line,
    ),
    Claim(
        "G14", "The line on which relief starts is at 8.5 deg to y",
        "fig. 5.17", "0.1 deg", relief_line,
    ),
    Claim(
        "G15",
        "At s = 5.75 mm the slide-roll ratio is 0.3632, the radius R 14.0 mm and the "
        "entrainment speed 6.71 m/s",
        "Table 7.1, sec. 7.6", "5e-4, 0.05 mm, 0.005 m/s", table_7_1,
    ),
    Claim(
        "G16", "The profiles are extruded at angles of 8.5, 5.7, 6.5 and 7.5 deg",
        "sec. 7.6", "0.05 deg", extrusion,
    ),
)  # fmt: skip
