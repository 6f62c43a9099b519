"""Physics core of gearlube: lubricated gear contacts, films, friction, bearings and dynamics."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("gearlube")
except PackageNotFoundError:  # imported from a source tree that was never installed
    __version__ = "0+unknown"
