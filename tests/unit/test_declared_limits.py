"""Limits of file fields that are declared by a number of a model."""

import math
from dataclasses import dataclass
from typing import Annotated

import pytest
from pydantic import Field, ValidationError

from drivetrain.axle_file.section import ModelSection
from gearlube_core.input_file.field_notes import Declared, field_notes
from gearlube_core.number import Number


@dataclass(frozen=True)
class Arm:
    """A model with a number, for the section below."""

    length: Annotated[float, Number("m", 1e-3, 0.2)]
    parts: Annotated[int, Number("1", 2, 9)]


class OfArm(ModelSection):
    """A section whose limits are those that the model declares."""

    length_mm: Annotated[float, Declared(Arm, "length_mm")] | None = None
    pieces: Annotated[int, Declared(Arm, "pieces", "parts")] | None = None
    width_um: Annotated[float, Declared(Number("m", 2e-6, 7e-5), "width_um")] | None = None
    disc_kg_mm2: Annotated[float, Declared(Number("kg m2", 3e-6, 5e-5), "disc_kg_mm2")] = 3.0
    tilt_knm_per_rad: Annotated[
        float, Declared(Number("N.m/rad", 2e3, 7e3), "tilt_knm_per_rad")
    ] = 2
    pull_kn_per_rad: Annotated[float, Declared(Number("N/rad", -3e3, 4e3), "pull_kn_per_rad")] = 0.0
    gap_mm: Annotated[float, Declared(Number("m", -1.0, 1.0), "gap_mm"), Field(gt=0.0)] = 1.0


@pytest.mark.parametrize(
    ("field", "low", "high"),
    [
        ("length_mm", 1.0, 200.0),
        ("pieces", 2, 9),
        ("width_um", 2.0, 70.0),
        ("disc_kg_mm2", 3.0, 50.0),
        ("tilt_knm_per_rad", 2.0, 7.0),
        ("pull_kn_per_rad", -3.0, 4.0),
    ],
)
def test_limits_of_a_field_are_those_of_the_number_of_the_model_in_its_unit(field, low, high):
    assert field_notes(OfArm)[field].limits == f"{low:g} to {high:g}"
    assert [getattr(OfArm(**{field: end}), field) for end in (low, high)] == [low, high]
    for outside in (low - 1, high + 1, math.nan, "3", True):
        with pytest.raises(ValidationError):
            OfArm(**{field: outside})


def test_a_field_may_leave_out_the_end_of_the_limits_of_its_model():
    assert field_notes(OfArm)["gap_mm"].limits == "above 0 to 1000"
    for outside in (0.0, -1.0, 1001.0):
        with pytest.raises(ValidationError):
            OfArm(gap_mm=outside)
