"""Levelling: the mean line or plane, or a polynomial, taken off by least squares."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.polynomial import legendre

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.surface.heights import Profile, S

_HIGHEST = 8  # degree; more is the work of a filter


def levelled(surface: S, degree: int = 1) -> S:
    """Return a surface without its form: its least-squares polynomial is subtracted.

    Parameters
    ----------
    surface
        Profile or map.
    degree
        Degree of the polynomial, to 8. 0: the mean; 1: a line or plane; of a map in x and y
        together. Along periodic sides the degree is always 0, because they have no slope.

    Raises
    ------
    ParameterError
        The degree is no whole number from 0 to 8, or there are too few points for it.

    Examples
    --------
    >>> slope = Profile(height=1e-8 * np.arange(50.0), spacing=1e-6)
    >>> bool(abs(levelled(slope).height).max() < 1e-18)
    True
    """
    if isinstance(degree, bool) or degree not in range(_HIGHEST + 1):
        raise ParameterError(
            f"degree must be a whole number within 0 to {_HIGHEST}, got {degree!r}. Use a filter "
            "to remove waviness."
        )
    height = surface.height
    if min(height.shape) <= degree:
        raise ParameterError(
            f"{surface.name}: degree must be below the {min(height.shape)} points along a side, "
            f"got {degree}."
        )
    if isinstance(surface, Profile):
        basis = _basis(height.size, 0 if surface.periodic else degree)
        return replace(surface, height=height - basis @ (basis.T @ height))
    along_x, along_y = (
        _basis(count, 0 if closed else degree)
        for count, closed in zip(height.shape, surface.periodic, strict=True)
    )
    weights = along_x.T @ height @ along_y
    powers = np.add.outer(np.arange(weights.shape[0]), np.arange(weights.shape[1]))
    weights[powers > degree] = 0.0
    return replace(surface, height=height - along_x @ weights @ along_y.T)


def _basis(count: int, degree: int) -> Array:
    """Return orthonormal polynomials (count, degree + 1) at even points."""
    legendres = legendre.legvander(np.linspace(-1.0, 1.0, count), degree)
    return np.asarray(np.linalg.qr(legendres)[0])
