"""Files and options made to harm: a sentence in under a second and little memory, no traceback."""

import io
import json
import os
import shutil
import subprocess
import sys
import zipfile

import netCDF4
import numpy as np
import pytest
from typer.testing import CliRunner

from gearlube.cli.ranges import numbers_from
from gearlube.command import app
from gearlube.studies.sweep.run import run_sweep
from gearlube.studies.sweep.unpack import fmu_guid, unpacked
from gearlube_core.errors import FileError, GearLubeError, ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.input_file import toml_data
from gearlube_core.input_file.table import read_table
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.rexs.exchange import read_rexs
from gearlube_core.storage.atomic_file import open_dataset, read_arrays
from gearlube_core.surface.files import read_surface
from tests.helpers.each import each

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


@each("case", TOML)
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


def write_bomb(path, blocks):
    """Write an archive of one part, as many blocks of 16 MB of zeros."""
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as file,
        file.open("a", "w", force_zip64=True) as part,
    ):
        for _ in range(blocks):
            part.write(bytes(1 << 24))


@pytest.fixture(scope="module")
def bomb(tmp_path_factory):
    write_bomb(path := tmp_path_factory.mktemp("bomb") / "bomb.zip", 36)
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "command"),
    [
        ("a.npz", ["roughness", "read"]),
        ("a.x3p", ["roughness", "read"]),
        ("a.fmu", ["sweep", "--fmu"]),
    ],
)
def test_a_command_refuses_an_archive_that_unpacks_to_gigabytes(
    name, command, bomb, tmp_path, caplog
):
    shutil.copy(bomb, tmp_path / name)
    assert CliRunner().invoke(app, [*command, str(tmp_path / name)]).exit_code == 2
    assert "got 604 MB" in caplog.text or "claims arrays of 604 MB" in caplog.text


@pytest.mark.slow
def test_an_fmu_that_unpacks_to_gigabytes_is_refused(bomb):
    with pytest.raises(ParameterError, match="unpack to at most 500 MB"), unpacked(bomb):
        pass


def zipped(**parts):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return stream.getvalue()


def npy(shape, zeros=0):
    stream, head = io.BytesIO(), {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, head)
    return stream.getvalue() + bytes(zeros)


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


@each("kind", ["toml", "csv", "nc", "json", "rexs", "npz", "x3p"])
def test_a_file_that_is_far_too_large_is_not_read(kind, tmp_path):
    path = tmp_path / f"large.{kind}"
    with path.open("wb") as stream:
        stream.truncate(10**12)  # without a block on the disk
    with pytest.raises(GearLubeError, match=r"must have at most [\d.]+ MB, got 1e\+06 MB"):
        READERS[kind](path)


def test_a_table_of_millions_of_cells_is_refused_with_its_line(tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("x,y\n" + "1,2\n" * 20, newline="\r")
    assert read_table(path, ("x", "y")).lines == list(range(2, 22))
    path.write_text("x\n" + "," * 2_500_000 + "\n")
    with pytest.raises(ParameterError, match="at most 2500000 cells, got more up to line 2"):
        read_table(path, ("x",))


ARRAYS = {  # shape, bytes that follow it
    "zeros": ((80_000_000,), 64_000_000),
    "packed": ((30_000_000,), 240_000_000),
    "claim": ((800_000_000,),),
    "overflow": ((2**40, 2**40),),
    "negative": ((-1,),),
}
NPZ = {
    "no head": zipped(**{"x.npy": b"no array"}),
    "long head": zipped(**{"x.npy": b"\x93NUMPY\x01\x00\xff\xff" + b"(" * 65_535}),
    "no zip": b"PK\x03\x04" + bytes(100),
    "empty": b"",
}


@pytest.mark.slow
@each("case", [*ARRAYS, *NPZ])
def test_npz_files_that_claim_or_break_are_refused(case, tmp_path):
    path = tmp_path / "map.npz"
    path.write_bytes(NPZ[case] if case in NPZ else zipped(**{"x.npy": npy(*ARRAYS[case])}))
    with pytest.raises(FileError, match=r"map\.npz must be an npz file"):
        read_arrays(path)
    with pytest.raises(ParameterError, match=r"map\.npz"):
        read_surface(path)


GUID = b'<fmiModelDescription fmiVersion="2.0" guid="{1}"/>'
FMUS = {
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


@each("case", FMUS)
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


@each("text", ["0:1e308:1e-308", "-1e308:1e308:1", "0:1:1e-300", "0:1e300:1", "nan:1:1"])
def test_ranges_beyond_all_numbers_are_refused(text):
    with pytest.raises(ParameterError, match="--x must"):
        numbers_from("--x", [text], "", -1e308, 1e308, example="0:1:0.1")


def test_ranges_together_give_no_more_values_than_one_may():
    with pytest.raises(ParameterError, match="--x must give at most 10 values, got 12"):
        numbers_from("--x", ["0:5:1", "10:15:1"], "", 0.0, 20.0, example="0:1:0.1", most=10)


def test_a_sweep_of_too_many_points_is_refused_before_work():
    speeds, preloads = np.linspace(20.0, 100.0, 500), np.linspace(2000.0, 6000.0, 201)
    with pytest.raises(ParameterError, match="speeds times preloads must be within 1 to 100000"):
        run_sweep(speeds_kmh=speeds, preloads=preloads)


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
import sys, time
from pathlib import Path
from gearlube.studies.sweep.run import run_sweep
from gearlube.studies.sweep.unpack import unpacked
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
# of this program alone: ru_maxrss has that of the process that started it
peak = next(line for line in open("/proc/self/status") if line.startswith("VmHWM"))
print("memory", peak.split()[1], sep=",")
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


# message and processor time [s]: three times that of an idle machine, which two processes on one
# core take; what loads the studies first takes 6 s so. The last three need SciPy or xarray.
COMMANDS = {
    "map broken.toml": ("is not a readable TOML file", 1.5),
    "contact none.toml": ("was not found", 1.5),
    "roughness read bomb.x3p": ("claims arrays of 2147 MB", 1.5),
    "roughness read bomb.npz": ("claims arrays of 2147 MB", 1.5),
    "sweep --fmu bomb.fmu": ("unpack to at most 500 MB", 1.5),
    "export shape.nc --to csv": ("shape.nc must be a NetCDF file", 6.0),
    "roughness read long.csv": ("long.csv", 5.0),
    "roughness read open.csv": ("a quote opened in line 2 is never closed", 5.0),  # 15 MB
}
PROCESS = """
import resource, subprocess, sys
done = subprocess.run(sys.argv[1:], capture_output=True, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(done.returncode, used.ru_utime + used.ru_stime, used.ru_maxrss)
print(" ".join((done.stdout + done.stderr).split()))
"""


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_says_its_message_in_little_time_and_memory(command, tmp_path):
    (tmp_path / "broken.toml").write_text("a = [1,,")
    (tmp_path / "long.csv").write_text("x_mm,height_um\n1," + "9" * 5_000_000 + "\n")
    (tmp_path / "open.csv").write_text('x_mm,height_um\n1,"' + "9,\n" * 5_000_000)
    with netCDF4.Dataset(tmp_path / "shape.nc", "w") as claim:
        claim.createDimension("x", 2_000_000_000)
        claim.createVariable("v", "f8", ("x",), zlib=True, chunksizes=(1000,))
    for name in ("bomb.x3p", "bomb.npz", "bomb.fmu"):
        write_bomb(tmp_path / name, 128)
    line = [sys.executable, "-c", PROCESS, sys.executable, "-m", "gearlube", *command.split()]
    done = subprocess.run(line, capture_output=True, text=True, check=True, cwd=tmp_path)
    numbers, text = done.stdout.splitlines()
    code, seconds, memory = map(float, numbers.split())
    said, most = COMMANDS[command]
    assert said in text
    assert (code in (1, 2), seconds < most, memory < 500_000) == (True, True, True), numbers  # kB
