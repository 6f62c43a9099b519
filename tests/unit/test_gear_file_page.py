"""The reference page of the gear file says what the data model says."""

import re
from pathlib import Path

from docs.gear_file import page
from gearlube_core.flank_surface.gear_file import HypoidGearFile
from gearlube_core.input_file.field_notes import field_notes

FOLDER = Path(__file__).parents[2] / "docs"
PAGE = (FOLDER / "gear_file.md").read_text(encoding="utf-8")


def test_page_is_up_to_date():
    """If not: python -m docs.gear_file."""
    assert page() == PAGE


def test_every_field_stands_on_the_page():
    for name, note in field_notes(HypoidGearFile).items():
        field = name.rpartition(".")[2]
        assert re.search(rf"\| `{field}` \|.*{re.escape(note.meaning)} \|", PAGE), name


def test_what_the_page_points_to_exists():
    links = re.findall(r"\]\(([^)#]+)", PAGE)
    assert "images/gear_pair.png" in links
    for link in links:
        assert (FOLDER / link).is_file(), link
    for path in re.findall(r"`((?:examples|tests|gearlube_core)/[\w./]+)`", PAGE):
        assert (FOLDER.parent / path).is_file(), path
