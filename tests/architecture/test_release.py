"""What is published agrees with pyproject.toml: recipe and citation."""

import re
from pathlib import Path

import gearlube
from docs.licences import requirements

ROOT = Path(__file__).parents[2]
CONDA_NAMES = {"matplotlib": "matplotlib-base", "netCDF4": "netcdf4"}


def test_the_recipe_has_the_same_packages():
    text = (ROOT / "recipe" / "recipe.yaml").read_text(encoding="utf-8")
    for name, versions in requirements()[""]:
        assert f"    - {CONDA_NAMES.get(name, name)} {versions}\n" in text


def test_the_versions_agree():
    stated = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text("utf-8"), re.M)
    assert stated
    number = stated[1]
    assert gearlube.__version__ == number
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text("utf-8")
    assert f'version: "{number}"' in (ROOT / "recipe" / "recipe.yaml").read_text("utf-8")
