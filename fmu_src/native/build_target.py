"""The kind of processor that kernels of native FMUs are optimised for."""

from __future__ import annotations

import os
import sys
from platform import machine

_LEVELS = {"amd64": "x86-64-v2", "x86_64": "x86-64-v2"}


def compile_for_any_machine() -> bool:
    """Let numba optimise for the level of native FMUs, not for this machine's processor.

    The intermediate code then does not depend on the machine that builds, and neither do the
    archives. Call it before numba is imported.

    Returns
    -------
    bool
        Whether it has an effect: False where numba has been imported already.
    """
    if "numba" in sys.modules:
        return False
    os.environ["NUMBA_CPU_NAME"] = _LEVELS.get(machine().lower(), "generic")
    os.environ["NUMBA_CPU_FEATURES"] = ""
    return True
