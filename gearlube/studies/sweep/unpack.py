"""An FMU as a folder on disk."""

from __future__ import annotations

import shutil
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError, why

_LARGEST, _MOST = 500_000_000, 10_000  # bytes and files of an unpacked FMU; ours has 30 MB
_CURE = "Build it again with `gearlube build-fmu`."


def unpack(fmu: Path, directory: Path) -> Path:
    """Unzip `fmu` into `directory` and return it."""
    if not fmu.is_file():
        raise ParameterError(
            f"The FMU must be a file or an unzipped folder, but {fmu} is neither. Build it with "
            "`gearlube build-fmu`."
        )
    with _checked(fmu) as archive:
        archive.extractall(directory)
    return directory


def check_fmu(fmu: Path) -> None:
    """Raise ParameterError unless the file is an archive that unpacks to a size of an FMU's."""
    with _checked(fmu):
        pass


@contextmanager
def _checked(fmu: Path) -> Iterator[zipfile.ZipFile]:
    try:
        with zipfile.ZipFile(fmu) as archive:
            entries = archive.infolist()
            size = sum(entry.file_size for entry in entries)
            if size > _LARGEST or len(entries) > _MOST:
                raise ParameterError(
                    f"{fmu} must unpack to at most {_LARGEST / 1e6:g} MB in {_MOST} files, got "
                    f"{size / 1e6:.0f} MB in {len(entries)}. {_CURE}"
                )
            yield archive
    except (zipfile.BadZipFile, zlib.error, RuntimeError, ValueError, OSError, EOFError) as error:
        if isinstance(error, ParameterError):
            raise
        raise ParameterError(f"{fmu} is no FMU: {why(error)}. {_CURE}") from error


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
    content = read_content(description, "model description")
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        root = etree.fromstring(content, parser)
    except (etree.XMLSyntaxError, ValueError) as error:
        raise ParameterError(f"{directory} is no unzipped FMU: {error}. {_CURE}") from None
    if root.tag != "fmiModelDescription" or not root.get("guid"):
        raise ParameterError(
            f"{directory} must hold an FMU of FMI 2 with a GUID, got <{str(root.tag)[:80]}> of "
            f"version {root.get('fmiVersion', 'unknown')[:80]}. {_CURE}"
        )
    return root


def fmu_guid(directory: Path) -> str:
    """Return the GUID in the model description of an unzipped FMU."""
    return str(_description(directory).get("guid"))


def fmu_kind(directory: Path) -> str:
    """Return "native" for an FMU that computes by itself, else "in Python"."""
    slave = _description(directory).find("CoSimulation")
    needs_tool = slave is not None and slave.get("needsExecutionTool") == "true"
    return "in Python" if needs_tool else "native"
