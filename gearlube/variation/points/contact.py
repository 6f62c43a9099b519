"""A hypoid pair on one side of its teeth: contact without and with load, aligned or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from gearlube.studies.contact.settings import ContactSettings, CycleSettings, Misalignment
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
from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.hypoid_contact.contact_dataset import mesh_error, side_contact, unloaded_contact
from gearlube_core.hypoid_contact.mesh_cycle import SIDES, position_record
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from gearlube_core.tooth_contact.mesh_cycle import stack_records

SIDE = operand("side", "", "Flanks in contact: drive or coast", "drive", kind="text")
TORQUE = operand("pinion.torque_n_m", "N.m", "On the pinion; 0: without load alone", 50.0, 0.0, 1e5)
POSITIONS = operand("mesh.positions", "1", "Over the mesh period", 16, 8, 400, "whole number")
OFFSET = operand("misalignment.pinion_offset_um", "um", "E: growth of the offset", 0.0, -5e3, 5e3)
PINION = operand("misalignment.pinion_axial_um", "um", "P: pinion outwards", 0.0, -5e3, 5e3)
GEAR = operand("misalignment.gear_axial_um", "um", "G: gear outwards", 0.0, -5e3, 5e3)
ANGLE = operand("misalignment.shaft_angle_mrad", "mrad", "Growth of the angle", 0.0, -50.0, 50.0)
MISALIGNMENTS = OFFSET, PINION, GEAR, ANGLE

_LOADED = (
    *order_quantities("te", "m", "transmission error under load"),
    Quantity("mesh_stiffness", "N/m", "mean mesh stiffness, secant"),
    Quantity("mesh_stiffness_tangent", "N/m", "mean mesh stiffness, tangent"),
    Quantity("pressure_max", "Pa", "highest pressure; at sharp edges it rises with finer cells"),
    Quantity("pairs", "1", "mean number of tooth pairs that carry"),
    Quantity("force_s", "1", "mean centre of force on the gear, root 0 to tip 1"),
    Quantity("force_t", "1", "mean centre of force on the gear, toe 0 to heel 1"),
    Quantity("pinion_arm", "m", "mean arm of the mesh force about the pinion axis"),
)
_QUANTITIES = (
    *order_quantities("te_unloaded", "rad", "transmission error without load, at the pinion"),
    Quantity("path_contact_ratio", "1", "pitches over which the unloaded path is on both teeth"),
    Quantity("path_s", "1", "middle of the unloaded path on the gear, root 0 to tip 1"),
    Quantity("path_t", "1", "middle of the unloaded path on the gear, toe 0 to heel 1"),
    Quantity("ease_off_max", "m", "largest gap to the conjugate gear flank"),
    Quantity("ease_off_mean", "m", "mean gap to the conjugate gear flank"),
    *_LOADED,
)
_CARRIES = 1e-3  # share of the torque above which a pair counts as in contact


@dataclass(frozen=True, kw_only=True)
class ContactPoint(FilePoint[HypoidGearFile]):
    """The study of tooth contact at one point; quick: eight positions."""

    name: ClassVar[str] = "contact"
    block: ClassVar[int] = 4
    shown: ClassVar[tuple[str, ...]] = ("te_mesh_1", "te_unloaded_pp", "pressure_max", "force_t")
    operands: ClassVar[Keys] = {key.name: key for key in (SIDE, TORQUE, POSITIONS, *MISALIGNMENTS)}
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES

    def check(self, point: Point) -> None:
        """Raise ParameterError where a field or a misalignment is out of range.

        Whether the flanks meet takes too long to ask of all points before the first.
        """
        check_option(SIDE.name, value(point, SIDE), SIDES)
        self.varied(point)
        misalignment(point)

    def compute(self, point: Point) -> Sequence[float]:
        """Find what touches without load, then load the pair over a mesh period."""
        file, side = self.varied(point), value(point, SIDE)
        pair = FlankPair.from_file(file, side, misalignment(point))
        torque = value(point, TORQUE)
        if not torque:
            unloaded = unloaded_contact(pair) | {"error": mesh_error(pair)}
            return (*_without_load(unloaded), *[float("nan")] * len(_LOADED))
        settings = ContactSettings(
            cycle=CycleSettings(
                torques=(torque,),
                positions=8 if self.quick else value(point, POSITIONS),
                misalignment=pair.misalignment,
            ),
        )
        teeth = teeth_of(file.model_dump_json(), settings.body)[side]
        records = (
            position_record(pair, float(phase), teeth, settings.cycle)
            for phase in settings.cycle.phases
        )
        found = side_contact(pair, stack_records(records), settings.cycle)
        return (*_without_load(found), *_under_load(found))


def misalignment(point: Point) -> Misalignment:
    """Return where the members of a point stand."""
    return Misalignment(
        pinion_offset=1e-6 * value(point, OFFSET),
        pinion_axial=1e-6 * value(point, PINION),
        gear_axial=1e-6 * value(point, GEAR),
        shaft_angle=1e-3 * value(point, ANGLE),
    )


def _without_load(found: dict[str, Array]) -> list[float]:
    gap = found["ease_off"]
    return [
        *order_values(found["error"]),
        float(found["path_contact_ratio"]),
        float(np.nanmean(found["path_s"])),
        float(np.nanmean(found["path_t"])),
        float(np.nanmax(gap)),
        float(np.nanmean(gap)),
    ]


def _under_load(found: dict[str, Array]) -> list[float]:
    share = found["share"][:, 0]
    return [
        *order_values(found["R_p"].mean() * found["rotation"][:, 0]),
        float(found["k_m"].mean()),
        float(found["k_t"].mean()),
        float(found["pressure_max"].max()),
        float((share > _CARRIES).sum(axis=-1).mean()),
        *(float(np.nansum(share * found[one][:, 0]) / share.sum()) for one in ("gear_s", "gear_t")),
        float(found["R_p"].mean()),
    ]


@lru_cache(maxsize=2)
def teeth_of(file: str, body: ToothBodySettings) -> dict[str, PairStiffness]:
    """Return the elastic teeth of a gear file; points that vary no field of it share them."""
    found = pair_stiffness(HypoidGearFile.model_validate_json(file), body, jobs=1, keep=False)
    return {str(side): one for side, one in found.items()}
