"""Notes on the fields of any data model: units, kinds, limits, and sentences about them."""

from typing import Annotated, ClassVar, Literal

import pytest
from pydantic import Field

from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile


class Sample(InputFile):
    """A file with one field of each kind."""

    package: ClassVar[str] = "gearlube_core.ehl"

    smooth: bool = Field(default=False, description="Smooth or not")
    speed_m_s: float = Field(default=1.5, description="Of the surface")
    load_n_per_mm: Annotated[float, Field(gt=0.0, le=10.0)] = Field(description="Of the line")
    load_n: float = Field(default=1.0, description="Load")
    modulus_gpa: float = Field(default=1.0, description="Modulus")
    slope_per_gpa: float = Field(default=1.0, description="Slope")
    oil_temperature_degc: float = Field(default=1.0, description="Of the oil")
    angle_deg: float = Field(default=1.0, description="Angle")
    conductivity_w_m_k: float = Field(default=1.0, description="Of heat")
    nodes: list[int] = Field(default=[], description="Of the grids")
    form: Literal["only"] = Field(default="only", description="One form")


NOTES = field_notes(Sample)


def test_the_longest_ending_of_a_name_is_its_unit():
    units = {name: note.unit for name, note in NOTES.items() if note.unit}
    assert units == {
        "speed_m_s": "m/s",
        "load_n_per_mm": "N/mm",
        "load_n": "N",
        "modulus_gpa": "GPa",
        "slope_per_gpa": "1/GPa",
        "oil_temperature_degc": "degC",
        "angle_deg": "deg",
        "conductivity_w_m_k": "W/(m.K)",
    }


def test_kinds_limits_and_defaults_are_words():
    assert (NOTES["smooth"].kind, NOTES["smooth"].default) == ("true or false", "false")
    assert (NOTES["nodes"].kind, NOTES["nodes"].default) == ("list of whole numbers", "none")
    assert (NOTES["form"].kind, NOTES["form"].limits) == ("text", "only")
    assert NOTES["load_n_per_mm"].limits == "above 0 to 10"
    assert NOTES["speed_m_s"].default == "1.5"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"smooth": "yes"}, "smooth must be true or false, got 'yes'"),
        ({"load_n_per_mm": 11.0}, "must be a number, above 0 to 10 N/mm, got 11.0"),
        ({"form": "other"}, "form must be a text, only, got 'other'"),
    ],
)
def test_what_is_wrong_is_said_in_the_same_words(changes, words):
    with pytest.raises(ParameterError) as refusal:
        Sample.from_data({"load_n_per_mm": 1.0, **changes}, "sample")
    assert words in str(refusal.value)
