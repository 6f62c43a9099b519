"""Parts of docs/film_model_axle.md that scripts write, each between its own marks."""

from __future__ import annotations

from pathlib import Path

from gearlube_core.storage.atomic_file import write_text

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "film_model_axle.md"
IMAGES = ROOT / "docs" / "images"


def put(mark: str, script: str, text: str) -> None:
    """Write a text between the marks of a name, left by a script of this folder."""
    page = PAGE.read_text(encoding="utf-8")
    begin = f"<!-- {mark}: python -m docs.film_model.{script} -->\n"
    end = f"<!-- end of {mark} -->"
    before, rest = page.split(begin)
    write_text(before + begin + "\n" + text + "\n" + end + rest.split(end, 1)[1], PAGE)
