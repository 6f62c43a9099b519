"""A copy of the tree to change, with caches of its own and what is known of its tests."""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from numba.core.caching import UserProvidedCacheLocator

from benchmarks.mutation.reach import PACKAGES, Reach
from benchmarks.mutation.trial import Plan, Result, run_tests

_ALLOWANCE = {True: 60.0, False: 4.0}  # [s] compiled: a test may have to compile
_EACH = 1.0  # [s] longest test without compilation
_LONGEST = 8.0  # [s] of tests of a file without compilation
_DURATION = re.compile(r"^([\d.]+)s (?:call|setup|teardown) +(\S+::.*)$", re.MULTILINE)


class Workplace:
    """The folder of a run: `tree` (the copy), caches, results, and seconds of tests."""

    def __init__(self, folder: Path, project: Path) -> None:
        self.folder = folder
        self.tree = folder / "tree"
        self.seconds: dict[bool, dict[str, float]] = {True: {}, False: {}}
        self._project = project
        self._failing: dict[bool, set[str]] = {True: set(), False: set()}
        self._measured: set[str] = set()  # files whose tests ran without compilation
        self._known = folder / "known_tests.jsonl"
        self._copy_tree()
        self.reach = Reach(self.tree)
        if self._known.exists():
            for line in self._known.read_text().splitlines():
                self._take(*json.loads(line))

    def read_durations(self, log: Path) -> None:
        """Take the tests' seconds from the output of `pytest --durations=0`."""
        for seconds, test in _DURATION.findall(log.read_text()):
            known = self.seconds[True]
            known[test] = known.get(test, 0.0) + float(seconds)

    def seed_compiled_code(self, tree: Path) -> None:
        """Copy compiled code that lies beside the sources of another copy of the project."""
        for package in PACKAGES:
            for folder in sorted((tree / package).rglob("__pycache__")):
                source = self.tree / folder.parent.relative_to(tree) / "__init__.py"
                place = UserProvidedCacheLocator.get_suitable_cache_subpath(str(source))
                there = self.folder / "compiled" / place
                for file in folder.glob("*.nb[ic]"):
                    there.mkdir(parents=True, exist_ok=True)
                    if not (there / file.name).exists():
                        shutil.copy2(file, there / file.name)

    def nearest_tests(self, file: str, scope: str, text: str) -> list[str]:
        """Return the test files that reach a change, nearest first, of equals the quickest."""
        seconds: Counter[str] = Counter()
        for test, each in self.seconds[True].items():
            seconds[test.partition("::")[0]] += each
        found = self.reach.tests_of(file, scope, text)
        return [test for _, test in sorted(found, key=lambda one: (one[0], seconds[one[1]]))]

    def try_unchanged(self, test: str, compiled: bool) -> bool:
        """Return whether a test passes on the unchanged tree; it runs once."""
        if test in self._failing[compiled]:
            return False
        if not compiled and test in self.seconds[False]:
            return True
        if f"{test} sound" in self._measured:
            return True
        plan = Plan((test,), compiled, limit=300.0)
        sound = self._run(plan, self._environment("compiled", "stored")).ended == "passed"
        self._note(f"{test} sound" if sound else test, compiled, 0.0 if sound else -1.0)
        return sound

    def measure_without_compilation(self, test_file: str) -> None:
        """Find out which tests of a file pass quickly without compilation."""
        if test_file in self._measured:
            return
        plan = Plan((test_file,), False, limit=_LONGEST, keep_going=True, each=_EACH)
        result = self._run(plan, self._environment("compiled", "stored"))
        for test, seconds in result.passed.items():
            self._note(test, False, seconds)
        self._note(test_file, False, 0.0)

    def run_changed(self, plan: Plan, file: str, content: bytes) -> Result:
        """Run tests of a changed tree, on copies of the caches that the change may spoil."""
        stored = "changed_stored"
        if file in self._closure("gearlube_core/tooth_compliance/tooth_body.py"):
            stored = "changed_empty"  # what is stored there would hide the change
        while True:
            with self._changed(file, content):
                result = self._run(plan, self._environment("changed_compiled", stored))
            if result.ended != "failed":
                return result
            if not result.test:  # pytest gave up: the change hurts what a conftest.py imports
                self._check_collection(plan)
                return result
            if self.try_unchanged(result.test, plan.compiled):
                return result
            # a file that cannot be read without the change either is left out as a whole
            files = [one for one in plan.files if one != result.test]
            if not files:
                return replace(result, ended="passed", test="")
            plan = replace(plan, files=files, left_out=plan.left_out | {result.test})

    def _check_collection(self, plan: Plan) -> None:
        """Raise where pytest cannot even collect the tests of the unchanged tree."""
        nothing = replace(plan, budget=-1.0)
        if self._run(nothing, self._environment("compiled", "stored")).ended != "passed":
            log = (self.folder / "log.txt").read_text()
            raise RuntimeError(f"pytest cannot run in the unchanged copy:\n{log}")

    def copy_caches(self) -> None:
        """Give the next mutant caches that nothing else sees."""
        shutil.rmtree(self.folder / "changed_empty", ignore_errors=True)
        for name in ("compiled", "stored"):
            shutil.rmtree(self.folder / f"changed_{name}", ignore_errors=True)
            (self.folder / name).mkdir(exist_ok=True)
            # the caches replace files, they never write into them: links will do
            shutil.copytree(
                self.folder / name, self.folder / f"changed_{name}", copy_function=os.link
            )

    def plan(self, files: list[str], compiled: bool, budget: float, limit: float) -> Plan:
        """Return a plan of what is known to pass."""
        return Plan(
            files,
            compiled,
            self.seconds[compiled],
            frozenset(self._failing[compiled]),
            known_only=not compiled,
            budget=budget,
            limit=limit,
        )

    @contextlib.contextmanager
    def _changed(self, file: str, content: bytes) -> Iterator[None]:
        path = self.tree / file
        original, status = path.read_bytes(), path.stat()
        try:
            path.write_bytes(content)
            # another second than the original's, by which Python knows its bytecode
            os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns + 10**12))
            yield
        finally:
            path.write_bytes(original)
            os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))

    def _run(self, plan: Plan, environment: dict[str, str]) -> Result:
        return run_tests(plan, self.tree, environment, _ALLOWANCE[plan.compiled])

    def _environment(self, compiled: str, stored: str) -> dict[str, str]:
        return {
            "NUMBA_CACHE_DIR": str(self.folder / compiled),
            "XDG_CACHE_HOME": str(self.folder / stored),
            "OPENBLAS_NUM_THREADS": "1",
            "MPLBACKEND": "agg",
        }

    def _closure(self, file: str) -> set[str]:
        seen, waiting = {file}, [file]
        while waiting:
            new = self.reach.imports[waiting.pop()] - seen
            seen |= new
            waiting += new
        return seen

    def _note(self, test: str, compiled: bool, seconds: float) -> None:
        self._take(test, compiled, seconds)
        with self._known.open("a") as file:
            file.write(json.dumps((test, compiled, seconds)) + "\n")

    def _take(self, test: str, compiled: bool, seconds: float) -> None:
        if seconds < 0.0:
            self._failing[compiled].add(test)
        elif "::" in test and not test.endswith(" sound"):
            self.seconds[compiled][test] = seconds
        else:
            self._measured.add(test)

    def _copy_tree(self) -> None:
        """Bring the copy to the state of the project; what is unchanged keeps its time."""
        listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(listed, cwd=self._project, check=True, capture_output=True).stdout
        wanted = {name for name in names.decode().split("\0") if name}
        for name in sorted(wanted):
            source, target = self._project / name, self.tree / name
            if not source.is_file():
                continue
            if not target.exists() or target.read_bytes() != source.read_bytes():
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(source, target)
        for path in self.tree.rglob("*.py"):
            if str(path.relative_to(self.tree)) not in wanted:
                path.unlink()
