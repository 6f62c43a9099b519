"""Sums over contact lines whose points lift off one by one, with derivatives: kernel."""

from __future__ import annotations

from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import built_up
from gearlube_core.dynamics.helical_pair.separation.points import (
    ALONG,
    DRAG,
    OFFSET,
    OFFSET_RATE,
    STIFFNESS,
    STIFFNESS_RATE,
    X,
    Z,
)
from gearlube_core.kernels.jit import kernel

# rows 0 to 4 are the sums of `mesh_wrench`; then per flank, drive and back, what damping needs
FLANK_LOAD, FLANK_DAMPING = (5, 6), (7, 8)
N_ROWS = 9
VALUE, BY_Y0, BY_Y1, BY_TORQUE = range(4)
N_BY = 4


@kernel
def separating_sums(
    y0: float, y1: float, points: Array, n: int, backlash: float, build_up: float, sums: Array
) -> float:
    """Fill the sums over the contact lines with their derivatives; return k dl in contact [N/m].

    w = k max(0, delta - e) on the drive flank, -k max(0, -delta - backlash - e) on the back flank,
    delta = y0 + p y1

    Parameters
    ----------
    y0, y1
        Strains of the plane of contact [m], [rad].
    points : ndarray of shape (at least n, N_POINT)
    backlash
        Normal [m].
    build_up
        Penetration over which a point's damping builds up [m].
    sums : ndarray of shape (N_ROWS, N_BY)
        Written. Rows: w, w p, r, r x, r z, w of either flank, k min(1, penetration/build_up) of
        either flank, all integrated over dl. Columns: value, derivatives by y0, y1 and the pinion
        torque.

    Notes
    -----
    Line loads as in `mesh_wrench.line_loads`, one-sided. The derivatives are exact but where a
    point is about to touch, where the sums have kinks.
    """
    sums[:, :] = 0.0
    touching = 0.0
    for i in range(n):
        p, k, e = points[i, ALONG], points[i, STIFFNESS], points[i, OFFSET]
        delta = y0 + p * y1
        pressed, side, flank = delta - e, 1.0, 0
        if pressed < 0.0:
            pressed, side, flank = delta + backlash + e, -1.0, 1
        if pressed * side <= 0.0:
            continue
        touching += k
        k_rate, e_rate = points[i, STIFFNESS_RATE], points[i, OFFSET_RATE]
        r, x, z = side * points[i, DRAG], points[i, X], points[i, Z]
        share = built_up(side * pressed, build_up)
        slope = side * k / build_up if share < 1.0 else 0.0
        for by in range(N_BY):
            if by == VALUE:
                w, damping = k * pressed, k * share
            elif by == BY_Y0:
                w, damping = k, slope
            elif by == BY_Y1:
                w, damping = k * p, slope * p
            else:
                w = k_rate * pressed - side * k * e_rate
                damping = k_rate * share - side * slope * e_rate
            sums[0, by] += w
            sums[1, by] += w * p
            sums[2, by] += r * w
            sums[3, by] += r * w * x
            sums[4, by] += r * w * z
            sums[FLANK_LOAD[flank], by] += w
            sums[FLANK_DAMPING[flank], by] += damping
    return touching
