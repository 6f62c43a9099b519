"""Film models of one's own in helical pairs and bearings: what is given is computed with."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_src.helical_pair import DEFINITION, HelicalPair, definition_with, pair_parameters
from fmu_src.identity import guid_of
from fmu_src.variable import OF_HOLDER
from gearlube.output.toml_text import toml_text
from gearlube.studies.bearing.report import findings
from gearlube.studies.bearing.run import BearingSettings, run_bearing
from gearlube.studies.helical.film_friction import film_dataset
from gearlube.studies.helical.findings import findings as helical_findings
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.variation.points.bearing import BearingPoint
from gearlube.variation.points.helical import HelicalPoint
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.bearings.losses.loss import LossModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.errors import GearLubeError, ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.own_film_models import OIL_FILE, altered, copy_of

LINES, ROLLERS = FilmModel.named("helical_line"), FilmModel.named("roller_race")


def gear_file(folder: Path, film: dict[str, str]) -> Path:
    """A shipped gear file with another section [film]."""
    data = tomllib.loads(HelicalGearFile.shipped_text("he_2007"))
    path = folder / "pair.toml"
    path.write_text(toml_text({**data, "name": "pair", "film": film}))
    return path


def bearing_file(folder: Path, model: str) -> Path:
    path = folder / "bearing.toml"
    path.write_text(f'film_model = "{model}"\n' + BearingFile.shipped_text("wingertszahn_2023"))
    return path


OWN = {"model": "solved", "line_model": "models/line.json"}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "models").mkdir()
    copy_of("helical_line", tmp_path / "models" / "line.json")
    copy_of("roller_race", tmp_path / "models" / "roller.json")
    return tmp_path


def operating(file: HelicalGearFile, **changes) -> HelicalSettings:
    given = {"pinion_torque": 226.0, "pinion_speed": 104.7, "mesh": "density", "draws": 0}
    return HelicalSettings(file=file, **{**given, **changes})


def film_of(settings: HelicalSettings):
    return film_dataset(settings, settings.constant_mesh())


@pytest.mark.slow
def test_a_copy_by_path_gives_the_shipped_pair_bit_for_bit(folder):
    shipped = film_of(operating(HelicalGearFile.named("he_2007"), film_model="solved"))
    own = film_of(operating(HelicalGearFile.given(str(gear_file(folder, OWN)))))
    for name in ("coefficient", "film_ratio", "line_load"):
        np.testing.assert_array_equal(own[name].values, shipped[name].values)
    assert own.attrs["operating_power_loss"] == shipped.attrs["operating_power_loss"]


@pytest.mark.slow
def test_other_weights_change_the_films_of_lines_by_what_they_say(folder):
    file = HelicalGearFile.given(str(gear_file(folder, OWN)))
    shipped = film_of(operating(file))
    assert shipped.attrs["operating_share_outside"] == 0.0
    thicker = altered("helical_line", film=1.25)
    thicker.write(folder / "models" / "line.json")
    found = film_of(operating(file))
    # loads are static: film and its ratio alone change, by the factor, where no formula is mixed in
    np.testing.assert_allclose(
        found["film_ratio"].values, 1.25 * shipped["film_ratio"].values, rtol=1e-12
    )
    words = [one.detail for one in helical_findings({"film": found}) if "solved" in one.headline]
    assert f"Model: altered (checksum {thicker.checksum})" in words[0]
    # given by itself, without a file
    plain = HelicalGearFile.named("he_2007")
    direct = film_of(operating(plain, film_model="solved", line_film_model=thicker))
    np.testing.assert_array_equal(direct["film_ratio"].values, found["film_ratio"].values)


def test_the_march_takes_model_and_oil_of_the_gear_file(folder):
    (folder / "oil.toml").write_text(OIL_FILE)
    path = gear_file(folder, {**OWN, "oil_file": "oil.toml"})
    altered("helical_line", film=1.25).write(folder / "models" / "line.json")
    parameters = helical_march_parameters(HelicalGearFile.given(str(path)))
    assert parameters.film == "solved"
    assert parameters.oil.name == "own"
    expected = altered("helical_line", film=1.25).copied_numbers()
    np.testing.assert_array_equal(parameters.film_model(), expected)
    assert operating(HelicalGearFile.given(str(path))).film().oil.name == "own"
    assert operating(HelicalGearFile.given(str(path)), oil="karagiannis_2012").film().oil.name == (
        "karagiannis_2012"
    )


def test_variants_of_a_pair_take_model_and_oil_of_the_file(folder):
    (folder / "oil.toml").write_text(OIL_FILE)
    path = gear_file(folder, {**OWN, "oil_file": "oil.toml"})
    altered("helical_line", film=1.25).write(folder / "models" / "line.json")
    study = HelicalPoint(file=HelicalGearFile.given(str(path))).prepared({})
    for one in ("oil.toml", "models/line.json"):
        (folder / one).unlink()  # held in memory
    settings = study._settings({})
    assert settings.film().oil.name == "own"
    assert settings.film().film_models["line"].name == "altered"
    assert study._settings({"oil": "karagiannis_2012"}).film().oil.name == "karagiannis_2012"


def test_an_fmu_carries_model_and_oil(folder):
    (folder / "oil.toml").write_text(OIL_FILE)
    path = gear_file(folder, {**OWN, "oil_file": "oil.toml"})
    guid = guid_of(definition_with(path))
    altered("helical_line", film=1.25).write(folder / "models" / "line.json")
    definition = definition_with(path)
    assert guid_of(definition) != guid
    assert set(definition.resources) == {"helical_gear.toml", "line_film_model.json", "oil.toml"}
    resources = folder / "unpacked"
    resources.mkdir()
    for name, content in definition.resources.items():
        (resources / name).write_bytes(content)
    assert HelicalPair.definition_of(resources) is definition
    starts = {v.argument: v.decoded(v.start) for v in definition.variables if v.is_model_parameter}
    assert (starts["oil"], starts["film"], starts["gear_name"]) == ("custom", "solved", "custom")
    embedded = definition.start.keywords["embedded"]
    for of_run in ("pinion_speed", *OF_HOLDER):
        starts.pop(of_run, None)
    own = pair_parameters(starts, embedded)
    assert own.oil.name == "own"
    assert own.line_film_model.name == "altered"
    # a shipped pair in the same FMU keeps the shipped model
    other = pair_parameters({**starts, "gear_name": "jamali_2015_a"}, embedded)
    assert other.line_film_model.checksum == LINES.checksum


def test_an_fmu_without_files_is_as_it_was():
    assert definition_with(None) is DEFINITION


@pytest.mark.parametrize(
    ("film", "error", "words"),
    [
        (
            {"line_model": "models/line.json"},
            ParameterError,
            "line_model is only for model = solve",
        ),
        ({**OWN, "line_model": "no.json"}, GearLubeError, r"no\.json was not found in"),
        (
            {**OWN, "line_model": "models/roller.json"},
            ParameterError,
            "must be a film model of helical lines",
        ),
    ],
)
def test_what_cannot_be_in_a_gear_file_is_refused(folder, film, error, words):
    path = gear_file(folder, film)
    with pytest.raises(error, match=words):
        operating(HelicalGearFile.given(str(path)))
    with pytest.raises(error, match=words):
        definition_with(path)


def test_a_line_model_of_another_oil_is_refused_and_what_differs_is_told(folder):
    thin = replace(Lubricant.named("mohammadpour_2015"), eyring_stress=80e6)
    with pytest.raises(
        ParameterError, match=r"trained for .*Eyring stress 80 MPa .* \(model: .* MPa\)"
    ):
        operating(HelicalGearFile.given(str(gear_file(folder, OWN))), oil=thin)


def rolling(file: BearingFile, model: FilmModel | None):
    settings = replace(
        BearingSettings.of_file(file), models=(LossModel(law="solved_films", film_model=model),)
    )
    return run_bearing(file, settings)


def test_a_bearing_takes_the_model_that_it_is_given(folder):
    shipped = BearingFile.named("wingertszahn_2023")
    own = BearingFile.given(str(bearing_file(folder, "models/roller.json")))
    first, copied = rolling(shipped, None), rolling(own, own.own_film_model())
    np.testing.assert_array_equal(copied["torque"].values, first["torque"].values)
    more = altered("roller_race", film=1.1, friction=1.5)
    more.write(folder / "models" / "roller.json")
    found = rolling(own, own.own_film_model())
    inside = first["out_of_range"].values == 0.0
    assert inside.any()
    # rolling alone is of the model: the factor on its torque and on the film, where no formula is
    # mixed in
    torques = [one["part_torque"].sel(part="rolling").values for one in (found, first)]
    np.testing.assert_allclose(torques[0][inside], 1.5 * torques[1][inside], rtol=1e-12)
    np.testing.assert_allclose(
        found["film_ratio"].values[inside], 1.1 * first["film_ratio"].values[inside], rtol=1e-12
    )
    said = [one.detail for one in findings(found) if "model of solved films" in one.headline]
    assert f"Model: altered (checksum {more.checksum})" in said[0]
    assert not [one for one in findings(run_bearing(shipped)) if "solved films" in one.headline]


def test_a_bearing_model_is_refused_where_it_cannot_be(folder):
    with pytest.raises(ParameterError, match="must come with the law solved_films, got roller_ra"):
        LossModel(law="palmgren", film_model=ROLLERS)
    with pytest.raises(ParameterError, match="must be a film model of rollers on races"):
        LossModel(law="solved_films", film_model=LINES)
    with pytest.raises(ParameterError, match=r"none\.json was not found in .*it in film_model"):
        BearingFile.given(str(bearing_file(folder, "none.json")))
    thin = replace(Lubricant.named("fva_3"), eyring_stress=60e6, eyring_slope=0.0)
    file = BearingFile.named("wingertszahn_2023")
    settings = replace(
        BearingSettings.of_file(file), models=(LossModel(law="solved_films", film_model=ROLLERS),)
    )
    with pytest.raises(ParameterError, match="Eyring stress 60 MPa"):
        settings.check(file.geometry(), thin)


def test_variants_of_a_bearing_hold_their_models(folder):
    path = bearing_file(folder, "models/roller.json")
    file = BearingFile.given(str(path))
    study = BearingPoint(file=file).prepared({})
    shipped = BearingPoint(file=BearingFile.named("wingertszahn_2023")).prepared({})
    point = {"law": "solved_films"}
    np.testing.assert_array_equal(study.compute(point), shipped.compute(point))
    altered("roller_race", friction=1.5).write(folder / "models" / "roller.json")
    other = BearingPoint(file=file).prepared({})
    assert other.identity != study.identity
    assert other.compute(point)[0] > study.compute(point)[0]
