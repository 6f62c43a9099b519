"""Every source that the code names can be looked up, and every equation can be found."""

import re
from collections import Counter

import pytest

from docs import equations as page
from docs.page import Page
from docs.source_tags import PACKAGES, ROOT, bibliography_keys, equations, package_tags, prose

FORMS = {"printed", "corrected", "other form", "not implemented"}
BIBLIOGRAPHY = (ROOT / "docs" / "bibliography.bib").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tags():
    return package_tags()


def test_every_source_that_the_code_names_is_in_the_bibliography(tags):
    keys = set(bibliography_keys())
    assert not {f"{tag.key} in {tag.file}" for tag in tags if tag.key not in keys}


def test_equations_are_cited_in_one_form():
    """Write [he_2007 (4)], one equation a tag; "He et al. 2007 eq. (4)" is found by no search."""
    other = re.compile(r"\b[Ee]qs?\.? \(|\b(?:1[5-9]|20)\d\d\)?,?\s+(?:equations?|formulas?)\s+\(")
    paths = [path for package in PACKAGES for path in (ROOT / package).rglob("*.py")]
    texts = {path: path.read_text(encoding="utf-8") for path in paths}
    assert not [
        f"{path}:{line}"
        for path, text in texts.items()
        if other.search(text)  # code is searched faster than it is read
        for line, words in prose(text)
        if other.search(words)
    ]


def test_every_entry_of_the_bibliography_is_cited(tags):
    assert not set(bibliography_keys()) - {tag.key for tag in tags}


def test_bibliography_entries_are_whole_and_single():
    keys = bibliography_keys()
    assert keys == sorted(set(keys))
    for entry in BIBLIOGRAPHY.split("\n@")[1:]:
        fields = re.findall(r"^  (\w+) = ", entry, re.MULTILINE)
        assert {"author", "title", "year"} <= set(fields), entry.splitlines()[0]
        assert max(Counter(fields).values()) == 1, entry.splitlines()[0]
    for doi in re.findall(r"doi = \{(.*)\}", BIBLIOGRAPHY):
        assert re.fullmatch(r"10\.\d{4,5}/\S+", doi), doi


def test_list_of_equations_is_whole():
    rows = equations()
    assert max(Counter((row.paper, row.number) for row in rows).values()) == 1
    assert {row.paper for row in rows} == set(page.PAPERS)
    for row in rows:
        assert row.form in FORMS, row
        assert row.what, row
        assert row.note or row.form == "printed", row


def test_tags_name_equations_that_exist_and_are_implemented(tags):
    forms = {(row.paper, f"({row.number})"): row.form for row in equations()}
    wrong = [
        tag
        for tag in tags
        if tag.key in page.PAPERS
        and tag.place.startswith("(")
        and forms.get((tag.key, tag.place), "not implemented") == "not implemented"
    ]
    assert not wrong


def test_every_implemented_equation_has_a_tag(tags):
    tagged = {(tag.key, tag.place) for tag in tags}
    missing = [
        f"{row.paper} ({row.number})"
        for row in equations()
        if row.form != "not implemented" and (row.paper, f"({row.number})") not in tagged
    ]
    assert not missing


def test_page_of_equations_is_up_to_date():
    """If not: python -m docs.equations."""
    assert page.refreshed().text == Page("equations").text
