"""The pages of the input files say what the data models say."""

import re
from pathlib import Path

from docs.field_pages import PAGES, refreshed
from docs.page import DOCS, Page
from gearlube_core.input_file.field_notes import field_notes
from tests.helpers.each import each

FILES = [name for name in PAGES if name.endswith("_file")]


@each("name", PAGES)
def test_page_is_up_to_date(name):
    """If not: python -m docs.field_pages."""
    assert refreshed(name).text == Page(name).text


@each("name", PAGES)
def test_every_field_stands_on_the_page(name):
    text = Page(name).text
    for model in PAGES[name]:
        for dotted, note in field_notes(model).items():
            field = dotted.rpartition(".")[2]
            assert re.search(rf"\| `{field}` \|.*{re.escape(note.meaning)} \|", text), dotted


@each("name", FILES)
def test_what_the_page_points_to_exists(name):
    text = Page(name).text
    links = re.findall(r"\]\(([^)#]+)", text)
    assert links
    for link in links:
        assert (DOCS / link).is_file(), link
    for path in re.findall(r"`((?:examples|tests|gearlube_core|drivetrain)/[\w./]+)`", text):
        assert (Path(DOCS).parent / path).exists(), path
