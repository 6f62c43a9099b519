"""Lubricant data: reading, checking, handing over to kernels."""

from pathlib import Path

import pytest

from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.oil.library import LIBRARY_PATH, TAGS, read_library
from gearlube_core.oil.lubricant import Lubricant, lubricant_names
from tests.helpers.each import each


def library_with(old: str, new: str, directory: Path) -> Path:
    text = LIBRARY_PATH.read_text(encoding="utf-8")
    assert old in text
    path = directory / "lubricants.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    return path


def test_library_holds_the_oils_of_the_papers() -> None:
    names = {"karagiannis_2012", "mohammadpour_2015", "jamali_2015"}
    assert names <= set(lubricant_names())


def test_every_datum_of_the_library_has_a_tag_and_a_source() -> None:
    for entry in read_library().values():
        assert entry["source"]
        for section in ("viscosity", "data"):
            for value, tag, source in entry[section].values():
                assert value is not None
                assert tag in TAGS
                assert source


def test_unknown_lubricant_is_answered_with_the_known_names() -> None:
    with pytest.raises(ParameterError, match=r"karagiannis_2012, mohammadpour_2015; got 'olive'"):
        Lubricant.named("olive")


@each(
    ("old", "new", "message"),
    [
        ("kinematic_1_mm2_s = [109.1,", "kinematic_1_mm2_s = [-109.1,", "kinematic viscosity"),
        ("dynamic_1 = [0.0171,", "dynamic_1 = [-0.0171,", "dynamic_1 must be above 0 Pa s"),
        ("alpha = [1.44e-8,", "alpha = [14.4,", r"14.4 1/GPa is 1.44e-08 1/Pa"),
        ("kinematic_2_mm2_s = [16.7,", "kinematic_2_mm2_s = [216.7,", "must fall"),
        ('density = [870.0, "printed", "Table 2"]', "density = 870.0", r"\[value, tag, source\]"),
        ('"printed", "m of [', '"guessed", "m of [', "must be one of printed"),
        ('heat_capacity = [2000.0, "completed"', 'heat = [2000.0, "completed"', "missing"),
        ("temperature_1_degc = [40.0,", "temperature = [40.0,", "needs temperature_1_degc"),
        ("[karagiannis_2012.viscosity]", "[karagiannis_2012.visc]", "has no viscosity"),
        ("conductivity_slope = [-7.3", 'conductivity_slope = ["x", "printed", "y"]\n#', "number"),
        ("[karagiannis_2012]", "[karagiannis_2012", "not a readable TOML file"),
    ],
)
def test_a_wrong_library_is_refused_with_the_reason(
    old: str, new: str, message: str, tmp_path: Path
) -> None:
    path = library_with(old, new, tmp_path)
    name = "mohammadpour_2015" if "dynamic" in old else "karagiannis_2012"
    with pytest.raises(ParameterError, match=message):
        Lubricant.from_toml(path, name)


def test_a_slope_is_only_taken_from_an_oil_with_two_viscosities(tmp_path: Path) -> None:
    path = library_with(
        'same_slope_as = ["karagiannis_2012"', 'same_slope_as = ["mohammadpour_2015"', tmp_path
    )
    with pytest.raises(ParameterError, match=r"same_slope_as must be one of .*karagiannis"):
        Lubricant.from_toml(path, "mohammadpour_2015")


def test_a_missing_library_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(GearLubeError, match=r"no lubricant library at .*nowhere\.toml"):
        Lubricant.from_toml(tmp_path / "nowhere.toml", "karagiannis_2012")


@pytest.mark.parametrize("temperature", [-40.0, 90.0, 700.0, float("nan")])
def test_temperature_outside_the_data_is_refused_with_the_range(temperature: float) -> None:
    with pytest.raises(ParameterError, match="temperature must be"):
        Lubricant.named("karagiannis_2012").dynamic_viscosity(temperature)


def test_data_sheet_viscosities_replace_the_line_only() -> None:
    base = Lubricant.named("karagiannis_2012")
    thinner = base.with_two_viscosities(68e-6, 313.15, 8.7e-6, 373.15, name="iso_68")
    # the two data-sheet points are reproduced to rounding
    assert thinner.dynamic_viscosity(313.15) == pytest.approx(68e-6 * base.density, rel=1e-12)
    assert thinner.dynamic_viscosity(373.15) == pytest.approx(8.7e-6 * base.density, rel=1e-12)
    assert (thinner.name, thinner.alpha) == ("iso_68", base.alpha)


@each(
    ("points", "message"),
    [
        ((109.1, 313.15, 16.7, 373.15), r"109.1 mm2/s \(cSt\) is 1.091e-4 m2/s"),
        ((-1e-4, 313.15, 1e-5, 373.15), "nu_1 must be within"),
        ((1e-4, -40.0, 1e-5, 373.15), "temperature_1 must be above 0 K"),
        ((1e-5, 313.15, 1e-4, 373.15), "must fall with temperature"),
        ((1e-4, 313.15, 1e-5, 313.15), "must fall with temperature"),
    ],
)
def test_wrong_data_sheet_points_are_refused(points: tuple[float, ...], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        Lubricant.named("karagiannis_2012").with_two_viscosities(*points, name="x")


def test_parameters_are_plain_floats() -> None:
    *parameters, factor = Lubricant.named("mohammadpour_2015").parameters()
    assert all(type(value) is float for value in (*parameters, *factor))
