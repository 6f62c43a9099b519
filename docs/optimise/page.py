"""Write docs/optimise.md from the tables of this folder: python -m docs.optimise.page."""

from __future__ import annotations

import csv
from pathlib import Path

from gearlube_core.storage.atomic_file import write_text

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "optimise.md"
TEXT, IMAGES = HERE / "text", HERE.parent / "images"


def page() -> str:
    """Return docs/optimise.md."""
    parts = [(TEXT / "head.md").read_text(encoding="utf-8")]
    for name in ("helical", "helical_plain", "hypoid"):
        if (HERE / f"{name}.csv").is_file():
            parts.append((TEXT / f"{name}.md").read_text(encoding="utf-8"))
            parts.append(_tables(name))
    parts.append((TEXT / "tail.md").read_text(encoding="utf-8"))
    return "\n".join(parts)


def _tables(name: str) -> str:
    lines = ["| Field | Before | After | Bounds | Unit |", "|---|---|---|---|---|"]
    for row in _rows(f"{name}_values"):
        bounds = f"{row['low']} to {row['high']}"
        before = row["before"] or "-"
        lines.append(f"| `{row['field']}` | {before} | {row['after']} | {bounds} | {row['unit']} |")
    lines += [
        "",
        "| Torque [N.m] | | Unit | Before | After | Change | Best without errors | Limit |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in _rows(name):
        lines.append("| " + " | ".join(one or "-" for one in row.values()) + " |")
    if (HERE / f"{name}_front.csv").is_file() and len(_rows(f"{name}_front")) > 1:
        lines += ["", "Least loss under limits of the mesh orders, both over those before:", ""]
        lines += ["| Mesh orders | Loss |", "|---|---|"]
        lines += [f"| {row['whine']} | {row['loss']} |" for row in _rows(f"{name}_front")]
    lines += [
        "",
        f"![Transmission error](images/optimise_{name}_transmission_error.png)",
        "",
        f"![All orders under each error](images/optimise_{name}_errors.png)",
        "",
    ]
    if (IMAGES / f"optimise_{name}_front.png").is_file():
        lines += [f"![Mesh orders and loss](images/optimise_{name}_front.png)", ""]
    return "\n".join(lines)


def _rows(name: str) -> list[dict[str, str]]:
    with (HERE / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    write_text(page(), PAGE)
