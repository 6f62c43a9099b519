"""Statements of Jamali 2015 on contact lines, their load and motion."""

from __future__ import annotations

import math

import numpy as np

from docs.helical.cases import Evidence
from docs.helical.verdicts import Claim, Verdict, judge
from gearlube_core.arrays import Array
from gearlube_core.helical_geometry.contact_line import line_count, line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.load_sharing import position_of, positions_at, shared_load
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.sample_modifications import jamali_2015

DESIGNS = ("a", "b")
FILES = {d: HelicalGearFile.named(f"jamali_2015_{d}") for d in DESIGNS}
PAIRS = {d: file.helical_pair() for d, file in FILES.items()}
MODIFIED = {d: jamali_2015(d) for d in DESIGNS}
_TORQUE, SPEED = 1060.0, 235.62  # N.m, rad/s: Table 4.1
_PHASES = np.arange(4000) / 4000


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


def path_limits(_: Evidence) -> Verdict:
    """G1."""
    found = [1e3 * v for d in DESIGNS for v in limits(d)]
    off = np.abs(np.array(found) - [-10.8, 10.8, -11.8, 10.8])
    b = PAIRS["b"]
    reference = b.gear_base_radius * math.tan(b.transverse_pressure_angle)
    reference -= math.sqrt(b.gear_tip_radius**2 - b.gear_base_radius**2)
    return Verdict(
        f"A {found[0]:.2f} to {found[1]:.2f}, B {found[2]:.2f} to {found[3]:.2f} mm",
        judge(bool(off.max() < 0.05)),
        "This is with the working pressure angle. With the reference angle B would begin at "
        f"{1e3 * reference:.2f} mm.",
    )


def path_ratio(_: Evidence) -> Verdict:
    """G2."""
    path = [high - low for low, high in (limits(d) for d in DESIGNS)]
    more = path[1] / path[0] - 1.0
    return Verdict(
        f"{100.0 * more:.2f} %",
        judge(abs(more - 0.044) < 1e-3),
        "This is the ratio of the paths above.",
    )


def lines_in_contact(_: Evidence) -> Verdict:
    """G3."""
    counts = []
    for d in DESIGNS:
        length = shared_load(positions_at(_PHASES, PAIRS[d]), ModifiedPair(pair=PAIRS[d]), 1.0)
        counts.append({int(n) for n in (length.length > 0.0).sum(axis=1)})
    return Verdict(
        " / ".join(" or ".join(str(n) for n in sorted(c)) for c in counts),
        judge(all(c == {2, 3} for c in counts)),
        f"The numbers are for A / B. At most there are {int(line_count(PAIRS['a'].plane))} lines.",
    )


def length_lost(_: Evidence) -> Verdict:
    """G4."""
    lost = [100.0 * (1.0 - _lengths(d, True).mean() / _lengths(d, False).mean()) for d in DESIGNS]
    off = np.abs(np.array(lost) - [41.18, 41.6])
    return Verdict(
        f"A / B: {both(lost)} %",
        judge(bool(off.max() < 1.0)),
        "A percentage point is allowed, because the printed zones of relief are not those of their "
        "formula (G9).",
    )


def length_variation(_: Evidence) -> Verdict:
    """G5."""
    found = []
    for d in DESIGNS:
        total = _lengths(d, True)
        found.append(100.0 * float(np.ptp(total) / total.mean()))
    inside = all(4.0 < v < 5.0 for v in found)
    near = abs(found[0] - 4.3) < 0.05 and abs(found[1] - 4.8) < 0.05
    return Verdict(
        f"A / B: {both(found)} %",
        judge(near, inside),
        "The size holds, the order does not. It depends on z_w, and the printed z_w cannot be "
        "that of B.",
    )


def largest_load(_: Evidence) -> Verdict:
    """G6."""
    loads, inside, normal = [], [], []
    for d in DESIGNS:
        pair = PAIRS[d]
        lag = pair.face_width * math.tan(pair.base_helix_angle)
        s = np.linspace(limits(d)[0] - lag, limits(d)[1], 8001)
        X = position_of(s, pair)
        load = shared_load(X, MODIFIED[d], _TORQUE, "thesis").load
        window = s[load > load.max() * (1.0 - 1e-6)]
        loads.append(1e-3 * float(load.max()))
        inside.append(bool(window.min() < -7.5e-3 < window.max()))
        normal.append(1e-3 * float(shared_load(X, MODIFIED[d], _TORQUE).load.max()))
    return Verdict(
        f"A / B: {both(loads)} kN, level about s_i = -7.5 mm",
        judge(all(abs(v - 14.4) < 0.05 for v in loads) and all(inside)),
        "T_1/r_b1 is shared by the lengths of the lines, as in the thesis. Normal to the flanks "
        f"the load is {both(normal)} kN.",
    )


def entrainment(_: Evidence) -> Verdict:
    """G7."""
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
        "The change is relative to the mean of the path.",
    )


def radii(_: Evidence) -> Verdict:
    """G8."""
    R = {}
    for d in DESIGNS:
        x = np.linspace(PAIRS[d].contact_start, PAIRS[d].contact_end, 201)
        R[d] = np.array([line_kinematics(float(v), SPEED, PAIRS[d].plane).R for v in x])
    ends = float(R["a"][0] / R["a"][-1])
    return Verdict(
        f"A: ends {ends:.3f} of each other; B rises from {1e3 * R['b'][0]:.1f} to "
        f"{1e3 * R['b'][-1]:.1f} mm",
        judge(abs(ends - 1.0) < 0.05 and bool((np.diff(R["b"]) > 0.0).all())),
        "The radii are those of the normal section.",
    )


LINES = (
    Claim(
        "G1",
        "Contact begins and ends at -10.8 and 10.8 mm on design A, at -11.8 and "
        "10.8 mm on design B",
        "sec. 4.2",
        "0.05 mm",
        path_limits,
    ),
    Claim(
        "G2",
        "The path of contact of B is 4.4 % longer than that of A",
        "sec. 4.2",
        "0.1 %",
        path_ratio,
    ),
    Claim("G3", "Two or three contact lines carry at a time", "sec. 4.1", "-", lines_in_contact),
    Claim(
        "G4",
        "Relief shortens the contact lines by 41.18 % on A and 41.6 % on B",
        "sec. 4.1",
        "1 percentage point",
        length_lost,
    ),
    Claim(
        "G5",
        "The total length of the contact lines varies by 4.3 % on A and 4.8 % on B",
        "sec. 4.1",
        "0.05; in part: 4 to 5 %",
        length_variation,
    ),
    Claim(
        "G6",
        "A contact line carries at most 14.4 kN, at s = -7.5 mm",
        "sec. 4.1",
        "0.05 kN",
        largest_load,
    ),
    Claim(
        "G7",
        "The entrainment speed is 6.7 m/s on A; on B it rises from 5.8 m/s by 25 %",
        "sec. 4.2",
        "0.06, 0.05 m/s; 3 points",
        entrainment,
    ),
    Claim(
        "G8",
        "The relative radius of curvature is nearly symmetric on A and rises on B",
        "sec. 4.2, fig. 4.3",
        "5 %",
        radii,
    ),
)
