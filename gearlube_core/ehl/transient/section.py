"""A part of a line contact in time, with heights that pass through it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.transient.conditions import FilmConditions
from gearlube_core.ehl.transient.problem import MovingFilm
from gearlube_core.errors import ParameterError

# (x, y, time) to heights of both solids above their smooth shape together [m], shape (nx, ny)
Heights = Callable[[Array, Array, float], Array]


def moving_section(
    section: PointContactProblem, heights: Heights, solids: SolidContact | None = None
) -> MovingFilm:
    """Return the film of a part of a line contact whose heights change in time.

    Parameters
    ----------
    section
        The smooth contact with its sliding, of `line_section`.
    heights
        Of nodes x (nx,) and y (ny,) [m] and a time [s]: what both solids together stand above
        their smooth shape [m], shape (nx, ny). It narrows the gap.
    solids
        What carries load where the film vanishes; None: the oil alone.

    Raises
    ------
    ParameterError
        The section does not say how it slides.
    """
    if section.sliding is None:
        raise ParameterError("section must have sliding, got none. Give (u_2 - u_1, 0) m/s.")
    mean, half = section.entrainment[0], 0.5 * section.sliding[0]

    def conditions(x: Array, y: Array, time: float) -> FilmConditions:
        gap = section.gap(x[:, None], y[None, :]) - heights(x, y, time)
        rows = np.ones(y.size)
        return FilmConditions(gap, section.load, (mean - half) * rows, (mean + half) * rows)

    return MovingFilm(
        conditions=conditions,
        lubricant=section.lubricant,
        contact_modulus=section.contact_modulus,
        x_limits=section.x_limits,
        y_limits=section.y_limits,
        nodes=section.nodes,
        hertz=section.hertz,
        load=section.load,
        speed=mean,
        solids=solids,
        sides=section.sides,
    )
