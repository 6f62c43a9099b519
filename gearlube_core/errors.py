"""Exceptions raised by gearlube. Kernels never raise; they return a status."""


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


def why(error: Exception) -> str:
    """Return the reason of an error in words: of the operating system's without its number.

    Examples
    --------
    >>> why(FileNotFoundError(2, "No such file or directory", "my_axle.toml"))
    'there is no such file'
    """
    for kind, words in (
        (FileNotFoundError, "there is no such file"),
        (IsADirectoryError, "it is a folder"),
        (PermissionError, "its permissions forbid reading it"),
    ):
        if isinstance(error, kind):
            return words
    return (getattr(error, "strerror", None) or str(error)).rstrip(".")
