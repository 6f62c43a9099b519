"""Convolution by FFT along both axes, in blocks that stay in the cache of a processor."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.contact.fftw import pyfftw
from gearlube_core.kernels.row_workers import RowWorkers

_ROWS, _COLUMNS = 32, 64  # of a block; results have the roundings of their blocks


class BlockedTransform:
    """Real array to the waves along its rows and its columns, times a transfer, and back.

    Columns are transformed, multiplied and transformed back block by block, so that large arrays
    pass the memory three times instead of six. Blocks are the same for any number of threads.

    Parameters
    ----------
    padded, result
        Input and output, (rows, length), aligned, which this keeps.
    transfer : ndarray, shape (rows, length//2 + 1)
        Real, with the factor 1/(rows length).
    workers
        Threads that share the blocks.
    """

    def __init__(self, padded: Any, result: Any, transfer: Array, workers: RowWorkers) -> None:
        rows, waves = transfer.shape
        paired: Any = np.result_type(padded.dtype, np.complex64)
        spectrum = pyfftw.empty_aligned((rows, waves), dtype=paired)
        options: dict[str, Any] = {"flags": ("FFTW_ESTIMATE",), "threads": 1}
        back: dict[str, Any] = {"direction": "FFTW_BACKWARD", **options}
        self._workers = workers
        self._rows, self._columns, self._returns = [], [], []
        for first in range(0, rows, _ROWS):
            part = slice(first, first + _ROWS)
            self._rows.append(pyfftw.FFTW(padded[part], spectrum[part], axes=(1,), **options))
            self._returns.append(pyfftw.FFTW(spectrum[part], result[part], axes=(1,), **back))
        for first in range(0, waves, _COLUMNS):
            block = spectrum[:, first : first + _COLUMNS]
            turned = pyfftw.empty_aligned(block.shape[::-1], dtype=paired)
            factor = np.repeat(transfer[:, first : first + _COLUMNS].T, 2, axis=1)
            self._columns.append(
                (
                    pyfftw.FFTW(block, turned.T, axes=(0,), **options),
                    turned.view(padded.dtype),
                    factor.astype(padded.dtype),
                    pyfftw.FFTW(turned.T, block, axes=(0,), **back),
                )
            )

    def execute(self) -> None:
        """Transform, multiply and transform back; the input is destroyed nowhere."""
        share = self._workers.share
        share(lambda part: [one.execute() for one in self._rows[slice(*part)]], len(self._rows))
        share(self._multiply, len(self._columns))
        share(lambda part: [one.execute() for one in self._returns[slice(*part)]], len(self._rows))

    def _multiply(self, part: tuple[int, int]) -> None:
        for forward, values, factor, backward in self._columns[slice(*part)]:
            forward.execute()
            np.multiply(values, factor, out=values)
            backward.execute()
