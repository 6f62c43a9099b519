"""What `gearlube native` tells a Python that no native program can load."""

import sys
import sysconfig
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

from gearlube.cli import native
from gearlube.command import app
from gearlube_core.errors import GearLubeError

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="Windows needs no shared libpython of its own: python3.dll"
)


@pytest.fixture
def library(monkeypatch, tmp_path):
    """Put the only shared Python there is at this path of a folder."""

    def put(folder, base="base"):
        version = f"{sys.version_info.major}.{sys.version_info.minor}{sys.abiflags}"
        path = tmp_path / folder / f"libpython{version}.so.1.0"
        path.parent.mkdir(parents=True)
        path.touch()
        monkeypatch.setattr(sys, "base_prefix", str(tmp_path / base))
        monkeypatch.setattr(
            sysconfig,
            "get_config_var",
            {"LIBDIR": str(tmp_path / "stated"), "MULTIARCH": "x86_64-linux-gnu"}.get,
        )
        return path

    return put


@pytest.mark.parametrize("folder", ["base/lib", "stated", "stated/x86_64-linux-gnu"])
def test_the_shared_python_is_found(library, folder):
    path = library(folder)
    assert native.shared_python() == path


def test_without_a_shared_python_the_user_is_told_what_to_install(library):
    library("elsewhere")
    with pytest.raises(GearLubeError, match=r"needs libpython3.*apt install libpython3"):
        native.shared_python()
    told = CliRunner().invoke(app, ["native"])
    assert told.exit_code == 1


def test_a_path_that_the_loader_would_split_is_refused(library):
    library("my base/lib", base="my base")
    with pytest.raises(GearLubeError, match="LD_PRELOAD cannot hold"):
        native.native_environment({})


def test_what_is_set_already_stays_behind(library):
    path = library("base/lib")
    environment = native.native_environment({"LD_PRELOAD": "/other.so", "HOME": "/home"})
    assert environment["LD_PRELOAD"] == f"{path}:/other.so"
    assert environment["PATH"] == str(Path(sys.executable).parent)
    assert environment["HOME"] == "/home"


def test_an_unknown_program_is_a_bad_argument(library):
    library("base/lib")
    assert CliRunner().invoke(app, ["native", "no_such_program"]).exit_code == 2


def test_files_of_the_other_program_are_its_own_business(library, monkeypatch, tmp_path):
    library("base/lib")
    ran = []
    monkeypatch.setattr(native.os, "execve", lambda path, words, environment: ran.append(words))
    monkeypatch.setattr(native.subprocess, "run", lambda words, **_: SimpleNamespace(returncode=0))
    file = tmp_path / "other.toml"
    file.write_text("a = [")  # not TOML
    CliRunner().invoke(app, ["native", "cat", str(file)])
    assert ran == [["cat", str(file)]]
