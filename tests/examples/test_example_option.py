"""What `--example` prints or writes can be read by the command that it is for."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import gearlube as gl
from drivetrain.axle_file.axle_file import AxleFile
from gearlube.cli.example import kept_example
from gearlube.command import app
from gearlube.studies.sound.transfer_path import generic_path, read_csv_path
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.oil.oil_file import OilFile
from gearlube_core.surface.statistics import profile_statistics


def printed(*words):
    done = CliRunner().invoke(app, [*words, "--example"])
    assert done.exit_code == 0, done.output
    return done.stdout


def test_measured_gears_are_written_with_their_tables_and_nothing_is_replaced(tmp_path, caplog):
    words = ["measured", "--example", str(tmp_path / "mine")]
    assert CliRunner().invoke(app, words).exit_code == 0
    file = gl.gears.MeasuredFile.from_toml(tmp_path / "mine" / "axle_17.toml")
    tables = {Path(one).name for one in (file.deviations, file.pitch, file.waviness)}
    assert {one.name for one in (tmp_path / "mine").iterdir()} == {"axle_17.toml", *tables}
    (tmp_path / "mine" / "axle_17.toml").write_text("mine", encoding="utf-8")
    assert CliRunner().invoke(app, words).exit_code != 0
    assert "Choose another folder" in caplog.text
    assert (tmp_path / "mine" / "axle_17.toml").read_text(encoding="utf-8") == "mine"


def test_a_rexs_file_holds_the_pair_of_he_2007(tmp_path):
    (tmp_path / "pair.rexs").write_text(printed("convert"), encoding="utf-8")
    pair, given = (
        one.helical_pair()
        for one in (
            gl.gears.read_rexs(tmp_path / "pair.rexs").file,
            gl.HelicalGearFile.named("he_2007"),
        )
    )
    assert pair.centre_distance == pytest.approx(given.centre_distance, rel=1e-9)
    assert pair.face_width == pytest.approx(given.face_width, rel=1e-9)


def test_the_kept_rexs_file_is_what_the_package_writes_today(tmp_path):
    def dateless(text):
        return re.sub(r'(date|applicationVersion)="[^"]*"', "", text)

    gl.gears.write_rexs(gl.HelicalGearFile.named("he_2007"), tmp_path / "he.rexs")
    written = (tmp_path / "he.rexs").read_text(encoding="utf-8-sig")
    assert dateless(printed("convert")) == dateless(written)


def test_a_transfer_path_is_the_generic_one_also_between_its_lines(tmp_path):
    (tmp_path / "path.csv").write_text(printed("sound"), encoding="utf-8")
    read = read_csv_path(tmp_path / "path.csv")
    frequency = np.geomspace(25.0, 15000.0, 400)
    generic = generic_path(tuple(read.responses))
    assert len(read.responses) == 6
    for path in read.responses:
        ratio = read.at(path, frequency) / generic.at(path, frequency)
        # twelve points in an octave: 0.1 dB
        assert np.abs(ratio - 1.0).max() < 0.012


@pytest.mark.slow
@pytest.mark.parametrize("command", ["read", "extrude"])
def test_a_profile_has_the_stated_roughness(command, tmp_path):
    (tmp_path / "profile.csv").write_text(printed("roughness", command), encoding="utf-8")
    profile = gl.surface.read_surface(tmp_path / "profile.csv")
    # as stated by the option; micrometres are written with nine digits
    assert profile_statistics(profile).Ra == pytest.approx(0.3e-6, rel=1e-3)
    words = ["roughness", command, str(tmp_path / "profile.csv"), "--out", str(tmp_path / "out")]
    assert CliRunner().invoke(app, words).exit_code == 0


def test_a_traction_table_gives_the_stress_of_which_it_was_made(tmp_path):
    (tmp_path / "table.csv").write_text(printed("oil", "fit"), encoding="utf-8")
    (tmp_path / "oil.toml").write_text(printed("oil"), encoding="utf-8")
    out = tmp_path / "fitted.toml"
    words = ["oil", "fit", "table.csv", "--oil", "oil.toml", "--radius-mm", "10", "--out", str(out)]
    words = [str(tmp_path / one) if one in ("table.csv", "oil.toml") else one for one in words]
    assert CliRunner().invoke(app, words).exit_code == 0
    # five decimals of a traction of 0.05: 1e-4
    assert gl.read_oil(out).lubricant.eyring_stress == pytest.approx(5e6, rel=1e-3)


@pytest.mark.parametrize(
    ("words", "kind", "name"),
    [
        (("whine",), gl.HypoidGearFile, "mohammadpour_2015"),
        (("ehl", "helical"), gl.HelicalGearFile, "jamali_2015_a"),
        (("ehl", "helical", "jamali_2015_b"), gl.HelicalGearFile, "jamali_2015_b"),
    ],
)
def test_a_gear_file_is_read(words, kind, name, tmp_path):
    (tmp_path / "gear.toml").write_text(printed(*words), encoding="utf-8")
    assert kind.from_toml(tmp_path / "gear.toml").name == name


@pytest.mark.slow
def test_files_are_printed_as_shipped_and_without_loading_what_computes():
    words = (["sweep"], ["map"], ["axle", "show"], ["bearing"], ["oil"], ["contact"], ["design"])
    whine = (["whine"], ["whine", "he_2007"])
    kept = (["convert"], ["oil", "fit"])
    films = (["ehl", kind] for kind in ("line", "point", "hypoid", "rough", "helical"))
    script = (
        "import json, sys\n"
        "from typer.testing import CliRunner\n"
        "from gearlube.command import app\n"
        "asked = json.loads(sys.argv[1])\n"
        "texts = [CliRunner().invoke(app, [*one, '--example']).stdout for one in asked]\n"
        "print(json.dumps([texts, sorted({'numba', 'scipy', 'xarray'} & set(sys.modules))]))\n"
    )
    asked = json.dumps([*words, *films, *whine, *kept])
    done = subprocess.run(
        [sys.executable, "-c", script, asked], capture_output=True, text=True, check=True
    )
    texts, loaded = json.loads(done.stdout)
    axle = AxleFile.shipped_text("mohammadpour_2015")
    assert texts == [
        axle,
        axle,
        axle,
        BearingFile.shipped_text("wingertszahn_2023"),
        OilFile.shipped_text("iso_vg_220_pao"),
        gl.HypoidGearFile.shipped_text("mohammadpour_2015"),
        BlankFile.shipped_text("hypoid_13_42"),
        LineCase.shipped_text("jamali_2015"),
        PointCase.shipped_text("mourier_2006"),
        HypoidCase.shipped_text("mohammadpour_2015"),
        RoughCase.shipped_text("jamali_2015_a"),
        gl.HelicalGearFile.shipped_text("jamali_2015_a"),
        gl.HypoidGearFile.shipped_text("mohammadpour_2015"),
        gl.HelicalGearFile.shipped_text("he_2007"),
        kept_example("he_2007.rexs"),
        kept_example("traction.csv"),
    ]
    assert loaded == []
