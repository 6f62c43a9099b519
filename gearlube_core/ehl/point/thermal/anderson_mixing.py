"""Anderson mixing: combines the last fixed-point iterates to converge faster."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array


class AndersonMixing:
    """Next value of x = g(x) from the last ones: what the least change of x = g(x) asks for.

    Parameters
    ----------
    depth
        Turns that are mixed, besides the last one.

    Notes
    -----
    x_next = g_k - sum over j of gamma_j (g_j+1 - g_j), where the sum of gamma_j (f_j+1 - f_j) is
    nearest to f_k = g_k - x_k. Source: [anderson_1965]; [walker_ni_2011], type II.
    """

    def __init__(self, depth: int) -> None:
        self._depth = depth
        self._values: list[Array] = []
        self._misses: list[Array] = []

    def __call__(self, before: Array, after: Array) -> Array:
        """Return the next value from the one before a turn and the one after it."""
        self._values.append(after.copy())
        self._misses.append(after - before)
        del self._values[: -self._depth - 1], self._misses[: -self._depth - 1]
        miss = self._misses[-1]
        changes = [later - earlier for earlier, later in zip(self._misses, self._misses[1:],
                                                             strict=False)]  # fmt: skip
        if not changes:
            return after
        table = np.array([[np.vdot(a, b) for b in changes] for a in changes])
        right = np.array([np.vdot(a, miss) for a in changes])
        # equations as they are scaled: old turns are larger by orders of magnitude
        scale = 1.0 / np.sqrt(np.maximum(np.diag(table), 1e-300))
        share = np.linalg.lstsq(table * np.outer(scale, scale), right * scale, rcond=1e-12)[0]
        mixed = after.copy()
        for weight, earlier, later in zip(share * scale, self._values, self._values[1:],
                                          strict=False):  # fmt: skip
            mixed -= weight * (later - earlier)
        return np.asarray(mixed)
