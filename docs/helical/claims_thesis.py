"""Statements G1 to G16 of Jamali 2015: contact lines, relief, lay, data of rough contacts."""

from __future__ import annotations

import math

import numpy as np

from docs.helical.cases import Evidence
from docs.page import Claims, Verdict, judge
from gearlube_core.arrays import Array
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.lay_angle import equal_radius_line, lay_angle_limits, lay_angles
from gearlube_core.helical_geometry.load_sharing import positions_at, shared_load
from gearlube_core.helical_geometry.meshing_steps import line_at_position
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.undeformed_gap import contact_line_gap
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_steps

DESIGNS = ("a", "b")
FILES = {d: HelicalGearFile.named(f"jamali_2015_{d}") for d in DESIGNS}
PAIRS = {d: file.helical_pair() for d, file in FILES.items()}
MODIFIED = {d: jamali_2015(d) for d in DESIGNS}
_TORQUE, SPEED = 1060.0, 235.62  # N.m, rad/s: Table 4.1
_PHASES = np.arange(4000) / 4000
THESIS = Claims()


def limits(design: str) -> tuple[float, float]:
    """Return s of the first and the last contact [m]."""
    p = PAIRS[design]
    return p.contact_start - p.pitch_point, p.contact_end - p.pitch_point


def _lengths(design: str, relieved: bool) -> Array:
    """Return the length of all lines over a mesh period [m]."""
    pair = PAIRS[design]
    modified = MODIFIED[design] if relieved else ModifiedPair(pair=pair)
    X = positions_at(_PHASES, pair)
    return np.asarray(shared_load(X, modified, _TORQUE).total_length[:, 0])


def both(values: list[float], form: str = "{:.2f}") -> str:
    """Return values with strokes between."""
    return " / ".join(form.format(v) for v in values)


@THESIS("G1")
def _path_limits(_: Evidence) -> Verdict:
    found = [1e3 * v for d in DESIGNS for v in limits(d)]
    off = np.abs(np.array(found) - [-10.8, 10.8, -11.8, 10.8])
    return Verdict(
        f"A {found[0]:.2f} to {found[1]:.2f}, B {found[2]:.2f} to {found[3]:.2f} mm",
        judge(bool(off.max() < 0.05)),
    )


@THESIS("G2")
def _path_ratio(_: Evidence) -> Verdict:
    path = [high - low for low, high in (limits(d) for d in DESIGNS)]
    more = path[1] / path[0] - 1.0
    return Verdict(f"{100.0 * more:.2f} %", judge(abs(more - 0.044) < 1e-3))


@THESIS("G3")
def _lines_in_contact(_: Evidence) -> Verdict:
    counts = []
    for d in DESIGNS:
        length = shared_load(positions_at(_PHASES, PAIRS[d]), ModifiedPair(pair=PAIRS[d]), 1.0)
        counts.append({int(n) for n in (length.length > 0.0).sum(axis=1)})
    return Verdict(
        " / ".join(" or ".join(str(n) for n in sorted(c)) for c in counts),
        judge(all(c == {2, 3} for c in counts)),
    )


@THESIS("G4")
def _length_lost(_: Evidence) -> Verdict:
    lost = [100.0 * (1.0 - _lengths(d, True).mean() / _lengths(d, False).mean()) for d in DESIGNS]
    off = np.abs(np.array(lost) - [41.18, 41.6])
    return Verdict(f"A / B: {both(lost)} %", judge(bool(off.max() < 1.0)))


@THESIS("G5")
def _length_variation(_: Evidence) -> Verdict:
    found = []
    for d in DESIGNS:
        total = _lengths(d, True)
        found.append(100.0 * float(np.ptp(total) / total.mean()))
    inside = all(4.0 < v < 5.0 for v in found)
    near = abs(found[0] - 4.3) < 0.05 and abs(found[1] - 4.8) < 0.05
    return Verdict(f"A / B: {both(found)} %", judge(near, inside))


@THESIS("G6")
def _largest_load(_: Evidence) -> Verdict:
    loads, inside = [], []
    for d in DESIGNS:
        pair = PAIRS[d]
        lag = pair.face_width * math.tan(pair.base_helix_angle)
        s = np.linspace(limits(d)[0] - lag, limits(d)[1], 8001)
        X = line_at_position(s, pair)
        load = shared_load(X, MODIFIED[d], _TORQUE, "thesis").load
        window = s[load > load.max() * (1.0 - 1e-6)]
        loads.append(1e-3 * float(load.max()))
        inside.append(bool(window.min() < -7.5e-3 < window.max()))
    return Verdict(
        f"A / B: {both(loads)} kN, level about s_i = -7.5 mm",
        judge(all(abs(v - 14.4) < 0.05 for v in loads) and all(inside)),
    )


@THESIS("G7")
def _entrainment(_: Evidence) -> Verdict:
    speeds = {}
    for d in DESIGNS:
        x = np.linspace(PAIRS[d].contact_start, PAIRS[d].contact_end, 201)
        speeds[d] = np.array(
            [line_kinematics(float(v), SPEED, PAIRS[d].plane).entrainment for v in x]
        )
    change = float(np.ptp(speeds["b"]) / speeds["b"].mean())
    level = float(np.abs(speeds["a"] - 6.7).max())
    first = float(speeds["b"][0])
    return Verdict(
        f"A {speeds['a'].min():.2f} to {speeds['a'].max():.2f}, B from {first:.2f} m/s, "
        f"{100.0 * change:.1f} %",
        judge(level < 0.06 and abs(first - 5.8) < 0.05 and abs(change - 0.25) < 0.03),
    )


@THESIS("G8")
def _radii(_: Evidence) -> Verdict:
    R = {}
    for d in DESIGNS:
        x = np.linspace(PAIRS[d].contact_start, PAIRS[d].contact_end, 201)
        R[d] = np.array([line_kinematics(float(v), SPEED, PAIRS[d].plane).R for v in x])
    ends = float(R["a"][0] / R["a"][-1])
    return Verdict(
        f"A: ends {ends:.3f} of each other; B rises from {1e3 * R['b'][0]:.1f} to "
        f"{1e3 * R['b'][-1]:.1f} mm",
        judge(abs(ends - 1.0) < 0.05 and bool((np.diff(R["b"]) > 0.0).all())),
    )


@THESIS("G9")
def _relief_zones(_: Evidence) -> Verdict:
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
    )


@THESIS("G10")
def _relief_starts(_: Evidence) -> Verdict:
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
    )


@THESIS("G11")
def _side_faces(_: Evidence) -> Verdict:
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
    )


@THESIS("G12")
def _lay_range(_: Evidence) -> Verdict:
    ends = np.array(limits("a"))
    angles = np.degrees(np.array(lay_angles(ends, PAIRS["a"], 1e-3)))
    off = np.abs(angles - [[4.6, 9.5], [9.5, 4.6]])
    return Verdict(
        f"theta_p {angles[0, 0]:.2f} to {angles[0, 1]:.2f}, theta_w {angles[1, 0]:.2f} to "
        f"{angles[1, 1]:.2f} deg",
        judge(bool(off.max() < 0.3)),
    )


@THESIS("G13")
def _lay_at_pitch_line(_: Evidence) -> Verdict:
    exact = math.degrees(float(lay_angle_limits(0.0, PAIRS["a"]).pinion))
    chords = [math.degrees(float(v)) for v in lay_angles(0.0, PAIRS["a"])]
    return Verdict(
        f"{exact:.3f} deg, by chords of 1 mm {both(chords)}",
        judge(abs(exact - 7.08) < 0.05),
    )


@THESIS("G14")
def _relief_line(_: Evidence) -> Verdict:
    angles = []
    for d in DESIGNS:
        m, X = MODIFIED[d], float(jamali_2015_steps(d).line(300))
        radius = m.pair.pinion_tip_radius - m.pinion.tip_relief.extent  # type: ignore[union-attr]
        y = contact_line_gap(m, X, [0.0]).pinion_relief_start + np.array([-1e-5, 1e-5])
        x = equal_radius_line(radius, y, X, m.pair, "pinion")
        angles.append(math.degrees(math.atan(float(np.diff(x)[0]) / 2e-5)))
    return Verdict(f"A / B: {both(angles)} deg", judge(all(abs(v - 8.5) < 0.1 for v in angles)))


@THESIS("G15")
def _table_7_1(_: Evidence) -> Verdict:
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
    )


_EXTRUSIONS = ((149.0, 8.5), (100.0, 5.7), (114.0, 6.5), (131.0, 7.5))  # um over 1 mm, deg


@THESIS("G16")
def _extrusion(_: Evidence) -> Verdict:
    angles = [math.degrees(math.atan(1e-3 * length)) for length, _printed in _EXTRUSIONS]
    off = max(abs(a - printed) for a, (_l, printed) in zip(angles, _EXTRUSIONS, strict=True))
    return Verdict(both(angles) + " deg", judge(off < 0.05))
