"""A small FMI 2.0 host on FMPy: variables by name, every status and every log message kept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fmpy import calloc, fmi2, free, read_model_description
from fmpy.fmi1 import FMICallException

OK, WARNING, DISCARD, ERROR, FATAL = range(5)


class Host:
    def __init__(self, directory: Path | str, guid: str = "", logging_on: bool = True) -> None:
        self.description = read_model_description(str(directory))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.log: list[tuple[int, str, str]] = []

        def logger(
            _environment: Any, _name: Any, status: int, category: bytes, text: bytes
        ) -> None:
            self.log.append((status, (category or b"").decode(), text.decode()))

        self._callbacks = fmi2.fmi2CallbackFunctions()
        self._callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(logger)
        self._callbacks.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(calloc)
        self._callbacks.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(free)
        self.slave = fmi2.FMU2Slave(
            guid=guid or self.description.guid,
            unzipDirectory=str(directory),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="pair",
        )
        self.slave.instantiate(callbacks=self._callbacks, loggingOn=logging_on)
        self.time = 0.0

    def messages(self, category: str) -> str:
        return "\n".join(text for _, found, text in self.log if found == category)

    def status(self, call: str, *arguments: Any, **named: Any) -> int:
        try:
            getattr(self.slave, call)(*arguments, **named)
        except FMICallException as error:
            return int(error.status)
        return OK

    def set(self, **values: float) -> int:
        return self.set_named({name.replace("__", "."): value for name, value in values.items()})

    def set_named(self, values: dict[str, float]) -> int:
        worst = OK
        for name, value in values.items():
            variable = self.variables[name]
            call = "setReal" if variable.type == "Real" else "setInteger"
            worst = max(worst, self.status(call, [variable.valueReference], [value]))
        return worst

    def get(self, *names: str) -> list[float]:
        values: list[float] = []
        for name in names:
            variable = self.variables[name]
            calls = {"Real": "getReal", "Boolean": "getBoolean"}
            call = getattr(self.slave, calls.get(variable.type, "getInteger"))
            values += call([variable.valueReference])
        return values

    def outputs(self) -> list[float]:
        return self.get(
            *(n for n, v in self.variables.items() if v.causality in ("output", "local"))
        )

    def start(self, start_time: float = 0.0, **values: float) -> int:
        self.time = start_time
        status = self.set(**values)
        for call, named in (
            ("setupExperiment", {"startTime": start_time}),
            ("enterInitializationMode", {}),
            ("exitInitializationMode", {}),
        ):
            status = max(status, self.status(call, **named))
        return status

    def step(self, h: float = 2.0**-10, count: int = 1) -> int:
        status = OK
        for _ in range(count):
            status = max(
                status,
                self.status("doStep", currentCommunicationPoint=self.time, communicationStepSize=h),
            )
            if status <= WARNING:
                self.time += h
        return status

    def save(self) -> Any:
        return self.slave.getFMUstate()

    def restore(self, state: Any, time: float) -> int:
        self.time = time
        return self.status("setFMUstate", state)

    def close(self) -> None:
        self.slave.freeInstance()
