"""Contact lines of a pair over the meshing cycle: lengths, loads, kinematics, lay angles."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.helical_geometry.contact_line import clip_line, line_kinematics
from gearlube_core.helical_geometry.lay_angle import lay_angle_limits, lay_angles
from gearlube_core.helical_geometry.load_sharing import CONVENTIONS, positions_at, shared_load
from gearlube_core.helical_geometry.meshing_steps import line_at_position, position_of_line
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.units import labelled

Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, str]]]

UNMODIFIED, RELIEVED = "unmodified", "with tip relief"
STATIONS = 881  # along a line; odd, so that one lies at mid-face
_POSITIONS, _PHASES, _PATH = 601, 1000, 401
_BEYOND = 0.02  # of the cycle shown before and after it
_CHORD = 1e-3  # m, [jamali_2015 sec. 7.3]


class Part(NamedTuple):
    """Variables of a dataset with their coordinates."""

    variables: Variables
    coordinates: Variables


def relieved_lines_always_touch(modified: ModifiedPair) -> bool:
    """Return whether some unrelieved contact is left at every position."""
    path = modified.contact_end - modified.contact_start
    lag = modified.pair.face_width * math.tan(modified.pair.base_helix_angle)
    return path > 0.0 and path + lag > modified.pair.base_pitch


def load_variables(modified: ModifiedPair, torque: float) -> Part:
    """Return length and load of one line over its cycle, and totals over a mesh period."""
    pair = modified.pair
    states = {UNMODIFIED: ModifiedPair(pair=pair)}
    has_relief = any(m.tip_relief is not None for m in (modified.pinion, modified.gear))
    if has_relief and relieved_lines_always_touch(modified):
        states[RELIEVED] = modified
    s_i = _cycle_positions(modified)
    phase = np.arange(_PHASES) / _PHASES
    X, X_all = line_at_position(s_i, pair), positions_at(phase, pair)
    one, loads, line_loads, totals, counts = [], [], [], [], []
    for state in states.values():
        shares = [shared_load(X, state, torque, convention) for convention in CONVENTIONS]
        one.append((shares[0].length, shares[0].total_length))
        loads.append([share.load for share in shares])
        line_loads.append([share.line_load for share in shares])
        period = shared_load(X_all, state, torque)
        totals.append(period.total_length[:, 0])
        counts.append((period.length > 0.0).sum(axis=1))
    total = np.array(totals)
    mean = total.mean(axis=1)
    cycle, period_dims = ("relief", "position"), ("relief", "phase")
    by_force = ("relief", "convention", "position")
    variables = {
        "length": labelled(cycle, np.array([a for a, _ in one]), "m", "length of a contact line"),
        "total_length": labelled(
            cycle, np.array([b for _, b in one]), "m", "total length of the lines in contact"
        ),
        "load": labelled(by_force, np.array(loads), "N", "load of a contact line"),
        "line_load": labelled(
            by_force, np.array(line_loads), "N/m", "load of a contact line per unit of its length"
        ),
        "period_length": labelled(
            period_dims, total, "m", "total length of the lines in contact over a mesh period"
        ),
        "lines_in_contact": labelled(
            period_dims, np.array(counts), "1", "contact lines of some length"
        ),
        "mean_length": labelled(
            ("relief",), mean, "m", "mean over a mesh period of the total length"
        ),
        "length_variation": labelled(
            ("relief",), np.ptp(total, axis=1) / mean, "1",
            "range of the total length over a mesh period, over its mean",
        ),
    }  # fmt: skip
    text = "end of the line on the face z = -W/2, along the line of action past the pitch line"
    return Part(
        variables,
        {
            "position": labelled(("position",), s_i, "m", text),
            "phase": labelled(("phase",), phase, "1", "mesh phase"),
            "relief": labelled(("relief",), list(states), "", "flanks whose lines are counted"),
            "convention": labelled(
                ("convention",), list(CONVENTIONS), "",
                "load: normal to the flanks, or torque over base radius as the thesis takes it",
            ),
        },
    )  # fmt: skip


def _cycle_positions(modified: ModifiedPair) -> Array:
    """Return s_i over the cycle [m], its corners included: lengths are straight between them."""
    pair = modified.pair
    lag = pair.face_width * math.tan(pair.base_helix_angle)
    ends = np.array(
        [pair.contact_start, modified.contact_start, modified.contact_end, pair.contact_end]
    )
    corners = np.concatenate([ends - lag, ends]) - pair.pitch_point
    first, last = corners.min(), corners.max()
    pad = _BEYOND * (last - first)
    grid = np.linspace(first - pad, last + pad, _POSITIONS)
    # a spur line is there at once: the points beside its ends draw the step
    beside = np.array([first, last]) + 1e-9 * (last - first) * np.array([-1.0, 1.0])
    return np.unique(np.concatenate([grid, corners, beside]))


def path_variables(pair: HelicalPair, pinion_speed: float) -> Part:
    """Return curvature, velocities and lay angles along the path of contact."""
    s = np.linspace(pair.contact_start, pair.contact_end, _PATH) - pair.pitch_point
    points = [line_kinematics(float(x), pinion_speed, pair.plane) for x in s + pair.pitch_point]
    cos_b, path = math.cos(pair.base_helix_angle), ("s",)
    R = np.array([one.R for one in points])
    variables = {
        "R_transverse": labelled(
            path, R * cos_b, "m", "relative radius of curvature in the transverse plane"
        ),
        "R_normal": labelled(path, R, "m", "relative radius of curvature in the normal plane"),
    }
    for name, field, unit, text in (
        ("R_pinion", "R_p", "m", "transverse radius of curvature of the pinion"),
        ("R_gear", "R_g", "m", "transverse radius of curvature of the gear"),
        ("entrainment", "entrainment", "m/s", "entrainment velocity, mean of both surfaces"),
        ("sliding", "sliding", "m/s", "sliding velocity, pinion less gear"),
        ("slide_roll", "slide_roll", "1", "sliding over entrainment velocity"),
    ):
        values = np.array([getattr(one, field) for one in points])
        variables[name] = labelled(path, values, unit, text)
    if pair.base_helix_angle > 0.0:
        chords, limits = lay_angles(s, pair, _CHORD), lay_angle_limits(s, pair)
        reached = s + pair.pitch_point + _CHORD * math.sin(pair.base_helix_angle)
        inside = reached < pair.tangent_length  # further on the gear has no involute
        for member in ("pinion", "gear"):
            text = f"angle between contact line and grinding marks of the {member}"
            chord = np.where(inside, getattr(chords, member), np.nan)
            variables[f"lay_{member}"] = labelled(path, chord, "rad", f"{text}, by a chord")
            variables[f"lay_{member}_limit"] = labelled(
                path, getattr(limits, member), "rad", f"{text}, where they cross"
            )
        variables["lay_chord"] = labelled((), _CHORD, "m", "chord along the contact line")
    text = "along the line of action, past the pitch line"
    return Part(variables, {"s": labelled(path, s, "m", text)})


def shown_line_variables(modified: ModifiedPair, X: Array, pinion_speed: float) -> Part:
    """Return the position of the shown lines, and the sliding along them."""
    pair, plane = modified.pair, modified.pair.plane
    y = np.linspace(-0.5, 0.5, STATIONS) * pair.face_width / plane.cos_b
    segments = [clip_line(float(one), plane) for one in X]
    ends_z = np.array([[one.z_low, one.z_high] for one in segments])
    ends_s = np.array([[one.x_low, one.x_high] for one in segments]) - pair.pitch_point
    ends = ("shown", "end")
    limits = np.array([modified.contact_start, modified.contact_end]) - pair.pitch_point
    variables = {
        "shown_position": labelled(
            ("shown",), position_of_line(X, pair), "m", "position of a shown contact line"
        ),
        "end_z": labelled(ends, ends_z, "m", "axial coordinate of a shown line's end"),
        "end_s": labelled(ends, ends_s, "m", "path coordinate of a shown line's end"),
        "unrelieved_s": labelled(("end",), limits, "m", "where unrelieved contact ends"),
    }
    if plane.sin_b > 0.0:
        x = X[:, None] - 0.5 * plane.W * plane.sin_b / plane.cos_b + y * plane.sin_b
        sliding = [
            [line_kinematics(one, pinion_speed, plane).sliding for one in row] for row in x.tolist()
        ]
        touching = (x >= plane.A) & (x <= plane.D)
        variables["line_sliding"] = labelled(
            ("shown", "y"), np.where(touching, sliding, np.nan), "m/s",
            "sliding velocity along a shown contact line, pinion less gear",
        )  # fmt: skip
    return Part(
        variables,
        {
            "shown": labelled(("shown",), np.arange(1, X.size + 1), "1", "shown contact line"),
            "end": labelled(("end",), ["low", "high"], "", "end of a line by its z"),
            "y": labelled(("y",), y, "m", "along the contact line, from mid-face"),
        },
    )
