"""Time steps of one contact line through its meshing cycle, and the thesis' position s_i."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.units import MILLIMETRE


def line_at_position(s_i: ArrayLike, pair: HelicalPair) -> Array:
    """Return X of the line whose end on the face z = -W/2 lies at s_i.

    X = x_P + s_i + F tan(beta_b)

    Parameters
    ----------
    s_i
        From the pitch line along the line of action [m], any shape: [jamali_2015 sec. 2.2.1].
    pair
        Helical or spur gear pair.

    Returns
    -------
    array
        [m], what contact lines are named by in gearlube.
    """
    return np.asarray(s_i, dtype=float) + pair.pitch_point + _lag(pair)


def position_of_line(X: ArrayLike, pair: HelicalPair) -> Array:
    """Return s_i [m] of the lines X [m], any shape."""
    return np.asarray(X, dtype=float) - pair.pitch_point - _lag(pair)


def _lag(pair: HelicalPair) -> float:
    """How far a line's end on the face z = -W/2 lags behind that on the other [m]."""
    return pair.face_width * math.tan(pair.base_helix_angle)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshingSteps:
    """Equal steps of a line: s_i = s_0 + step n, n = 0 to count.

    Parameters
    ----------
    pair : HelicalPair
    first_position : float
        s_0 [m].
    step : float
        Advance along the line of action [m].
    count : int
        Steps [-].

    Raises
    ------
    ParameterError
        A step or count that is not positive.
    """

    pair: HelicalPair
    first_position: float
    step: float
    count: int

    def __post_init__(self) -> None:
        check_positive("step", self.step, "m", "Give metres.")
        check_within("count", self.count, 1, 1_000_000)
        check_within("first_position", self.first_position, -1.0, 1.0, "m", "Give metres.")

    def position(self, n: ArrayLike) -> Array:
        """Return s_i [m] at steps n, any shape."""
        return self.first_position + self.step * np.asarray(n, dtype=float)

    def line(self, n: ArrayLike) -> Array:
        """Return X [m] at steps n, any shape."""
        return line_at_position(self.position(n), self.pair)

    def step_at(self, s_i: ArrayLike) -> Array:
        """Return the step [-], not rounded, at which the line lies at s_i [m]."""
        return (np.asarray(s_i, dtype=float) - self.first_position) / self.step

    def duration(self, pinion_speed: float) -> float:
        """Return the time of one step [s] at a pinion speed [rad/s]."""
        check_positive("pinion_speed", pinion_speed, "rad/s", "Give the speed's magnitude.")
        return self.step / (self.pair.pinion_base_radius * pinion_speed)

    @property
    def side_face_limits(self) -> tuple[float, float]:
        """Steps between which the side faces, not the tips, end the line at both ends [-].

        Empty, the second below the first, where F tan(beta_b) exceeds the path of contact.
        """
        p = self.pair
        low = self.step_at(p.contact_start - p.pitch_point)
        return float(low), float(self.step_at(p.contact_end - p.pitch_point - _lag(p)))


def meshing_steps(modified: ModifiedPair, step: float, smallest_share: float) -> MeshingSteps:
    """Return the steps between which the unrelieved line is long enough.

    L(s_i) >= share w,  w = F/cos(beta_b)

    Parameters
    ----------
    modified
        Modified pair; tip relief shortens the line.
    step
        Advance along the line of action [m].
    smallest_share
        L/w at both ends of the analysed cycle [-]; [jamali_2015 sec. 4.4] takes 0.16.

    Returns
    -------
    MeshingSteps
        Whole steps; the last may end up to one step early.

    Raises
    ------
    ParameterError
        A share that no line reaches.
    """
    check_within("smallest_share", smallest_share, 0.0, 1.0)
    check_positive("step", step, "m", "Give metres.")
    pair, lag = modified.pair, _lag(modified.pair)
    low, high = modified.contact_start, modified.contact_end
    if smallest_share * lag > high - low:
        raise ParameterError(
            f"smallest_share must be at most {(high - low) / lag:.3g}, the longest line over "
            f"F/cos(beta_b), got {smallest_share:g}. Lower it."
        )
    first = low - (1.0 - smallest_share) * lag - pair.pitch_point
    last = high - smallest_share * lag - pair.pitch_point
    return MeshingSteps(
        pair=pair, first_position=first, step=step, count=math.floor((last - first) / step)
    )


def gear_file_steps(file: HelicalGearFile) -> MeshingSteps:
    """Return the steps of a gear file's section [meshing_steps].

    Raises
    ------
    ParameterError
        The file has no such section.
    """
    given = file.meshing_steps
    if given is None:
        raise ParameterError(
            f"meshing_steps must be in the gear file, got none in {file.name!r}. Add the section, "
            "or take meshing_steps(...), which cuts the cycle by the length of the line."
        )
    return MeshingSteps(
        pair=file.helical_pair(),
        first_position=given.first_position_mm * MILLIMETRE,
        step=given.step_mm * MILLIMETRE,
        count=given.count,
    )
