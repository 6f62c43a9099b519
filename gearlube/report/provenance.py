"""Versions and date: what a report says of its origin."""

from __future__ import annotations

import platform
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version

from gearlube_core import __version__

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib", "plotly")


def versions() -> list[tuple[str, str]]:
    """Return the versions of gearlube, of Python and of the packages that results rest on."""
    found = [("gearlube", __version__), ("Python", platform.python_version())]
    found.append(("system", f"{platform.system()} {platform.machine()}"))
    for package in _PACKAGES:
        try:
            found.append((package, version(package)))
        except PackageNotFoundError:  # an installation without it
            continue
    return found


def today() -> str:
    """Return date and time of now, UTC, as "2026-03-01 12:30 UTC"."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
