"""An FMU as a folder on disk."""

from __future__ import annotations

import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gearlube_core.errors import ParameterError


def unpack(fmu: Path, directory: Path) -> Path:
    """Unzip `fmu` into `directory` and return it."""
    if not fmu.is_file():
        raise ParameterError(
            f"The FMU must be a file or an unzipped folder, but {fmu} is neither. Build it with "
            "`gearlube build-fmu`."
        )
    try:
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(directory)
    except zipfile.BadZipFile as error:
        raise ParameterError(
            f"{fmu} is no FMU: {error}. Build it again with `gearlube build-fmu`."
        ) from error
    return directory


@contextmanager
def unpacked(fmu: Path) -> Iterator[Path]:
    """Give the folder of an FMU: `fmu` itself if it is one, else a temporary one."""
    if fmu.is_dir():
        yield fmu
        return
    directory = Path(tempfile.mkdtemp(prefix="gearlube-fmu-"))
    try:
        yield unpack(fmu, directory)
    finally:
        shutil.rmtree(directory, ignore_errors=True)


def _description(directory: Path) -> Any:
    from lxml import etree

    description = directory / "modelDescription.xml"
    if not description.is_file():
        raise ParameterError(
            f"{directory} is no unzipped FMU: modelDescription.xml is missing. "
            "Give the .fmu file, or unzip it again."
        )
    return etree.parse(str(description)).getroot()


def fmu_guid(directory: Path) -> str:
    """Return the GUID in the model description of an unzipped FMU."""
    return str(_description(directory).get("guid"))


def fmu_kind(directory: Path) -> str:
    """Return "native" for an FMU that computes by itself, else "in Python"."""
    slave = _description(directory).find("CoSimulation")
    needs_tool = slave is not None and slave.get("needsExecutionTool") == "true"
    return "in Python" if needs_tool else "native"
