"""The page that counts verdicts agrees with the pages of verdicts."""

from docs import validation_summary
from docs.page import Page


def test_the_page_counts_the_verdicts_as_they_stand():
    # cure: python -m docs.validation_summary
    assert validation_summary.refreshed().text == Page("validation_summary").text


def test_a_row_counts_once_by_its_first_verdict():
    text = """
| 1 | a | **holds** | **does not hold** |
| 2 | b | **holds in part** | **holds** |
| 3 | c | **not held**: why | |
| 4 | d | **order held**: numbers | |
a **holds** outside a table
"""
    assert validation_summary.verdicts(text) == {"yes": 1, "part": 2, "no": 1}
