"""The part of a film that statistics are taken over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array, Flags
from gearlube_core.checks import check_positive
from gearlube_core.ehl.point.equations.mesh import cell_faces
from gearlube_core.errors import ParameterError

_FEWEST = 4  # nodes along a side


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class FilmZone:
    """The nodes of a film whose statistics are taken, usually inside the Hertzian contact.

    Parameters
    ----------
    x, y
        Nodes [m], shapes (nx,) and (ny,).
    inside
        Which nodes are counted, shape (nx, ny).
    cells
        Areas of all cells [m2], shape (nx, ny).

    Examples
    --------
    >>> zone = FilmZone.line(np.linspace(-4e-4, 4e-4, 401), np.linspace(0.0, 1e-3, 33), 2.01e-4)
    >>> int(zone.inside.sum())
    6633
    """

    x: Array
    y: Array
    inside: Flags
    cells: Array

    @classmethod
    def line(cls, x: Array, y: Array, half_width: float) -> FilmZone:
        """Return |x| <= a on all rows, a [m] the half-width of a line contact."""
        check_positive("half_width", half_width, "m")
        return cls._of(x, y, np.abs(x)[:, None] <= half_width + 0.0 * y)

    @classmethod
    def ellipse(cls, x: Array, y: Array, a: float, b: float) -> FilmZone:
        """Return (x/a)^2 + (y/b)^2 <= 1, with the half-axes of a point contact [m]."""
        check_positive("a", a, "m")
        check_positive("b", b, "m")
        return cls._of(x, y, (x[:, None] / a) ** 2 + (y / b) ** 2 <= 1.0)

    @classmethod
    def _of(cls, x: Array, y: Array, inside: Flags) -> FilmZone:
        for name, nodes in (("x", x), ("y", y)):
            if nodes.ndim != 1 or nodes.size < _FEWEST or not (np.diff(nodes) > 0.0).all():
                raise ParameterError(
                    f"{name} must be at least {_FEWEST} rising places [m], got shape {nodes.shape}."
                )
        if not inside.any():
            raise ParameterError(
                "The Hertzian contact must hold a node, got none. Give lengths in m and x = 0 in "
                "its middle."
            )
        cells = np.diff(cell_faces(x))[:, None] * np.diff(cell_faces(y))
        return cls(x=x, y=y, inside=inside, cells=cells)
