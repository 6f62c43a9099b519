"""The torsional hypoid pair over mesh frequency: its resonance at one point."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self

import numpy as np

from gearlube.studies.resonance.datasets import resonance_dataset
from gearlube.studies.resonance.response import Response, follow_response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.study import ResonanceStudy
from gearlube.studies.resonance.summary import summaries
from gearlube.variation.design import Point, Spread, Value
from gearlube.variation.file_variants import content_hash
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import ORDERS, operand, value
from gearlube.variation.scatter import scatter_of
from gearlube_core.dynamics.flank_force import BACKLASH
from gearlube_core.errors import ConvergenceError
from gearlube_core.input_file.field_units import limits_in
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable

_MODEL = "two_dof"
_FREQUENCIES = {False: 60, True: 25}  # by quick

TORQUE = operand("pinion.torque_n_m", "N.m", "Mean, on the pinion", 50.0, 0.1, 1e4)
TABLE = operand("mesh_table", "", "Shipped mesh table or a file (.nc)", "", kind="text")
RADII = operand("radii", "", "consistent, paper or mean", "consistent", kind="text")
FIRST = operand("range.first", "1", "Mesh over natural frequency", 0.2, 0.05, 3.0)
LAST = operand("range.last", "1", "Mesh over natural frequency", 1.6, 0.05, 3.0)
# name of the parameter: operand, SI units in its unit
_OF_PAIR = {
    "backlash": (
        operand("backlash_um", "um", "Total, along the line", 150.0, *limits_in("um", BACKLASH)),
        1e-6,
    ),
    "damping": (operand("damping_n_s_m", "N.s/m", "Of the mesh", 2278.1, 0.0, 1e6), 1.0),
    "pinion_inertia": (
        operand("pinion.inertia_kg_mm2", "kg.mm2", "About its axis", 1734.0, 1e-3, 1e9),
        1e-6,
    ),
    "gear_inertia": (
        operand("gear.inertia_kg_mm2", "kg.mm2", "About its axis", 58100.0, 1e-3, 1e9),
        1e-6,
    ),
}
_QUANTITIES = (
    Quantity("natural_frequency", "Hz", "natural frequency of the mesh mode"),
    Quantity("damping_ratio", "1", "damping of the mesh mode over the critical one"),
    Quantity("dte_peak", "m", "largest peak-to-peak transmission error of a stable motion"),
    Quantity("dte_peak_at", "1", "mesh over natural frequency there"),
    *(Quantity(f"dte_peak_mesh_{k}", "m", f"transmission error there, order {k}") for k in ORDERS),
    Quantity("apart_rising", "1", "mesh over natural frequency where a rising sweep loses contact"),
    Quantity("apart_falling_end", "1", "where a falling sweep regains it"),
    Quantity("separation_share", "1", "longest share of the period without contact, stable"),
    Quantity("folds", "1", "folds of the branch"),
)


@dataclass(frozen=True, kw_only=True)
class ResonancePoint:
    """The study of resonance at one point: the dry 2-DOF pair, by continuation.

    Parameters
    ----------
    table : str
        Mesh table: a shipped one by its name, or a file.
    tables : mapping of str to MeshTable
        What was read, by name.
    quick : bool
        Fewer frequencies of the curve, for a first look.
    """

    name: ClassVar[str] = "resonance"
    block: ClassVar[int] = 4
    shown: ClassVar[tuple[str, ...]] = (
        "dte_peak",
        "dte_peak_at",
        "apart_rising",
        "separation_share",
    )
    operands: ClassVar[Keys] = {
        key.name: key
        for key in (TORQUE, TABLE, RADII, FIRST, LAST, *(key for key, _ in _OF_PAIR.values()))
    }
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES

    table: str
    tables: Mapping[str, MeshTable] = field(default_factory=dict)
    quick: bool = False

    @property
    def subject(self) -> str:
        """Name of what is varied."""
        return self.table

    @property
    def keys(self) -> Keys:
        """The operands; the usual mesh table is that of the study."""
        return {**self.operands, TABLE.name: TABLE._replace(usual=self.table)}

    @property
    def identity(self) -> str:
        """Content of the mesh tables, and whether it is quick."""
        return f"{[(one, content_hash(one)) for one in sorted(self.tables)]} quick {self.quick}"

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all mesh tables read that the values of the axes name."""
        names = map(str, texts.get(TABLE.name, (self.table,)))
        return replace(self, tables={name: _read(name) for name in names})

    def scatter(self) -> tuple[Spread, ...]:
        """Refuse: a mesh table has no tolerances."""
        return scatter_of(f"the mesh table {self.table}", {}, {})

    def values(self) -> dict[str, Any]:
        """Return the usual operands."""
        return {key.name: key.usual for key in self.keys.values()}

    def check(self, point: Point) -> None:
        """Raise ParameterError or TableError where table, torque or range is wrong."""
        self._settings(point)

    def compute(self, point: Point) -> Sequence[float]:
        """Follow the periodic motions over the range; return resonance and loss of contact."""
        settings = self._settings(point)
        study = ResonanceStudy(settings=settings)
        response = study.responses[_MODEL] = Response(model=_MODEL)
        follow_response(response, settings, doubled=False)
        dataset = resonance_dataset(study)
        summary, rows = summaries(dataset)[0], dataset.sel(model=_MODEL)
        stable = rows["stable"].values > 0.5
        if not stable.any():
            raise ConvergenceError("No motion in the range is stable. Widen the range.")
        top = int(np.argmax(np.where(stable, rows["peak_to_peak"].values, -np.inf)))
        model = response.segments[0].problem.model
        rising, falling = summary.separated_up, summary.separated_down
        return (
            model.natural_frequency,
            model.damping_ratio,
            summary.peak,
            summary.peak_at,
            *map(float, rows["harmonics"].values[top, : len(ORDERS)]),
            rising[0][0] if rising else math.nan,
            falling[-1][1] if falling else math.nan,
            float(np.max(rows["separation_share"].values[stable])),
            float((rows["special_kind"] == "fold").sum()),
        )

    def _settings(self, point: Point) -> ResonanceSettings:
        name = str(point.get(TABLE.name, self.table))
        radii: Any = value(point, RADII)
        return ResonanceSettings(
            mesh=self.tables.get(name) or _read(name),
            radii=radii,
            pinion_torque=value(point, TORQUE),
            friction="off",
            first=value(point, FIRST),
            last=value(point, LAST),
            frequencies=_FREQUENCIES[self.quick],
            sweep_frequencies=0,
            section_starts=0,
            changes=tuple(
                (parameter, scale * value(point, key))
                for parameter, (key, scale) in _OF_PAIR.items()
                if key.name in point
            ),
        )


def _read(name: str) -> MeshTable:
    return read_mesh_table(name) if name.endswith(".nc") else shipped_mesh_table(name)
