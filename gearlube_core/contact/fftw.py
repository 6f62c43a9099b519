"""pyfftw without its interface to dask, whose import costs half a second of processor time.

pyfftw imports dask's arrays where dask is installed. Nothing here uses them: plans are made by
`pyfftw.FFTW` itself. `import pyfftw.interfaces.dask_fft` still gives that interface to others.
"""

from __future__ import annotations

import sys

__all__ = ["pyfftw"]

if "pyfftw" in sys.modules or "dask" in sys.modules:
    import pyfftw
else:
    sys.modules["dask"] = None  # type: ignore[assignment]  # as if it were not installed
    try:
        import pyfftw
    finally:
        del sys.modules["dask"]
