"""Conditions and laws of a study of bearing friction."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.geometry import BearingGeometry
from gearlube_core.bearings.losses.laws import DEFAULT_LAW
from gearlube_core.bearings.losses.loss import LossModel, check_condition
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

DEFAULT_LAWS = (DEFAULT_LAW, "zhou_hoeprich")  # the second tells rolling and rib apart
MOST_POINTS = 50_000  # conditions times laws


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingSettings:
    """Speeds, loads, temperatures and laws of a bearing study; all are combined.

    Parameters
    ----------
    speeds : tuple of float
        Speeds of the shaft [rad/s].
    axial_loads, radial_loads : tuple of float
        Loads on the bearing [N].
    temperatures : tuple of float
        Temperatures of the oil in the bearing [K].
    models : tuple of LossModel
        Friction laws; figures show the parts of the first one.

    Examples
    --------
    >>> settings = BearingSettings.of_file(BearingFile.named("wingertszahn_2023"))
    >>> settings.points  # conditions times laws
    72
    """

    speeds: tuple[float, ...]
    axial_loads: tuple[float, ...]
    radial_loads: tuple[float, ...]
    temperatures: tuple[float, ...]
    models: tuple[LossModel, ...] = field(
        default_factory=lambda: tuple(LossModel(law=law) for law in DEFAULT_LAWS)
    )

    def __post_init__(self) -> None:
        for name in ("speeds", "axial_loads", "radial_loads", "temperatures", "models"):
            values = getattr(self, name)
            if not values:
                raise ParameterError(f"{name} must have at least one value, got none.")
            if len(set(values)) < len(values):
                raise ParameterError(f"{name} must not have a value twice, got {values}.")
        laws = [model.law for model in self.models]
        if len(set(laws)) < len(laws):
            raise ParameterError(f"models must not have a law twice, got {', '.join(laws)}.")
        check_within("the number of conditions times laws", self.points, 1, MOST_POINTS)

    @classmethod
    def of_file(cls, file: BearingFile) -> BearingSettings:
        """Return the conditions in [operation] of a bearing file, with the usual laws."""
        of = file.operation
        return cls(
            speeds=tuple(rpm_to_rads(n) for n in of.speed_rpm),
            axial_loads=of.axial_load_n,
            radial_loads=of.radial_load_n,
            temperatures=tuple(celsius_to_kelvin(t) for t in of.temperature_degc),
        )

    @property
    def points(self) -> int:
        """Number of conditions times laws."""
        conditions = len(self.speeds) * len(self.axial_loads) * len(self.radial_loads)
        return conditions * len(self.temperatures) * len(self.models)

    def check(self, geometry: BearingGeometry, oil: Lubricant) -> None:
        """Raise ParameterError where a condition is out of range, before anything is computed."""
        for model in self.models:
            if model.film_model is not None:
                check_oil(model.film_model, oil, geometry.solid, "film_model")
            for T in self.temperatures:
                check_condition(
                    geometry, oil, model, max(self.speeds), max(self.axial_loads), 0.0, T
                )
            for axial, radial in product(self.axial_loads, self.radial_loads):
                lowest = min(self.speeds)
                first = self.temperatures[0]
                check_condition(geometry, oil, model, lowest, axial, radial, first)
