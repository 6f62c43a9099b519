"""The film model that an input names: found, of the right kind, for the right oil."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.film_model.chosen_model import (
    _OIL_GROUPS,
    _inlet_of,
    check_oil,
    chosen_model,
    file_of_model,
)
from gearlube_core.film_model.model import FilmModel, model_names, shipped_model
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.own_film_models import copy_of

OIL = Lubricant.named("mohammadpour_2015")
FLANKS = FilmModel.named("hypoid_flank")


def test_a_path_is_relative_to_the_folder_and_a_shipped_name_needs_none(tmp_path):
    copy_of("hypoid_flank", tmp_path / "own.json")
    assert chosen_model("own.json", "flank", "x", tmp_path).checksum == FLANKS.checksum
    assert chosen_model("hypoid_flank", "flank", "x", tmp_path).checksum == FLANKS.checksum
    assert file_of_model("hypoid_flank", tmp_path) is None
    assert file_of_model("own.json", tmp_path) == tmp_path / "own.json"
    with pytest.raises(FileError, match="must be one of helical_line, hypoid_flank, roller_race"):
        chosen_model("own", "flank", "x", tmp_path)


def test_each_kind_has_a_shipped_model_and_says_its_bounds():
    for kind in ("flank", "line", "roller"):
        model = shipped_model(kind)
        assert model.kind == kind
        assert model.name in model_names()
        assert model.oils
        assert f"{100.0 * model.film_bound:.2g} % of the central film" in model.words
        assert model.checksum in model.words
        assert model.checksum in repr(model)


def test_a_model_of_another_kind_is_refused_with_the_cure():
    with pytest.raises(
        ParameterError,
        match=r"film.flank_model must be a film model of hypoid flanks \(kind flank\), got "
        r"helical_line of helical lines.*train --contact flank",
    ):
        chosen_model("helical_line", "flank", "film.flank_model")


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda text: text[: len(text) // 2], "not JSON or is cut off"),
        (
            lambda text: text.replace('"border": [ 0.1 ]', '"border": [ 0.2 ]'),
            "do not belong to its",
        ),
        (lambda text: text.replace('"last_offset"', '"lost"'), "missing .'last_offset'."),
        (lambda text: "{}", "must have the format"),
    ],
)
def test_a_cut_off_or_changed_file_is_refused(tmp_path, spoil, words):
    path = copy_of("hypoid_flank", tmp_path / "own.json")
    text = path.read_text()
    assert spoil(text) != text
    path.write_text(spoil(text))
    with pytest.raises(FileError, match=words) as refusal:
        chosen_model("own.json", "flank", "x", tmp_path)
    assert "own.json" in str(refusal.value)
    assert "gearlube film-model fit" in str(refusal.value)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(FileError, match=r"film model no\.json was not found in"):
        chosen_model("no.json", "flank", "x", tmp_path)


def test_shipped_oils_are_in_the_shipped_domains():
    for name in ("mohammadpour_2015", "karagiannis_2012"):
        for kind in ("flank", "line", "roller"):
            oil, model = Lubricant.named(name), shipped_model(kind)
            assert check_oil(model, oil, STEEL_MOHAMMADPOUR_2015, "model") is None  # no refusal
            thin = replace(oil, eyring_stress=100.0 * oil.eyring_stress)
            with pytest.raises(ParameterError, match="Outside its domain: Eyring stress"):
                check_oil(model, thin, STEEL_MOHAMMADPOUR_2015, "model")


def test_an_oil_that_a_model_says_nothing_of_is_refused_and_what_differs_is_told():
    # the domain ends at 10 MPa with a border of a tenth of its logarithmic width, at 12.6 MPa
    check_oil(FLANKS, replace(OIL, eyring_stress=12e6), STEEL_MOHAMMADPOUR_2015, "x")
    with pytest.raises(
        ParameterError,
        match=r"x must be a film model that holds for the oil mohammadpour_2015, got hypoid_flank, "
        r"trained for mohammadpour_2015, karagiannis_2012. Outside its domain: Eyring stress 13 "
        r"MPa from 0 to 150 degC \(model: 1 to 10 MPa\). Train one .*--contact flank --oil OIL",
    ):
        check_oil(FLANKS, replace(OIL, eyring_stress=13e6), STEEL_MOHAMMADPOUR_2015, "x")


def test_an_oil_that_fits_at_some_temperatures_is_taken():
    # 1 Pa.s at 0 degC lies far outside, beyond 0.115 and its border
    assert OIL.dynamic_viscosity(OIL.temperature_low) > 0.9
    check_oil(FLANKS, OIL, STEEL_MOHAMMADPOUR_2015, "x")


def test_another_solid_is_refused():
    aluminium = replace(STEEL_MOHAMMADPOUR_2015, youngs_modulus=70e9)
    with pytest.raises(ParameterError, match=r"contact modulus E\* 3.* GPa \(model: 11"):
        check_oil(FLANKS, OIL, aluminium, "x")


def test_groups_of_an_oil_are_told_in_its_own_numbers():
    solid = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
    inlet = _inlet_of(OIL, 353.15, solid)
    expected = {
        "viscosity": (OIL.dynamic_viscosity(353.15), "Pa.s"),
        "exponent": (OIL.roelands_z, ""),
        "stress": (1e-6 * OIL.eyring_stress, "MPa"),
        "conductivity": (OIL.conductivity, "W/(m.K)"),
        "capacity": (1e-6 * OIL.density * OIL.heat_capacity, "MJ/(m3.K)"),
    }
    found = {g.group: (g.plain(getattr(inlet, g.group), inlet, solid), g.unit) for g in _OIL_GROUPS}
    for name, (value, unit) in expected.items():
        # constants of Roelands' law agree to 4e-7
        assert found[name] == (pytest.approx(value, rel=1e-6), unit), name
    assert found["cooling"][0] > 0.0
