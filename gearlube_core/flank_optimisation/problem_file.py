"""The problem file: what may change, at which loads and errors it counts, and what limits it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, model_validator

from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import InputFile, Section
from gearlube_core.storage.file_names import Name

Text = Annotated[str, Field(min_length=1)]
Number = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Torque = Annotated[float, Field(ge=1e-2, le=1e6, allow_inf_nan=False), Usual(1.0, 100000.0)]
Length = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False), Usual(1.0, 300.0)]
Angle = Annotated[float, Field(ge=0.0, le=20.0, allow_inf_nan=False), Usual(0.05, 5.0)]
Times = Annotated[float, Field(ge=0.1, le=10.0, allow_inf_nan=False)]
Share = Annotated[float, Field(gt=0.0, le=1.0, allow_inf_nan=False)]
Band = Annotated[float, Field(gt=0.0, le=0.3, allow_inf_nan=False)]
Span = Annotated[float, Field(gt=0.0, le=10.0, allow_inf_nan=False), Usual(0.01, 5.0)]
Ratio = Annotated[float, Field(gt=0.0, le=0.2, allow_inf_nan=False)]
Order = Annotated[int, Field(ge=1, le=20)]
_RANGE = ("low", "high", "start")


class Range(Section):
    """Between which values one field may change, in the unit of the field."""

    low: Number = Field(description="Smallest allowed value")
    high: Number = Field(description="Largest allowed value")
    start: Number | None = Field(
        default=None,
        description="Value at which the search starts; left out: the value in the gear file",
    )

    @model_validator(mode="after")
    def _check_order(self) -> Range:
        if not self.low < self.high:
            raise ValueError(f"low must be below high, got {self.low:g} and {self.high:g}")
        if self.start is not None and not self.low <= self.start <= self.high:
            raise ValueError(
                f"start must lie within low and high, {self.low:g} to {self.high:g}, got "
                f"{self.start:g}"
            )
        return self


def _flat(data: Any, prefix: str = "") -> Any:
    """Return tables in tables as dotted names, so that names need no quotes in the file."""
    if not isinstance(data, Mapping):
        return data
    found: dict[str, Any] = {}
    for name, entry in data.items():
        whole = f"{prefix}{name}"
        if isinstance(entry, Mapping) and not any(key in _RANGE for key in entry):
            found |= _flat(entry, f"{whole}.")
        else:
            found[whole] = entry
    return found


class Errors(Section):
    """Errors of assembly and making; each is taken with both signs, one at a time."""

    pinion_offset_um: Length = Field(default=0.0, description="Hypoid pair: error E of the offset")
    pinion_axial_um: Length = Field(
        default=0.0, description="Hypoid pair: error P of the pinion's axial position"
    )
    gear_axial_um: Length = Field(
        default=0.0, description="Hypoid pair: error G of the gear's axial position"
    )
    shaft_angle_mrad: Angle = Field(
        default=0.0, description="Hypoid pair: error Sigma of the shaft angle"
    )
    lead_slope_um: Length = Field(
        default=0.0,
        description="Helical pair: misalignment in the plane of contact, over the face width",
    )
    profile_slope_um: Length = Field(
        default=0.0,
        description="Helical pair: error of the pressure angle of a gear, as a profile slope",
    )
    fields: Annotated[dict[Text, Number], BeforeValidator(_flat)] = Field(
        default={},
        description="Tolerances of further fields of the gear file, by their dotted names",
    )


class Limits(Section):
    """Limits of the better pair at each torque; 1 is the value of the given gear file."""

    pressure: Times | None = Field(
        default=1.0,
        description="Limit of the highest pressure, with errors, divided by that of the given pair",
    )
    loss: Times | None = Field(
        default=1.0,
        description="Limit of the sliding loss with a constant friction coefficient, divided by "
        "that of the given pair",
    )
    sensitivity: Times | None = Field(
        default=1.0,
        description="Limit of the change of the mesh orders by the errors, divided by that of "
        "the given pair",
    )
    force_swing: Times | None = Field(
        default=None,
        description="Only for hypoid pairs: limit of the mesh orders of the mesh force at "
        "constant torque, divided by those of the given pair; left out: no limit",
    )
    edge_share: Share | None = Field(
        default=None,
        description="Largest share of the load in the border of the flanks; left out: no limit",
    )
    edge_band: Band = Field(
        default=0.05,
        description="Width of this border at tip, toe and heel, as a fraction of tooth height "
        "and face width",
    )
    other_side_torques_n_m: Annotated[tuple[Torque, ...], Field(strict=False)] = Field(
        default=(),
        description="Torques on the other flanks of a hypoid pair (coast if side is drive), "
        "only for the next two limits",
    )
    other_side_pressure: Times | None = Field(
        default=1.0,
        description="Limit of the highest pressure on the other flanks, with errors, divided by "
        "that of the given pair",
    )
    other_side_edge_share: Share | None = Field(
        default=None,
        description="Largest share of the load in the border of the other flanks; left out: no "
        "limit",
    )

    @model_validator(mode="after")
    def _check_other_side(self) -> Limits:
        torques = self.other_side_torques_n_m
        if any(later <= earlier for earlier, later in pairwise(torques)):
            raise ValueError(f"other_side_torques_n_m must rise, got {list(torques)}")
        if self.other_side_edge_share is not None and not torques:
            raise ValueError(
                "other_side_edge_share needs other_side_torques_n_m, got none. Give torques of "
                "the pinion, or leave it out"
            )
        return self


class Settings(Section):
    """Machine settings of a hypoid pair that may change about the values of the gear file."""

    members: Annotated[tuple[Literal["pinion", "gear"], ...], Field(strict=False, min_length=1)] = (
        Field(
            default=("pinion",),
            description="Member whose settings may change; those of the other member are kept",
        )
    )
    blades: bool = Field(
        default=False,
        description="Whether the blades of its cutter may change too; false: they are kept",
    )
    within_mm: Span = Field(default=0.5, description="Lengths may change by plus and minus this")
    within_deg: Span = Field(default=0.5, description="Angles may change by plus and minus this")
    within_ratio: Ratio = Field(
        default=0.01,
        description="The ratio of roll may change by plus and minus this fraction of its value",
    )


class OptimisationFile(InputFile):
    """Problem file of an optimisation: what may change on a gear pair, and what limits it.

    Examples
    --------
    >>> OptimisationFile.shipped()
    ('helical', 'helical_plain', 'hypoid')
    """

    package: ClassVar[str] = "gearlube_core.flank_optimisation"
    title: ClassVar[str] = "problem file"
    files: ClassVar[tuple[str, ...]] = ("gear",)

    name: Name = Field(description="Name of the optimised pair")
    gear: Text = Field(
        description="Name of a shipped gear pair, or a gear file (.toml), its path relative to "
        "this file"
    )
    torques_n_m: Annotated[tuple[Torque, ...], Field(strict=False, min_length=1)] = Field(
        description="Operating torques of the pinion, all with the same weight"
    )
    side: Literal["drive", "coast"] = Field(
        default="drive", description="Flanks of a hypoid pair that are optimised"
    )
    orders: Annotated[tuple[Order, ...], Field(strict=False, min_length=1)] = Field(
        default=(1, 2, 3),
        description="Mesh orders of the loaded transmission error to minimise, with equal weights",
    )
    aim: Literal["mean", "worst"] = Field(
        default="mean",
        description="mean: smallest mean square over all torques and errors; worst: smallest "
        "value of the worst one",
    )
    positions: Annotated[int, Field(ge=6, le=64)] = Field(
        default=8,
        description="Number of mesh phases in the search; more than twice the highest order",
    )
    parameters: Annotated[dict[Text, Range], BeforeValidator(_flat)] = Field(
        default={}, description="Fields of the gear file that may change, with bounds"
    )
    settings: Settings | None = None
    errors: Errors = Errors()
    limits: Limits = Limits()

    @model_validator(mode="after")
    def _check_relations(self) -> OptimisationFile:
        if not self.parameters and self.settings is None:
            raise ValueError(
                "[parameters] must name a field that may change, or [settings] be given, got none"
            )
        if len(set(self.orders)) < len(self.orders):
            raise ValueError(f"orders must name each order once, got {list(self.orders)}")
        least = 2 * max(self.orders) + 1
        if self.positions < least:
            raise ValueError(
                f"positions must be at least {least} for order {max(self.orders)}, got "
                f"{self.positions}"
            )
        torques = self.torques_n_m
        if any(later <= earlier for earlier, later in pairwise(torques)):
            raise ValueError(f"torques_n_m must rise, got {list(torques)}")
        return self
