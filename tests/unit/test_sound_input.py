"""What a sound is made of: runs and transfer paths that are not fit are refused with a cure."""

from __future__ import annotations

import numpy as np
import pytest
import pyuff

from gearlube.studies.sound.force_record import read_forces
from gearlube.studies.sound.pressure import sound_pressure
from gearlube.studies.sound.run import read_transfer, run_sound
from gearlube.studies.sound.settings import SoundSettings
from gearlube.studies.sound.wav import wav_names, write_wav
from gearlube_core.errors import FileError, ParameterError
from tests.helpers.each import each
from tests.helpers.made_run import made_run

QUIET = SoundSettings(metrics=())
F = np.arange(20.0, 7501.0, 20.0)
PATHS = ("pinion.axial", "pinion.radial 1", "gear.axial", "gear.radial 1")


def changed(**how):
    """Return a made run with one thing wrong."""
    run = made_run({13.0: 20.0})
    time = run["time"].values.copy()
    if "drop" in how:
        run = run.drop_vars(how["drop"])
    if "unit" in how:
        run[how["unit"]].attrs.pop("units")
    if how.get("gap"):
        time[9000:] += 0.01
        run = run.assign_coords(time=("time", time, {"units": "s"}))
    if how.get("missing"):
        run["bearing_force"].values[123, 0, 0] = np.nan
    if how.get("slow"):
        run = made_run({13.0: 20.0}, rate=1000.0)
    if how.get("short"):
        run = made_run({13.0: 20.0}, duration=0.2)
    if how.get("stopped"):
        run["pinion_speed"].values[:] = 0.0
    if how.get("constant"):
        run = made_run({})
    return run


@each(
    ("how", "words"),
    [
        ({"drop": "bearing_force"}, ["must hold bearing_force", "pinion_speed", "gearlube runup"]),
        ({"drop": "pinion_speed"}, ["must hold pinion_speed"]),
        ({"unit": "bearing_force"}, ["must have a unit", "'N'", "got none"]),
        ({"unit": "time"}, ["must have a unit", "'s'"]),
        ({"gap": True}, ["a gap of", "at 0.549", "constant"]),
        ({"missing": True}, ["must be finite", "sample 123"]),
        ({"slow": True}, ["at least 2000 Hz", "got 1000 Hz", "higher"]),
        ({"short": True}, ["at least 0.5 s", "got 0.2 s", "longer"]),
        ({"stopped": True}, ["above 0 rad/s", "got 0 rad/s"]),
        ({"constant": True}, ["must change with time", "no sound"]),
    ],
)
def test_a_run_that_is_not_fit_is_refused(how, words):
    with pytest.raises(ParameterError) as refusal:
        run_sound(changed(**how), QUIET)
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


def test_a_folder_without_forces_and_a_file_that_is_none_are_refused(tmp_path):
    made_run({13.0: 1.0}).drop_vars("bearing_force").to_netcdf(tmp_path / "sweep.nc")
    with pytest.raises(ParameterError, match=r"bearing_force.*sweep\.nc"):
        read_forces(tmp_path)
    (tmp_path / "text.nc").write_text("no")
    with pytest.raises(FileError, match="gearlube runup"):
        read_forces(tmp_path / "text.nc")
    with pytest.raises(FileError, match=r"none\.nc was not found in "):
        read_forces(tmp_path / "none.nc")


def test_a_run_is_read_from_its_folder_with_the_speed_of_its_wheels(tmp_path):
    run = made_run({13.0: 1.0}, start=100.0, end=200.0)
    run = run.drop_vars(["vehicle_speed", "pinion_angle"])
    run["wheel_speed"] = ("time", run["pinion_speed"].values / 3.0, {"units": "rad s-1"})
    run.attrs["rolling_radius"] = 0.3
    run.to_netcdf(tmp_path / "runup.nc")
    found = read_forces(tmp_path)
    assert found.vehicle_speed == pytest.approx(0.1 * found.speed)
    assert found.angle[-1] == pytest.approx(150.0, abs=0.02)  # mean speed times a second
    assert found.paths == PATHS


def csv_of(heads, values):
    rows = [",".join(f"{one:.9g}" for one in row) for row in np.column_stack([F, *values])]
    return "\n".join([",".join(["frequency [Hz]", *heads]), *rows])


def full_csv(part="real", unit="Pa/N"):
    heads, values = [], []
    for i, path in enumerate(PATHS):
        response = (1e-3 * (i + 1)) * np.exp(-2j * np.pi * F * 2e-3)
        other = "imag" if part == "real" else "phase"
        heads += [
            f"{path} {part} [{unit}]",
            f"{path} {other} [{unit if part == 'real' else 'deg'}]",
        ]
        if part == "real":
            values += [response.real, response.imag]
        elif unit == "Pa/N":
            values += [np.abs(response), np.degrees(np.angle(response))]
        else:
            values += [20.0 * np.log10(np.abs(response) / 20e-6), np.degrees(np.angle(response))]
    return csv_of(heads, values)


@pytest.mark.parametrize(
    ("part", "unit"), [("real", "Pa/N"), ("magnitude", "Pa/N"), ("magnitude", "dB re 20 uPa/N")]
)
def test_the_same_path_in_any_form_is_the_same(part, unit, tmp_path):
    file = tmp_path / "path.csv"
    file.write_text(full_csv(part, unit))
    found = read_transfer(file, read_forces(made_run({13.0: 1.0})))
    at = np.array([333.0])
    expected = 2e-3 * np.exp(-2j * np.pi * at * 2e-3)
    assert np.abs(found.at("pinion.radial 1", at) - expected)[0] < 1e-8


@each(
    ("change", "words"),
    [
        (("frequency [Hz]", "frequency"), ["must contain its unit", "frequency [Hz]"]),
        (("frequency [Hz]", "frequency [kHz]"), ["must be in Hz", "[kHz]"]),
        (("gear.axial real [Pa/N]", "gear.axial real [Pa]"), ["must be Pa/N", "got [Pa]"]),
        (("gear.axial real", "gear.axial size"), ["real, imag, magnitude or phase"]),
        (("gear.axial real", "gear.other real"), ["gear.other", "must have real and imag"]),
        (("gear.axial ", "hub.axial "), ["missing: gear.axial", "give zeros"]),
        (("\n40,", "\n40,x"), ["line 3", "[Pa/N] must be a finite", "got 'x"]),
        (("\n40,", "\n20,"), ["must rise", "Sort the rows"]),
    ],
)
def test_a_csv_path_that_is_not_fit_is_refused(change, words, tmp_path):
    file = tmp_path / "path.csv"
    text = full_csv()
    assert change[0] in text
    file.write_text(text.replace(*change))
    with pytest.raises(ParameterError) as refusal:
        read_transfer(file, read_forces(made_run({13.0: 1.0})))
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


def uff(file, *, func=4, types=(15, 13), entity=("pinion", "gear"), sign=1):
    sets = []
    for i, bearing in enumerate(entity):
        for way in (1, 2):
            data = (1e-3 * (2 * i + way)) * np.exp(-2j * np.pi * F * 2e-3)
            sets.append(
                pyuff.prepare_58(
                    binary=0, func_type=func, rsp_node=99, rsp_dir=0, ref_node=i + 1,
                    ref_dir=sign * way, ref_ent_name=bearing, data=sign * data, x=F, id1="ear",
                    ordinate_spec_data_type=types[0], orddenom_spec_data_type=types[1],
                    abscissa_spec_data_type=18,
                )
            )  # fmt: skip
    pyuff.UFF(str(file)).write_sets(sets, "overwrite")


@pytest.mark.parametrize(
    "how", [{}, {"entity": ("NONE", "NONE")}, {"sign": -1}], ids=["names", "numbers", "minus"]
)
def test_a_universal_file_holds_the_same_path(how, tmp_path):
    file = tmp_path / "path.uff"
    uff(file, **how)
    found = read_transfer(file, read_forces(made_run({13.0: 1.0})))
    at = np.array([333.0])
    expected = 4e-3 * np.exp(-2j * np.pi * at * 2e-3)
    assert np.abs(found.at("gear.radial 1", at) - expected)[0] < 1e-7  # six digits in the file


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({"func": 1}, ["must hold frequency responses", "got none"]),
        ({"types": (12, 13)}, ["must be pressure over force", "12 over 13"]),
        ({"entity": ("pinion", "pinion")}, ["one response for each force", "pinion.axial"]),
        ({"entity": ("pinion",)}, ["missing: gear.axial, gear.radial 1"]),
    ],
)
def test_a_universal_file_that_is_not_fit_is_refused(how, words, tmp_path):
    file = tmp_path / "path.uff"
    uff(file, **how)
    with pytest.raises(ParameterError) as refusal:
        read_transfer(file, read_forces(made_run({13.0: 1.0})))
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


def test_a_path_that_does_not_cover_the_forces_is_refused_and_a_band_allows_it(tmp_path):
    lines = full_csv().splitlines()
    file = tmp_path / "path.csv"
    file.write_text("\n".join(lines[:16]))  # 20 to 300 Hz; the order lies at 414 Hz
    record = read_forces(made_run({13.0: 20.0}))
    path = read_transfer(file, record)
    with pytest.raises(ParameterError) as refusal:
        sound_pressure(record, path)
    for word in ("must cover the forces", "near 41", "20 to 300 Hz", "--band 20:300"):
        assert word in str(refusal.value), str(refusal.value)
    assert sound_pressure(record, path, (20.0, 300.0)).band == (20.0, 300.0)
    with pytest.raises(ParameterError, match="must lie within 20 to 300 Hz"):
        sound_pressure(record, path, (20.0, 500.0))


def test_a_wav_that_would_clip_is_refused_and_not_written(tmp_path):
    tone = 0.3 * np.sin(2.0 * np.pi * 440.0 * np.arange(48000) / 48000.0)
    with pytest.raises(ParameterError, match=r"0.2 Pa, got 0.3 Pa.*0.5 Pa"):
        write_wav(tone, tmp_path / "tone.wav", full_scale=0.2)
    assert not list(tmp_path.iterdir())
    with pytest.raises(ParameterError, match="the WAV would clip"):
        run_sound(made_run({13.0: 20.0}), SoundSettings(metrics=(), full_scale=1e-4))


def test_orders_above_the_band_are_refused():
    with pytest.raises(ParameterError, match="The order 300 must lie in the band"):
        run_sound(made_run({13.0: 20.0}), SoundSettings(metrics=(), orders=(300.0,)))


def test_without_a_package_of_loudness_all_metrics_are_left_out_and_a_named_one_refused(
    monkeypatch,
):
    monkeypatch.setattr("gearlube.studies.sound.metrics.find_spec", lambda name: None)
    sound = run_sound(made_run({13.0: 2.0}))
    assert len(sound.missing) == 1
    assert "pip install 'gearlube[sound]'" in sound.missing[0]
    assert "level" in sound.runs[0].dataset
    assert "loudness" not in sound.runs[0].dataset
    with pytest.raises(ParameterError, match="neither is installed"):
        run_sound(made_run({13.0: 2.0}), SoundSettings(metrics=("loudness",)))


@each(
    ("runs", "stems"),
    [
        (["müll", "möll"], ["müll", "möll"]),
        (["m l", "m/l"], ["m_l", "m_l_2"]),
        (["Run", "run"], ["Run", "run_2"]),  # one file where the case of letters is lost
        (["u\u0308", "\u00fc"], ["\u00fc", "\u00fc_2"]),  # the same letter, composed and not
        (["漢字", "..."], ["漢字", "run"]),
        (["a" * 300, "a" * 301], ["a" * 100, "a" * 100 + "_2"]),
    ],
)
def test_wav_files_of_two_runs_have_readable_names_of_their_own(runs, stems):
    assert wav_names(runs, 0.5) == [f"{stem}_full_scale_0.5_Pa.wav" for stem in stems]
