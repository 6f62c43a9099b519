"""Exceptions raised by gearlube. Kernels never raise; they return a status."""

from __future__ import annotations

from pathlib import Path


class GearLubeError(Exception):
    """Base class of all errors that gearlube raises on purpose; catch it to catch them all.

    Examples
    --------
    >>> from gearlube_core.units import celsius_to_kelvin
    >>> from gearlube_core.oil.lubricant import Lubricant
    >>> try:
    ...     Lubricant.named("mohammadpour_2015").dynamic_viscosity(95.0)
    ... except GearLubeError as error:
    ...     print(str(error)[:31])
    temperature must be within 273.
    """


class ParameterError(GearLubeError, ValueError):
    """An input is outside its valid range; the message says the limit and what to do.

    Examples
    --------
    >>> issubclass(ParameterError, ValueError)
    True
    """


class ConvergenceError(GearLubeError):
    """An iterative solution did not reach its tolerance."""


class StepError(GearLubeError):
    """A time step was refused; the model is still in the state before the step."""


class TableError(GearLubeError, ValueError):
    """A mesh table file is incomplete or contradicts itself."""


class InterruptedRunError(GearLubeError):
    """A long run was stopped from the keyboard; the message says which results are stored."""


class FileError(GearLubeError):
    """A file is missing, damaged or of another kind."""


def is_of_machine(error: BaseException) -> bool:
    """Return whether an error comes from memory, disk or a fault of the program, not from physics.

    What fails so may succeed when it is computed again.

    Examples
    --------
    >>> is_of_machine(MemoryError()), is_of_machine(ConvergenceError("no equilibrium"))
    (True, False)
    """
    behind = error.__cause__ or error.__context__
    return (
        not isinstance(error, GearLubeError)
        or isinstance(error, FileError)
        or isinstance(behind, (OSError, MemoryError))
    )


def why(error: Exception) -> str:
    """Return the reason of an error in words: of the operating system's without its number.

    Examples
    --------
    >>> why(PermissionError(13, "Permission denied", "my_axle.toml"))
    'its permissions forbid reading it'
    """
    name = getattr(error, "filename", None)
    if isinstance(error, FileNotFoundError):
        return "there is no such file" + (f" in {_folder(name)}" if name else "")
    # Windows forbids to read a folder
    if isinstance(error, IsADirectoryError) or (isinstance(error, OSError) and _is_folder(name)):
        return "it is a folder"
    if isinstance(error, PermissionError):
        return "its permissions forbid reading it"
    return (getattr(error, "strerror", None) or str(error)).rstrip(".")


# the command that writes a file of a kind to start from
_EXAMPLES = {
    "axle file": "sweep",
    "gear file": "contact",
    "hypoid gear file": "contact",
    "blank file": "design",
    "bearing file": "bearing",
    "train file": "drivetrain",
    "oil file": "oil show",
    "problem file": "optimise hypoid",
    "point contact": "ehl point",
    "line contact": "ehl line",
    "hypoid flank": "ehl hypoid",
    "rough line contact": "ehl rough",
}


# what writes a file that another file names, by the last part of the field; the kind of file
_MADE_BY = {
    "mesh_table": ("mesh table", "`gearlube contact my_gears.toml` writes one"),
    "asperity_table": ("asperity table", "`gearlube roughness flow-factors` writes one"),
    "line_mesh": ("line mesh", "`gearlube helical my_pair.toml` writes one"),
    "flank_model": ("film model", "`gearlube film-model fit` writes one"),
    "roller_model": ("film model", "`gearlube film-model fit` writes one"),
    "line_model": ("film model", "`gearlube film-model fit` writes one"),
    "film_model": ("film model", "`gearlube film-model fit` writes one"),
    "matrices_file": ("file of matrices", "numpy.savez writes one, see docs/trains.md"),
    "gear_set.gear_file": ("hypoid gear file", ""),
    "gear_file": ("gear file", ""),
    "gear": ("gear file", ""),
    "axle_file": ("axle file", ""),
    "oil_file": ("oil file", ""),
    "oil": ("oil file", ""),
    "name": ("oil file", ""),
    "oil.file": ("oil file", ""),
}


def unread_named(path: str | Path, error: Exception, namer: str | Path, field: str) -> str:
    """Return why a file that the file `namer` names in a field cannot be read, in sentences.

    Examples
    --------
    >>> unread_named(
    ...     "/cars/x.nc", IsADirectoryError(), "my.toml", "gear_set.mesh_table"
    ... )  # doctest: +ELLIPSIS
    'The mesh table /cars/x.nc cannot be read: it is a folder. my.toml names it in gear_set...'
    """
    found = _MADE_BY.get(field) or _MADE_BY.get(field.rpartition(".")[2]) or ("file", "")
    cure = f" {found[1][0].upper()}{found[1][1:]}." if found[1] else ""
    return (
        f"{unread(found[0], path, error)}. {namer} names it in {field}; a relative path in a file "
        f"counts from the folder of that file.{cure}"
    )


def unread(what: str, path: str | Path, error: Exception) -> str:
    """Return why a file cannot be read, as a sentence without its full stop.

    Examples
    --------
    >>> unread("axle file", "/cars/my.toml", FileNotFoundError())  # doctest: +ELLIPSIS
    'The axle file my.toml was not found in /cars, which is no folder; `gearlube sweep --exam...'
    """
    if isinstance(error, FileNotFoundError):
        name, start = Path(path).name, ""
        if command := _EXAMPLES.get(what):
            kind = "of a hypoid pair" if what == "gear file" else "to start from"
            start = f"; `gearlube {command} --example > {name}` writes one {kind}"
        if what == "gear file":
            start += f", `gearlube helical --example > {name}` one of a helical pair"
        return f"The {what} {name} was not found in {_folder(path)}{start}"
    return f"The {what} {path} cannot be read: {why(error)}"


def _folder(path: str | Path) -> str:
    folder = Path(path).parent.resolve()
    return str(folder) if folder.is_dir() else f"{folder}, which is no folder"


def _is_folder(path: object) -> bool:
    return isinstance(path, str) and Path(path).is_dir()
