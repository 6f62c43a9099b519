"""What is published agrees with pyproject.toml: recipe and citation."""

import re
from pathlib import Path

import gearlube
from docs.licences import requirements

ROOT = Path(__file__).parents[2]
CONDA_NAMES = {"matplotlib": "matplotlib-base", "netCDF4": "netcdf4"}


def test_the_recipe_has_the_same_packages():
    text = (ROOT / "recipe" / "recipe.yaml").read_text(encoding="utf-8")
    listed = re.findall(r"^    - ([A-Za-z0-9_-]+ [<>=].*)$", text.partition("run:")[2], re.M)
    listed = [one for one in listed if not one.startswith("python ")]
    wanted = [f"{CONDA_NAMES.get(name, name)} {v}" for name, v in requirements()[""]]
    assert sorted(listed) == sorted(wanted)


def test_the_versions_agree():
    stated = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text("utf-8"), re.M)
    assert stated
    number = stated[1]
    assert gearlube.__version__ == number
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text("utf-8")
    assert f'version: "{number}"' in (ROOT / "recipe" / "recipe.yaml").read_text("utf-8")


def test_every_package_to_install_has_a_hash():
    lines = (ROOT / "constraints.txt").read_text("utf-8").split("\n")
    starts = [i for i, line in enumerate(lines) if re.match(r"[a-z0-9]", line)]
    assert len(starts) > 150
    for i in starts:
        assert re.fullmatch(r"    --hash=sha256:[0-9a-f]{64}( \\)?", lines[i + 1]), lines[i]


def test_every_package_that_is_named_has_one_version():
    """An extra that is new needs constraints.txt written again."""
    stated = set(
        re.findall(r"^([a-z0-9-]+)==", (ROOT / "constraints.txt").read_text("utf-8"), re.M)
    )
    names = {name for rows in requirements().values() for name, _ in rows}
    assert {re.sub(r"[-_.]+", "-", name).lower() for name in names} <= stated


def test_every_action_is_pinned_by_its_commit():
    used = [
        line.strip()
        for path in (ROOT / ".github" / "workflows").glob("*.yml")
        for line in path.read_text("utf-8").splitlines()
        if "uses:" in line
    ]
    assert len(used) > 10
    for line in used:
        assert re.search(r"uses: [\w./-]+@[0-9a-f]{40}  # v\d", line), line


def test_what_builds_a_release_cannot_write_to_the_repository():
    text = (ROOT / ".github" / "workflows" / "release.yml").read_text("utf-8")
    jobs = re.split(r"^  (?=\w+:$)", text.split("\njobs:\n")[1], flags=re.M)
    for job in jobs:
        assert not ("contents: write" in job or "id-token: write" in job) or (
            "actions/checkout" not in job and "pip install" not in job
        ), job
