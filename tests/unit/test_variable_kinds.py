"""What the makers of FMU variables say of a variable, and leave to FMI's defaults."""

from fmu_src.variable import Variable, count, input_, option, options_by_number, output, parameter


def test_makers_describe_the_variable_they_are_asked_for():
    torque = input_("torque", "N.m", "Torque", start=3.0, minimum=-5.0, maximum=7.0, nominal=2.0)
    assert torque == Variable(
        name="torque", type="Real", causality="input", unit="N.m", description="Torque",
        start=3.0, minimum=-5.0, maximum=7.0, nominal=2.0,
    )  # fmt: skip
    mass = parameter("mass", "kg", "Mass", start=1.0, argument="pinion_mass")
    assert mass == Variable(
        name="mass", type="Real", causality="parameter", unit="kg", description="Mass",
        start=1.0, argument="pinion_mass",
    )  # fmt: skip
    steps = count("steps", "Steps", 16, 4, 64, "updates")
    assert steps == Variable(
        name="steps", type="Integer", causality="parameter", description="Steps", start=16,
        minimum=4, maximum=64, argument="updates",
    )  # fmt: skip
    load = output("load", "N", "Load", nominal=1e3, display_unit="kN")
    assert load == Variable(
        name="load", type="Real", causality="output", unit="N", description="Load", nominal=1e3,
        display_unit="kN",
    )  # fmt: skip


def test_nominal_of_an_output_is_one_as_in_the_standard():
    assert output("efficiency", "1", "Efficiency").nominal == 1.0  # FMI 2.0.4, table in 2.2.7
    assert output("efficiency", "1", "Efficiency").display_unit == ""


def test_options_count_their_literals_from_one():
    radii = option("radii", "Radii", "paper", "mean", "consistent", start="mean", argument="radii")
    assert (radii.start, radii.literals) == (2, ("paper", "mean", "consistent"))
    load = output("load", "N", "Load")
    (number,) = options_by_number((load, radii))
    assert (number.name, number.option_of, number.type) == ("radii.number", "radii", "Integer")
    # zero leaves the option as it is
    assert (number.start, number.minimum, number.maximum) == (0, 0, 3)
