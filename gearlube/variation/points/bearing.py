"""Friction of a tapered roller bearing at one speed, load and temperature."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from gearlube.variation.design import Point
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import FilePoint, operand, value
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.losses.loss import PARTS, LossModel, bearing_loss, check_condition
from gearlube_core.film_model.model import ROLLER
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


@dataclass(frozen=True, kw_only=True)
class BearingPoint(FilePoint[BearingFile]):
    """The study of bearing friction at one point.

    Examples
    --------
    >>> study = BearingPoint(file=BearingFile.named("wingertszahn_2023"))
    >>> round(study.compute({"load.axial_n": 4000.0})[0], 2)  # N.m
    1.98
    """

    name: ClassVar[str] = "bearing"
    block: ClassVar[int] = 200
    shown: ClassVar[tuple[str, ...]] = ("torque", "film_ratio")
    operands: ClassVar[Keys] = _OPERANDS
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES
    film_field: ClassVar[str] = "film_model"
    film_kind: ClassVar[str] = ROLLER
    unused: ClassVar[tuple[str, ...]] = ("operation.",)  # the operands stand for them

    def varied(self, point: Point) -> BearingFile:
        """Return the file with the fields of a point that are its own; it has no tolerances."""
        own = {name: one for name, one in point.items() if name not in self.operands}
        # one part has no tolerances; they need not be checked again for each
        return self.file.model_copy(update={"tolerances": {}}).varied(own) if own else self.file

    @property
    def usual_oils(self) -> tuple[str, ...]:
        """The oil of the file."""
        return (self.file.oil,)

    def check(self, point: Point) -> None:
        """Raise ParameterError where bearing or condition are out of range."""
        file = self.varied(point)
        speed, axial, radial, temperature = _condition(point)
        check_condition(
            file.geometry(),
            self.oil(file.oil),
            self._model(point),
            speed,
            axial,
            radial,
            temperature,
        )

    def compute(self, point: Point) -> Sequence[float]:
        """Return torque, power and parts of the torque; a part that the law lacks is NaN."""
        file = self.varied(point)
        speed, axial, radial, temperature = _condition(point)
        found = bearing_loss(
            file.geometry(),
            self.oil(file.oil),
            self._model(point),
            speed=speed,
            axial_load=axial,
            radial_load=radial,
            temperature=temperature,
        )
        parts = [found.parts.get(part, float("nan")) for part in PARTS]
        ratios = found.film_ratio, found.rib_film_ratio
        return (found.torque, found.power, *parts, found.factor, *ratios)

    def _model(self, point: Point) -> LossModel:
        law = value(point, LAW)
        return LossModel(
            law=law,
            inlet_layer=1e-6 * value(point, LAYER),
            temperature_rise=value(point, RISE),
            film_model=self.film_model(self.varied(point)) if law == "solved_films" else None,
        )


def _condition(point: Point) -> tuple[float, float, float, float]:
    return (
        rpm_to_rads(value(point, SPEED)),
        value(point, AXIAL),
        value(point, RADIAL),
        celsius_to_kelvin(value(point, TEMPERATURE)),
    )
