"""Links that leave the project: few, and of a form that can be looked up.

Links inside the documentation are checked by the build of the site.
"""

import re

from docs.source_tags import ROOT

PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff")),
    *(path for name in ("docs", "examples", "benchmarks") for path in (ROOT / name).rglob("*.md")),
]
BIBLIOGRAPHY = (ROOT / "docs" / "bibliography.bib").read_text(encoding="utf-8")


def test_every_doi_is_that_of_a_source():
    """A DOI that is typed again on a page may have a slip; the one in the bibliography decides."""
    known = set(re.findall(r"doi = \{(.*)\}", BIBLIOGRAPHY))
    found = {
        doi.rstrip(".)")
        for path in PAGES
        for doi in re.findall(r"\b10\.\d{4,5}/[^\s\"'>,;|]+", path.read_text(encoding="utf-8"))
    }
    assert found <= known
    assert "10.1177/0954407015598677" in found


def test_external_links_are_secure_and_whole():
    links = {
        link
        for path in PAGES
        for link in re.findall(r"\w+://[^\s)\"'`>|]*", path.read_text(encoding="utf-8"))
    }
    web = {link for link in links if link.startswith("http")}
    assert "https://www.rexs.info" in web
    assert not {link for link in web if not re.fullmatch(r"https://[\w.-]+\.\w+(/\S*)?", link)}
