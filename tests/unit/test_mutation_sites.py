"""The faults that a mutation run puts into code: where, which, and which tests are near."""

from __future__ import annotations

import ast
from pathlib import Path

from benchmarks.mutation.reach import Reach
from benchmarks.mutation.sites import mutants_of

SOURCE = b'''
"""Text of 3 + 4 words."""
from typing import Literal

def force(k: "float = 2 * 3", x: float, mode: Literal[1, 2], \xc3\xa4: list) -> float:
    """Return 2 * 3."""
    check_positive("k", 5.0)
    if k < 0.0:
        raise ValueError(f"{k + 1} is below {2 * x}")
    return k * x ** 3 + \xc3\xa4[i]
'''


def changes(source: bytes, seed: int = 1) -> set[str]:
    return {f"{one.before} -> {one.after}" for one in mutants_of("a.py", source, seed)}


def test_each_place_of_a_formula_is_changed_and_no_text_limit_or_error() -> None:
    seen = set().union(*(changes(SOURCE, seed) for seed in range(20)))
    assert seen >= {
        "k < 0.0 -> k >= 0.0",
        "0.0 -> 1.0",
        "x ** 3 -> x * 3",
        "3 -> 4",
        "k * x ** 3 -> k / x ** 3",
        "k * x ** 3 -> k",
        "k * x ** 3 + ä[i] -> k * x ** 3 - ä[i]",
        "ä[i] -> ä[i - 1]",
    }
    assert not [one for one in seen if "5.0" in one or "1 ->" in one or "2 *" in one]


def test_a_mutant_is_the_code_with_its_change_alone() -> None:
    for mutant in mutants_of("a.py", SOURCE, 1):
        changed = ast.unparse(ast.parse(mutant.applied(SOURCE)))
        assert changed != ast.unparse(ast.parse(SOURCE))
        rest = mutant.applied(SOURCE).replace(f"({mutant.after})".encode(), b"", 1)
        assert len(rest) == len(SOURCE) - (mutant.end - mutant.start)


def test_a_mutant_keeps_its_key_when_other_lines_change() -> None:
    before = {one.key: one.line for one in mutants_of("a.py", SOURCE, 1)}
    after = {one.key: one.line for one in mutants_of("a.py", b"a = b\n" + SOURCE, 1)}
    assert after == {key: line + 1 for key, line in before.items()}


def test_nearest_tests_are_those_that_name_the_function(tmp_path: Path) -> None:
    files = {
        "gearlube/__init__.pyi": "from gearlube_core.a import force as force\n",
        "gearlube_core/a.py": "@kernel\ndef force(): ...\ndef other(): ...\n",
        "gearlube_core/b.py": "from gearlube_core.a import other\n",
        "gearlube_core/c.py": "",
        "gearlube/oil.pyi": "from gearlube_core.d import film as film\n",
        "gearlube_core/d.py": "def film(): ...\n",
        "tests/test_oil.py": "import gearlube as gl\ngl.oil.film()\n",
        "tests/helpers/cases.py": "import gearlube as gl\ngl.force()\n",
        "tests/test_near.py": "from tests.helpers.cases import case\n",
        "tests/test_named.py": "from gearlube_core.a import force\n",
        "tests/test_far.py": "from gearlube_core.b import b\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    reach = Reach(tmp_path)
    found = [test for _, test in reach.tests_of("gearlube_core/a.py", "force")]
    assert found == ["tests/test_named.py", "tests/test_near.py", "tests/test_far.py"]
    assert [test for _, test in reach.tests_of("gearlube_core/d.py", "film")] == [
        "tests/test_oil.py"
    ]
    assert reach.is_compiled("gearlube_core/a.py")
    assert not reach.is_compiled("gearlube_core/c.py")
