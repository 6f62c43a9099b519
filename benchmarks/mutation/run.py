"""Put faults into a copy of the code, one after the other, and see whether a test fails.

    python -m benchmarks.mutation.run FOLDER [--count 500] [--by-hand] [--again [--thorough]]
    python -m benchmarks.mutation.run FOLDER --code gearlube/studies gearlube/report

FOLDER keeps the copy, its caches and `results.jsonl`. A run goes on where the last one stopped:
the order of the mutants depends on the seed and on the text that each of them changes, so a
mutant keeps its place while other code changes. Each mutant meets the nearest tests without
compilation first, then the nearest compiled ones, then those farther away; what survives these
meets all tests that import the file, directly or not, with `--again --thorough`.
"""

from __future__ import annotations

import argparse
import gc
import json
import time
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.mutation.sites import Mutant, mutants_of
from benchmarks.mutation.trial import import_all
from benchmarks.mutation.workplace import Workplace

PROJECT = Path(__file__).parents[2]
HERE = Path(__file__).parent
_MUTATED = ("gearlube_core", "drivetrain", "fmu_src")
_NEAREST, _NEAR, _FAR = 2, 5, 15  # test files of each stage
_SECONDS = (12.0, 8.0)  # of unchanged tests, near and far
_ALL = 500.0  # [s] of tests and of processor time, where a survivor meets all tests
_LIMIT = 50.0  # [s] of processor time at each compiled stage


def sampled(tree: Path, seed: int, code: Sequence[str] = _MUTATED) -> list[Mutant]:
    """Return all mutants of the folders or files `code` in the order in which they are taken."""
    tops = [tree / one for one in code]
    files = [one for top in tops for one in ([top] if top.is_file() else sorted(top.rglob("*.py")))]
    found: list[Mutant] = []
    for path in files:
        if path.name != "errors.py":
            found += mutants_of(str(path.relative_to(tree)), path.read_bytes(), seed)
    return sorted(found, key=lambda mutant: mutant.key)


def by_hand(tree: Path) -> Iterator[Mutant]:
    """Yield the mutants of `by_hand.toml`."""
    for name, one in tomllib.loads((HERE / "by_hand.toml").read_text("utf-8")).items():
        source = (tree / one["file"]).read_bytes()
        before = one["before"].encode()
        if source.count(before) != 1:
            raise ValueError(
                f"{name}: its text must be there once, is {source.count(before)} times"
            )
        start = source.index(before)
        line = source.count(b"\n", 0, start) + 1
        yield Mutant(
            f"by hand: {name}",
            one["file"],
            line,
            one.get("scope", ""),
            one["before"],
            one["after"],
            start,
            start + len(before),
        )


def outcome(
    place: Workplace, mutant: Mutant, thorough: bool, limit: float = _LIMIT
) -> dict[str, object]:
    """Return what became of a mutant."""
    source = (place.tree / mutant.file).read_bytes()
    changed = mutant.applied(source)
    if mutant.key.startswith("by hand"):  # whole statements
        changed = source[: mutant.start] + mutant.after.encode() + source[mutant.end :]
    first = mutant.line - 1
    text = b"\n".join(source.splitlines()[first : first + 1 + mutant.before.count("\n")]).decode()
    tests = place.nearest_tests(mutant.file, mutant.scope, text)
    near, far = _SECONDS
    stages = [(tests[:_NEAR], True, near), (tests[_NEAR:_FAR], True, far)]
    if thorough:
        stages = [(tests[:_NEAR], True, _ALL), (tests[_NEAR:], True, _ALL)]
    if place.reach.is_compiled(mutant.file):
        for file in tests[:_NEAREST]:
            place.measure_without_compilation(file)
        stages.insert(0, (tests[:_NEAREST], False, near))
    row: dict[str, object] = {
        "key": mutant.key,
        "file": mutant.file,
        "line": mutant.line,
        "scope": mutant.scope,
        "before": mutant.before,
        "after": mutant.after,
    }
    spent, how = 0.0, "survived"
    place.copy_caches()
    for files, compiled, budget in stages:
        if not files:
            continue
        plan = place.plan(files, compiled, budget, _ALL if thorough else limit)
        result = place.run_changed(plan, mutant.file, changed)
        spent += result.seconds
        if result.ended in ("failed", "too long"):
            how = "killed"
            row |= {"by": result.test or files[0], "why": result.ended, "compiled": compiled}
            break
        if result.ended == "limit":
            how = "survived, not all tests ran"
    return row | {"outcome": how, "seconds": round(spent, 2)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=500, help="mutants of the sample")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--code", nargs="+", default=_MUTATED, help="folders or files")
    parser.add_argument("--by-hand", action="store_true", help="those of by_hand.toml instead")
    parser.add_argument("--again", action="store_true", help="survivors once more, on new tests")
    parser.add_argument("--thorough", action="store_true", help="all tests that reach the file")
    parser.add_argument("--part", default="1/1", metavar="K/N", help="every N-th mutant, from K on")
    parser.add_argument("--limit", type=float, default=_LIMIT, help="[s] of a compiled stage")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="end after")
    parser.add_argument("--compiled-code-of", type=Path, help="a tree whose compiled code to take")
    parser.add_argument("--durations", type=Path, help="output of pytest -n 0 --durations=0")
    options = parser.parse_args()

    end = time.monotonic() + 60.0 * options.minutes
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    place = Workplace(folder, PROJECT)
    if options.compiled_code_of:
        place.seed_compiled_code(options.compiled_code_of.resolve())
    if options.durations:
        place.read_durations(options.durations)
    wanted = sampled(place.tree, options.seed, options.code)[: options.count]
    if options.by_hand:
        wanted = list(by_hand(place.tree))
    part, parts = map(int, options.part.split("/"))
    wanted = wanted[part - 1 :: parts]
    results = folder / "results.jsonl"
    before = {}
    if results.exists():
        rows = map(json.loads, results.read_text("utf-8").splitlines())
        before = {row["key"]: row["outcome"] for row in rows}
    import_all()
    gc.collect()
    gc.freeze()
    for mutant in wanted:
        done = before.get(mutant.key, "")
        if time.monotonic() > end or (done and (done == "killed" or not options.again)):
            continue
        row = outcome(place, mutant, options.thorough, options.limit)
        with results.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        said = f"{row['outcome']:>9} {row['seconds']:>6} s  {mutant.file}:{mutant.line}"
        print(said, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
