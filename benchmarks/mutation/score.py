"""Count the results of a mutation run and list its survivors.

    python -m benchmarks.mutation.score FOLDER

Score: killed / (all - equivalent). A mutant is equivalent if no result changes, or none by more
than the method's own error; each stands in `equivalent.toml` with the reason. By the last run of
each mutant.
"""

from __future__ import annotations

import argparse
import json
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any

_SAMPLE = 500


def last_rows(results: Path) -> dict[str, dict[str, Any]]:
    """Return the last result of each mutant."""
    return {row["key"]: row for row in map(json.loads, results.read_text("utf-8").splitlines())}


def summary(rows: dict[str, dict[str, Any]], reasons: dict[str, str]) -> list[str]:
    """Return the lines that say how many were killed, how, and which survive."""
    killed = [row for row in rows.values() if row["outcome"] == "killed"]
    left = {key: row for key, row in rows.items() if row["outcome"] != "killed"}
    equivalent = left.keys() & reasons.keys()
    counted = len(rows) - len(equivalent)
    seconds = sum(row["seconds"] for row in rows.values())
    by = Counter(row["by"].partition("::")[0] for row in killed)
    uncompiled = sum(not row["compiled"] for row in killed)
    lines = [
        f"{len(rows)} mutants: {len(killed)} killed, {len(equivalent)} equivalent, "
        f"{counted - len(killed)} survive",
        f"score {len(killed) / max(counted, 1):.1%} of {counted}",
        f"{uncompiled} killed without compilation, {len(by)} test files kill",
        f"{seconds:.0f} s of processor time, {seconds / max(len(rows), 1):.1f} s a mutant, "
        f"{_SAMPLE * seconds / max(len(rows), 1) / 3600:.1f} h for {_SAMPLE}",
    ]
    for key, row in sorted(left.items(), key=lambda item: item[1]["file"]):
        change = f"{row['before']} -> {row['after']}"
        place = f"{row['file']}:{row['line']} {row['scope']}"
        lines.append(f"{key}  {place}\n    {change}\n    {reasons.get(key, row['outcome'])}")
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    text = Path(__file__).with_name("equivalent.toml").read_text("utf-8")
    reasons = {key: one["reason"] for key, one in tomllib.loads(text).items()}
    print("\n".join(summary(last_rows(folder / "results.jsonl"), reasons)))  # noqa: T201


if __name__ == "__main__":
    main()
