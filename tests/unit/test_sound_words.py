"""Two runs side by side, in a listener's words, and the files of the study."""

from __future__ import annotations

import csv
import re

import numpy as np
import pytest
import xarray as xr
from scipy.io import wavfile
from typer.testing import CliRunner

from gearlube.command import app
from gearlube.report.stored import read_report
from gearlube.studies.sound.dataset import level_range, level_values, weighted_order
from gearlube.studies.sound.run import run_sound
from gearlube.studies.sound.settings import SoundSettings
from gearlube.studies.sound.words import difference_sentences
from gearlube_core.errors import ParameterError
from tests.helpers.made_run import made_run
from tests.helpers.units import without_units

RAMP = {"start": 100.0, "end": 300.0, "duration": 3.0}  # 36 to 108 km/h
QUIET = SoundSettings(metrics=())


def pair(first, second, names=("A", "B"), settings=QUIET, ramp=RAMP):
    runs = [made_run(one, **ramp, name=n) for one, n in zip((first, second), names, strict=True)]
    return run_sound(runs[0], settings, against=runs[1])


def test_half_the_force_of_an_order_is_6_db_at_all_speeds():
    found = pair({13.0: 400.0, 26.0: 300.0}, {13.0: 200.0, 26.0: 300.0}).findings
    text = next(one for one in found if "mesh order 1" in one)
    # the first and last turns of the pinion are needed to tell orders apart
    assert re.fullmatch(r"At mesh order 1 B is 6 dB quieter between 3[6-8] and 10[78] km/h.", text)
    assert not any("mesh order 2" in one for one in found)


def test_the_louder_of_two_orders_is_told_first():
    found = pair({13.0: 100.0, 26.0: 400.0}, {13.0: 200.0, 26.0: 100.0}).findings
    told = [one for one in found if one.startswith("At mesh order")]
    assert [re.findall(r"mesh order \d|\d+ dB \w+", one) for one in told] == [
        ["mesh order 2", "12 dB quieter"],
        ["mesh order 1", "6 dB louder"],
    ]


@pytest.mark.parametrize(
    ("loudness", "said"),
    [
        (4.2, "B is about as loud: 4 and 4.2 sone (N5)."),  # 5 %
        (8.0, "With B the loudness rises from 4 to 8 sone (N5). The difference is largest at "
         "955 rpm: 4 and 8 sone."),
    ],
)  # fmt: skip
def test_loudness_is_compared_and_only_one_car_leaves_the_speed_of_the_pinion(loudness, said):
    def one(name, sone):
        speed = np.linspace(100.0, 200.0, 3)
        return xr.Dataset(
            {
                "pinion_speed": ("time", speed),
                "vehicle_speed": ("time", 0.1 * speed),
                "loudness": ("time", np.full(3, sone)),
                "loudness_single": sone,
                "order_level": (("order", "time"), np.full((1, 3), 30.0)),
            },
            coords={"order": [13.0], "time": [0.0, 1.0, 2.0]},
            attrs={"name": name, "pinion_teeth": 13, "level_a_mean_db": 50.0},
        )

    found = difference_sentences(one("A", 4.0), one("B", loudness).drop_vars("vehicle_speed"))
    assert found[0] == said


def test_runs_that_are_alike_are_said_to_be():
    found = pair({13.0: 400.0}, {13.0: 410.0}).findings  # 0.2 dB
    assert "A and B sound alike" in found[0]


def test_pinions_of_other_teeth_are_compared_by_mesh_order():
    run = made_run({13.0: 400.0}, **RAMP, name="A")
    other = made_run({11.0: 200.0}, **RAMP, name="B")
    other.attrs["pinion_teeth"] = 11
    found = run_sound(run, QUIET, against=other).findings
    assert any(one.startswith("At mesh order 1 B is ") and "quieter" in one for one in found)


def test_runs_without_a_common_speed_are_refused():
    slow = made_run({13.0: 400.0}, start=100.0, end=120.0)
    with pytest.raises(ParameterError, match="must share speeds"):
        run_sound(slow, QUIET, against=made_run({13.0: 400.0}, start=200.0, end=240.0))


def test_a_steady_recording_is_heard_over_time():
    found = run_sound(made_run({13.0: 400.0}, duration=1.0), QUIET)
    assert "at 0." in found.findings[0]
    # 1e-4 Pa/N on the plateau, 400 N: 0.04 Pa of peak is 63.0 dB
    level = found.dataset["level"].sel(time=slice(0.6, 0.9))
    assert level.values == pytest.approx(63.0, abs=0.1)


def test_orders_are_drawn_as_the_ear_weighs_them():
    """A-weighting of IEC 61672-1, table 3: -19.1 dB at 100 Hz, -3.2 at 500 Hz, none at 1 kHz."""
    frequency = np.array([100.0, 500.0, 1000.0])
    run = xr.Dataset(
        {
            "order_level": (("order", "time"), np.full((1, 3), 60.0)),
            "pinion_speed": ("time", 2.0 * np.pi * frequency / 13.0),
            "level_a": ("time", np.full(3, 61.0)),
        },
        coords={"order": [13.0], "time": [0.0, 1.0, 2.0]},
    )
    # the table has a tenth of a dB
    np.testing.assert_allclose(weighted_order(run, 0), [40.9, 56.8, 60.0], atol=0.05)
    assert level_values(run, 2) is None
    low, high = level_range([run])
    assert low < 40.9
    assert high > 61.0


@pytest.mark.slow
def test_the_command_writes_every_file_and_says_what_is_generic(tmp_path, caplog):
    for name, size in (("möll", 400.0), ("müll", 200.0)):
        (tmp_path / name).mkdir()
        made_run({13.0: size}, start=150.0, end=250.0).to_netcdf(tmp_path / name / "runup.nc")
    out = tmp_path / "out"
    arguments = [tmp_path / "möll", tmp_path / "müll", "--metrics", "none", "--out", out]
    caplog.set_level("INFO", logger="gearlube")
    result = CliRunner().invoke(app, ["sound", *map(str, arguments)])
    assert result.exit_code == 0, caplog.text
    assert "At mesh order 1 müll is 6 dB quieter" in caplog.text
    assert "generic, not measured" in caplog.text
    wavs = sorted(out.glob("*.wav"))
    assert [file.name for file in wavs] == [
        "möll_full_scale_0.05_Pa.wav",
        "müll_full_scale_0.05_Pa.wav",
    ]
    signals = [wavfile.read(file)[1][12000:36000].astype(float) for file in wavs]
    ratio = np.sqrt(np.mean(signals[0] ** 2) / np.mean(signals[1] ** 2))
    assert 20.0 * np.log10(ratio) == pytest.approx(6.02, abs=0.01)  # 16 bits and half the force
    with xr.open_dataset(out / "sound_b.nc") as stored:
        assert not without_units(stored)
        assert stored.attrs["wav_full_scale_pa"] == 0.05
        assert stored["order_level"].attrs["units"] == "dB"
    with (out / "summary.csv").open(encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    assert {row["run"] for row in rows} == {"möll", "müll"}
    assert {"vehicle_speed_kmh", "level_a_dba", "mesh_order_1_db"} <= set(rows[0])
    page = (out / "report.html").read_text()
    assert page.count("<audio controls") == 2
    assert read_report(out)["study"] == "sound"
    assert {file.stem for file in (out / "figures").iterdir()} == {
        "spectrogram",
        "levels",
        "transfer_path",
    }


def test_an_unknown_metric_and_a_wrong_band_are_refused(tmp_path, caplog):
    made_run({13.0: 1.0}).to_netcdf(tmp_path / "run.nc")
    for option, word in (("--metrics", "loudness"), ("--band", "50:4000")):
        arguments = ["sound", str(tmp_path / "run.nc"), option, "x", "--out", str(tmp_path / "out")]
        assert CliRunner().invoke(app, arguments).exit_code == 2
        assert word in caplog.text
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_the_quieter_run_is_less_loud_and_its_whine_is_heard_less():
    settings = SoundSettings(metrics=("loudness",), orders=(13.0, 26.0))
    ramp = {"start": 200.0, "end": 260.0, "duration": 1.5}
    found = pair({13.0: 400.0}, {13.0: 100.0}, settings=settings, ramp=ramp)
    first, second = (run.dataset for run in found.runs)
    # 12 dB less: 10 dB halve the loudness, so less than half but more than a third
    ratio = float(second["loudness_single"] / first["loudness_single"])
    assert 0.33 < ratio < 0.5
    assert found.findings[0].startswith("With B the loudness falls from")
    assert any("A: One hears mesh order 1 most all the way" in one for one in found.findings)
