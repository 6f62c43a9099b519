"""Variables of FMI 3: which scalars become elements of an array."""

from fmu_src.native.sources import array_variables
from fmu_src.variable import Variable
from fmu_src.variables import HYPOID_AXLE


def real(name, description="Load"):
    return Variable(name=name, type="Real", causality="output", unit="N", description=description)


def found(*variables):
    return [(one.variable.name, one.references) for one in array_variables(variables)]


def test_numbered_variables_become_one_array_at_the_place_of_its_first_element():
    variables = array_variables(
        [
            real("torque"), real("flank[2].load", "Load, flank 2"), real("speed"),
            real("flank[1].load", "Load, flank 1"), real("flank[3].load", "Load, flank 3"),
        ]
    )  # fmt: skip
    assert [(one.variable.name, one.references) for one in variables] == [
        ("torque", (0,)), ("speed", (2,)), ("flank.load", (3, 1, 4))
    ]  # fmt: skip
    array = variables[-1].variable
    assert array.description == "Load, of each flank"
    assert (array.unit, array.causality) == ("N", "output")


def test_description_of_the_first_element_loses_its_number():
    pairs = [real(f"bearing[{i}].force", f"Force of bearing {i}") for i in (1, 2)]
    (array,) = array_variables(pairs)
    assert array.variable.description == "Force, of each bearing"


def test_what_is_not_numbered_from_one_to_n_stays_scalar():
    assert found(real("a[1].x")) == [("a[1].x", (0,))]
    assert found(real("a[1].x"), real("a[3].x")) == [("a[1].x", (0,)), ("a[3].x", (1,))]
    assert found(real("a[0].x"), real("a[1].x")) == [("a[0].x", (0,)), ("a[1].x", (1,))]
    assert found(real("a[1].x[1]"), real("a[1].x[2]")) == [
        ("a[1].x[1]", (0,)), ("a[1].x[2]", (1,))
    ]  # fmt: skip
    assert found(real("a[1].x"), real("a[2].y")) == [("a[1].x", (0,)), ("a[2].y", (1,))]


def test_an_array_keeps_the_whole_description_of_its_first_element():
    found = {one.variable.name: one.variable.description for one in array_variables(HYPOID_AXLE)}
    assert found["flank.film_thickness"] == "Central film thickness, of each flank"
    assert found["bearing.roller_load_max"] == "Largest roller load, of each bearing"
