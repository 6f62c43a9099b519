"""Packages of optional dependencies, imported where they are needed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from gearlube_core.errors import ParameterError


def extra_package(module: str, extra: str, what: str, instead: str = "") -> Any:
    """Return a module of the optional dependencies `extra`.

    Parameters
    ----------
    module : str
        Module to import, such as "sklearn.gaussian_process".
    extra : str
        As in `pip install 'gearlube[extra]'`.
    what : str
        What needs it, with its verb, such as "A VTK file is written".
    instead : str
        A sentence on what also works.

    Raises
    ------
    ParameterError
        The package is not installed.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as missing:
        top = module.partition(".")[0]
        if missing.name is not None and missing.name.partition(".")[0] != top:
            raise  # the package is there, and lacks another
        package = top.replace("sklearn", "scikit-learn")
        raise ParameterError(
            f"{what} by the package {package}, which is not installed. Install it: "
            f"pip install 'gearlube[{extra}]'.{' ' * bool(instead)}{instead}"
        ) from None
