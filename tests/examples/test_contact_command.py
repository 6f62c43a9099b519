"""The command `gearlube contact`: what it writes, refuses and resumes."""

import logging
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.cli.exit_codes import BAD_ARGUMENT, FAILED, INTERRUPTED
from gearlube.report.stored import read_report
from gearlube.studies.contact import run as contact_run
from gearlube.studies.contact import sensitivity
from gearlube.studies.contact.figures.catalogue import CONTACT_CATALOGUE
from gearlube_core.errors import ConvergenceError
from gearlube_core.hypoid_contact import contact_dataset, mesh_cycle
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity
from tests.helpers.each import each

COARSE_BODY = ToothBodySettings(
    neighbour_pitches=0.0,
    condensation=CondensationSettings(
        profile_hats=3,
        lengthwise_hats=5,
        density=MeshDensity(profile=4, lengthwise=8, thickness=2, fillet=2, slot=1, rim=1),
    ),
)
COARSE_CELLS = LoadedSettings(strips=StripSettings(cells_across=9, cells_along=12))


def run(*arguments):
    return CliRunner().invoke(cli.app, ["contact", *map(str, arguments)])


@pytest.fixture
def coarse(monkeypatch, tmp_path):
    """The command with coarse teeth and cells, and a cache of its own."""
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(contact_dataset, "ERROR_POSITIONS", 8)
    real = contact_run.run_contact

    def run_coarse(file, settings, **options):
        cycle = replace(settings.cycle, loaded=COARSE_CELLS)
        return real(file, replace(settings, cycle=cycle, body=COARSE_BODY), **options)

    monkeypatch.setattr(contact_run, "run_contact", run_coarse)
    return tmp_path / "out"


@pytest.fixture
def asked(monkeypatch):
    """What the command would have analysed; it ends as a failed analysis does."""
    calls = []

    def note(file, settings, **options):
        calls.append({"file": file, "settings": settings, **options})
        raise ConvergenceError("noted")

    monkeypatch.setattr(contact_run, "run_contact", note)
    return calls


def test_quick_run_goes_on_after_a_stop_and_writes_table_dataset_and_figures(coarse, monkeypatch):
    options = ("--quick", "--positions", 4, "--jobs", 1, "--out", coarse)
    real, loaded = mesh_cycle.position_record, []

    def stopping(pair, phase, *others):
        if len(loaded) == 2:
            raise KeyboardInterrupt
        loaded.append((pair.side, phase))
        return real(pair, phase, *others)

    monkeypatch.setattr(mesh_cycle, "position_record", stopping)
    assert run(*options).exit_code == INTERRUPTED
    assert len(list((coarse / "positions").glob("*.npz"))) == 2
    assert not (coarse / "contact.nc").exists()

    before = list(loaded)

    def counting(pair, phase, *others):
        loaded.append((pair.side, phase))
        return real(pair, phase, *others)

    monkeypatch.setattr(mesh_cycle, "position_record", counting)
    result = run(*options)
    assert result.exit_code == 0, result.output
    # four positions of either side, none of them twice
    assert len(loaded) == len(set(loaded)) == 8
    assert not set(before) & set(loaded[2:])

    data = read_report(coarse)
    assert data["findings"]
    turning = data["charts"]["solid_view"]["frames"]
    assert [len(one["data"]) for one in turning] == [3] * len(turning)
    figures = {path.stem for path in (coarse / "figures").glob("*.png")}
    assert figures == set(CONTACT_CATALOGUE)
    dataset = xr.load_dataset(coarse / "contact.nc", engine="scipy")
    assert dataset["k_m"].dims == ("side", "phase", "torque")
    np.testing.assert_array_equal(dataset["torque"], [20.0, 50.0, 150.0])
    # shares are parts of one torque
    np.testing.assert_allclose(dataset["share"].sum("pair"), 1.0, atol=1e-9)
    table = read_mesh_table(coarse / "mohammadpour_2015.nc")
    np.testing.assert_array_equal(table.torque, [-150.0, -50.0, -20.0, 20.0, 50.0, 150.0])
    means = dataset["k_m"].sel(side="coast").mean("phase")
    # the table holds the same mean as the zeroth order of its series, coast torques reversed
    np.testing.assert_allclose(table.series["k_m"][:3, 0, 0], means.values[::-1], rtol=1e-12)


def test_default_is_the_shipped_pair_at_eight_torques(asked):
    assert run().exit_code == FAILED
    (call,) = asked
    assert call["file"] == HypoidGearFile.named("mohammadpour_2015")
    assert call["settings"] == ContactSettings()
    assert str(call["folder"]) == "gearlube_contact"


def test_options_reach_the_settings_in_si_units(asked):
    result = run(
        *("--torques", "80", "30", "--positions", "6", "--offset-error-um", "50"),
        *("--pinion-axial-um", "-20", "--gear-axial-um", "10", "--shaft-angle-mrad", "0.5"),
        *("--jobs", "2"),
    )
    assert result.exit_code == FAILED, result.output
    (call,) = asked
    cycle = call["settings"].cycle
    assert cycle.torques == (30.0, 80.0)
    assert cycle.positions == 6
    assert cycle.misalignment.pinion_offset == pytest.approx(50e-6)
    assert cycle.misalignment.pinion_axial == pytest.approx(-20e-6)
    assert cycle.misalignment.gear_axial == pytest.approx(10e-6)
    assert cycle.misalignment.shaft_angle == pytest.approx(0.5e-3)
    assert call["jobs"] == 2


@pytest.fixture
def differentiated(monkeypatch):
    """What the command would have differentiated; it ends as a failed analysis does."""
    calls = []

    def note(file, settings, **options):
        calls.append({"file": file, "settings": settings, **options})
        raise ConvergenceError("noted")

    monkeypatch.setattr(sensitivity, "run_sensitivity", note)
    return calls


def test_sensitivity_takes_one_torque_and_the_misalignment(differentiated, asked, tmp_path):
    result = run(
        *("--sensitivity", "--torques", 120, "--positions", 5, "--gear-axial-um", 10),
        *("--jobs", 1, "--out", tmp_path / "out"),
    )
    assert result.exit_code == FAILED, result.output
    (call,) = differentiated
    assert (call["settings"].torque, call["settings"].positions) == (120.0, 5)
    assert call["settings"].misalignment.gear_axial == pytest.approx(10e-6)
    assert call["folder"] == tmp_path / "out"
    assert not asked


@pytest.mark.slow
@each(
    ("options", "word"),
    [(("--torques", 20, 50), "one torque"), (("--export",), "--export"), (("--torques", 0), "0")],
)
def test_sensitivity_refuses_what_it_does_not_do(options, word, differentiated, tmp_path, caplog):
    caplog.clear()
    with caplog.at_level(logging.ERROR, "gearlube"):
        result = run("--sensitivity", *options, "--out", tmp_path / "out")
    assert result.exit_code == BAD_ARGUMENT
    assert word in caplog.text
    assert not differentiated


def test_a_gear_file_is_read_from_its_path(asked, tmp_path, gear_text):
    path = tmp_path / "own.toml"
    path.write_text(gear_text.replace('name = "mohammadpour_2015"', 'name = "own"'))
    assert run(path).exit_code == FAILED
    assert asked[0]["file"].name == "own"


@each(
    ("change", "words"),
    [
        (("ratio_of_roll = 2.762", 'ratio_of_roll = "fast"'), ["ratio_of_roll"]),
        (("tilt_angle_deg = 31.736", "tilt_angle_deg = 95.0"), ["tilt_angle_deg", "95"]),
        (("sliding_base_mm = 20.647\n", ""), ["sliding_base_mm"]),
        (("radial_setting_mm", "radial_seting_mm"), ["radial_seting_mm"]),
        (("[pinion]", "[pinion"), ["not a readable TOML"]),
    ],
)
def test_a_bad_field_is_named_and_ends_with_bad_argument(
    change, words, asked, tmp_path, gear_text, caplog
):
    assert change[0] in gear_text
    caplog.clear()
    path = tmp_path / "bad.toml"
    path.write_text(gear_text.replace(*change))
    with caplog.at_level(logging.ERROR, "gearlube"):
        result = run(path)
    assert result.exit_code == BAD_ARGUMENT
    assert not asked
    for word in words:
        assert word in caplog.text


def test_the_example_is_a_gear_file_to_start_from(asked, tmp_path):
    printed = run("--example")
    assert printed.exit_code == 0
    path = tmp_path / "mine.toml"
    path.write_text(printed.stdout)
    assert HypoidGearFile.from_toml(path) == HypoidGearFile.named("mohammadpour_2015")
    assert not asked  # nothing was analysed


@each("name", ["no_such_pair", "no_such_file.toml"])
def test_an_unknown_pair_or_file_ends_with_bad_argument(name, asked, caplog):
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run(name).exit_code == BAD_ARGUMENT
    assert name in caplog.text
    assert not asked


@each(
    "options",
    [
        ("--torques", "-5"),
        ("--torques", "nan"),
        ("--torques", "50", "50"),
        ("--positions", "2"),
        ("--offset-error-um", "1e9"),
        ("--films-rpm", "1"),
        ("--films-rpm", "2000", "--oil-temperature", "900"),
        ("--films-rpm", "2000", "--oil", "no_such_oil"),
        ("--oil", "mohammadpour_2015"),  # without --films-rpm
    ],
)
def test_options_out_of_range_end_with_bad_argument(options, asked):
    assert run(*options).exit_code == BAD_ARGUMENT
    assert not asked


def test_flanks_that_do_not_meet_end_with_bad_argument(coarse, tmp_path, gear_text, caplog):
    path = tmp_path / "apart.toml"
    path.write_text(gear_text.replace("radial_setting_mm = 86.983", "radial_setting_mm = 200.0"))
    with caplog.at_level(logging.ERROR, "gearlube"):
        assert run(path, "--jobs", 1, "--out", coarse).exit_code == BAD_ARGUMENT
    assert "radial_setting_mm" in caplog.text
    assert not (coarse / "contact.nc").exists()


@pytest.fixture
def gear_text():
    from importlib.resources import files

    data = files("gearlube_core.hypoid_geometry") / "data" / "mohammadpour_2015.toml"
    return data.read_text(encoding="utf-8")
