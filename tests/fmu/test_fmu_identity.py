"""The GUID of an FMU covers the code and data that it computes with, and nothing else."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import fmu_src
from fmu_src import identity
from fmu_src.hypoid_axle import DEFINITION
from tests.helpers.fmu_cases import Case

ROOT = Path(str(fmu_src.__file__)).parents[1]
_PACKAGES = ("fmu_src", "gearlube_core", "drivetrain", "gearlube")

_RUN = """
import sys
opened = set()
sys.addaudithook(lambda event, args: opened.add(str(args[0])) if event == "open" else None)
from {slave} import {name} as Slave
from fmu_src.slave_base import compile_ahead
from pathlib import Path
assert compile_ahead(Slave.definition_of(Path())) == ""
for module in list(sys.modules.values()):
    if module.__name__.partition(".")[0] in {packages}:
        print(module.__file__)
for path in opened:
    if path.endswith((".nc", ".toml")):
        print(path)
"""


@pytest.mark.slow
def test_the_guid_covers_every_file_that_an_fmu_loads(case: Case) -> None:
    slave = f"fmu_src.{case.definition.slave}"
    code = _RUN.format(slave=slave, name=case.name, packages=_PACKAGES)
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=dict(os.environ, PYTHONPATH=str(ROOT)),
        capture_output=True,
        text=True,
        check=True,
    )
    loaded = {Path(line).relative_to(ROOT).as_posix() for line in done.stdout.split()}
    covered = set(identity.contents(case.definition))
    missed = loaded - covered
    # packages are imported around their modules; what they define is not used
    assert {name for name in missed if not name.endswith("__init__.py")} == set()
    assert {f"fmu_src/{case.definition.slave}.py", "gearlube_core/oil/lubricants.toml"} <= covered
    assert len([name for name in loaded if not name.endswith(".py")]) >= 2


def test_an_fmu_does_not_depend_on_commands_films_by_grid_or_builders(case: Case) -> None:
    others = ("gearlube/", "gearlube_core/ehl/", "gearlube_core/hypoid_contact/", "fmu_src/build")
    assert not [name for name in identity.contents(case.definition) if name.startswith(others)]


# file, text, text instead of it, whether the GUID changes
_EDITS = [
    ("gearlube_core/film/point_film.py", '"""', '"""Better words. ', False),
    ("gearlube_core/film/point_film.py", "\n\n\n", "\r\n\r\n# a comment\r\n\r\n\r\n", False),
    ("gearlube_core/ehl/__init__.py", '"""', 'NEW = 1.0\n"""', False),
    ("gearlube_core/film/point_film.py", " = 4.31", " = 4.32", True),
    ("gearlube_core/bearings/losses/catalogue.py", " = 160e-7", " = 161e-7", True),
    ("gearlube_core/oil/lubricants.toml", "density = [870.0", "density = [871.0", True),
]

_EDIT = """
import sys
from pathlib import Path
from fmu_src import identity
from fmu_src.hypoid_axle import DEFINITION
print(identity.source_digest(DEFINITION).hex())
for name, old, new, changes in {edits}:
    path = Path(identity.__file__).parents[1] / name
    text = path.read_text(encoding="utf-8")
    assert old in text, (name, old)
    path.write_text(text.replace(old, new, 1), encoding="utf-8", newline="")
    identity.source_digest.cache_clear()
    print(identity.source_digest(DEFINITION).hex())
"""


@pytest.mark.slow
def test_the_guid_follows_code_and_data_but_no_words(tmp_path: Path) -> None:
    for package in ("fmu_src", "drivetrain", "gearlube_core"):
        ignore = shutil.ignore_patterns("__pycache__", "*.png")
        shutil.copytree(ROOT / package, tmp_path / package, ignore=ignore)
    done = subprocess.run(
        [sys.executable, "-c", _EDIT.format(edits=_EDITS)],
        env=dict(os.environ, PYTHONPATH=str(tmp_path)),
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    digests = done.stdout.split()
    assert digests[0] == identity.source_digest(DEFINITION).hex()
    changes = [one != other for one, other in pairwise(digests)]
    assert changes == [edit[-1] for edit in _EDITS]
