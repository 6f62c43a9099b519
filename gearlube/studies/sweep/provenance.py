"""Version of the code that computed a point."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

import drivetrain
from gearlube_core import __version__


@cache
def code_version() -> str:
    """Return version and digest of the drivers and of the sweep, "0.1.0+1a2b3c4d5e6f".

    The axle itself is identified by the GUID of its FMU.
    """
    root = Path(str(drivetrain.__file__)).parent
    digest = hashlib.sha256()
    for path in sorted([*root.rglob("*.py"), *Path(__file__).parent.glob("*.py")]):
        digest.update(path.name.encode())
        digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return f"{__version__}+{digest.hexdigest()[:12]}"
