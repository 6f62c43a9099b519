"""Files and options made to harm: a sentence in under a second and little memory, no traceback."""

import io
import json
import os
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube.cli.ranges import numbers_from
from gearlube.command import app
from gearlube.studies.sweep.fmu_axle import fmu_guid, unpacked
from gearlube.studies.sweep.run import run_sweep
from gearlube_core.errors import FileError, GearLubeError, ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.input_file import toml_data
from gearlube_core.input_file.table import read_table
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.rexs.exchange import read_rexs
from gearlube_core.storage.atomic_file import open_dataset, read_arrays
from gearlube_core.surface.files import read_surface

TOML = {
    "key": (b".".join([b"a"] * 50_000) + b" = 1\n", "a key has more than 20 parts"),
    "quoted key": (b".".join([rb'"\""'] * 50_000) + b" = 1\n", "a key has more than 20 parts"),
    "section": (b"[" + b" . ".join([b"'a'"] * 50_000) + b"]\n", "a key has more than 20 parts"),
    "digits": (b"a = " + b"9" * 5000 + b"\n", "a whole number has too many digits"),
    "digits that Python takes": (b"a = " + b"9" * 400 + b"\n", "at most 18 digits, got one of 400"),
    "lists": (b"a = " + b"[" * 100_000 + b"\n", "its lists or tables are too deep"),
    "tables": (b"a = " + b"{a = " * 50_000 + b"\n", "its lists or tables are too deep"),
    "text": (b'name = "' + b"x" * 20_000 + b'"\n', "name must be a text of at most 10000"),
    "control": (b'source = "a\\u0001b"\n', "source must be a text without control characters"),
    "entries": (b"a = [" + b"1," * 100_000 + b"]\n", "at most 50000 entries"),
}


@pytest.mark.parametrize("case", TOML)
def test_toml_beyond_the_limits_is_refused_in_a_sentence(case):
    content, said = TOML[case]
    with pytest.raises(ParameterError, match=said) as refused:
        toml_data(content, "x.toml")
    assert len(str(refused.value)) < 400


def test_keys_and_texts_that_only_look_deep_are_read():
    text = 'a = "' + "b.c " * 400 + '"\n[m.n]\no.p = [' + "1.5, " * 500 + "]\n"
    data = toml_data(b"\xef\xbb\xbf" + text.encode(), "x.toml")  # as editors of Windows write it
    assert data["m"]["n"]["o"]["p"] == [1.5] * 500


def test_many_wrong_fields_are_counted_and_the_first_are_named(tmp_path):
    path = tmp_path / "gear.toml"
    path.write_text("".join(f"field_{k} = {k}\n" for k in range(20_000)))
    with pytest.raises(ParameterError, match=r"has 200\d\d wrong field") as refused:
        HypoidGearFile.from_toml(path)
    assert len(str(refused.value)) < 20 * 1000


def zipped(**parts):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return stream.getvalue()


def npy(shape, content=b""):
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        stream, {"descr": "<f8", "fortran_order": False, "shape": shape}
    )
    return stream.getvalue() + content


READERS = {
    "toml": HypoidGearFile.from_toml,
    "csv": lambda path: read_table(path, ["x"]),
    "nc": read_mesh_table,
    "json": FilmModel.read,
    "rexs": read_rexs,
    "npz": read_surface,
    "x3p": read_surface,
    "dataset": open_dataset,
    "arrays": read_arrays,
}


@pytest.mark.parametrize("kind", READERS)
def test_devices_folders_and_nul_in_paths_end_in_a_sentence(kind, tmp_path):
    link = tmp_path / f"endless.{kind}"
    link.symlink_to("/dev/zero")
    with pytest.raises(GearLubeError, match="ordinary file, got a device or a pipe"):
        READERS[kind](link)
    link.unlink()
    os.mkfifo(link)
    with pytest.raises(GearLubeError, match="ordinary file, got a device or a pipe"):
        READERS[kind](link)
    with pytest.raises(GearLubeError, match="without control characters"):
        READERS[kind](tmp_path / f"a\0b.{kind}")
    link.unlink()
    link.mkdir()
    with pytest.raises(GearLubeError, match="it is a folder"):
        READERS[kind](link)


@pytest.mark.parametrize("kind", ["toml", "csv", "nc", "json", "rexs", "npz", "x3p"])
def test_a_file_that_is_far_too_large_is_not_read(kind, tmp_path):
    path = tmp_path / f"large.{kind}"
    with path.open("wb") as stream:
        stream.truncate(10**12)  # without a block on the disk
    with pytest.raises(GearLubeError, match=r"must have at most [\d.]+ MB, got 1e\+06 MB"):
        READERS[kind](path)


NPZ = {
    "zeros": zipped(**{"x.npy": npy((80_000_000,), bytes(640_000_000 // 10))}),
    "packed": zipped(**{"x.npy": npy((30_000_000,), bytes(240_000_000))}),
    "claim": zipped(**{"x.npy": npy((800_000_000,))}),
    "overflow": zipped(**{"x.npy": npy((2**40, 2**40))}),
    "negative": zipped(**{"x.npy": npy((-1,))}),
    "no head": zipped(**{"x.npy": b"no array"}),
    "long head": zipped(**{"x.npy": b"\x93NUMPY\x01\x00\xff\xff" + b"(" * 65_535}),
    "no zip": b"PK\x03\x04" + bytes(100),
    "empty": b"",
}


@pytest.mark.parametrize("case", NPZ)
def test_npz_files_that_claim_or_break_are_refused(case, tmp_path):
    path = tmp_path / "map.npz"
    path.write_bytes(NPZ[case])
    with pytest.raises(FileError, match=r"map\.npz must be an npz file"):
        read_arrays(path)
    with pytest.raises(ParameterError, match=r"map\.npz"):
        read_surface(path)


GUID = b'<fmiModelDescription fmiVersion="2.0" guid="{1}"/>'
FMUS = {
    "bomb": (zipped(**{"a.bin": bytes(600_000_000)}), "unpack to at most 500 MB"),
    "no zip": (b"no archive", "is no FMU"),
    "no description": (zipped(a=b"b"), "modelDescription.xml is missing"),
    "no xml": (zipped(**{"modelDescription.xml": b"<a"}), "is no unzipped FMU"),
    "empty xml": (zipped(**{"modelDescription.xml": b""}), "is no unzipped FMU"),
    "other xml": (zipped(**{"modelDescription.xml": b"<a/>"}), "must hold an FMU of FMI 2"),
    "no guid": (
        zipped(**{"modelDescription.xml": GUID.replace(b"guid", b"id")}),
        "must hold an FMU of FMI 2 with a GUID",
    ),
    "wrong sum": (
        zipped(**{"modelDescription.xml": GUID * 20}).replace(b"\x01", b"\x02"),
        "is no FMU|is no unzipped FMU",
    ),
}


@pytest.mark.parametrize("case", FMUS)
def test_broken_fmus_are_refused_in_words(case, tmp_path):
    path = tmp_path / "axle.fmu"
    content, said = FMUS[case]
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=said), unpacked(path) as folder:
        fmu_guid(folder)


HEAD = '<fmiModelDescription fmiVersion="2.0" modelName="a" guid="{1}">'
NO_AXLES = {
    "no model": (HEAD + "</fmiModelDescription>", "no valid model description"),
    "other version": (HEAD.replace("2.0", "9.0") + "</fmiModelDescription>", "no valid model"),
    "no variables": (
        HEAD + '<CoSimulation modelIdentifier="a"/><ModelVariables/><ModelStructure/>'
        "</fmiModelDescription>",
        "no valid model description",
    ),
    "other variables": (
        HEAD + '<CoSimulation modelIdentifier="a"/><ModelVariables><ScalarVariable name="x" '
        'valueReference="0" causality="local"><Real/></ScalarVariable></ModelVariables>'
        "<ModelStructure/></fmiModelDescription>",
        "must have the variables of a gearlube hypoid axle",
    ),
}


@pytest.mark.parametrize("case", NO_AXLES)
def test_an_fmu_that_is_no_axle_is_refused_before_anything_is_computed(case, tmp_path):
    content, said = NO_AXLES[case]
    (tmp_path / "modelDescription.xml").write_text(content)
    with pytest.raises(ParameterError, match=said):
        run_sweep(speeds_kmh=[50.0], preloads=[4500.0], fmu=tmp_path)


@pytest.mark.parametrize(
    "text", ["0:1e308:1e-308", "-1e308:1e308:1", "0:1:1e-300", "0:1e300:1", "nan:1:1"]
)
def test_ranges_beyond_all_numbers_are_refused(text):
    with pytest.raises(ParameterError, match="--x must"):
        numbers_from("--x", [text], "", -1e308, 1e308, example="0:1:0.1")


def page(data):
    return f'<script type="application/json" id="report-data">{data}</script>'


WHOLE = {
    "format": 1,
    "study": "map",
    "title": "a",
    "subtitle": "b",
    "made": "now",
    "findings": [["ok", "fine", ""]],
    "numbers": [["loss", 1.0, "W", 3]],
    "inputs": [["a", "1", "", "", ""]],
    "charts": {},
}
TAMPERED = {
    "no json": "{",
    "deep": "[" * 100_000,
    "list": "[]",
    "format": json.dumps(WHOLE | {"format": 9}),
    "numbers": json.dumps(WHOLE | {"numbers": [["loss"]]}),
    "text": json.dumps(WHOLE | {"numbers": [["loss", "much", "W", 3]]}),
    "digits": json.dumps(WHOLE | {"numbers": [["loss", 1.0, "W", "three"]]}),
    "inputs": json.dumps(WHOLE | {"inputs": 3}),
    "findings": json.dumps(WHOLE | {"findings": [3]}),
    "charts": json.dumps(WHOLE | {"charts": {"a": {"data": 3}}}),
    "trace": json.dumps(
        WHOLE
        | {"charts": {"a": {"title": "", "caption": "", "data": [{"x": {}, "q": 1}], "layout": 3}}}
    ),
    "lacking": json.dumps({"format": 1, "study": "map"}),
}


@pytest.mark.parametrize("case", TAMPERED)
def test_tampered_reports_are_refused_in_words(case, tmp_path, caplog, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, data in (("a", TAMPERED[case]), ("b", TAMPERED[case])):
        (tmp_path / name).mkdir()
        (tmp_path / name / "report.html").write_text(page(data))
    done = CliRunner().invoke(app, ["compare", "a", "b"])
    assert done.exit_code == 2, done.exception
    assert "Run its study again" in caplog.text or "run the command of its study" in caplog.text
    assert {path.name for path in tmp_path.iterdir()} == {"a", "b"}


@pytest.mark.parametrize("command", [["make", "--points", "30000", "--rows", "30000"]])
def test_options_whose_product_is_too_large_are_refused(command, tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)
    sizes = ["--width-mm", "1", "--rq-um", "0.3", "--correlation-um", "20"]
    assert CliRunner().invoke(app, ["roughness", *command, *sizes]).exit_code == 2
    assert "--points times --rows must be within 0 to 1.67772e+07, got 9e+08" in caplog.text
    assert not list(tmp_path.iterdir())


MEASURED = """
import resource, sys, time
from pathlib import Path
from gearlube.studies.sweep.run import run_sweep
from gearlube.studies.sweep.fmu_axle import unpacked
from gearlube_core.errors import GearLubeError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.surface.files import read_surface
readers = {
    ".toml": HypoidGearFile.from_toml,
    ".npz": read_surface,
    ".fmu": lambda path: unpacked(path).__enter__(),
}
for path in sorted(Path(sys.argv[1]).iterdir()):
    start = time.perf_counter()
    try:
        readers[path.suffix](path)
    except GearLubeError:
        print(path.name, time.perf_counter() - start, sep=",")
print("memory", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, sep=",")
"""


@pytest.mark.slow
def test_each_message_comes_within_a_second_and_in_little_memory(tmp_path):
    cases = {f"{name}.toml": one[0] for name, one in TOML.items()}
    cases |= {f"{name}.npz": content for name, content in NPZ.items()}
    cases |= {f"{name}.fmu": content for name, (content, _) in FMUS.items() if name == "bomb"}
    cases["name.toml"] = b'name = "' + b"x" * 10_000_000 + b'"\n'
    for name, content in cases.items():
        (tmp_path / name).write_bytes(content)
    command = [sys.executable, "-c", MEASURED, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    *rows, memory = (line.rpartition(",") for line in done.stdout.splitlines())
    assert {row[0] for row in rows} == set(cases)
    for name, _, seconds in rows:
        assert float(seconds) < 1.0, name
    assert float(memory[2]) < 500_000  # kB, with Python and its libraries
