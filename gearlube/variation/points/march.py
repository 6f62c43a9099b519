"""An axle in its car at one vehicle speed, marched in time: a point of the speed sweep."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import xarray as xr

from gearlube.studies.sweep.axle_in_fmu import check_operation, settings_of
from gearlube.studies.sweep.datasets import QUANTITIES
from gearlube.studies.sweep.point import march
from gearlube.studies.sweep.recording import AXES, BEARINGS, LOSSES
from gearlube.studies.sweep.settings import SPEED_RANGE, SweepSettings, quick_sweep_settings
from gearlube.variation.design import Point
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import AxlePoint, operand, value
from gearlube_core.checks import check_option
from gearlube_core.units import celsius_to_kelvin

SPEED = operand("vehicle.speed_kmh", "km/h", "Of the vehicle", 60.0, *SPEED_RANGE)
TEMPERATURE = operand("oil.temperature_degc", "degC", "Of the oil", 95.0, -60.0, 250.0)
DRIVER = operand("driver", "", "vehicle or hold", "vehicle", kind="text")
_OPERANDS = {key.name: key for key in (SPEED, TEMPERATURE, DRIVER)}
_ORDERS = (1, 2, 3)  # of the mesh
_WHINE = {"dte": "dte_spectrum", "bearing_force": "bearing_force_spectrum"}

_SCALARS = (
    "vehicle_speed", "pinion_speed", "pinion_torque", "wheel_torque", "mesh_frequency",
    "dte_min", "dte_max", "dte_mean", "dte_pp", "dte_rms", "separation", "separated_fraction",
    "mesh_force_min", "mesh_force_max", "mesh_force_mean", "dynamic_factor",
    "radial_mean", "radial_pp", "axial_pp", "wheel_axial_pp",
    "roller_load_min", "roller_load_max", "roller_load_mean",
    "power_in", "efficiency_mesh", "efficiency_axle", "energy_closure_error",
    "film_thickness_min", "film_ratio_min", "flank_temperature_max", "range_exceeded",
)  # fmt: skip


def _quantities() -> tuple[Quantity, ...]:
    whine = [
        Quantity(
            f"{name}_mesh_{order}",
            QUANTITIES[spectrum][0],
            f"mesh order {order} of the "
            + QUANTITIES[spectrum][1].removeprefix("amplitude of the "),
        )
        for name, spectrum in _WHINE.items()
        for order in _ORDERS
    ]
    scalars = [Quantity(name, *QUANTITIES[name]) for name in _SCALARS]
    losses = [Quantity(f"loss_{name}", "W", f"power lost by {name}") for name in LOSSES]
    forces = [
        Quantity(f"bearing_{j}_force_{axis}_pp", "N", f"peak-to-peak force of bearing {j}, {axis}")
        for j in BEARINGS
        for axis in AXES
    ]
    return (*whine, Quantity("loss", "W", "total power lost"), *losses, *scalars, *forces)


@dataclass(frozen=True, kw_only=True)
class MarchPoint(AxlePoint):
    """The speed sweep's study at one point, run by the model in this process.

    Parameters
    ----------
    quick : bool
        Short records, for a first look.
    """

    name: ClassVar[str] = "sweep"
    block: ClassVar[int] = 5
    shown: ClassVar[tuple[str, ...]] = ("dte_mesh_1", "bearing_force_mesh_1", "loss", "dte_pp")
    operands: ClassVar[Keys] = _OPERANDS
    quantities: ClassVar[tuple[Quantity, ...]] = _quantities()

    quick: bool = False

    @property
    def identity(self) -> str:
        """Axle file, its tables, and the length of the records."""
        return f"{self.axle.identity} quick {self.quick}"

    def check(self, point: Point) -> None:
        """Raise ParameterError where axle, temperature or the torque of the road is wrong."""
        check_option(DRIVER.name, value(point, DRIVER), ("vehicle", "hold"))
        car = self.axle.car_axle(point)
        check_operation(car, self._settings(point), [value(point, SPEED)])

    def compute(self, point: Point) -> Sequence[float]:
        """Return scalars, losses by source and mesh orders of a marched point."""
        car = self.axle.car_axle(point)
        found = march(car, value(point, SPEED), self._settings(point))
        return numbers_of(found, car.axle.mesh.pinion_teeth)

    def _settings(self, point: Point) -> SweepSettings:
        settings = settings_of(
            self.axle.car_axle(point).axle,
            oil_temperature=celsius_to_kelvin(value(point, TEMPERATURE)),
            driver=value(point, DRIVER),
        )
        return quick_sweep_settings(settings) if self.quick else settings


def numbers_of(found: xr.Dataset, teeth: int) -> list[float]:
    """Return the quantities in the dataset of a point, of a pinion with so many teeth.

    A mesh order above the end of the spectra is NaN.
    """
    order = found["order"].values
    numbers = []
    for spectrum in _WHINE.values():
        amplitude = found[spectrum].values
        for multiple in _ORDERS:
            at = int(np.argmin(np.abs(order - multiple * teeth)))
            met = abs(order[at] - multiple * teeth) < 1e-6 * teeth
            numbers.append(float(amplitude[at]) if met else float("nan"))
    losses = found["loss"].values
    numbers += [float(losses.sum()), *map(float, losses)]
    numbers += [float(found[name]) for name in _SCALARS]
    return numbers + [float(one) for one in found["bearing_force_pp"].values.ravel()]
