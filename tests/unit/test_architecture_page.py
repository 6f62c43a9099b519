"""docs/architecture.md says what the import contracts say."""

from docs.architecture import make
from docs.page import Page


def test_page_and_picture_are_up_to_date():
    """If not: python -m docs.architecture.make."""
    assert make.refreshed().text == Page("architecture").text
    assert make.picture() == make.PICTURE.read_text(encoding="utf-8")


def test_every_room_says_what_it_holds():
    for name in ("Inside gearlube", "Inside the core"):
        floors, package = make.layers(name)
        for room in (room for floor in floors for room in floor):
            assert len(make.summary(f"{package}.{room}")) > 10, room
