"""Numbers that a kernel declares in its own file: added from outside the package."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Annotated, Literal, NamedTuple

import pytest

from gearlube_core.dynamics.hypoid_axle import HypoidAxleParameters, mohammadpour_2015_axle
from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, Positive, check_fields, constants_of


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesionScalars(HypoidAxleParameters):
    adhesion: Annotated[float, Number("N", 0.0, 9.0, "Oil pulls with less than 1 N.")] = 0.25


class AdhesionConstants(NamedTuple):
    adhesion: float
    backlash: float


def sticky_axle() -> AdhesionScalars:
    axle = mohammadpour_2015_axle()
    return AdhesionScalars(**{field.name: getattr(axle, field.name) for field in fields(axle)})


def test_a_new_number_is_a_keyword_with_a_default_and_reaches_its_kernel() -> None:
    axle = sticky_axle()
    assert constants_of(AdhesionConstants, axle) == (0.25, 150e-6)
    assert constants_of(AdhesionConstants, replace(axle, adhesion=2), backlash=0.0) == (2.0, 0.0)


def test_a_new_number_is_checked_as_its_annotation_says() -> None:
    with pytest.raises(ParameterError) as caught:
        replace(sticky_axle(), adhesion=9.5)
    assert str(caught.value) == (
        "adhesion must be within 0 to 9 N, got 9.5 N. Oil pulls with less than 1 N."
    )


@dataclass(frozen=True, kw_only=True)
class Plate:
    thickness: Annotated[float, Positive("m", "3 mm is 0.003 m.")] = 0.003
    finish: Literal["ground", "milled"] = "ground"

    def __post_init__(self) -> None:
        check_fields(self)


def test_a_number_above_zero_and_a_choice_are_checked_as_their_annotations_say() -> None:
    assert Plate(thickness=1e-9, finish="milled").finish == "milled"
    with pytest.raises(ParameterError, match=r"thickness must be above 0 m, got 0 m\. 3 mm is"):
        Plate(thickness=0.0)
    with pytest.raises(ParameterError, match="finish must be one of ground, milled; got 'cast'"):
        Plate(finish="cast")  # type: ignore[arg-type]


def test_the_numbers_of_the_model_stay_checked() -> None:
    for change in ({"hysteretic_loss": 0.6}, {"gear_mass": 0.0}, {"steps_per_mesh_period": 8}):
        with pytest.raises(ParameterError, match=next(iter(change))):
            replace(sticky_axle(), **change)  # type: ignore[arg-type]


def test_constants_that_nobody_gives_or_takes_are_errors() -> None:
    with pytest.raises(AttributeError, match="adhesion"):
        constants_of(AdhesionConstants, mohammadpour_2015_axle())
    with pytest.raises(TypeError, match="lateral"):
        constants_of(AdhesionConstants, sticky_axle(), lateral=1.0)
