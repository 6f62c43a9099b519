"""Stability of a periodic motion from the eigenvalues of its monodromy matrix."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

Multipliers = np.ndarray[Any, np.dtype[np.complex128]]


def floquet_multipliers(monodromy: Array, *, trivial: int = 0) -> Multipliers:
    """Return the multipliers that decide stability, largest modulus first, shape (k - trivial,).

    Parameters
    ----------
    monodromy : ndarray, shape (k, k)
        Derivative of the state after a period by the state at its start.
    trivial
        Number of multipliers equal to one by construction; the ones closest to +1 are left out.
        Near a fold a multiplier that matters comes as close, and which of the two is left out is
        then within their distance of no consequence.

    Raises
    ------
    ParameterError
        The matrix is not square or has fewer rows than trivial multipliers.

    Notes
    -----
    A disturbance along an eigenvector is multiplied by mu each period ([floquet_1883]). With
    damping, the product of all multipliers is exp of the integral of the divergence over the
    period.

    Examples
    --------
    >>> floquet_multipliers(np.array([[0.0, -0.25], [1.0, 0.0]])).imag.round(9).tolist()
    [0.5, -0.5]
    """
    if monodromy.ndim != 2 or monodromy.shape[0] != monodromy.shape[1]:
        raise ParameterError(f"monodromy must be square, got shape {monodromy.shape}.")
    if trivial > monodromy.shape[0]:
        raise ParameterError(
            f"trivial must be at most the {monodromy.shape[0]} states, got {trivial}."
        )
    if not np.isfinite(monodromy).all():
        return np.full(monodromy.shape[0] - trivial, complex(np.nan, np.nan))
    mu = np.linalg.eigvals(monodromy).astype(np.complex128)
    if trivial:
        mu = mu[np.argsort(np.abs(mu - 1.0))[trivial:]]
    return mu[np.lexsort((-mu.imag, -np.abs(mu)))]


def stability_margin(multipliers: Multipliers) -> float:
    """Return 1 - max |mu| [-]: the smallest decay of a disturbance over one period.

    Negative where disturbances grow; one where nothing can be disturbed.
    """
    return 1.0 - float(np.max(np.abs(multipliers), initial=0.0))


def stable(multipliers: Multipliers) -> bool:
    """Whether every small disturbance dies out: all multipliers inside the unit circle."""
    return stability_margin(multipliers) > 0.0


def exchange_test(multipliers: Multipliers) -> float:
    """Return the product of (1 - mu) [-]; changes sign where one real multiplier passes +1."""
    return float(np.prod(1.0 - multipliers).real)


def doubling_test(multipliers: Multipliers) -> float:
    """Return the product of (1 + mu) [-]; changes sign where one real multiplier passes -1."""
    return float(np.prod(1.0 + multipliers).real)


def torus_test(multipliers: Multipliers) -> float:
    """Return the product of (mu_i mu_j - 1) over pairs [-].

    It changes sign where a complex pair passes the unit circle, and also where two real multipliers
    become reciprocal, which is no bifurcation: `torus_pair` separates them.
    """
    i, j = np.triu_indices(multipliers.size, 1)
    return float(np.prod(multipliers[i] * multipliers[j] - 1.0).real)


def torus_pair(multipliers: Multipliers) -> bool:
    """Whether the two multipliers whose product is closest to one are complex."""
    i, j = np.triu_indices(multipliers.size, 1)
    if i.size == 0:
        return False
    closest = int(np.argmin(np.abs(multipliers[i] * multipliers[j] - 1.0)))
    return bool(multipliers[i[closest]].imag != 0.0)
