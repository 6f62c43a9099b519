"""Limits of file fields that are declared by a number of a model."""

import math
from dataclasses import dataclass
from typing import Annotated

import pytest
from pydantic import ValidationError

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


@pytest.mark.parametrize(
    ("field", "low", "high"), [("length_mm", 1.0, 200.0), ("pieces", 2, 9), ("width_um", 2.0, 70.0)]
)
def test_limits_of_a_field_are_those_of_the_number_of_the_model_in_its_unit(field, low, high):
    assert field_notes(OfArm)[field].limits == f"{low:g} to {high:g}"
    assert [getattr(OfArm(**{field: end}), field) for end in (low, high)] == [low, high]
    for outside in (low - 1, high + 1, math.nan, "3", True):
        with pytest.raises(ValidationError):
            OfArm(**{field: outside})
