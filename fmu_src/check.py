"""Static checks of a built FMU by two independent tools."""

from __future__ import annotations

import logging
from pathlib import Path

from gearlube_core.errors import GearLubeError


class _Collector(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.messages: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.messages.append(record.getMessage())


def fmpy_problems(path: Path) -> list[str]:
    """Return the findings of FMPy: schema, names, structure, start values, units."""
    from fmpy.validation import validate_fmu

    return [f"fmpy: {problem}" for problem in validate_fmu(str(path))]


def fmutool_problems(path: Path) -> list[str]:
    """Return the findings of `fmutool -check`: schema and the rules of FMI 2.0, section 2.2."""
    try:
        from fmu_manipulation_toolbox.checker import get_checkers
        from fmu_manipulation_toolbox.operations import FMU
    except ImportError as error:
        raise GearLubeError(
            "Checking an FMU needs fmutool. Install it with `pip install fmu-manipulation-toolbox`."
        ) from error
    collector = _Collector()
    logger = logging.getLogger("fmu_manipulation_toolbox")
    logger.addHandler(collector)
    try:
        with FMU(str(path)) as fmu:
            for checker in get_checkers():
                fmu.apply_operation(checker())
    finally:
        logger.removeHandler(collector)
    return [f"fmutool: {message}" for message in collector.messages]


def problems(path: Path) -> list[str]:
    """Return the problems of the FMU at `path`, from both tools; none if it is sound."""
    return fmpy_problems(path) + fmutool_problems(path)
