"""The page of licences names every dependency with its range of versions."""

from docs.licences import requirements
from docs.page import Page


def test_every_dependency_is_in_its_chapter():
    text = Page("licences").text
    for extra, rows in requirements().items():
        chapter = text.partition(f"## Extra `{extra}`:" if extra else "## Always installed")[2]
        assert chapter, f"docs/licences.md has no chapter for the extra {extra}"
        for name, versions in rows:
            here = chapter.partition("\n## ")[0]
            assert f"| {name} | {versions} |" in here, f"{name}: run python -m docs.licences"
