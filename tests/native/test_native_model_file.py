"""The file from which a native FMU reads its model: where it is looked for, what is refused."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

import pytest

from drivetrain.train.train_file import TrainFile
from fmu_src.native.build import library_kind, native_guid
from fmu_src.native.model_file import HEAD_SIZE, MARK, MODEL_FILE, model_file, with_checksum
from tests.helpers.damaged_models import try_damaged
from tests.helpers.native_library import ERROR, OK, NativeInstance, NativeLibrary
from tests.helpers.small_native_builds import MODEL, linux_library, loaded, unpacked
from tests.helpers.watching_library import COMPILER, NO_COMPILER

ROOT = Path(__file__).parents[2]
SOUND = model_file(MODEL, library_kind(MODEL), native_guid(MODEL))


@pytest.fixture(params=[2, 3], ids=["FMI 2", "FMI 3"])
def apart(request: pytest.FixtureRequest, tmp_path: Path) -> NativeLibrary:
    """A library with no resources beside it."""
    path = tmp_path / "RotatingMass.so"
    shutil.copy(linux_library(), path)
    return loaded(request.param, path)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    path = tmp_path / "a folder, 100 % größer" / "resources"
    path.mkdir(parents=True)
    (path / MODEL_FILE).write_bytes(SOUND)
    return path


FORMS: dict[str, Callable[[str], str]] = {
    "file:///": lambda path: f"file://{quote(path)}",
    "file:/": lambda path: f"file:{quote(path)}",
    "file://localhost/": lambda path: f"file://localhost{quote(path)}",
    "capitals": lambda path: f"FILE://{quote(path)}",
    "small hexadecimal digits": lambda path: f"file://{quote(path)}".replace("%C3", "%c3"),
    "a slash behind": lambda path: f"file://{quote(path)}/",
    "a space as it is": lambda path: f"file://{quote(path, safe='/ ')}",
    "a path": lambda path: path,
    "a path, a slash behind": lambda path: f"{path}/",
}


@pytest.mark.parametrize("form", FORMS)
def test_the_folder_of_a_host_is_read(apart: NativeLibrary, folder: Path, form: str) -> None:
    instance = NativeInstance(apart, resources=FORMS[form](str(folder)).encode())
    assert instance.start() == OK
    assert instance.step() == OK
    instance.close()


def _refusal(library: NativeLibrary, folder: Path, content: bytes | None, **options: str) -> str:
    """Return why there is no instance with this file, or none."""
    (folder / MODEL_FILE).unlink()
    if content is not None:
        (folder / MODEL_FILE).write_bytes(content)
    instance = NativeInstance(library, resources=folder.as_uri().encode(), **options)
    assert instance.address is None
    ((status, category, text),) = instance.log
    assert (status, category) == (ERROR, "logStatusError")
    return text


def test_a_missing_file_is_named(apart: NativeLibrary, folder: Path) -> None:
    text = _refusal(apart, folder, None)
    assert text.startswith("The FMU cannot read its model, the file model.bin")
    assert folder.as_uri() in text.replace("%%", "%")  # FMI 2 sends texts of printf


@pytest.mark.parametrize("uri", [None, b"", b"file:", b"%", 9000 * b"x", b"file:///%00"])
def test_no_folder_is_no_instance(apart: NativeLibrary, uri: bytes | None) -> None:
    instance = NativeInstance(apart, resources=uri)
    assert instance.address is None
    assert "cannot read its model" in instance.log[0][2]


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "cannot read its model"),
        (SOUND[:20], "is none of gearlube"),
        (b"gearmod0" + SOUND[8:], "is none of gearlube"),
        (SOUND[:-1], "is damaged: length or checksum"),
        (SOUND + b"\0", "is damaged: length or checksum"),
        (SOUND[:HEAD_SIZE] + bytes(8) + SOUND[HEAD_SIZE + 8 :], "is damaged: length or checksum"),
        (model_file(MODEL, "another kind", native_guid(MODEL)), "belongs to another library"),
        (model_file(MODEL, library_kind(MODEL), "another"), "must be another, that of the model"),
    ],
    ids=["empty", "cut", "mark", "shorter", "longer", "changed", "kind", "GUID"],
)
def test_a_file_that_does_not_fit_is_refused_with_the_reason(
    apart: NativeLibrary, folder: Path, content: bytes, why: str
) -> None:
    assert content[:8] != MARK or len(content) != len(SOUND) or content != SOUND
    assert why in _refusal(apart, folder, content)


def test_numbers_that_contradict_each_other_are_refused_behind_a_checksum_that_fits(
    apart: NativeLibrary, folder: Path
) -> None:
    start_of_torque = HEAD_SIZE + 8 * len(MODEL.data)
    content = with_checksum(SOUND[:start_of_torque] + b"\xff" * 8 + SOUND[start_of_torque + 8 :])
    assert "numbers in its file contradict each other" in _refusal(apart, folder, content)


def test_the_given_folder_goes_before_the_one_beside_the_library(tmp_path: Path) -> None:
    path = unpacked(MODEL, tmp_path, linux_library().read_bytes())
    given = tmp_path / "given"
    given.mkdir()
    (given / MODEL_FILE).write_bytes(SOUND[:-1])
    library = loaded(2, path)
    refused = NativeInstance(library, resources=given.as_uri().encode())
    assert refused.address is None
    assert "is damaged" in refused.log[0][2]
    taken = NativeInstance(library, resources=(tmp_path / "none").as_uri().encode())
    assert taken.start() == OK
    taken.close()


def test_a_state_is_refused_by_a_model_with_other_numbers(tmp_path: Path) -> None:
    """One library serves models of one kind, so it may hold states of several."""
    other = model_file(MODEL, library_kind(MODEL), "00000000-0000-0000-0000-000000000000")
    (tmp_path / MODEL_FILE).write_bytes(other)
    library = loaded(2)
    one = NativeInstance(library)
    two = NativeInstance(
        library, guid="00000000-0000-0000-0000-000000000000", resources=str(tmp_path).encode()
    )
    assert one.start() == two.start() == OK
    state = one.save()
    assert two.restore(state) == ERROR
    assert f"must come from the FMU with GUID {'0' * 8}" in two.log[-1][2]
    assert one.restore(state) == OK
    one.close()
    two.close()


def test_hundreds_of_damaged_files_break_nothing(
    apart: NativeLibrary, folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    found = try_damaged(apart, folder, 600, seed=1)
    capfd.readouterr()
    answers = {answer for _, answer in found}
    assert "refused" in answers
    assert found["swap, checksum fits", "refused"] > 0
    assert found["counts, checksum fits", "refused"] > 0
    assert sum(found.values()) == 600


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason=NO_COMPILER)
def test_ten_thousand_damaged_files_break_nothing_that_watches_itself() -> None:
    command = [sys.executable, "-m", "tests.helpers.damaged_models", "--count=10000"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-5000:]
    # the model of these tests, axle, pair and all shipped trains
    assert done.stdout.count("exit status 0") == 3 + len(TrainFile.shipped())
