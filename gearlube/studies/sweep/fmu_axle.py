"""An FMI 2.0 co-simulation slave, stepped with as little work per step as possible."""

from __future__ import annotations

import ctypes
import shutil
import tempfile
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError, StepError, why

_LARGEST, _MOST = 500_000_000, 10_000  # bytes and files of an unpacked FMU; ours has 30 MB
_CURE = "Build it again with `gearlube build-fmu`."
INPUTS = ("pinion.torque", "wheel.torque", "oil.temperature")

_INSTANCE = "axle"
_WARNING = 1  # fmi2Warning
_LOADER_NOTE = "Fatal py exception"  # added by pythonfmu's loader, without information


def unpack(fmu: Path, directory: Path) -> Path:
    """Unzip `fmu` into `directory` and return it."""
    if not fmu.is_file():
        raise ParameterError(
            f"The FMU must be a file or an unzipped folder, but {fmu} is neither. Build it with "
            "`gearlube build-fmu`."
        )
    try:
        with zipfile.ZipFile(fmu) as archive:
            entries = archive.infolist()
            size = sum(entry.file_size for entry in entries)
            if size > _LARGEST or len(entries) > _MOST:
                raise ParameterError(
                    f"{fmu} must unpack to at most {_LARGEST / 1e6:g} MB in {_MOST} files, got "
                    f"{size / 1e6:.0f} MB in {len(entries)}. {_CURE}"
                )
            archive.extractall(directory)
    except (zipfile.BadZipFile, zlib.error, RuntimeError, ValueError, OSError, EOFError) as error:
        if isinstance(error, ParameterError):
            raise
        raise ParameterError(f"{fmu} is no FMU: {why(error)}. {_CURE}") from error
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


def axle_description(directory: Path, channels: Sequence[str]) -> Any:
    """Return the model description of an unzipped FMU.

    Raises
    ------
    ParameterError
        It is not valid, or not that of a hypoid axle for co-simulation.
    """
    from fmpy import read_model_description

    cure = "Build it with `gearlube build-fmu`."
    try:
        description = read_model_description(str(directory))
    except Exception as error:  # FMPy raises no other class
        lines = " ".join(str(error).split())[:300]
        raise ParameterError(f"The FMU has no valid model description: {lines} {cure}") from None
    there = {variable.name for variable in description.modelVariables}
    missing = [name for name in (*INPUTS, *channels) if name not in there]
    if missing or description.coSimulation is None:
        lack = f"{', '.join(missing)[:300]} is missing" if missing else "it has no co-simulation"
        raise ParameterError(
            f"The FMU must have the variables of a gearlube hypoid axle, {lack}. {cure}"
        )
    return description


class FmuAxle:
    """One instance of the axle FMU.

    Parameters
    ----------
    directory : Path
        Folder into which the FMU was unzipped.
    channels : sequence of str
        Real outputs that `read` returns, in this order.

    Notes
    -----
    Value references are looked up once and all outputs come in one fmi2GetReal call into a buffer
    that is reused. What the FMU logs is kept in `messages`.
    """

    def __init__(self, directory: Path, channels: Sequence[str]) -> None:
        from fmpy import fmi2
        from fmpy.fmi1 import FMICallException

        description = axle_description(directory, channels)
        self.guid = description.guid
        self.messages: list[str] = []
        self.warnings: list[str] = []  # each said once a run
        self._variables = {v.name: v for v in description.modelVariables}
        self._fmi = fmi2
        self._call_error = FMICallException
        # The callbacks must outlive the instance, hence an attribute.
        self._callbacks = self._make_callbacks()
        self._slave: Any = fmi2.FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(directory),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=_INSTANCE,
        )
        self._slave.instantiate(callbacks=self._callbacks, loggingOn=True)
        self._input_references = self._references(INPUTS)
        self._inputs = (ctypes.c_double * len(INPUTS))()
        self._output_references = self._references(channels)
        self._outputs = (ctypes.c_double * len(channels))()
        self._view: Array = np.ctypeslib.as_array(self._outputs)
        self._time = 0.0

    def __enter__(self) -> FmuAxle:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._slave.freeInstance()

    def _references(self, names: Sequence[str]) -> Any:
        references = [self._variables[name].valueReference for name in names]
        return (ctypes.c_uint * len(references))(*references)

    def _make_callbacks(self) -> Any:
        from fmpy import calloc, free

        def log(_environment: Any, _name: Any, status: int, _category: Any, message: bytes) -> None:
            if status > 0 and message:
                text = message.decode(errors="replace").strip()
                self.messages.append(text)
                if status == _WARNING:
                    self.warnings.append(text.removeprefix(f"{_INSTANCE}: "))

        fmi2 = self._fmi
        callbacks = fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(log)
        callbacks.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(free)
        return callbacks

    def _refusal(self, what: str) -> str:
        """Return `what` with the FMU's messages, without the loader's stack notes."""
        said = [text.removeprefix(f"{_INSTANCE}: ") for text in self.messages]
        reasons = [text for text in dict.fromkeys(said) if not text.startswith(_LOADER_NOTE)]
        distinct = [
            text
            for i, text in enumerate(reasons)
            if not any(text in other for j, other in enumerate(reasons) if j != i)
        ]
        return f"{what}: {' '.join(distinct) or 'the FMU gave no reason.'}"

    def set_parameters(self, values: Mapping[str, str | float | int]) -> None:
        """Set FMU parameters by name; enumerations take the name of their item."""
        for name, value in values.items():
            variable = self._variables.get(name)
            if variable is None:
                raise ParameterError(f"The FMU has no parameter {name!r}. Rebuild the FMU.")
            reference = [variable.valueReference]
            if variable.type == "Enumeration":
                items = {item.name: int(item.value) for item in variable.declaredType.items}
                if value not in items:
                    raise ParameterError(
                        f"{name} must be one of {', '.join(items)}; got {value!r}."
                    )
                self._slave.setInteger(reference, [items[str(value)]])
            elif variable.type == "Integer":
                self._slave.setInteger(reference, [int(value)])
            else:
                self._slave.setReal(reference, [float(value)])

    def initialise(self, pinion_torque: float, wheel_torque: float, temperature: float) -> None:
        """Enter and leave initialisation mode with these inputs [N.m, N.m, K]."""
        self._inputs[:] = [pinion_torque, wheel_torque, temperature]
        slave = self._slave
        try:
            slave.setupExperiment(startTime=0.0)
            slave.enterInitializationMode()
            slave.fmi2SetReal(slave.component, self._input_references, 3, self._inputs)
            slave.exitInitializationMode()
        except self._call_error as error:
            raise StepError(self._refusal("The axle FMU could not be initialised")) from error
        self._time = 0.0

    def read(self) -> Array:
        """Return the channels; the array is overwritten by the next call."""
        slave = self._slave
        slave.fmi2GetReal(
            slave.component, self._output_references, len(self._outputs), self._outputs
        )
        return self._view

    def step(self, h: float, pinion_torque: float, wheel_torque: float) -> None:
        """Advance by `h` [s] with constant torques [N.m]."""
        inputs, slave = self._inputs, self._slave
        inputs[0] = pinion_torque
        inputs[1] = wheel_torque
        try:
            slave.fmi2SetReal(slave.component, self._input_references, 3, inputs)
            slave.fmi2DoStep(slave.component, self._time, h, 1)
        except self._call_error as error:
            refusal = self._refusal(f"The axle FMU refused the step at t = {self._time:.4f} s")
            raise StepError(refusal) from error
        self._time += h
