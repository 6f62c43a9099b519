"""LossMap_FMI3.fmu: a loss map as an FMU, its points as arrays by FMI-LS-STRUCT 1.0.0-rc.1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from fmu_src.definition import MAP, Definition, Value
from fmu_src.native.model import NativeModel
from fmu_src.variable import Variable, input_, output, parameter
from gearlube_core.arrays import Array
from gearlube_core.dynamics.ranges import RANGE_EXCEEDED
from gearlube_core.errors import ParameterError

_ENTRY = Path(__file__).with_name("loss_map_entry.c")
_LARGEST = 1e9  # of any value of a map
# axis -> input, unit, unit shown, words, limits
_AXES = {
    "speed": ("pinion.speed", "rad/s", "rpm", "Speed of the pinion", 0.0, 5e3),
    "torque": ("pinion.torque", "N.m", "", "Torque on the pinion, below 0 in coast", -1e5, 1e5),
    "temperature": ("oil.temperature", "K", "degC", "Temperature of the oil", 200.0, 500.0),
}


class _Map:
    """The map in Python."""

    def __init__(
        self,
        axes: Mapping[str, Array],
        maps: Mapping[str, Array],
        parameters: Mapping[str, Value],
        inputs: Sequence[float],
    ) -> None:
        self._axes = [axes[name] for name in _AXES]
        self._at = RegularGridInterpolator(self._axes, np.stack([*maps.values()], axis=-1))
        self.step(0.0, *inputs)

    def step(self, h: float, *inputs: float) -> None:
        """Take over the inputs."""
        held = np.clip(inputs, *np.transpose([one[[0, -1]] for one in self._axes]))
        values = self._at(held)[0]
        left = sum(1 << i for i, one in enumerate(held != inputs) if one)
        self.outputs = np.array([*values, values[0] * inputs[0], left])


def loss_map_model(
    axes: Mapping[str, Array], maps: Mapping[str, Array], description: str
) -> NativeModel:
    """Return the native model of a map, linear between its points and held at its ends.

    Parameters
    ----------
    axes : mapping of str to ndarray
        "speed" [rad/s], "torque" [N.m] and "temperature" [K], in this order, each rising.
    maps : mapping of str to ndarray
        Torques at the pinion [N.m] over the axes by name; the first is the loss torque.
    description : str
        One line for the user.

    Raises
    ------
    ParameterError
        An axis has fewer than two points, or a value is not finite.
    """
    shape = tuple(len(axes[name]) for name in _AXES)
    for name, values in axes.items():
        if len(values) < 2:
            raise ParameterError(
                f"The {name}s of a sampled map must be at least 2, got {len(values)}. Compute the "
                "map with more of them."
            )
    for name, values in maps.items():
        if not np.isfinite(values).all():
            missing = int((~np.isfinite(values)).sum())
            raise ParameterError(
                f"Every point of a sampled map must be there, but {name} lacks {missing} of "
                f"{values.size}. map.csv says why; leave out those torques or speeds with --span."
            )
    variables: list[Variable] = []
    members: list[tuple[str, str]] = []
    for name, (signal, unit, shown, words, low, high) in _AXES.items():
        middle = float(axes[name][len(axes[name]) // 2])
        variables.append(
            input_(signal, unit, words, start=middle, minimum=low, maximum=high, display_unit=shown)
        )
        members += [(f"map.{name}", f"{MAP}.domain"), (signal, f"{MAP}.domainInput")]
    for name, (_, unit, shown, words, low, high) in _AXES.items():
        variables += _points(f"map.{name}", unit, words, axes[name], low, high, shown)
    outputs = []
    for name, values in maps.items():
        words = name.replace("_", " ")
        variables += _points(f"map.{name}", "N.m", f"Points of the {words}", values.ravel(),
                             -_LARGEST, _LARGEST)  # fmt: skip
        outputs.append(output(name, "N.m", f"{words.capitalize()} at the pinion"))
        members += [(f"map.{name}", f"{MAP}.codomain"), (name, f"{MAP}.codomainOutput")]
    left = Variable(name=RANGE_EXCEEDED, type="Integer", causality="output",
                    description="0 inside the map; else the sum of 1 speed, 2 torque, "
                    "4 temperature: the map is held at its end")  # fmt: skip
    outputs += [output("power_loss", "W", "Power lost: loss torque times speed", 100.0), left]
    limits = [limit for *_, low, high in _AXES.values() for limit in (low, high)]
    table = (*variables, *outputs)
    return NativeModel(
        definition=Definition(
            name="LossMap",
            description=description,
            variables=table,
            output_names=tuple(v.name for v in outputs),
            stop_time=1.0,
            step_size=1e-2,
            slave="slave_base",
            shipped_data=(),
            flanges={},
            map_members=tuple(members),
            map_shape=shape,
        ),
        c_code={_ENTRY.name: _ENTRY.read_text("utf-8")},
        make_data=lambda: np.array([*shape, len(maps), *limits], dtype=float),
        state_size=len(_AXES) + 1,
        control_at=len(_AXES),
        work_size=len(limits) + sum(v.is_model_parameter for v in table),
        limits_at=0,
        ranges_at=len(limits),
        ranges=(),
        refusals={2: "the points of an axis must rise. Correct map.speed, map.torque or "
                  "map.temperature"},
        in_python=partial(_Map, axes, maps),
    )  # fmt: skip


def _points(
    name: str, unit: str, words: str, values: Array, low: float, high: float, shown: str = ""
) -> list[Variable]:
    return [
        parameter(f"{name}[{i}]", unit, f"{words}, point {i}", start=float(value), minimum=low,
                  maximum=high, display_unit=shown, argument=f"{name}_{i}")
        for i, value in enumerate(values, start=1)
    ]  # fmt: skip
