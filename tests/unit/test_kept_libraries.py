"""Libraries of native FMUs are built once for each kind of model, and kept."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from fmu_src.build import axle_definition
from fmu_src.helical_pair import definition_with
from fmu_src.native import build
from fmu_src.native.axle_data import kind_of_classes
from fmu_src.native.build import libraries, library_kind, native_guid, prebuilt_folder
from fmu_src.native.kept import keep_library, kept_file, kept_library
from fmu_src.native.model import NativeModel
from fmu_src.native.models import native_model
from fmu_src.native.parameter_map import KernelClasses
from fmu_src.native.platforms import PLATFORMS, Platform
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.storage.folders import locked_folder
from tests.helpers.small_native_model import small_native_model

ROOT = Path(__file__).parents[2]
PAIR = ROOT / "gearlube_core" / "helical_geometry" / "data" / "jamali_2015_a.toml"
TWO = PLATFORMS[:2]
NAMES = [platform.name for platform in TWO]


class Builds:
    """Stands for compiler and linker: tells what they were asked for."""

    def __init__(self) -> None:
        self.asked: list[str] = []

    def __call__(
        self, model: NativeModel, platforms: Sequence[Platform], report: Any
    ) -> Iterator[tuple[str, bytes]]:
        for platform in platforms:
            self.asked.append(platform.name)
            yield platform.name, f"{model.kind} {platform.name}".encode()


@pytest.fixture
def builds(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Builds:
    """A cache of its own, and nothing that ships."""
    found = Builds()
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(build, "PREBUILT", tmp_path / "prebuilt")
    monkeypatch.setattr(build, "_built", found)
    return found


def of_kind(kind: str, **changes: Any) -> NativeModel:
    return replace(small_native_model(), kind=kind, **changes)


def test_models_of_a_kind_share_their_libraries_whatever_their_numbers_and_words(
    builds: Builds,
) -> None:
    one = of_kind("one")
    other = of_kind(
        "one", make_data=lambda: np.arange(9.0), work_size=99, refusals={1: "another word"}
    )
    said: list[str] = []
    first = libraries(one, TWO)
    assert libraries(other, TWO, said.append) == first
    assert builds.asked == NAMES
    assert said == [f"RotatingMass: libraries of earlier builds for {', '.join(NAMES)}"]
    assert native_guid(one) != native_guid(other)
    assert libraries(of_kind("other"), TWO) != first
    assert builds.asked == 2 * NAMES


def test_only_what_is_missing_is_built(builds: Builds) -> None:
    libraries(of_kind("one"), TWO[:1])
    libraries(of_kind("one"), TWO)
    assert builds.asked == NAMES


def test_a_model_without_a_kind_is_built_each_time_and_says_so(builds: Builds) -> None:
    said: list[str] = []
    for _ in range(2):
        libraries(small_native_model(), TWO[:1], said.append)
    assert builds.asked == 2 * NAMES[:1]
    assert "for this model alone, which is not kept" in said[0]
    changed = replace(small_native_model(), make_data=lambda: np.array([40.0, 29.0]))
    assert library_kind(small_native_model()) != library_kind(changed)


@pytest.mark.parametrize("damage", [b"", b"x", None], ids=["empty", "cut", "changed"])
def test_a_damaged_library_is_built_again(
    builds: Builds, tmp_path: Path, damage: bytes | None
) -> None:
    sound = libraries(of_kind("one"), TWO[:1])
    (path,) = (tmp_path / "cache" / "libraries").rglob("*.kept")
    content = path.read_bytes()
    path.write_bytes(content[:-1] + b"\0" if damage is None else damage)
    assert libraries(of_kind("one"), TWO[:1]) == sound
    assert builds.asked == 2 * NAMES[:1]
    assert path.read_bytes() == content


def test_one_builds_and_the_others_wait(builds: Builds, monkeypatch: pytest.MonkeyPatch) -> None:
    """As two processes do: the lock is on a file."""
    building, both, seen = threading.Event(), threading.Event(), []

    def slowly(model: NativeModel, platforms: Any, report: Any) -> Iterator[tuple[str, bytes]]:
        if not platforms:
            return
        building.set()
        assert both.wait(10.0)
        second.join(0.3)
        assert second.is_alive()
        yield from builds(model, platforms, report)

    monkeypatch.setattr(build, "_built", slowly)
    said: list[str] = []
    first, second = (
        threading.Thread(target=lambda: seen.append(libraries(of_kind("one"), TWO, said.append)))
        for _ in range(2)
    )
    first.start()
    assert building.wait(10.0)
    second.start()
    both.set()
    first.join()
    second.join()
    assert builds.asked == NAMES
    assert seen[0] == seen[1]
    assert sum("waiting for another process" in text for text in said) == 1


def test_what_is_kept_is_taken_while_another_builds_for_more_platforms(
    builds: Builds, tmp_path: Path
) -> None:
    one = libraries(of_kind("one"), TWO[:1])
    (path,) = (tmp_path / "cache" / "libraries").rglob("*.kept")
    with locked_folder(path.parent):
        assert libraries(of_kind("one"), TWO[:1]) == one
    assert builds.asked == NAMES[:1]


def test_libraries_that_nobody_takes_are_removed_after_three_months(
    builds: Builds, tmp_path: Path
) -> None:
    for kind in ("old", "taken", "young"):
        libraries(of_kind(kind), TWO[:1])
    folders = {one.parent for one in (tmp_path / "cache" / "libraries").rglob("*.kept")}
    assert len(folders) == 3
    month = 30 * 86400.0
    for kind, age in (("old", 3.1), ("taken", 3.1), ("young", 2.9)):
        (path,) = {one for one in folders if one.name == build._key(of_kind(kind))}
        for one in (path, *path.iterdir()):
            os.utime(one, 2 * (time.time() - age * month,))
    libraries(of_kind("taken"), TWO[:1])
    libraries(of_kind("new"), TWO[:1])
    left = {one.name for one in (tmp_path / "cache" / "libraries").iterdir()}
    assert left == {build._key(of_kind(kind)) for kind in ("taken", "young", "new")}


def test_a_cache_that_cannot_be_written_keeps_nothing(
    builds: Builds, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("GEARLUBE_CACHE", str(tmp_path / "file"))
    first, second = (libraries(of_kind("one"), TWO) for _ in range(2))
    assert builds.asked == 2 * NAMES
    assert list(first) == list(second) == NAMES


def test_a_library_that_ships_needs_no_build(builds: Builds, tmp_path: Path) -> None:
    model = of_kind("one")
    assert prebuilt_folder(model).parent == tmp_path / "prebuilt"
    for platform in TWO:
        keep_library(prebuilt_folder(model), platform.name, b"shipped")
    assert libraries(model, TWO) == dict.fromkeys(NAMES, b"shipped")
    assert builds.asked == []
    assert not (tmp_path / "cache").exists()
    kept_file(prebuilt_folder(model), NAMES[0]).write_bytes(b"damaged")
    assert libraries(model, TWO)[NAMES[1]] == b"shipped"
    assert builds.asked == NAMES[:1]


def test_a_kept_library_is_read_as_it_was(tmp_path: Path) -> None:
    assert kept_library(tmp_path / "none", "any") is None
    keep_library(tmp_path / "new", "any", b"\0library")
    assert kept_library(tmp_path / "new", "any") == b"\0library"


@pytest.mark.slow
def test_axles_of_other_numbers_and_oils_have_one_library() -> None:
    shipped = native_model(axle_definition(None, None))
    own = native_model(axle_definition(None, ROOT / "examples" / "my_axle.toml"))
    assert library_kind(own) == library_kind(shipped)
    assert native_guid(own) != native_guid(shipped)


def test_pairs_of_other_gears_have_one_library() -> None:
    shipped = native_model(definition_with(None, None))
    own = native_model(definition_with(PAIR, None))
    assert library_kind(own) == library_kind(shipped)
    assert native_guid(own) != native_guid(shipped)


class OwnLaw(NamedTuple):
    """Stands for a law of friction of a user's own."""

    mu: float


def test_a_class_of_ones_own_has_no_kind_that_others_could_share() -> None:
    shipped = KernelClasses(TaperedRollerParameters, MixedFlankFriction)
    own: Any = KernelClasses(TaperedRollerParameters, OwnLaw)  # type: ignore[arg-type]
    assert kind_of_classes(shipped, ()) != ""
    assert kind_of_classes(own, ()) == ""
