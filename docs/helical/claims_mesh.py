"""Statements H1 to H8 and H19 of He et al. 2007: contact lines and mesh forces."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from docs.helical.cases import HE, LOW, Evidence, line_lengths, steady, steady_with_helix
from docs.helical.closed_forms import zone_differences
from docs.helical.structure import reaction, sliding_reversal, symmetry
from docs.page import Claims, Verdict, judge
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.linear_system import event_phases
from tests.helpers.he_2007 import he_2007_pair

_RATIO, _SWING = 2.7426, 0.136  # by arithmetic on the printed dimensions
_JUST = 1e-9  # mesh periods beside an event
INCH = 0.0254  # m
ORDER = ("A", "P", "C", "Q", "D", "E", "H", "G", "R")
_HELIX = (5.0, 10.0, 15.0, 21.5, 25.0, 30.0)  # deg
MESH = Claims()


def drawn_landmarks() -> dict[str, float]:
    """Return the distances from T1 of the letters of fig. 3 [m].

    Drawn from its inches: circles and a tangent, no formula of the package.
    """
    turn = math.radians(25.0)  # of the line of action against the pitch circles' tangent
    r_p, centre = 0.5 * 3.125 * INCH, 3.5 * INCH
    pitch_point = np.array([0.0, r_p])
    along = np.array([math.cos(turn), math.sin(turn)])
    foot = float(pitch_point @ along)

    def cuts(middle: ArrayLike, radius: float) -> Array:
        """Distances from the pitch point to where the line of action cuts a circle."""
        offset = pitch_point - np.asarray(middle)
        roots = np.roots([1.0, 2.0 * offset @ along, offset @ offset - radius**2])
        return np.sort(roots.real)

    a = foot + float(cuts((0.0, centre), 0.5 * 4.13 * INCH)[0])
    d = foot + float(cuts((0.0, 0.0), 0.5 * 3.38 * INCH)[1])
    lead = 2.0 * math.pi * r_p / math.tan(math.radians(21.5))  # base and pitch cylinder's alike
    base = r_p * math.cos(turn)
    skew, pitch = 1.25 * INCH * 2.0 * math.pi * base / lead, 2.0 * math.pi * base / 25
    return {
        "A": a, "P": foot, "C": a + pitch, "Q": a + skew, "D": d, "E": a + 2.0 * pitch,
        "H": foot + skew, "G": d + skew, "R": a + 3.0 * pitch,
    }  # fmt: skip


def landmarks() -> dict[str, float]:
    """Return the same from the pair's plane of contact [m]."""
    p = HE.plane
    skew = p.W * p.sin_b / p.cos_b
    return {
        "A": p.A, "P": p.P, "C": p.A + p.pitch, "Q": p.A + skew, "D": p.D,
        "E": p.A + 2.0 * p.pitch, "H": p.P + skew, "G": p.D + skew, "R": p.A + 3.0 * p.pitch,
    }  # fmt: skip


@MESH("H1")
def _contact_ratio(_: Evidence) -> Verdict:
    touching = line_lengths((np.arange(2000) + 0.5) / 2000) > 0.0
    pairs = {int(n) for n in touching.sum(axis=1)}
    ratio = HE.total_contact_ratio
    return Verdict(
        f"{ratio:.5f}; {' or '.join(str(n) for n in sorted(pairs))} pairs",
        judge(abs(ratio - _RATIO) < 1e-4 and abs(ratio - 2.7) < 0.05 and pairs == {2, 3}),
    )


@MESH("H2")
def _landmark_places(_: Evidence) -> Verdict:
    drawn, ours = drawn_landmarks(), landmarks()
    worst = max(abs(ours[letter] / drawn[letter] - 1.0) for letter in ORDER)
    ordered = sorted(drawn, key=drawn.__getitem__) == list(ORDER)
    return Verdict(f"off the drawing by {worst:.0e}", judge(worst < 1e-6 and ordered))


@MESH("H3")
def _length_trapezoid(_: Evidence) -> Verdict:
    events = np.append(event_phases(HE.plane, he_2007_pair(0.0).mesh_arrays()), 1.0)
    events = np.unique(np.append(0.0, events))
    low, high, middle = (
        line_lengths(phase).sum(axis=1)
        for phase in (events[:-1] + _JUST, events[1:] - _JUST, 0.5 * (events[1:] + events[:-1]))
    )
    bend = float(np.abs(middle - 0.5 * (low + high)).max() / middle.max())
    mean = float(np.sum(0.5 * (low + high) * np.diff(events)))
    b = HE.base_helix_angle
    expected = HE.transverse_contact_ratio * HE.face_width / math.cos(b)
    swing = float((max(low.max(), high.max()) - min(low.min(), high.min())) / mean)
    off = abs(mean / expected - 1.0)
    return Verdict(
        f"mean {1e3 * mean:.4f} mm, off by {off:.0e}; range {100.0 * swing:.1f} % of it",
        judge(off < 1e-6 and abs(swing - _SWING) < 5e-4 and bend < 1e-6),
    )


@MESH("H4")
def _trapezoidal_stiffness(evidence: Evidence) -> Verdict:
    data = evidence.contact
    length = data["contact_length"].sum("line").values
    total = float(np.corrcoef(length, data["K"].values)[0, 1])
    entering = [int(n) for n in data["line"].values if n >= 0]
    followed = data.sel(line=entering)
    one = followed["K_line"].values.T.ravel()
    single = float(np.corrcoef(followed["contact_length"].values.T.ravel(), one)[0, 1])
    return Verdict(
        f"correlation with length {single:.3f} for one pair, {total:.3f} for all",
        judge(single > 0.999 and total > 0.999, single > 0.98 and total > 0.9),
    )


@MESH("H5")
def _closed_forms(_: Evidence) -> Verdict:
    worst = zone_differences().max()
    return Verdict(f"{worst:.0e}", judge(worst < 1e-10))


@MESH("H6")
def _no_friction(_: Evidence) -> Verdict:
    asymmetry, least_eigenvalue, ranks, off_line = symmetry()
    moved = max(float(np.abs(steady(0.0).signal(n)).max()) for n in ("u_yp", "u_yg"))
    return Verdict(
        f"asymmetry {asymmetry:.0e}, least eigenvalue {least_eigenvalue:.0e}, "
        f"rank {' or '.join(str(r) for r in ranks)}; u_y = {moved:g}",
        judge(
            asymmetry < 1e-12
            and least_eigenvalue > -1e-12
            and min(ranks) >= 1
            and off_line == 0.0
            and moved == 0.0
        ),
    )


@MESH("H7")
def _action_reaction(_: Evidence) -> Verdict:
    force, moment, _ = reaction()
    return Verdict(
        f"forces {force:.0e}, moments {moment:.0e}",
        judge(force < 1e-12 and moment < 1e-12),
    )


@MESH("H8")
def _reversal(_: Evidence) -> Verdict:
    ratio, there = sliding_reversal()
    return Verdict(
        f"v_s there {ratio:.0e} of that at A",
        judge(there and ratio < 1e-12),
    )


@MESH("H19")
def _axial_share(_: Evidence) -> Verdict:
    axial = reaction()[2]
    swings = [
        float(np.ptp(steady_with_helix(LOW, math.radians(angle)).mesh_force[:, 2]))
        for angle in _HELIX
    ]
    identity = axial < 1e-12
    return Verdict(
        "F_z, peak to peak, "
        + " / ".join(f"{swing:.0f}" for swing in swings)
        + " N at "
        + " / ".join(f"{angle:g}" for angle in _HELIX)
        + " deg, mu = 0.01",
        judge(identity and bool(np.all(np.diff(swings) > 0.0)), identity),
    )
