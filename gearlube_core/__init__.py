"""Physics core of gearlube: lubricated gear contacts, films, friction, bearings and dynamics."""

from __future__ import annotations


def __getattr__(name: str) -> str:
    """Return `__version__`, which takes time to look up."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("gearlube")
    except PackageNotFoundError:  # imported from a source tree that was never installed
        return "0+unknown"
