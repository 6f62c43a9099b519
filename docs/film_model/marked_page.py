"""Parts of docs/film_model_axle.md that scripts write, each between its own marks."""

from __future__ import annotations

from docs.page import Page


def put(mark: str, script: str, text: str) -> None:
    """Write a text between the marks of a name, left by a script of this folder."""
    page = Page("film_model_axle")
    begin = f"<!-- {mark}: python -m docs.film_model.{script} -->\n"
    before, rest = page.text.split(begin)
    after = rest.split(end := f"<!-- end of {mark} -->", 1)[1]
    page.text = before + begin + "\n" + text + "\n" + end + after
    page.write()
