"""Figure 3 of He et al. 2007 drawn from its inches: circles and a tangent, no formula of ours."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from docs.helical.cases import HE
from gearlube_core.arrays import Array

INCH = 0.0254  # m
ORDER = ("A", "P", "C", "Q", "D", "E", "H", "G", "R")


def drawn_landmarks() -> dict[str, float]:
    """Return the distances from T1 of the letters of fig. 3 [m]."""
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
