"""Compiled code on disk: when it is loaded, linked and compiled again, by which sources."""

from __future__ import annotations

import ast
import gc
import os
import random
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from numba.core.caching import NullCache
from numba.core.compiler import Flags
from numba.core.registry import CPUDispatcher

import gearlube_core
from gearlube_core.kernels.compiled_cache import _CheckedFiles
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.source_code import code_of
from gearlube_core.kernels.source_files import source_files, source_stamp
from tests.helpers.each import each

ROOT = Path(str(gearlube_core.__file__)).parents[1]
SOURCES = {
    "package/__init__.py": "",
    "package/constants.py": "GAIN = 2.0\n",
    "package/law.py": """
from typing import NamedTuple
from package.constants import GAIN
class Law(NamedTuple):
    slope: float
    def value(self, x):
        return GAIN * self.slope * x
""",
    "package/solver.py": """
from numba import types
from numba.extending import overload_method
from gearlube_core.kernels.jit import kernel
OFFSET = 0.0
@overload_method(types.BaseNamedTuple, "value", strict=False)
def _value(law, x):
    return law.instance_class.value
@kernel
def solve(law, x):
    return law.value(x)
""",
    "package/caller.py": """
from gearlube_core.kernels.jit import kernel
def made(inside):
    @kernel
    def between(x):
        return inside(x)
    @kernel
    def outer(x):
        return between(x)
    return outer
""",
    "package/inner.py": """
from gearlube_core.kernels.jit import kernel
from package import constants
@kernel
def inner(x):
    return constants.GAIN * x
""",
    "run.py": """
from package.caller import made
from package.inner import inner
from package.law import Law
from package.solver import solve
outer = made(inner)
print(outer(1.0), solve(Law(10.0), 1.0))
for one in (outer, solve):
    print(sum(one.stats.cache_hits.values()), sum(one.stats.cache_misses.values()))
""",
}


def _package(folder: Path) -> None:
    for name, text in SOURCES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)


def _run(folder: Path) -> tuple[list[float], list[list[int]]]:
    """Return both results, then hits and misses of either kernel."""
    paths = os.pathsep.join((str(folder), str(ROOT)))
    done = subprocess.run(
        [sys.executable, "-B", str(folder / "run.py")],
        env=dict(os.environ, PYTHONPATH=paths),
        capture_output=True,
        text=True,
        check=True,
    )
    values, *counts = done.stdout.splitlines()
    return [float(v) for v in values.split()], [[int(c) for c in line.split()] for line in counts]


@pytest.mark.slow
def test_a_constant_in_another_file_reaches_compiled_callers(tmp_path: Path) -> None:
    _package(tmp_path)
    assert _run(tmp_path) == ([2.0, 20.0], [[0, 1], [0, 1]])
    assert _run(tmp_path) == ([2.0, 20.0], [[1, 0], [1, 0]])
    # the solver does not import the law, which imports the constant
    (tmp_path / "package/constants.py").write_text("GAIN = 3.0\n")
    assert _run(tmp_path) == ([3.0, 30.0], [[0, 1], [0, 1]])
    # kernels that do not come from a file keep their code
    law = tmp_path / "package/law.py"
    law.write_text(law.read_text().replace("GAIN * ", "-GAIN * "))
    assert _run(tmp_path) == ([3.0, -30.0], [[1, 0], [0, 1]])


def test_damaged_code_counts_as_absent_and_is_written_again(tmp_path: Path) -> None:
    """numba alone unpickles it, and the process ends with "Aborted." or a wrong number."""
    code = {"code": bytes(range(256))}
    files = _CheckedFiles(str(tmp_path), "law.outer", "stamp")
    files.save("float", code)
    assert files.load("float") == code
    assert files.load("int") is None
    drawn = random.Random(1)
    for path in sorted(tmp_path.iterdir()):
        good = path.read_bytes()
        for number in range(200):
            bad = bytearray(good)
            bad[drawn.randrange(len(good))] ^= 1 << drawn.randrange(8)
            path.write_bytes(bad if number % 2 else good[: drawn.randrange(len(good))])
            assert files.load("float") is None
        files.save("float", code)
        assert files.load("float") == code
    # the index of one process, the code of another one
    shutil.copy(tmp_path / "law.outer.1.nbc", tmp_path / "law.outer.2.nbc")
    files._save_index({"float": "law.outer.1.nbc", "int": "law.outer.2.nbc"})
    assert files.load("int") is None


def test_kernels_run_without_any_folder_and_say_so_once(tmp_path: Path) -> None:
    _package(tmp_path)
    (tmp_path / "file").touch()
    # places of a cache that cannot be made, whoever runs this
    locators = "from numba.core.caching import UserProvidedCacheLocator as one, CacheImpl\n"
    script = f"{locators}CacheImpl._locator_classes = [one]\nimport logging\n"
    command = f"{script}logging.basicConfig(format='%(message)s')\nimport run"
    done = subprocess.run(
        [sys.executable, "-B", "-c", command],
        env=dict(
            os.environ,
            PYTHONPATH=os.pathsep.join((str(tmp_path), str(ROOT))),
            NUMBA_CACHE_DIR=str(tmp_path / "file" / "cache"),
        ),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[0] == "2.0 20.0"
    assert done.stderr.count("Compiled kernels are not kept") == 1


def _write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text)


def _names(path: Path) -> set[str]:
    return {Path(file).name for file in source_files(str(path))}


def test_sources_are_found_through_all_kinds_of_import(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    inner = tmp_path / "around/inner"
    inner.mkdir(parents=True)
    _write(
        inner.parent,
        __init__="",
        a="from . import b, missing\nfrom .inner import (\n  c,  # (one)\n d)",
        b="import math, numpy as np\n",
        e="import around.inner.c",
        f="def f():\n    import around.b",
    )
    _write(inner, __init__="", c="from ..f import f as g", d="from .. import e")
    monkeypatch.syspath_prepend(str(tmp_path))
    # `missing` may be defined in around/__init__.py, all other names are modules
    modules = {"a.py", "b.py", "c.py", "d.py", "e.py", "f.py"}
    assert _names(inner.parent / "a.py") == modules | {"__init__.py"}
    assert _names(inner.parent / "b.py") == {"b.py"}
    assert _names(inner.parent / "e.py") == {"e.py", "c.py", "f.py", "b.py"}


def test_imports_for_type_checkers_are_no_sources(tmp_path: Path) -> None:
    (tmp_path / "user.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from gearlube_core import units\n"
        "\n    import numpy\nfrom gearlube_core import errors\n"
    )
    assert _names(tmp_path / "user.py") == {"user.py", "errors.py"}


def test_a_film_kernel_has_the_sources_of_its_oil() -> None:
    """A kernel of the package, by files that name each other: film, friction, then the oil."""
    friction = ROOT / "gearlube_core/friction/mixed_friction.py"
    names = {Path(file).relative_to(ROOT).as_posix() for file in source_files(str(friction))}
    assert "gearlube_core/oil/roelands_1966.py" in names
    assert not any(name.startswith(("gearlube_core/ehl", "gearlube/")) for name in names)


def test_the_stamp_of_a_file_follows_its_contents(tmp_path: Path) -> None:
    file = tmp_path / "one.py"
    file.write_text("A = 1\n")
    before = source_stamp(str(file))
    assert source_stamp(str(file)) == before
    file.write_text("A = 10\n")
    assert source_stamp(str(file)) != before
    file.write_text("A = 1\n")
    assert source_stamp(str(file)) == before


SCRIPT = """
from gearlube_core.kernels.jit import kernel

@kernel
def half(x):
    return 0.5 * x

@kernel
def quarter(x):
    return half(half(x))

print(quarter(8.0), *half._linked.stats.cache_hits.values(), half.overloads == {})
"""


@kernel
def _cube(x: float) -> float:
    return x * x * x


@kernel
def _sum_of_cubes(x: float, y: float) -> float:
    return _cube(x) + _cube(y)


def test_a_kernel_is_called_by_python_and_by_kernels() -> None:
    assert _sum_of_cubes(2.0, 3.0) == 35.0
    assert _cube(2.0) == 8.0
    assert _sum_of_cubes(1.0, 2.0) == 9.0


def test_a_called_kernel_has_no_machine_code() -> None:
    def called(x: float) -> float:
        return x + 1.0

    inner: Any = kernel(called)
    outer: Any = kernel(lambda x: inner(x))
    outer._cache = NullCache()  # else the second run of this test reads the code of the caller
    assert outer(1.0) == 2.0
    assert inner.overloads == {}
    library = next(iter(inner._linked.overloads.values())).library
    assert library.get_pointer_to_function(next(library.get_defined_functions()).name) == 0


def test_options_of_a_compilation_are_equal_by_their_values() -> None:
    plain, given = Flags(), Flags()
    given.release_gil = False  # as where it is not given
    assert plain == given == given.copy()
    assert hash(plain) == hash(given)
    given.release_gil = True
    assert plain != given
    assert plain != "release_gil"


@each("usual", [(700, 10, 10), (0, 10, 10), (500_000, 3, 3)])
def test_garbage_is_looked_for_seldom_during_compilation_alone(usual, monkeypatch):
    before = gc.get_threshold()
    found = []
    monkeypatch.setattr(CPUDispatcher, "compile", lambda *_: found.append(gc.get_threshold()))
    try:
        gc.set_threshold(*usual)
        kernel(lambda x: x).compile("float64(float64)")
        assert gc.get_threshold() == usual
    finally:
        gc.set_threshold(*before)
    assert found[0] == (usual if usual[0] != 700 else (100_000, 10, 10))


@pytest.mark.slow
def test_linked_code_is_read_from_disk_when_its_caller_is_compiled_anew(
    tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)

    def output() -> list[str]:
        command = [sys.executable, str(script)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()

    assert output() == ["2.0", "True"]
    # a run that compiles nothing would hold intermediate code, which no caller is linked with
    for code in (tmp_path / "cache").rglob("*.nbc"):
        assert (b"BC\xc0\xde" in code.read_bytes()) == ("linked" in code.name)
    assert output() == ["2.0", "True"]
    for caller in (tmp_path / "cache").rglob("*quarter*"):
        caller.unlink()
    assert output() == ["2.0", "1", "True"]


WITH_WORDS = '''
"""About the module."""  # and a comment
NAMES = [
    "one",  # kept, it is an element
    "two # not a comment"
]
JOINED = \\
    "kept"


class A:  # a comment
    r"""Text with "quotes" and \\\\ in it.

    More."""

    x = 1
    """What x is."""

    def f(self, text='a"b'):
        """Return f."""
        return f"{text}#" + ("a"
            "b")
'''
WITHOUT = """NAMES = [
    "one",
    "two # not a comment"
]
JOINED = \\
    "kept"
class A:
    x = 1
    def f(self, text='a"b'):
        return f"{text}#" + ("a"
            "b")"""


def test_only_words_are_left_out() -> None:
    assert code_of(WITH_WORDS) == WITHOUT
    assert code_of(WITH_WORDS.replace("\n", "\r\n")) == WITHOUT


def _statements(text: str) -> str:
    """Return the syntax tree without docstrings, by Python's own parser."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        for name, value in ast.iter_fields(node):
            if isinstance(value, list) and name != "values":
                value[:] = [one for one in value if not _is_text(one)] or [ast.Pass()] * (
                    name == "body"
                )
    return ast.dump(tree)


def _is_text(node: object) -> bool:
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return is_text and isinstance(node.value.value, str)  # type: ignore[attr-defined]


def _with_pass(code: str) -> str:
    """Give bodies that were only a docstring a `pass`, so that the text can be parsed."""
    lines = code.split("\n")
    kept = []
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        kept.append(line)
        indent = len(line) - len(line.lstrip())
        opens = line.endswith(":") and line.lstrip().startswith(("class ", "def ", ")"))
        if opens and len(after) - len(after.lstrip()) <= indent:
            kept.append(" " * (indent + 4) + "pass")
    return "\n".join(kept)


@pytest.mark.slow
def test_the_code_of_the_core_is_complete() -> None:
    folder = Path(str(gearlube_core.__file__)).parent
    for path in [*folder.glob("kernels/*.py"), *folder.glob("*/h*.py"), *folder.glob("oil/*.py")]:
        text = path.read_text(encoding="utf-8")
        assert _statements(_with_pass(code_of(text))) == _statements(text), path
