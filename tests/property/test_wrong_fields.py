"""Every field of every input file, wrong in every way: an error names it, never a traceback."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from drivetrain.axle_file.axle_file import AxleFile
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.case.rough_case import RoughCase
from gearlube_core.errors import GearLubeError, ParameterError, TableError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.blank_limits import check_blank
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile, read_toml
from gearlube_core.mesh_table.line_mesh_file import line_mesh_from_bytes
from gearlube_core.mesh_table.netcdf import mesh_table_from_bytes, shipped_mesh_table
from gearlube_core.oil.oil_file import OilFile

NAN, INF = math.nan, math.inf
# of the wrong type, of a size that no unit gives, no number, empty, missing
WRONG = ["text", "", True, None, [], {}, [1.0], {"a": 1}, NAN, INF, -INF, 1e300, -1e300, 10**30]
LIKELY = [0, -1, 0.0, -1.0, 1e-30, 1e6, 1e-9]  # may be legal; if not, the error must say so


def built_pair(file: HelicalGearFile) -> None:
    file.helical_pair()
    file.modified_pair()


def built_case(case: Any) -> None:
    case.problem()
    case.settings()


def built_rough_case(case: RoughCase) -> None:
    case.film()
    case.settings()


MESH = shipped_mesh_table("mohammadpour_2015")


def every_axle_field() -> dict[str, Any]:
    """All numbers of the paper's axle as fields of a file, alternatives aside."""
    data: dict[str, Any] = {}
    for note in AxleFile.named("mohammadpour_2015").car_axle(MESH).inputs:
        *sections, key = note.field.split(".")
        if note.origin != "inferred" and note.value != "":
            section = data
            for part in sections:
                section = section.setdefault(part, {})
            section[key] = note.value
    return data


FILES: list[tuple[type[InputFile], str, Callable[[Any], object]]] = [
    (HelicalGearFile, "he_2007", built_pair),
    (HelicalGearFile, "jamali_2015_a", built_pair),
    (HypoidGearFile, "mohammadpour_2015", lambda file: file.blank()),
    (BlankFile, "hypoid_13_42", lambda file: check_blank(DesignedBlank.from_file(file))),
    (LineCase, "jamali_2015", built_case),
    (LineCase, "jamali_2015_thermal", built_case),
    (PointCase, "mourier_2006", built_case),
    (HypoidCase, "mohammadpour_2015", lambda case: (case.settings(), case.oil_temperature)),
    (AxleFile, "mohammadpour_2015", lambda file: file.car_axle(MESH).axle.kernel_parameters()),
    (RoughCase, "jamali_2015_a", built_rough_case),
    (BearingFile, "wingertszahn_2023", lambda file: file.geometry()),
    (OilFile, "iso_vg_220_pao", lambda file: file.described().lubricant.parameters()),
]
IDS = [f"{kind.__name__}-{name}" for kind, name, _ in FILES]


# a point contact prepares its grid in a tenth of a second, hundreds of times
BUILT = [
    pytest.param(*file, marks=[pytest.mark.slow] * (file[0] is PointCase), id=name)
    for file, name in zip(FILES, IDS, strict=True)
]


def fields(data: dict[str, Any], prefix: str = "") -> Iterator[str]:
    for key, value in data.items():
        yield f"{prefix}{key}"
        if isinstance(value, dict):
            yield from fields(value, f"{prefix}{key}.")


def with_field(data: dict[str, Any], name: str, value: Any) -> dict[str, Any]:
    *sections, key = name.split(".")
    section: Any = (changed := dict(data))
    for part in sections:
        inner = section.get(part, {})
        if not isinstance(inner, dict):
            return changed
        section[part] = section = dict(inner)
    if value is None:
        section.pop(key, None)
    else:
        section[key] = value
    return changed


def read_or_refused(kind: type[InputFile], data: dict[str, Any]) -> tuple[Any, str]:
    try:
        return kind.from_data(data, "the file"), ""
    except ParameterError as error:
        return None, str(error)


def refusal_of(act: Callable[[], object], what: str) -> str:
    """Return why something is refused, or nothing; any other error fails the test."""
    try:
        act()
    except GearLubeError as error:
        return str(error)
    except Exception as error:
        raise AssertionError(f"{what} ends in {error!r}") from error
    return ""


def data_of(kind: type[InputFile], name: str) -> dict[str, Any]:
    if kind is AxleFile:  # fields that its file leaves out are absent from a dump
        return every_axle_field()
    return kind.named(name).model_dump(exclude_none=True)


@pytest.mark.parametrize(("kind", "name", "build"), BUILT)
def test_a_wrong_field_is_refused_by_its_name(kind, name, build):
    data = data_of(kind, name)
    names = sorted({*fields(data), *field_notes(kind)})
    assert len(names) > 10
    for field in names:
        for value in WRONG:
            file, refusal = read_or_refused(kind, with_field(data, field, value))
            if refusal:
                # a section that is missing or no table is named by itself or its fields
                assert field.split(".")[-1] in refusal or field.split(".")[0] in refusal
                continue
            numbers = isinstance(value, float) and not math.isfinite(value)
            assert not numbers, f"{field} takes {value}"
            build_refused_or_built(build, file, field, value)


@pytest.mark.parametrize(("kind", "name", "build"), BUILT)
def test_a_number_that_no_gear_has_is_refused_or_built(kind, name, build):
    data = data_of(kind, name)
    for field in field_notes(kind):
        for value in LIKELY:
            file, refusal = read_or_refused(kind, with_field(data, field, value))
            if not refusal:
                build_refused_or_built(build, file, field, value)


def build_refused_or_built(build, file, field, value):
    reason = refusal_of(lambda: build(file), f"{field} = {value!r}")
    assert reason == "" or len(reason) > 20, (field, value)


@pytest.mark.parametrize(("kind", "name", "build"), FILES, ids=IDS)
def test_a_field_that_does_not_exist_is_refused(kind, name, build):
    data = kind.named(name).model_dump(exclude_none=True)
    with pytest.raises(ParameterError, match="zzz is not a field of this file"):
        kind.from_data(with_field(data, "zzz", 1.0), "the file")


@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"a = ", b"[a]\n[a]\n", b"a = 1979-13-99"])
def test_a_file_that_is_no_toml_is_refused(tmp_path, content):
    path = tmp_path / "wrong.toml"
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=r"wrong\.toml is not a readable TOML file"):
        read_toml(path)
    with pytest.raises(ParameterError, match="cannot be read: it is a folder"):
        read_toml(tmp_path)


TABLES = {
    "mesh table": ("mohammadpour_2015.nc", mesh_table_from_bytes),
    "line mesh": ("line_mesh_he_2007.nc", line_mesh_from_bytes),
}


@pytest.mark.parametrize("kind", TABLES)
def test_a_table_that_is_cut_off_is_refused(kind, shipped_table):
    content, read = shipped_table(kind)
    cuts = [*range(0, 200, 7), *(int(share * len(content)) for share in (0.1, 0.5, 0.9, 0.999))]
    for cut in cuts:
        with pytest.raises(TableError, match="the table"):
            read(content[:cut], "the table")


@pytest.mark.parametrize("kind", TABLES)
def test_a_table_with_wrong_bytes_is_refused_or_read(kind, shipped_table):
    content, read = shipped_table(kind)
    for at in range(0, 1400, 61):  # the header
        for byte in (0x00, 0xFF):
            wrong = content[:at] + bytes([byte]) + content[at + 1 :]
            reason = refusal_of(lambda: read(wrong, "the table"), f"byte {at} = {byte}")  # noqa: B023
            assert reason == "" or len(reason) > 20


@pytest.fixture
def shipped_table():
    from importlib.resources import files

    def load(kind):
        name, read = TABLES[kind]
        return (files("gearlube_core.mesh_table") / "data" / name).read_bytes(), read

    return load
