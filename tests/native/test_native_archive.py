"""The library and the archives of a native FMU: what is in them, and what checkers say."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from fmu_src.check import fmpy_problems, fmutool_problems
from fmu_src.identity import write_archive
from fmu_src.native.build import (
    NativeOptions,
    build_native,
    fmi2_content,
    fmi3_content,
    libraries,
    native_guid,
)
from fmu_src.native.driveline import driveline_model
from fmu_src.native.platforms import PLATFORMS, fmi_headers, universal_library
from fmu_src.native.sources import array_variables, c_sources
from tests.helpers.binary_formats import Binary, elf, mach_o, pe
from tests.helpers.small_native_builds import LINUX, MODEL, linux_library
from tests.helpers.small_native_model import small_native_model

SCHEMAS = Path(fmpy.__file__).parent / "schema"
FUNCTIONS = {
    name
    for header, text in fmi_headers().items()
    if header.endswith("Functions.h")
    for name in re.findall(r"Export\s+\w+TYPE\s+(fmi[23]\w+);", text)
}
LIBC = {"__stack_chk_fail", "bcmp", "calloc", "dladdr", "fclose", "fopen", "fprintf", "fread",
        "free", "fseek", "ftell", "malloc", "memcmp", "memcpy", "memset", "snprintf", "stderr",
        "strcmp", "strlen", "strncmp", "vsnprintf"}  # fmt: skip
# what a library of each system must ask for: fixed tables, no jump to a place that is no target
GUARDS = {"x86_64-linux": {"PT_GNU_RELRO", "BIND_NOW", "IBT", "SHSTK"},
          "aarch64-linux": {"PT_GNU_RELRO", "BIND_NOW", "BTI", "PAC"},
          "x86_64-windows": {"HIGH_ENTROPY_VA", "DYNAMIC_BASE", "NX_COMPAT"}}  # fmt: skip
GLIBC = {"libc.so.6", "libdl.so.2", "libm.so.6"}
LIBM = {"ceil", "exp", "floor", "log", "pow", "sin", "cos"}
WINDOWS = re.compile(r"KERNEL32\.dll|api-ms-win-crt-\w+-l1-1-0\.dll")


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("archives")
    built = {LINUX.name: linux_library().read_bytes()}
    paths = {}
    for version, content in (("2", fmi2_content), ("3", fmi3_content)):
        paths[version] = folder / f"fmi{version}" / "RotatingMass.fmu"
        write_archive(paths[version], content(MODEL, built))
    return paths


def test_the_standards_have_these_functions() -> None:
    assert len([name for name in FUNCTIONS if name.startswith("fmi3")]) > 60
    assert {"fmi2DoStep", "fmi2GetFMUstate", "fmi3DoStep", "fmi3SetBinary"} <= FUNCTIONS


def test_nothing_of_fftw_is_in_the_library() -> None:
    """FFTW is GPL, and gearlube's film solvers load it; a native FMU must not."""
    content = linux_library().read_bytes().lower()
    assert b"instantiate" in content  # names are stored as they are read here
    assert b"fftw" not in content


def has_all_functions(binary: Binary) -> bool:
    """Whether all functions of co-simulation are exported, and nothing else."""
    exports = {name.removeprefix("_") for name in binary.exports} - MACH_O_OWN
    model_exchange_2 = {name for name in FUNCTIONS if name.startswith("fmi2")} - exports
    return exports <= FUNCTIONS and model_exchange_2 <= MODEL_EXCHANGE_2 and (
        {name for name in FUNCTIONS if name.startswith("fmi3")} <= exports
    )  # fmt: skip


# put there by the linker, not seen from outside
MACH_O_OWN = {"_mh_dylib_header", "__dso_handle"}
# FMI 2 asks a library for co-simulation for none of these
MODEL_EXCHANGE_2 = {
    f"fmi2{name}"
    for name in ("EnterEventMode", "NewDiscreteStates", "EnterContinuousTimeMode",
                 "CompletedIntegratorStep", "SetTime", "SetContinuousStates", "GetDerivatives",
                 "GetEventIndicators", "GetContinuousStates", "GetNominalsOfContinuousStates")
}  # fmt: skip


def test_the_linux_library_needs_the_c_library_alone_and_shows_fmi_alone() -> None:
    content = linux_library().read_bytes()
    binary = elf(content)
    assert binary.machine == "EM_X86_64"
    assert has_all_functions(binary)
    assert binary.needs <= GLIBC
    assert binary.imports <= LIBC | LIBM
    assert "__stack_chk_fail" in binary.imports  # the stack is checked
    assert binary.guards == GUARDS[LINUX.name]
    versions = [tuple(map(int, one.split("_")[1].split("."))) for one in binary.versions]
    assert max(versions) <= (2, 17)
    assert binary.name == ""
    assert len(content) < 100_000


def is_free_of_traces(content: bytes) -> bool:
    """Whether no path of the machine that built it and no name of Python is inside."""
    traces = (
        rb"/tmp|/home|/root|/work|/usr/(?!lib/(dyld|libSystem))|[Pp]ython|numba|NRT_|\.zig|\.pdb"
    )
    return re.search(traces, content) is None


def test_the_linux_library_holds_no_trace_of_its_builder() -> None:
    assert is_free_of_traces(linux_library().read_bytes())


@pytest.mark.parametrize("version", ["2", "3"])
def test_checkers_find_no_problem(archives: dict[str, Path], version: str) -> None:
    assert fmpy_problems(archives[version]) == []
    if version == "2":
        assert fmutool_problems(archives[version]) == []


@pytest.mark.parametrize(
    ("version", "file", "schema"),
    [
        ("2", "modelDescription.xml", "fmi2/fmi2ModelDescription.xsd"),
        ("3", "modelDescription.xml", "fmi3/fmi3ModelDescription.xsd"),
        ("3", "terminalsAndIcons/terminalsAndIcons.xml", "fmi3/fmi3TerminalsAndIcons.xsd"),
    ],
)
def test_every_description_obeys_its_schema(
    archives: dict[str, Path], version: str, file: str, schema: str
) -> None:
    validator = etree.XMLSchema(etree.parse(str(SCHEMAS / schema)))
    with zipfile.ZipFile(archives[version]) as archive:
        validator.validate(etree.fromstring(archive.read(file)))
    assert list(validator.error_log) == []


@pytest.mark.parametrize("version", ["2", "3"])
def test_a_host_finds_no_sources_to_build_without_the_kernels(
    archives: dict[str, Path], version: str
) -> None:
    """FMPy replaces the library of an archive by what `sources` declares."""
    description = fmpy.read_model_description(str(archives[version]))
    assert not description.buildConfigurations
    with zipfile.ZipFile(archives[version]) as archive:
        names = archive.namelist()
    assert not [name for name in names if name.startswith("sources/")]
    assert {"documentation/sources/instance.c", "documentation/sources/fmi3Functions.h"} <= {*names}


def test_the_archive_has_the_licence_of_every_part(archives: dict[str, Path]) -> None:
    for path in archives.values():
        with zipfile.ZipFile(path) as archive:
            texts = {
                Path(name).name: archive.read(name).decode()
                for name in archive.namelist()
                if name.startswith("documentation/licenses/")
            }
        owners = {"gearlube_MIT.txt": "gearlube", "zig_MIT.txt": "Zig contributors",
                  "numba_BSD-2-Clause.txt": "Anaconda, Inc.",
                  "mingw-w64_ZPL-2.1.txt": "mingw-w64 project"}  # fmt: skip
        assert set(texts) == set(owners)
        assert all(owner in texts[name] for name, owner in owners.items())


@pytest.mark.slow
def test_a_driveline_for_windows_shows_fmi_alone() -> None:
    """casadi marks each function that it writes for export there."""
    windows = PLATFORMS[1]
    binary = pe(libraries(driveline_model(), [windows])[windows.name])
    assert has_all_functions(binary)


def test_fmi_3_has_an_array_for_indexed_outputs(archives: dict[str, Path]) -> None:
    description = fmpy.read_model_description(str(archives["3"]))
    found = {v.name: [d.start for d in v.dimensions] for v in description.modelVariables}
    assert found["disc.power"] == [3]
    assert not any(name.startswith("disc[") for name in found)
    references = {v.name: v.valueReference for v in description.modelVariables}
    assert references["disc.power"] == MODEL.definition.references["disc[1].power"]
    assert references["time"] == len(MODEL.definition.variables)


def test_terminals_name_variables_of_the_fmu(archives: dict[str, Path]) -> None:
    names = {one.variable.name for one in array_variables(MODEL.definition.variables)}
    with zipfile.ZipFile(archives["3"]) as archive:
        root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    members = [one.get("variableName") for one in root.iter("TerminalMemberVariable")]
    assert len(members) == 6
    assert set(members) <= names


def test_fmpy_runs_both_archives_alike(archives: dict[str, Path]) -> None:
    options = {"stop_time": 0.25, "output_interval": 2.0**-8, "output": ["pinion.speed"]}
    runs = [
        fmpy.simulate_fmu(str(archives[version]), **options)["pinion.speed"].tolist()
        for version in ("2", "3")
    ]
    assert runs[0] == runs[1]
    assert len(runs[0]) == 65


@pytest.mark.slow
def test_the_sources_compile_without_a_warning(tmp_path: Path) -> None:
    (tmp_path / "fmi").mkdir()
    headers = {f"fmi/{name}": text for name, text in fmi_headers().items()}
    for name, text in (c_sources(MODEL) | headers).items():
        (tmp_path / name).write_text(text)
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wcast-qual",
              "-Wcast-align", "-Wvla", "-Wundef", "-Wformat-security",
              "-Wmissing-prototypes", "-Wno-unused-parameter"]  # fmt: skip
    files = sorted(path.name for path in tmp_path.glob("*.c"))
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c99", *strict, "-Werror", "-I.",
               "-isystem", "fmi", "-c", *files]  # fmt: skip
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    complaints = [line for line in done.stderr.splitlines() if "unused-command-line" not in line]
    assert (done.returncode, complaints) == (0, [])


def _other(operation, step, data, parameters, inputs, state, work, outputs):  # type: ignore[no-untyped-def]
    return 0


def test_the_guid_covers_the_entry_and_its_data() -> None:
    same, other = small_native_model(), small_native_model(entry=_other)
    changed = small_native_model()
    changed.data[1] = 29.0
    assert native_guid(same) == native_guid(MODEL)
    assert native_guid(other) != native_guid(MODEL)
    assert native_guid(changed) != native_guid(MODEL)


BUILD = """
import sys
from pathlib import Path
from fmu_src.native.build import NativeOptions, build_native
from tests.helpers.small_native_builds import LINUX, MODEL
options = NativeOptions(platforms=[LINUX.name], reference=False)  # it has no Python model
build_native(MODEL, Path(sys.argv[1]), options)
"""


@pytest.mark.slow
def test_two_builds_are_equal_bit_for_bit(tmp_path: Path) -> None:
    """Also by a linker that keeps nothing of earlier builds, in another folder."""
    root = Path(__file__).parents[2]
    for name in ("one", "another/longer name"):
        place = tmp_path / name
        (place / "tmp").mkdir(parents=True)
        environment = os.environ | {
            "TMPDIR": str(place / "tmp"), "ZIG_LOCAL_CACHE_DIR": str(place / "zig"),
            "PYTHONPATH": str(root), "PYTHONHASHSEED": str(len(name)),
        }  # fmt: skip
        command = [sys.executable, "-c", BUILD, str(place)]
        subprocess.run(command, env=environment, cwd=root, check=True)
    for archive in ("RotatingMass.fmu", "RotatingMass_FMI3.fmu"):
        one, other = ((tmp_path / n / archive).read_bytes() for n in ("one", "another/longer name"))
        assert one == other


@pytest.fixture(scope="module")
def all_libraries() -> dict[str, bytes]:
    return libraries(MODEL)


@pytest.mark.slow
def test_the_library_of_every_platform_needs_only_its_system(
    all_libraries: dict[str, bytes],
) -> None:
    assert set(all_libraries) == {platform.name for platform in PLATFORMS}
    for name, content in all_libraries.items():
        assert is_free_of_traces(content), name
        assert len(content) < 200_000
        binary = {"linux": elf, "windows": pe, "darwin": mach_o}[name.split("-")[1]](content)
        assert has_all_functions(binary), name
        assert binary.guards == GUARDS.get(name, set()), name
        if "windows" in name:
            assert binary.machine == "x86_64"
            assert all(map(WINDOWS.fullmatch, binary.needs)), binary.needs
        elif "darwin" in name:
            assert binary.machine == {"x86_64": "x86_64", "aarch64": "arm64"}[name.split("-")[0]]
            assert binary.needs == {"/usr/lib/libSystem.B.dylib"}
            assert binary.system == (11, 0)
            assert binary.name == "RotatingMass.dylib"
            # arm64 runs nothing without a signature
            assert binary.is_signed or binary.machine == "x86_64"
        else:
            assert binary.needs <= GLIBC | {"ld-linux-aarch64.so.1"}
            assert binary.machine == {"x86_64": "EM_X86_64", "aarch64": "EM_AARCH64"}[name[:-6]]


@pytest.mark.slow
def test_the_universal_library_holds_both_slices(all_libraries: dict[str, bytes]) -> None:
    slices = {name: all_libraries[name] for name in ("x86_64-darwin", "aarch64-darwin")}
    content = universal_library(slices)
    number = int.from_bytes
    assert (number(content[:4], "big"), number(content[4:8], "big")) == (0xCAFEBABE, 2)
    found = []
    for i in range(2):
        row = content[8 + 20 * i : 28 + 20 * i]
        kind, _, place, size, align = (number(row[k : k + 4], "big") for k in range(0, 20, 4))
        assert place % 2**align == 0
        inside = content[place : place + size]
        assert inside in slices.values()
        # the row names the processor that the slice itself names
        assert kind == number(inside[4:8], "little")
        found.append(mach_o(inside).machine)
    assert sorted(found) == ["arm64", "x86_64"]


@pytest.mark.slow
def test_the_archives_hold_a_library_for_every_platform(all_libraries: dict[str, bytes]) -> None:
    two = {n for n in fmi2_content(MODEL, all_libraries) if n.startswith("binaries/")}
    three = {n for n in fmi3_content(MODEL, all_libraries) if n.startswith("binaries/")}
    assert two == {f"binaries/{one}" for one in (
        "linux64/RotatingMass.so", "win64/RotatingMass.dll", "darwin64/RotatingMass.dylib",
        "aarch64-linux/RotatingMass.so")}  # fmt: skip
    assert three == {f"binaries/{one.name}/RotatingMass{one.suffix}" for one in PLATFORMS}


def test_a_platform_or_version_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Exception, match="platform"):
        build_native(MODEL, tmp_path, NativeOptions(platforms=["amiga"]))
    assert list(tmp_path.iterdir()) == []
