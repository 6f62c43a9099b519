"""Numbers are put into a page of the documentation where they belong, or not at all."""

from __future__ import annotations

import pytest

from docs import page as module
from docs.page import Page, Verdict, judge

TEXT = """# Title

The film is 1.25 um thick,
and 12 of 25 contacts hold.

3 statements hold.

| # | What | Printed in | Found | Verdict | Reason |
|---|---|---|---|---|---|
| A1 | one | p. 1 | 0.9 | **holds** | why |
| A2 | two | p. 2 | 0.8 | **does not hold** | since |

| Grid | Film |
| --- | --- |
| 9 | 1.0 |
"""


@pytest.fixture
def page(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "DOCS", tmp_path)
    (tmp_path / "one.md").write_text(TEXT, encoding="utf-8")
    return Page("one")


def test_numbers_of_a_sentence_change_and_nothing_else(page):
    page.fill("film is {} um thick, and {} of {} contacts hold.", "0.75", 3, 4)
    assert page.text == TEXT.replace("1.25 um", "0.75 um").replace("12 of 25", "3 of 4")


def test_statements_are_judged_in_the_order_of_the_page(page):
    claims = {
        "A2": lambda x: Verdict(f"{x:g}", judge(True), "new"),
        "A1": lambda x: Verdict(f"{2 * x:g}", judge(False)),
    }
    page.judged(claims, 0.5, "contacts hold.")
    assert "1 statement does not hold, 1 holds." in page.text
    assert "| A1 | one | p. 1 | 1 | **does not hold** | why |" in page.text
    assert "| A2 | two | p. 2 | 0.5 | **holds** | new |" in page.text


@pytest.mark.parametrize(
    ("put", "said"),
    [
        (lambda page: page.fill("a film of {} mm", 1), "has 0 times"),
        (lambda page: page.rows("Grid | Film", [["9"]]), "2 columns"),
        (lambda page: page.rows("Mesh", []), "has 0 times"),
        (lambda page: page.fill("film is {} um thick, and {} of", 1), "1 values for"),
        (lambda page: page.cells("Grid | Film", [["2"], ["3"]], first=1), "1 rows, got 2"),
        (lambda page: page.claims({"A1": ()}, "contacts hold."), "has statements"),
    ],
)
def test_what_has_no_place_is_refused(page, put, said):
    with pytest.raises(ValueError, match=said):
        put(page)
    assert page.text == TEXT
