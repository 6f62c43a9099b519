"""The FMU of a drivetrain from a train file: its variables, and the model in Python."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from drivetrain.train.train_file import TrainCase, TrainFile
from fmu_src.definition import Definition, Value
from fmu_src.variable import Variable, declared_locals, declared_outputs, input_, parameter, rates
from gearlube_core.arrays import Array
from gearlube_core.checks import read_content
from gearlube_core.dynamics.ranges import MAX_SPEED, RANGE_EXCEEDED, Range
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.model import MOST_TORQUE, Train
from gearlube_core.errors import ParameterError

FILE_IN_FMU = "train.toml"  # for the reader; the model itself is in the library


MOST_RANGES = 31  # bits of range.exceeded


def train_ranges(train: Train) -> tuple[Range, ...]:
    """Return the ranges of all elements, under the names of the train's outputs."""
    found = [
        one._replace(output=f"{element.name}.{one.output}")
        for element in train.elements
        for one in element.ranges()
    ]
    return tuple(found[:MOST_RANGES])


class TrainModel:
    """A train as an FMU steps it."""

    def __init__(self, train: Train, ports: Sequence[str]) -> None:
        self._train, self._ports = train, tuple(ports)
        self._ranges = train_ranges(train)

    @property
    def outputs(self) -> Array:
        """Present outputs: of the train, which ranges were left as bits, then locals."""
        found = self._train.outputs()
        x = self._train.continuous
        others = dict(zip(self._train.continuous_names, x.tolist(), strict=True))
        others = {name: value for name, value in others.items() if name not in found}
        left = [
            found[one.output] != 0.0 and not one.low <= found[one.output] <= one.high
            for one in self._ranges
        ]
        bits = sum(1 << bit for bit, one in enumerate(left) if one)
        exchanged = [self._train.derivative(x), self._train.indicators(x)]
        return np.concatenate([[*found.values(), bits, *others.values()], *exchanged])

    @property
    def step(self) -> Callable[..., None]:
        """(h, *inputs): advance by h [s]."""
        return self._step

    def _step(self, h: float, *inputs: float) -> None:
        *torques, temperature = inputs
        self._train.step(h, dict(zip(self._ports, torques, strict=True)), temperature)

    def exceeded(self) -> Mapping[str, str]:
        """Return the quantities out of range now: a sentence for each, by the output's name."""
        return self._train.exceeded()

    def get_state(self) -> Array:
        """Return the whole state."""
        return self._train.get_state()

    def set_state(self, state: Array) -> None:
        """Continue from a state that `get_state` returned."""
        self._train.set_state(state)


def fmu_name(name: str) -> str:
    """Return the model identifier of an FMU for the name of a train.

    Raises
    ------
    ParameterError
        No letter is in it.

    Examples
    --------
    >>> fmu_name("two-stage e-axle, 2nd")
    'TwoStageEAxle2nd'
    """
    words = re.findall(r"[A-Za-z0-9]+", name)
    found = "".join(word[0].upper() + word[1:] for word in words)
    if not found or not found[0].isalpha():
        raise ParameterError(
            f"The name of a train must begin with a letter from A to Z, got {name!r}. Its FMU is "
            "named after it."
        )
    return found[:63]


def variables(case: TrainCase) -> tuple[Variable, ...]:
    """Return the variables of a train: inputs, parameters, then its outputs and locals."""
    oil, made = case.train.oil, case.train.assembly
    outputs = declared_outputs(made.outputs)
    known = {one.name for one in outputs}
    states = declared_locals(one.record for one in made.continuous)
    of_name = {one.name: one for one in (*states, *outputs)}
    return (
        *(
            input_(f"{name}.torque", "N.m", f"Torque of the port {name}", start=float(torque),
                   minimum=-MOST_TORQUE, maximum=MOST_TORQUE)
            for name, torque in case.torques.items()
        ),
        *(
            input_(name, "rad/s", f"Speed at which a holder keeps the body of the port "
                   f"{name.partition('.')[0]}, in the sense of its torque", start=speed,
                   minimum=-MAX_SPEED, maximum=MAX_SPEED, display_unit="rpm")
            for name, speed in case.train.references.items()
        ),
        input_("oil.temperature", "K", "Temperature of the oil", start=case.oil_temperature,
               minimum=oil.temperature_low, maximum=oil.temperature_high, display_unit="degC"),
        *(
            parameter(f"{name}.speed_start", "rad/s", f"Speed of {name} about z at the start",
                      start=speed, minimum=-MAX_SPEED, maximum=MAX_SPEED, display_unit="rpm",
                      argument=name)
            for name, speed in case.speeds.items()
        ),
        *outputs,
        Variable(name=RANGE_EXCEEDED, type="Integer", causality="output",
                 description="0: all quantities are in range; else the sum of 1, 2, 4 and so on, "
                 "one for each range of the documentation that was left, in its order"),
        *(one for one in states if one.name not in known),
        *rates([of_name[one.record.name] for one in made.continuous]),
        *declared_locals(one.record for one in made.events),
    )  # fmt: skip


def _start(case: TrainCase, speeds: Mapping[str, Value], inputs: Sequence[float]) -> TrainModel:
    *torques, temperature = inputs
    names, of = (*case.torques, *case.train.references), case.train
    given = dict(zip(names, torques, strict=True))
    train = Train(  # one of its own, as several models may run side by side
        of.bodies,
        of.elements,
        of.oil,
        steps_per_highest_period=of.steps_per_highest_period,
        driver=of.driver,
    )
    train.initialise({n: float(v) for n, v in speeds.items()}, given, temperature)
    return TrainModel(train, names)


def definition_with_train(path: str | Path) -> tuple[Definition, TrainCase]:
    """Return the definition of the FMU of a train file, and the train.

    Parameters
    ----------
    path : path
        Train file (TOML), or the name of a shipped one.

    Raises
    ------
    ParameterError
        The file is missing or wrong.
    """
    file = TrainFile.given(str(path))
    case = file.case()
    shipped = str(path) in TrainFile.shipped() and not Path(path).is_file()
    content = (
        TrainFile.shipped_text(str(path)).encode() if shipped else read_content(path, "train file")
    )
    table = variables(case)
    bodies, elements = len(case.train.bodies), len(case.train.elements)
    definition = Definition(
        name=fmu_name(case.name),
        description=f"Drivetrain {case.name}: {bodies} bodies, {elements} elements",
        variables=table,
        output_names=tuple(one.name for one in table if one.is_computed),
        start=partial(_start, case),
        stop_time=0.1,
        step_size=1e-3,
        slave="train",
        shipped_data=(),
        resources={FILE_IN_FMU: content},
        flanges={
            one.name: (
                f"Port {one.name}",
                f"{one.name}.torque",
                f"{one.body}.speed",
                f"{one.body}.angle",
            )
            for one in case.train.elements
            if isinstance(one, Port)
        },
        sources=tuple({inspect.getfile(type(one)): None for one in case.train.elements}),
    )
    return definition, case
