"""Compliance of several contact strips: half-space cells plus a smooth coupling of low rank."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from gearlube_core.arrays import Array
from gearlube_core.contact.half_space import HalfSpaceConvolution
from gearlube_core.errors import ParameterError

_SYMMETRY = 1e-9  # of the largest entry: above the rounding of a solved influence matrix


class StripCompliance:
    """Displacement u = A f + W K W^T f of the cells of all strips under their forces.

    A is block diagonal, one half-space strip a tooth pair; W interpolates from a few smooth
    shape functions to cells, and K is their compliance: bending, base rotation, shafts, and the
    coupling of tooth pairs through the rim.

    Parameters
    ----------
    strips
        One convolution a strip; cells are numbered strip by strip, each with y fastest. Strips
        may share one object.
    shapes : sparse array, shape (n_cells, n_shapes), optional
        W [-]; left out together with `shape_compliance`.
    shape_compliance : ndarray, shape (n_shapes, n_shapes), optional
        K [m/N], symmetric; may be indefinite as long as the sum with A is positive definite.

    Raises
    ------
    ParameterError
        No strip, shapes that do not fit, or K neither finite nor symmetric.

    Notes
    -----
    Calls write into one buffer: an object serves one thread at a time.
    """

    __slots__ = ("_compliance", "_displacement", "_gather", "_rows", "_spread", "n_cells", "strips")

    def __init__(
        self,
        strips: Sequence[HalfSpaceConvolution],
        shapes: Any = None,
        shape_compliance: Array | None = None,
    ) -> None:
        if not strips:
            raise ParameterError("strips must hold at least one strip, got none.")
        self.strips = tuple(strips)
        ends = np.cumsum([0, *(strip.shape[0] * strip.shape[1] for strip in strips)])
        self._rows = tuple(slice(int(a), int(b)) for a, b in pairwise(ends))
        self.n_cells = int(ends[-1])
        self._displacement = np.zeros(self.n_cells)
        self._spread: csr_array | None = None
        if (shapes is None) != (shape_compliance is None):
            raise ParameterError("shapes and shape_compliance belong together, got one of them.")
        if shapes is not None and shape_compliance is not None:
            self._spread = csr_array(shapes, dtype=np.float64)
            self._gather = csr_array(self._spread.T)
            self._compliance = _checked_compliance(shape_compliance)
            expected = (self.n_cells, self._compliance.shape[0])
            if self._spread.shape != expected:
                raise ParameterError(
                    f"shapes must have shape {expected}, got {self._spread.shape}: one row a cell "
                    "of all strips, one column a row of shape_compliance."
                )

    def __call__(self, forces: Array) -> Array:
        """Return the displacement [m], shape (n_cells,), under cell forces [N], same shape.

        The result is a buffer that the next call overwrites.
        """
        for rows, strip in zip(self._rows, self.strips, strict=True):
            self._displacement[rows].reshape(strip.shape)[:] = strip(
                forces[rows].reshape(strip.shape)
            )
        if self._spread is not None:
            self._displacement += self._spread @ (self._compliance @ (self._gather @ forces))
        return self._displacement


def _checked_compliance(shape_compliance: Array) -> Array:
    compliance = np.array(shape_compliance, dtype=np.float64)
    if compliance.ndim != 2 or compliance.shape[0] != compliance.shape[1]:
        raise ParameterError(f"shape_compliance must be square, got shape {compliance.shape}.")
    if not np.isfinite(compliance).all():
        raise ParameterError("shape_compliance must be finite, got NaN or infinity in m/N.")
    asymmetry = np.abs(compliance - compliance.T).max(initial=0.0)
    largest = np.abs(compliance).max(initial=0.0)
    if asymmetry > _SYMMETRY * largest:
        raise ParameterError(
            f"shape_compliance must be symmetric within {_SYMMETRY:g} of its largest entry "
            f"{largest:g} m/N, got a difference of {asymmetry:g} m/N. Average it with "
            "its transpose."
        )
    return np.asarray(0.5 * (compliance + compliance.T))
