"""What `import gearlube` gives, and the page that shows it."""

from __future__ import annotations

import ast
import inspect
import re
from pathlib import Path

import pytest

import gearlube
from docs import api
from tests.helpers.each import each

ROOT = Path(__file__).parents[2]
SCRIPTS = (
    "axle_torque_ramp",
    "film_with_own_oil",
    "helical_transmission_error",
    "rough_own_profile",
    "sliding_point_contact",
    "speed_sweep",
)


# what a page or a docstring shows although no public name has it
INSIDE = {
    "from gearlube.studies.contact.settings import QUICK",
    "from gearlube_core.drag import seal_torque",
    "from gearlube_core.dynamics.helical_pair.march import gear_file_march",
    "from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh",
    "from gearlube_core.dynamics.train.element import RATE, RZ, W",
    "from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings",
    "from gearlube_core.mesh_table.line_mesh_file import named_line_mesh",
    "from gearlube_core.oil.film_oil_data import jamali_2015_oil",
}

NAMES = [(group.module, name) for group in api.groups() for name in group.names]


@each("name", NAMES)
def test_every_public_name_has_words_and_an_example(name):
    assert inspect.getdoc(api.public(*name))
    assert api.example(*name)


def test_about_25_names_stand_at_the_top():
    assert len([name for module, name in NAMES if module == "gl"]) <= 28


def test_the_page_is_up_to_date():
    """If not: python -m docs.api."""
    assert api.page() == api.PAGE.read_text(encoding="utf-8")


def test_every_name_is_in_one_group():
    modules = {module for module, _ in NAMES} - {"gl"}
    own = {name for module, name in NAMES if module == "gl"}
    assert set(gearlube.__all__) == own | {one.removeprefix("gl.") for one in modules}
    for module in modules:
        names = [name for of, name in NAMES if of == module]
        assert sorted(names) == sorted(api.public("gl", module[3:]).__all__)
    assert len(set(NAMES)) == len(NAMES)


def test_an_unknown_name_says_where_the_names_are():
    with pytest.raises(AttributeError, match=r"docs/api\.md"):
        gearlube.no_such_name  # noqa: B018


@each("script", SCRIPTS)
def test_library_scripts_are_short_and_use_public_names_alone(script):
    text = (ROOT / "examples" / f"{script}.py").read_text(encoding="utf-8")
    tree = ast.parse(text)
    own = [
        node.module if isinstance(node, ast.ImportFrom) else node.names[0].name
        for node in ast.walk(tree)
        if isinstance(node, (ast.Import, ast.ImportFrom))
    ]
    packages = ("gearlube_core", "fmu_src", "drivetrain", "gearlube.")
    assert not [name for name in own if name.startswith(packages)]
    statements = [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]
    words = [node for node in statements if isinstance(node, ast.Expr) and _is_text(node)]
    assert len(statements) - len(words) <= 20


def test_pages_and_examples_import_gearlube_alone():
    """Those of a developer's pages may differ: what they show is inside."""
    inner = re.compile(r"^\W*(?:from|import) (gearlube_core|drivetrain|fmu_src|gearlube\.\w+\.)")
    pages = [ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*.py")]
    found = {
        line.strip(" >.")
        for page in pages
        if page.name != "architecture.md"
        for line in page.read_text(encoding="utf-8").splitlines()
        if inner.match(line)
    }
    assert found <= INSIDE


def _is_text(node: ast.Expr) -> bool:
    return isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
