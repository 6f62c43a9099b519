"""A native FMU of FMI 2 in model exchange and in co-simulation, by FMPy, for comparisons."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave
from numpy.typing import NDArray

Array = NDArray[np.float64]
Torques = Callable[[float], tuple[float, float]]


class Unpacked:
    """An extracted FMU."""

    def __init__(self, path: Path, folder: Path) -> None:
        self.description = read_model_description(str(path))
        self.folder = extract(str(path), str(folder))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        rates = [one.variable for one in self.description.derivatives]
        self.rates = [variable.name for variable in rates]
        self.states = [variable.derivative.name for variable in rates]

    def instance(self, kind: type) -> FMU2Model | FMU2Slave:
        made = kind(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.modelExchange.modelIdentifier,
            instanceName="one",
        )
        made.instantiate()
        made.setupExperiment()
        return made

    def set(self, made: FMU2Model | FMU2Slave, values: dict[str, float]) -> None:
        for name, value in values.items():
            reference = [self.references[name]]
            if isinstance(value, int):
                made.setInteger(reference, [value])
            else:
                made.setReal(reference, [value])


class Exchange:
    """An instance in continuous-time mode."""

    def __init__(self, fmu: Unpacked, values: dict[str, float]) -> None:
        self.fmu = fmu
        self.model = fmu.instance(FMU2Model)
        fmu.set(self.model, values)
        self.model.enterInitializationMode()
        self.model.exitInitializationMode()
        assert self.model.newDiscreteStates() == (False, False, False, False, False, 0.0)
        self.model.enterContinuousTimeMode()

    def _array(self, call: Callable[..., None], n: int) -> Array:
        values = (ctypes.c_double * n)()
        call(values, n)
        return np.array(values)

    @property
    def states(self) -> Array:
        return self._array(self.model.getContinuousStates, len(self.fmu.states))

    @states.setter
    def states(self, values: Array) -> None:
        self.model.setContinuousStates((ctypes.c_double * values.size)(*values), values.size)

    @property
    def nominals(self) -> Array:
        return self._array(self.model.getNominalsOfContinuousStates, len(self.fmu.states))

    def rates_at(self, states: Array) -> Array:
        self.states = states
        return self._array(self.model.getDerivatives, states.size)

    def get(self, names: Sequence[str]) -> Array:
        return np.array(self.model.getReal([self.fmu.references[name] for name in names]))

    def at(self, states: Array, names: Sequence[str]) -> Array:
        self.states = states
        return self.get(names)

    def along(self, unknowns: Sequence[str], knowns: Sequence[str], seed: Sequence[float]) -> Array:
        references = self.fmu.references
        found = self.model.getDirectionalDerivative(
            [references[name] for name in unknowns], [references[name] for name in knowns], seed
        )
        return np.array(found)

    def close(self) -> None:
        self.model.terminate()
        self.model.freeInstance()


def co_simulated(
    fmu: Unpacked, values: dict[str, float], torques: Torques, times: Array, h: float, *names: str
) -> Array:
    """Return outputs at times, shape (times, names), by communication steps of at most h."""
    slave = fmu.instance(FMU2Slave)
    fmu.set(slave, values)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    references = [fmu.references[name] for name in names]
    rows = []
    last = 0.0
    for wanted in times.tolist():
        ends = np.linspace(last, wanted, 1 + math.ceil((wanted - last) / h - 1e-6))
        for begin, end in pairwise(ends.tolist()):
            pinion, wheel = torques(0.5 * (begin + end))
            fmu.set(slave, {"pinion.torque": pinion, "wheel.torque": wheel})
            slave.doStep(begin, end - begin)
        last = wanted
        rows.append(slave.getReal(references))
    slave.terminate()
    slave.freeInstance()
    return np.array(rows)
