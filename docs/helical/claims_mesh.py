"""Statements H1 to H8 and H19 of He et al. 2007: contact lines and mesh forces."""

from __future__ import annotations

import math

import numpy as np

from docs.helical.cases import HE, LOW, Evidence, line_lengths, steady, steady_with_helix
from docs.helical.closed_forms import zone_differences
from docs.helical.landmarks import ORDER, drawn_landmarks, landmarks
from docs.helical.structure import reaction, sliding_reversal, symmetry
from docs.helical.verdicts import Claim, Verdict, judge
from gearlube_core.dynamics.helical_pair.he_2007 import he_2007_pair
from gearlube_core.dynamics.helical_pair.linear.linear_system import event_phases

_RATIO, _SWING = 2.7426, 0.136  # by arithmetic on the printed dimensions
_JUST = 1e-9  # mesh periods beside an event
_HELIX = (5.0, 10.0, 15.0, 21.5, 25.0, 30.0)  # deg


def contact_ratio(_: Evidence) -> Verdict:
    """H1."""
    touching = line_lengths((np.arange(2000) + 0.5) / 2000) > 0.0
    pairs = {int(n) for n in touching.sum(axis=1)}
    ratio = HE.total_contact_ratio
    return Verdict(
        f"{ratio:.5f}; {' or '.join(str(n) for n in sorted(pairs))} pairs",
        judge(abs(ratio - _RATIO) < 1e-4 and abs(ratio - 2.7) < 0.05 and pairs == {2, 3}),
        f"The transverse contact ratio is {HE.transverse_contact_ratio:.4f}, the overlap ratio is "
        f"{HE.overlap_ratio:.4f}.",
    )


def landmark_places(_: Evidence) -> Verdict:
    """H2."""
    drawn, ours = drawn_landmarks(), landmarks()
    worst = max(abs(ours[letter] / drawn[letter] - 1.0) for letter in ORDER)
    ordered = sorted(drawn, key=drawn.__getitem__) == list(ORDER)
    return Verdict(
        "; ".join(f"{letter} {1e3 * ours[letter]:.4f}" for letter in ORDER)
        + f" mm; off the drawing by {worst:.0e}",
        judge(worst < 1e-6 and ordered),
        "The places are drawn with circles and a tangent from the printed inches. Zone 6, E to H, "
        f"is only {1e6 * (drawn['H'] - drawn['E']):.0f} um long.",
    )


def length_trapezoid(_: Evidence) -> Verdict:
    """H3."""
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
        f"The length is straight between {events.size - 1} kinks to {bend:.0e}. The paper prints "
        "no number.",
    )


def trapezoidal_stiffness(evidence: Evidence) -> Verdict:
    """H4."""
    data = evidence.contact
    length = data["contact_length"].sum("line").values
    total = float(np.corrcoef(length, data["K"].values)[0, 1])
    entering = [int(n) for n in data["line"].values if n >= 0]
    followed = data.sel(line=entering)
    one = followed["K_line"].values.T.ravel()
    single = float(np.corrcoef(followed["contact_length"].values.T.ravel(), one)[0, 1])
    corner = float(data["share"].sel(line=0).isel(phase=0))
    return Verdict(
        "one density: the same curve; loaded contact: correlation with length "
        f"{single:.3f} for one pair, {total:.3f} for all",
        judge(single > 0.999 and total > 0.999, single > 0.98 and total > 0.9),
        "The stiffness of one pair rises, stays level and falls as its line does. By corner "
        f"contact a pair carries {100.0 * corner:.1f} % of the torque where its line has no "
        "length yet, a step as in fig. 2. The stiffness also depends on where on the teeth a line "
        "lies. This shows most in all pairs together.",
    )


def closed_forms(_: Evidence) -> Verdict:
    """H5."""
    found = zone_differences()
    worst = max(max(d.deflection, d.x_moment, d.z_moment) for d in found)
    printed = [d.printed for d in found]
    return Verdict(
        f"{worst:.0e}",
        judge(worst < 1e-10),
        "This is with x_g in place of the misprinted x_e. With x_e = x_D, the end of contact, "
        f"(10b) alone is off by up to {100.0 * max(printed):.0f} %.",
    )


def no_friction(_: Evidence) -> Verdict:
    """H6."""
    found = symmetry()
    moved = max(float(np.abs(steady(0.0).signal(n)).max()) for n in ("u_yp", "u_yg"))
    return Verdict(
        f"asymmetry {found.asymmetry:.0e}, least eigenvalue {found.least_eigenvalue:.0e} of the "
        f"largest entry, rank {' or '.join(str(r) for r in found.ranks)}; u_y = {moved:g}",
        judge(
            found.asymmetry < 1e-12
            and found.least_eigenvalue > -1e-12
            and min(found.ranks) >= 1
            and found.off_line == 0.0
            and moved == 0.0
        ),
        "Compression is linear along the lines. So the rank is two, for a spur pair too.",
    )


def action_reaction(_: Evidence) -> Verdict:
    """H7."""
    found = reaction()
    return Verdict(
        f"forces {found.force:.0e}, moments about any point {found.moment:.0e}",
        judge(found.force < 1e-12 and found.moment < 1e-12),
        "The numbers are relative to the force, with arms of a metre. They cover mu from 0 to "
        "0.3, all phases and random displacements of the helical and of the spur pair. The "
        "printed (22), whose first term lacks mu, has no such balance.",
    )


def reversal(_: Evidence) -> Verdict:
    """H8."""
    ratio, there = sliding_reversal()
    return Verdict(
        f"v_s at the pitch line {ratio:.0e} of that at A",
        judge(there and ratio < 1e-12),
        "The sliding changes sign at x_p = r_bp tan(alpha_w) at every point of every line.",
    )


def axial_share(_: Evidence) -> Verdict:
    """H19."""
    found = reaction()
    swings = [
        float(np.ptp(steady_with_helix(LOW, math.radians(angle)).mesh_force[:, 2]))
        for angle in _HELIX
    ]
    identity = found.axial < 1e-12
    return Verdict(
        f"F_z = -F_x tan b to {found.axial:.0e}; F_z of the mesh, peak to peak, "
        + " / ".join(f"{swing:.0f}" for swing in swings)
        + " N at "
        + " / ".join(f"{angle:g}" for angle in _HELIX)
        + " deg, mu = 0.01",
        judge(identity and bool(np.all(np.diff(swings) > 0.0)), identity),
        "At a given variation of the normal force, F_z grows as sin b, as eq. (15) says. But with "
        "the angle the overlap grows and this variation falls. So F_z of this pair does not rise "
        "with the angle.",
    )


MESH = (
    Claim(
        "H1",
        "The contact ratio is about 2.7: two or three pairs of teeth are in contact",
        "sec. 3",
        "1e-4",
        contact_ratio,
    ),
    Claim(
        "H2",
        "The printed places of the points A, P, C, Q, D, E, H, G and R on the line of action "
        "follow from the geometry",
        "fig. 3, eq. (24)",
        "1e-6",
        landmark_places,
    ),
    Claim(
        "H3",
        "The total length of the contact lines over a mesh period is a trapezoid with the "
        "mean eps_alpha W/cos b and a range of 13.6 %",
        "sec. 3; range by arithmetic",
        "1e-6; 0.05 %",
        length_trapezoid,
    ),
    Claim(
        "H4",
        "The stiffness of one pair of teeth, and of all pairs, is a trapezoid over the mesh "
        "period and follows the length of the lines",
        "sec. 3, figs 2, 4",
        "correlation 0.999; in part: 0.98, 0.9",
        trapezoidal_stiffness,
    ),
    Claim(
        "H5",
        "The closed forms (10b), (18a) and (18b) are the integrals along the contact lines",
        "sec. 3",
        "1e-10",
        closed_forms,
    ),
    Claim(
        "H6",
        "Without friction the matrix of the mesh stiffness is symmetric and semidefinite, and"
        " u_y is at rest",
        "eq. (7), (16), (21)",
        "1e-12",
        no_friction,
    ),
    Claim(
        "H7",
        "Forces and moments on pinion and gear balance each other",
        "eq. (7)-(22)",
        "1e-12",
        action_reaction,
    ),
    Claim(
        "H8",
        "Sliding changes its direction at the pitch line",
        "eq. (5), (6)",
        "1e-12",
        reversal,
    ),
)
AXIAL = Claim(
    "H19", "A larger helix angle gives a larger axial excitation", "sec. 6, eq. (15)",
    "1e-12; rising", axial_share,
)  # fmt: skip
