"""Exceptions raised by gearlube. Kernels never raise; they return a status."""


class GearLubeError(Exception):
    """Base of every error that gearlube raises on purpose."""


class ParameterError(GearLubeError, ValueError):
    """An input lies outside the range in which the model means anything."""


class ConvergenceError(GearLubeError):
    """An iterative solution did not reach its tolerance."""


class StepError(GearLubeError):
    """A time step was refused; the model is still in the state before the step."""


class TableError(GearLubeError, ValueError):
    """A mesh table file is incomplete or contradicts itself."""


class InterruptedRunError(GearLubeError):
    """A long run was stopped from the keyboard; the message says what is kept."""


class FileError(GearLubeError):
    """A file is missing, damaged or of another kind."""
