"""A helical or spur pair under one torque: loaded contact, vibration, losses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from gearlube.studies.helical.operating_point import operating_point
from gearlube.studies.helical.pair_losses import PARTS_OF_LOSS, losses_dataset
from gearlube.studies.helical.settings import HelicalSettings, quick_settings
from gearlube.variation.design import Point
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import (
    FilePoint,
    operand,
    order_quantities,
    order_values,
    value,
)
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS as RMS_ROUGHNESS
from gearlube_core.dynamics.helical_pair.gear_file_pair import USUAL_OIL
from gearlube_core.dynamics.helical_pair.supports import BEARING_FORCES
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import LINE
from gearlube_core.helical_contact.contact_dataset import contact_dataset, line_mesh
from gearlube_core.helical_contact.mesh_cycle import run_cycle
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.input_file.field_units import limits_in
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

OIL = operand("oil", "", "Shipped oil or an oil file", USUAL_OIL, kind="text")
TEMPERATURE = operand("oil.temperature_degc", "degC", "Of the oil", 80.0, -60.0, 250.0)
ROUGHNESS = operand(
    "roughness_rms_um", "um", "Of both flanks together", 0.5, *limits_in("um", RMS_ROUGHNESS)
)
FRICTION = operand(
    "friction", "", "Of the vibrating pair: film, or constant with friction.coefficient",
    "film", kind="text",
)  # fmt: skip
COEFFICIENT = operand("friction.coefficient", "1", "With friction constant", 0.05, 0.0, 1.0)
MESH = operand(
    "mesh", "", "Of the vibrating pair: contact, or density of ISO 6336-1", "contact", kind="text"
)
POSITIONS = operand(
    "mesh.positions", "1", "Mesh phases of the loaded contact", 24, 8, 400, "whole number"
)
_FORCES = tuple(name for name in BEARING_FORCES if name.startswith("F"))
_QUANTITIES = (
    Quantity("loss", "W", "power lost by the flanks, static loads"),
    *(Quantity(f"loss_{part}", "W", f"power lost by {part}") for part in PARTS_OF_LOSS),
    Quantity("efficiency", "1", "efficiency of the mesh"),
    Quantity("film_min", "m", "smallest film thickness, Dowson 1968"),
    Quantity("film_ratio", "1", "least central film over roughness"),
    Quantity("film_temperature_rise", "K", "largest mean rise of the film over the oil"),
    Quantity("share_outside", "1", "load outside the film model; above 0.05 all is by formulas"),
    *order_quantities("te", "m", "transmission error under load, without vibration"),
    *order_quantities("dte", "m", "dynamic transmission error"),
    *(one for name in _FORCES for one in order_quantities(name, "N", f"bearing force {name}")),
    Quantity("friction_power", "W", "power that friction takes from the vibrating pair"),
    Quantity("stability_margin", "1", "one less the largest modulus of a Floquet multiplier"),
    Quantity("mesh_stiffness", "N/m", "mean mesh stiffness along x, secant"),
    Quantity("mesh_stiffness_tangent", "N/m", "mean mesh stiffness along x, tangent"),
    Quantity("pressure_max", "Pa", "highest pressure; at sharp edges it rises with finer cells"),
    Quantity("corner_share", "1", "highest share of the torque outside the plane of contact"),
    Quantity("transverse_contact_ratio", "1", "transverse contact ratio"),
    Quantity("overlap_ratio", "1", "overlap ratio"),
)


@dataclass(frozen=True, kw_only=True)
class HelicalPoint(FilePoint[HelicalGearFile]):
    """The study of a helical pair at one point; quick: coarse teeth, eight mesh phases."""

    name: ClassVar[str] = "helical"
    block: ClassVar[int] = 4
    shown: ClassVar[tuple[str, ...]] = ("dte_mesh_1", "F_xp_mesh_1", "loss", "film_min")
    operands: ClassVar[Keys] = {
        key.name: key
        for key in (OIL, TEMPERATURE, ROUGHNESS, FRICTION, COEFFICIENT, MESH, POSITIONS)
    }
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES
    film_field: ClassVar[str] = "film.line_model"
    film_kind: ClassVar[str] = LINE
    unused: ClassVar[tuple[str, ...]] = ("film_mesh.", "meshing_steps.", "compared_with")

    @property
    def usual_oils(self) -> tuple[str, ...]:
        """The oil file of the gear file; without it [oil] or the usual oil."""
        return () if self.file.film.oil_file is None else (self.file.film.oil_file,)

    def check(self, point: Point) -> None:
        """Raise ParameterError where pair, oil or operating point are out of range."""
        self._settings(point)

    def compute(self, point: Point) -> Sequence[float]:
        """Load the contact over a mesh period, then let the pair vibrate on it."""
        settings = self._settings(point)
        modified, cycle = settings.file.modified_pair(), settings.cycle()
        pair = modified.pair
        record = run_cycle(modified, _teeth(pair, settings.body), cycle, jobs=1)
        loaded = contact_dataset(modified, cycle, record).isel(torque=0)
        mesh = line_mesh(modified, cycle, record)
        lost = losses_dataset(settings, mesh).isel(temperature=0, torque=0, speed=0)
        vibrating = settings.parameters(mesh if settings.mesh == "contact" else None)
        constant = () if settings.friction == "film" else (value(point, COEFFICIENT),)
        moving = operating_point(vibrating, settings.pinion_speed, constant).isel(case=0)
        powers = lost["loss"].values
        return (
            float(powers.sum()),
            *map(float, powers),
            *(float(lost[one]) for one in ("efficiency", "film_min", "film_ratio")),
            float(lost["temperature_rise"]),
            float(lost["share_outside"]) if "share_outside" in lost else 0.0,
            *order_values(loaded["transmission_error"].values),
            *order_values(moving["delta_z"].values),
            *(one for name in _FORCES for one in order_values(moving[name].values)),
            float(moving["friction_power"]),
            float(moving["stability_margin"]),
            float(loaded["K"].mean()),
            float(loaded["K_tangent"].mean()),
            float(np.nanmax(loaded["pressure_max"])),
            float(loaded["corner_share"].max()),
            pair.transverse_contact_ratio,
            pair.overlap_ratio,
        )

    def _settings(self, point: Point) -> HelicalSettings:
        file = self.varied(point)
        if file.operation is None:
            raise ParameterError(
                f"The gear file must have [operation] with pinion_torque_n_m and pinion_speed_rpm, "
                f"got none in {file.name}. Add the section."
            )
        torque = file.operation.pinion_torque_n_m
        speed = rpm_to_rads(file.operation.pinion_speed_rpm)
        oil = point.get(OIL.name) or file.film.oil_file
        settings = HelicalSettings(
            file=file,
            pinion_torque=torque,
            pinion_speed=speed,
            torques=(torque,),
            speeds=(speed,),
            positions=value(point, POSITIONS),
            mesh=value(point, MESH),
            friction=value(point, FRICTION),
            oil=None if oil is None else self.oil(str(oil)),
            oil_temperature=celsius_to_kelvin(value(point, TEMPERATURE)),
            roughness_rms=1e-6 * value(point, ROUGHNESS),
            draws=0,
            line_film_model=self.film_model(file),
            parts="dynamics",
        )
        return quick_settings(settings) if self.quick else settings


@lru_cache(maxsize=2)
def _teeth(pair: HelicalPair, body: HelicalBodySettings) -> PairStiffness:
    """Return the elastic teeth of a pair; points that vary no teeth share them."""
    return pair_stiffness(pair, body, jobs=1, keep=False)
