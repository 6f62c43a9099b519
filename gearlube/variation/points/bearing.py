"""Friction of a tapered roller bearing at one speed, load and temperature."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from gearlube.variation.design import Point
from gearlube.variation.keys import Keys, file_keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.operands import operand, value
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import (
    DEFAULT_LAW,
    PARTS,
    LossModel,
    bearing_loss,
    check_condition,
)
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

SPEED = operand("shaft.speed_rpm", "rpm", "Of the shaft", 2000.0, 0.0, 1e6)
AXIAL = operand("load.axial_n", "N", "Axial load of the bearing", 2000.0, 0.0, 1e8)
RADIAL = operand("load.radial_n", "N", "Radial load of the bearing", 0.0, 0.0, 1e8)
TEMPERATURE = operand(
    "oil.temperature_degc", "degC", "Of the oil at the bearing", 60.0, -60.0, 250.0
)
LAYER = operand("oil.inlet_layer_um", "um", "At the raceways; 0: flooded", 0.0, 0.0, 1e4)
RISE = operand("oil.temperature_rise_k", "K", "In the contacts", 0.0, 0.0, 100.0)
LAW = operand("law", "", "Law of friction", DEFAULT_LAW, kind="text")
_OPERANDS = {key.name: key for key in (SPEED, AXIAL, RADIAL, TEMPERATURE, LAYER, RISE, LAW)}
_QUANTITIES = (
    Quantity("torque", "N m", "friction torque at the shaft"),
    Quantity("power", "W", "power lost"),
    *(Quantity(f"torque_{part}", "N m", f"friction torque by {part}") for part in PARTS),
    Quantity("error_factor", "1", "the torque lies within torque/factor and torque*factor, k = 2"),
    Quantity("film_ratio", "1", "smallest film ratio of the raceways, flooded"),
    Quantity("rib_film_ratio", "1", "smallest film ratio at the rib"),
)
_FROM_OPERANDS = "operation."  # section of the file that the operands stand for


@dataclass(frozen=True, kw_only=True)
class BearingPoint:
    """The study of bearing friction at one point.

    Parameters
    ----------
    file : BearingFile
    oils : mapping of str to Lubricant
        By the name or file in the field `oil`.

    Examples
    --------
    >>> study = BearingPoint(file=BearingFile.named("wingertszahn_2023"))
    >>> round(study.compute({"load.axial_n": 4000.0})[0], 2)  # N.m
    2.35
    """

    file: BearingFile
    oils: Mapping[str, Lubricant] = field(default_factory=dict)
    name: str = "bearing"
    block: int = 200
    shown: tuple[str, ...] = ("torque", "film_ratio")

    def with_oils(self, names: Iterable[str]) -> BearingPoint:
        """Return the study with these oils read, by name or file."""
        wanted = {self.file.oil, *names}
        return BearingPoint(file=self.file, oils={one: read_oil(one).lubricant for one in wanted})

    @property
    def subject(self) -> str:
        """Name of what is varied."""
        return self.file.name

    @property
    def keys(self) -> Keys:
        """Fields of the bearing file, and the operands in the place of its conditions."""
        fields = file_keys(field_notes(BearingFile))
        own = {n: one for n, one in fields.items() if not n.startswith(_FROM_OPERANDS)}
        return {**own, **_OPERANDS}

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """What `compute` returns."""
        return _QUANTITIES

    @property
    def identity(self) -> str:
        """Bearing file and content of oil files."""
        files = sorted(name for name in self.oils if Path(name).is_file())
        digests = [hashlib.sha256(Path(name).read_bytes()).hexdigest() for name in files]
        return json.dumps([self.file.model_dump(mode="json"), digests], sort_keys=True)

    def check(self, point: Point) -> None:
        """Raise ParameterError where bearing or condition are out of range."""
        file = self._file(point)
        speed, axial, radial, temperature = _condition(point)
        check_condition(
            file.geometry(), self._oil(file), _model(point), speed, axial, radial, temperature
        )

    def compute(self, point: Point) -> Sequence[float]:
        """Return torque, power and parts of the torque; a part that the law lacks is NaN."""
        file = self._file(point)
        speed, axial, radial, temperature = _condition(point)
        found = bearing_loss(
            file.geometry(),
            self._oil(file),
            _model(point),
            speed=speed,
            axial_load=axial,
            radial_load=radial,
            temperature=temperature,
        )
        parts = [found.parts.get(part, float("nan")) for part in PARTS]
        ratios = found.film_ratio, found.rib_film_ratio
        return (found.torque, found.power, *parts, found.factor, *ratios)

    def _file(self, point: Point) -> BearingFile:
        own = {name: one for name, one in point.items() if name not in _OPERANDS}
        return self.file.varied(own) if own else self.file

    def _oil(self, file: BearingFile) -> Lubricant:
        held = self.oils.get(file.oil)
        return read_oil(file.oil).lubricant if held is None else held


def _condition(point: Point) -> tuple[float, float, float, float]:
    return (
        rpm_to_rads(value(point, SPEED)),
        value(point, AXIAL),
        value(point, RADIAL),
        celsius_to_kelvin(value(point, TEMPERATURE)),
    )


def _model(point: Point) -> LossModel:
    return LossModel(
        law=value(point, LAW),
        inlet_layer=1e-6 * value(point, LAYER),
        temperature_rise=value(point, RISE),
    )
