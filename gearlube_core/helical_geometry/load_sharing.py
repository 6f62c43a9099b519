"""Load of a contact line as its share of the total contact length.

The working assumption of [jamali_2015 sec. 4.1]: the load spreads evenly over what is left of the
contact lines between the starts of tip relief. Loaded tooth contact needs no such assumption.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import (
    ContactPlane,
    clip_line,
    line_count,
    line_position,
    segment_length,
)
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.kernels.jit import kernel

CONVENTIONS = ("normal", "thesis")


class SharedLoad(NamedTuple):
    """Lengths and loads of contact lines; arrays of the shape of their positions."""

    length: Array  # of the line, between the starts of relief [m]
    total_length: Array  # of all lines in contact with it [m]
    share: Array  # of the load [-]
    load: Array  # on the line [N]
    line_load: Array  # per unit of its length [N/m]; zero where the line has none


def relief_on_path(tip_radius: float, base_radius: float, depth: float) -> float:
    """Return the part of the path of contact that tip relief removes [m].

    z = sqrt(r_tip^2 - r_b^2) - sqrt(r_start^2 - r_b^2),  r_start = r_tip - depth

    Parameters
    ----------
    tip_radius, base_radius
        Of the relieved member [m].
    depth
        Radial [m]; the relief starts outside the base circle.

    Notes
    -----
    Source: [jamali_2015 (2.14)], pinion: z_p, and [jamali_2015 (2.15)], wheel: z_w.
    """
    check_positive("base_radius", base_radius, "m")
    check_within(
        "depth", depth, 0.0, tip_radius - base_radius, "m",
        "Relief must start outside the base circle.",
    )  # fmt: skip
    start = tip_radius - depth
    return math.sqrt(tip_radius**2 - base_radius**2) - math.sqrt(start**2 - base_radius**2)


def unrelieved_plane(modified: ModifiedPair) -> ContactPlane:
    """Return the plane of contact cut at the starts of tip relief: A + z_w to D - z_p."""
    start, end = modified.contact_start, modified.contact_end
    if not start < end:
        raise ParameterError(
            "Tip relief must leave part of the path of contact without relief, but "
            f"{1e3 * (end - start):.4g} mm is left (limit 0 mm). Shorten the relief."
        )
    return modified.pair.plane._replace(A=start, D=end)


def positions_at(phase: ArrayLike, pair: HelicalPair) -> Array:
    """Return X of all lines at mesh phases, shape (phases, lines) [m]."""
    plane = pair.plane
    return np.array(
        [
            [line_position(float(one), line, plane) for line in range(line_count(plane))]
            for one in np.ravel(phase)
        ]
    )


def shared_load(
    X: ArrayLike, modified: ModifiedPair, torque: float, convention: str = "normal"
) -> SharedLoad:
    """Return length, share and load of contact lines.

    P(X) = F L(X)/sum_n L(X + n lambda),  F = T_1/(r_b1 cos(beta_b))

    Parameters
    ----------
    X
        Of the lines [m], any shape; see `line_at_position` and `positions_at`.
    modified
        Pair with its tip relief; without relief the whole path of contact carries.
    torque
        T_1, on the pinion [N.m].
    convention
        What F is: "normal", the force normal to the flanks that balances the torque, or "thesis",
        T_1/r_b1, which leaves out cos(beta_b) as Jamali 2015 does.

    Returns
    -------
    SharedLoad

    Raises
    ------
    ParameterError
        At one of the positions no line is left unrelieved.

    Notes
    -----
    Source: [jamali_2015 sec. 4.1]; 14.4 kN at the most with his convention.
    """
    check_positive("torque", torque, "N.m", "Torque drives the pinion.")
    check_option("convention", convention, CONVENTIONS)
    pair, plane = modified.pair, unrelieved_plane(modified)
    position = np.asarray(X, dtype=float)
    flat = np.ravel(position)
    length = _lengths(flat, plane).reshape(position.shape)
    total = _totals(flat, plane).reshape(position.shape)
    if (total <= 0.0).any():
        raise ParameterError(
            "the length of unrelieved contact must be above 0 m at every position, got 0 m at "
            f"X = {flat[np.argmin(total)]:.6g} m. Shorten the tip relief or widen the face."
        )
    force = torque / pair.pinion_base_radius
    if convention == "normal":
        force /= math.cos(pair.base_helix_angle)
    share = length / total
    line_load = np.where(length > 0.0, force / total, 0.0)
    return SharedLoad(length, total, share, force * share, line_load)


@kernel
def _lengths(X: Any, plane: ContactPlane) -> Any:
    lengths = np.empty(X.size)
    for i in range(X.size):
        lengths[i] = segment_length(clip_line(X[i], plane), plane)
    return lengths


@kernel
def _totals(X: Any, plane: ContactPlane) -> Any:
    """Return the sum over all lines that are in contact at the same time as line X."""
    totals = np.empty(X.size)
    count = line_count(plane)
    for i in range(X.size):
        phase = (X[i] - plane.A) / plane.pitch
        total = 0.0
        for line in range(count):
            X_line = line_position(phase, line, plane)
            total += segment_length(clip_line(X_line, plane), plane)
        totals[i] = total
    return totals
