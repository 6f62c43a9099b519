"""Film models of a user: in files, FMUs and studies."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from drivetrain.axle_file.axle_file import AxleFile
from drivetrain.axle_file.read_axle import read_axle
from drivetrain.cycle.traces import DriveCycle
from fmu_src.hypoid_axle import DEFINITION, HypoidAxle, car_axle_in, definition_with_axle
from fmu_src.identity import guid_of
from fmu_src.native.hypoid_axle import native_model
from gearlube.studies.drive_cycle.report import findings as cycle_findings
from gearlube.studies.drive_cycle.run import run_cycle
from gearlube.studies.drive_cycle.settings import DriveCycleSettings, LossGrid
from gearlube.studies.loss_map.findings import findings
from gearlube.studies.loss_map.run import run_loss_map
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube.studies.sweep.axle_in_fmu import axle_with_oil
from gearlube.variation.file_variants import AxleVariants
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.errors import FileError, ParameterError
from gearlube_core.film_model.chosen_model import (
    _OIL_GROUPS,
    _groups_of,
    check_oil,
    chosen_model,
    file_of_model,
)
from gearlube_core.film_model.model import FilmModel, model_names, shipped_model
from gearlube_core.friction.flank_film import flank_film_model
from gearlube_core.oil.lubricant import Lubricant
from tests.helpers.own_film_models import OIL_FILE, altered, copy_of

COARSE = LossGrid(torques=8, speeds=6, temperature_step=45.0)
VISCOUS = LOSS_SOURCES.index("friction_viscous")
BOTH = (
    '[film]\nmodel = "solved"\nflank_model = "models/flank.json"\nroller_model = "roller.json"\n'
    '[model]\nbearing_torque_loss = "solved_films"\n'
)


def axle_file(folder: Path, more: str = BOTH, name: str = "axle.toml") -> Path:
    path = folder / name
    path.write_text(f'[gear_set]\nmesh_table = "mohammadpour_2015"\n{more}')
    return path


@pytest.fixture
def copies(tmp_path):
    (tmp_path / "models").mkdir()
    copy_of("hypoid_flank", tmp_path / "models" / "flank.json")
    copy_of("roller_race", tmp_path / "roller.json")
    return tmp_path


def losses(axle):
    points = {"torques": np.array([200.0, 300.0]), "speeds": np.array([200.0])}
    return axle_losses(axle, **points, temperatures=np.array([353.15]))


def test_a_copy_by_path_gives_the_shipped_losses_bit_for_bit(copies):
    plain = BOTH.replace('flank_model = "models/flank.json"\n', "").replace(
        'roller_model = "roller.json"\n', ""
    )
    shipped = read_axle(axle_file(copies, plain, "shipped.toml")).axle
    by_name = plain.replace("[film]", '[film]\nflank_model = "hypoid_flank"')
    own = read_axle(axle_file(copies)).axle
    named = read_axle(axle_file(copies, by_name, "named.toml")).axle
    first = losses(shipped)
    for other in (own, named):
        found = losses(other)
        for one in fields(first):
            np.testing.assert_array_equal(getattr(first, one.name), getattr(found, one.name))
    assert shipped.flank_film_model is None
    assert own.flank_film_model.checksum == FilmModel.named("hypoid_flank").checksum


def test_other_weights_change_film_and_losses_by_what_they_say(copies):
    shipped = losses(read_axle(axle_file(copies)).axle)
    np.testing.assert_array_equal(shipped.share_outside, 0.0)
    # a fifth more friction of the same film: a fifth more of its loss, where no formula is mixed
    # in; friction takes part in the pinion's balance of torque, so the load falls by half a percent
    altered("hypoid_flank", friction=1.2).write(copies / "models" / "flank.json")
    more = losses(read_axle(axle_file(copies)).axle)
    np.testing.assert_allclose(
        more.power[..., VISCOUS], 1.2 * shipped.power[..., VISCOUS], rtol=0.01
    )
    np.testing.assert_allclose(more.film_ratio, shipped.film_ratio, rtol=1e-3)
    # a film 1.1 times as thick
    altered("hypoid_flank", film=1.1).write(copies / "models" / "flank.json")
    thicker = losses(read_axle(axle_file(copies)).axle)
    np.testing.assert_allclose(thicker.film_ratio, 1.1 * shipped.film_ratio, rtol=1e-3)
    # rollers: a third more rolling force
    altered("roller_race", friction=4.0 / 3.0).write(copies / "roller.json")
    rolling = losses(read_axle(axle_file(copies)).axle)
    drag = [LOSS_SOURCES.index(one) for one in LOSS_SOURCES if "bearing" in one]
    assert np.all(rolling.power[..., drag].sum(-1) > 1.05 * thicker.power[..., drag].sum(-1))


def test_a_map_names_its_models_with_their_bounds(copies):
    altered("hypoid_flank", film=1.1).write(copies / "models" / "flank.json")
    settings = LossMapSettings(
        axle=read_axle(axle_file(copies)).axle,
        torques=np.array([100.0]),
        speeds=np.array([200.0]),
        temperatures=np.array([353.15]),
        draws=0,
    )
    found = run_loss_map(settings)
    bounds = FilmModel.named("hypoid_flank")
    words = (
        f"altered (checksum {altered('hypoid_flank', film=1.1).checksum}), bounds "
        f"{100.0 * bounds.film_bound:.2g} % of the central film and "
        f"{100.0 * bounds.friction_bound:.2g} % of friction"
    )
    assert found.attrs["film_model_flank"] == words
    assert found.attrs["film_model_roller"].startswith("roller_race (checksum")
    said = [one.detail for one in findings(found) if "solved films" in one.headline]
    assert f"Model: {words}." in said[0]
    assert f"Model: {found.attrs['film_model_roller']}." in said[1]


def test_a_cycle_has_the_bounds_of_flanks_and_rollers(copies):
    car = read_axle(axle_file(copies))
    time, speed = np.array([0.0, 5.0, 10.0]), np.full(3, 10.0)  # s, m/s
    trace = DriveCycle(name="even", time=time, speed=speed)
    warm = {"start_temperature": 353.15, "air_temperature": 343.15}  # K, within the domains
    found = run_cycle(DriveCycleSettings(car=car, cycle=trace, draws=0, grid=COARSE, **warm))
    seconds = found["duration"].values
    for name, source in (("drag", "bearing_torque"), ("friction", "friction_viscous")):
        bound, loss = found[f"{name}_bound"].values, found["loss"].sel(source=source).values
        assert np.all((bound > 0.0) & (bound < 0.2 * loss))
    assert float(found["energy_drag_bound"]) == pytest.approx(
        1e-3 * float(found["drag_bound"].values @ seconds)
    )
    assert np.all(found["rollers_outside"].values < 0.5)
    said = [one.headline for one in cycle_findings(found) if "solved films" in one.headline]
    assert ["of the flanks" in said[0], "of the rollers" in said[1]] == [True, True]


def test_a_file_says_which_models_its_axle_takes(copies):
    notes = {one.field: one for one in read_axle(axle_file(copies)).inputs}
    assert notes["film.flank_model"][1:4] == ("models/flank.json", "", "given")
    assert notes["film.roller_model"][1:4] == ("roller.json", "", "given")
    plain = axle_file(copies, '[film]\nmodel = "solved"\n', "plain.toml")
    notes = {one.field: one for one in read_axle(plain).inputs}
    assert notes["film.flank_model"][1:4] == ("hypoid_flank", "", "assumed")
    assert "film.roller_model" not in notes


@pytest.mark.parametrize(
    ("more", "error", "words"),
    [
        ('[film]\nflank_model = "hypoid_flank"', ParameterError, "only for model = solved, got"),
        (
            '[film]\nmodel = "solved"\nroller_model = "roller_race"',
            ParameterError,
            "only for model.bearing_torque_loss = solved_films, got 'roller_race' with that left",
        ),
        (
            '[film]\nmodel = "solved"\nflank_model = "roller.json"',
            ParameterError,
            r"film.flank_model must be a film model of hypoid flanks.*\(kind roller\)",
        ),
        (
            '[film]\nmodel = "solved"\nflank_model = "no.json"',
            ParameterError,
            r"no\.json was not found in .*names it in film\.flank_model",
        ),
        (
            '[film]\nmodel = "solved"\nflank_model = "models/flank.json"\n'
            "[oil]\neyring_stress_mpa = 40.0",
            ParameterError,
            r"film.flank_model must be a film model that holds for the oil own oil.*Eyring stress "
            r"40 MPa from .* \(model: .* MPa\)",
        ),
    ],
)
def test_what_cannot_be_is_refused(copies, more, error, words):
    with pytest.raises(error, match=words):
        read_axle(axle_file(copies, more))


@pytest.mark.slow
def test_an_fmu_carries_the_models_and_computes_with_them(copies):
    path = axle_file(copies)
    guid = guid_of(definition_with_axle(path))
    flank, roller = altered("hypoid_flank", film=1.2), altered("roller_race", film=1.1)
    flank.write(copies / "models" / "flank.json")
    roller.write(copies / "roller.json")
    definition = definition_with_axle(path)
    assert guid_of(definition) != guid
    inside = car_axle_in(definition.resources).axle
    assert inside.flank_film_model.checksum == flank.checksum
    assert inside.roller_film_model.checksum == roller.checksum
    # unpacked, without the folder of the axle file
    resources = copies / "unpacked"
    resources.mkdir()
    for name, content in definition.resources.items():
        (resources / name).write_bytes(content)
    assert HypoidAxle.definition_of(resources) is definition
    # the native FMU has the same numbers as constants
    data = native_model(definition).data
    for numbers in (flank_film_model(flank), roller.copied_numbers()):
        windows = np.lib.stride_tricks.sliding_window_view(data, numbers.size)
        assert any(np.array_equal(one, numbers, equal_nan=True) for one in windows)
    plain = native_model(DEFINITION)
    assert plain.data.size == data.size


def test_a_shipped_name_needs_no_file_in_the_fmu(copies):
    path = axle_file(copies, '[film]\nmodel = "solved"\nflank_model = "hypoid_flank"\n')
    assert set(definition_with_axle(path).resources) == {"axle.toml"}


def test_a_sweep_with_another_oil_keeps_the_models(copies):
    (copies / "oil.toml").write_text(OIL_FILE)
    path = axle_file(copies)
    (copies / "sweep").mkdir()
    made = axle_with_oil(path, None, copies / "oil.toml", copies / "sweep")
    for one in (copies / "models" / "flank.json", copies / "roller.json"):
        one.unlink()
    axle = read_axle(made).axle
    assert axle.flank_film_model.checksum == FilmModel.named("hypoid_flank").checksum
    assert axle.roller_film_model.checksum == FilmModel.named("roller_race").checksum
    assert axle.oil.name == "own"


def test_variants_hold_the_models_in_memory_and_know_their_content(copies):
    path = axle_file(copies)
    altered("hypoid_flank", film=1.1).write(copies / "other.json")
    key = "film.flank_model"
    read = AxleVariants.read(str(path))
    variants = read.with_files([(key, "other.json")])
    before = variants.identity
    (copies / "other.json").unlink()
    thicker = variants.car_axle({key: "other.json"}).axle
    assert thicker.flank_film_model.checksum == altered("hypoid_flank", film=1.1).checksum
    assert variants.car_axle({}).axle.flank_film_model.name == "hypoid_flank"
    altered("hypoid_flank", film=1.3).write(copies / "other.json")
    assert read.with_files([(key, "other.json")]).identity != before


def test_the_fields_of_a_file_without_models_are_as_they_were():
    made = AxleFile.named("mohammadpour_2015").car_axle().axle
    assert (made.flank_film_model, made.roller_film_model) == (None, None)
    assert made.film_models == {}


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
    # the domain ends at 25 MPa with a border of a tenth of its logarithmic width, at 34 MPa
    check_oil(FLANKS, replace(OIL, eyring_stress=25e6), STEEL_MOHAMMADPOUR_2015, "x")
    with pytest.raises(
        ParameterError,
        match=r"x must be a film model that holds for the oil mohammadpour_2015, got hypoid_flank, "
        r"trained for .*mohammadpour_2015. Outside its domain: Eyring stress 40 "
        r"MPa from 0 to 150 degC \(model: .* MPa\). Train one .*--contact flank --oil OIL",
    ):
        check_oil(FLANKS, replace(OIL, eyring_stress=40e6), STEEL_MOHAMMADPOUR_2015, "x")


def test_another_solid_is_refused():
    aluminium = replace(STEEL_MOHAMMADPOUR_2015, youngs_modulus=70e9)
    with pytest.raises(ParameterError, match=r"contact modulus E\* 3.* GPa \(model: 11"):
        check_oil(FLANKS, OIL, aluminium, "x")


def test_groups_of_an_oil_are_told_in_its_own_numbers():
    solid = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
    groups = _groups_of(OIL, 353.15, solid)
    state = OIL.state(353.15)
    expected = {
        "warmth": (state.beta, "1/K"),
        "stress": (1e-6 * OIL.eyring_stress, "MPa"),
        "conductivity": (OIL.conductivity, "W/(m.K)"),
        "capacity": (1e-6 * OIL.density * OIL.heat_capacity, "MJ/(m3.K)"),
        # by Roelands and Houpert at 0.5 GPa
        "cooling": ((1.0 + 5.1e-9 * 5e8) ** OIL.roelands_z, ""),
    }
    found = {
        g.group: (g.plain(getattr(groups, g.group), 353.15, solid), g.unit) for g in _OIL_GROUPS
    }
    for name, (value, unit) in expected.items():
        # constants of Roelands' law agree to 1e-5
        assert found[name] == (pytest.approx(value, rel=1e-4), unit), name
    assert 0.5 < found["shape"][0] < 1.0
