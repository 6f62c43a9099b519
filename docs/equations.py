"""Rewrite docs/equations.md from docs/equations.csv and the code: python -m docs.equations."""

from __future__ import annotations

from pathlib import Path

from docs.source_tags import Equation, Tag, equations, package_tags

FOLDER = Path(__file__).parent
PAPERS = {
    "he_2007": "He, Gunda and Singh 2007: helical gears with sliding friction",
    "karagiannis_2012": "Karagiannis, Theodossiades and Rahnejat 2012: lubricated hypoid gears",
    "mohammadpour_2015": "Mohammadpour et al. 2015: hypoid gears on tapered roller bearings",
    "jamali_2015": "Jamali 2015: thesis on films of helical gears",
}

HEAD = """# Where the papers' equations are

Written by `python -m docs.equations` from `docs/equations.csv` and the tags in the code; not edited
by hand. Every numbered equation of the four papers stands here.

The code names the source of an equation by a tag, one equation a tag, so a search finds it:

```
grep -rn "he_2007 (10b)" gearlube_core drivetrain
```

The keys are those of [bibliography.bib](bibliography.bib).

- **printed**: as in the paper.
- **corrected**: a misprint is put right; the note says which.
- **other form**: the same content, written differently.
- **not implemented**: the note says what stands in its place.
"""

TAIL = """
Chapter 7 of the thesis numbers only the angle of the grinding marks. Its films of rough surfaces
with different lays are on the page [rough_line_contact.md](rough_line_contact.md).
"""


def places(equation: Equation, tags: list[Tag]) -> list[str]:
    """Return where an equation is tagged, functions and classes before constants of modules."""
    here = [tag for tag in tags if (tag.key, tag.place) == (equation.paper, f"({equation.number})")]
    named = {_path(tag): bool(tag.scope) for tag in here}
    inside = [place for place, scoped in named.items() if scoped]
    return inside or list(named)


def _path(tag: Tag) -> str:
    module = tag.file.removesuffix(".py").removeprefix("gearlube_core/").replace("/", ".")
    return f"{module}:{tag.scope}" if tag.scope else module


def page() -> str:
    """Return the text of docs/equations.md."""
    tags, rows = package_tags(), equations()
    text = [HEAD]
    for paper, title in PAPERS.items():
        text.append(f"\n## {title}\n\nTags: `[{paper} (number)]`.\n")
        text.append("| Equation | What | Form | Where | Note |\n|---|---|---|---|---|")
        for row in rows:
            if row.paper == paper:
                where = ", ".join(f"`{place}`" for place in places(row, tags)) or "-"
                text.append(
                    f"| ({row.number}) | {row.what} | {row.form} | {where} | {row.note or '-'} |"
                )
    return "\n".join(text) + "\n" + TAIL


if __name__ == "__main__":
    (FOLDER / "equations.md").write_text(page(), encoding="utf-8")
