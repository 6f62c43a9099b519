"""Planned Fourier transforms: those of pyfftw, or where it is not installed those of SciPy.

FFTW is GPL, and not everyone may pass it on. SciPy's give the same numbers to round-off.
pyfftw imports dask's arrays where dask is installed, for half a second of processor time. Nothing
here uses them: plans are made by `pyfftw.FFTW` itself. `import pyfftw.interfaces.dask_fft` still
gives that interface to others.
"""

from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import scipy.fft

from gearlube_core.arrays import Array

__all__ = ["SciPyTransform", "pyfftw", "scipy_transforms"]


class SciPyTransform:
    """Transform of one array into another, without a factor, called as `pyfftw.FFTW`.

    Parameters
    ----------
    source, target : ndarray
        Real to complex, complex to complex, or complex to real; `execute` reads and writes them.
    axes : tuple of int
    direction : str
        Direction: "FFTW_FORWARD" or "FFTW_BACKWARD".
    **options
        How FFTW plans; they change nothing here.
    """

    def __init__(
        self,
        source: Array,
        target: Array,
        axes: tuple[int, ...] = (-1,),
        direction: str = "FFTW_FORWARD",
        **options: Any,
    ) -> None:
        self.source, self.target, self.axes = source, target, axes
        self.back = direction == "FFTW_BACKWARD"

    def execute(self) -> None:
        """Write the transform of the source into the target."""
        source, axes = self.source, self.axes
        if self.target.dtype.kind == "f":
            size = [self.target.shape[axis] for axis in axes]
            self.target[:] = scipy.fft.irfftn(source, size, axes, norm="forward")
        elif source.dtype.kind == "f":
            self.target[:] = scipy.fft.rfftn(source, axes=axes)
        elif self.back:
            self.target[:] = scipy.fft.ifftn(source, axes=axes, norm="forward")
        else:
            self.target[:] = scipy.fft.fftn(source, axes=axes)


scipy_transforms = SimpleNamespace(
    FFTW=SciPyTransform,
    empty_aligned=np.empty,
    zeros_aligned=np.zeros,
    next_fast_len=scipy.fft.next_fast_len,
)


def _installed() -> Any:
    """Return pyfftw, imported without dask, or SciPy's transforms."""
    without_dask = "pyfftw" not in sys.modules and "dask" not in sys.modules
    if without_dask:
        sys.modules["dask"] = None  # type: ignore[assignment]  # as if it were not installed
    try:
        import pyfftw
    except ImportError:
        return scipy_transforms
    finally:
        if without_dask:
            del sys.modules["dask"]
    return pyfftw


pyfftw = _installed()
