"""Which tests reach a file: by imports, nearest first.

A test's helpers count as parts of it. A name that a package hands on leads to the module that
defines it. Modules that are named in texts, as commands and slaves are, count as imported.
"""

from __future__ import annotations

import ast
import re
from collections import defaultdict, deque
from collections.abc import Iterable
from functools import cache, cached_property
from pathlib import Path

PACKAGES = ("gearlube_core", "drivetrain", "fmu_src", "gearlube")
_FOLDERS = (*PACKAGES, "tests", "docs", "examples")
_MODULE = re.compile(r"(?:gearlube_core|drivetrain|fmu_src|gearlube)(?:\.\w+)+")
_KERNEL = re.compile(r"^\s*@(?:kernel|inlined|summing|compiled)\b", re.MULTILINE)
_NAMED = 2.0  # steps that a test seems nearer when it names the changed function
_SHARED = 0.4  # the same for each rare word of the changed lines that stands in the test
_RARE = 0.1  # of all tests


def _parts_of(names: Iterable[str]) -> frozenset[str]:
    """Return the words of names as they are written in code, in small letters."""
    parts = {part for name in names for part in re.split(r"_|(?<=[a-z])(?=[A-Z])", name)}
    return frozenset(part.lower() for part in parts if len(part) > 3)


class Reach:
    """The import graph of a copy of the project."""

    def __init__(self, root: Path) -> None:
        self._root = root
        paths = [path for folder in _FOLDERS for path in sorted((root / folder).rglob("*.py"))]
        self._texts = {str(path.relative_to(root)): path.read_text("utf-8") for path in paths}
        stubs = {
            str(path.relative_to(root).with_suffix(".py")): path
            for path in sorted((root / "gearlube").rglob("*.pyi"))
        }
        self._faces = set(stubs)  # modules of public names: their stubs say what defines each
        self._texts |= {file: path.read_text("utf-8") for file, path in stubs.items()}
        self._trees = {file: ast.parse(text) for file, text in self._texts.items()}
        self.imports = {file: self._imports_of(file) for file in self._texts}
        self._words = {
            file: frozenset(re.findall(r"\w+", text)) for file, text in self._texts.items()
        }

    @cached_property
    def _importers(self) -> dict[str, set[str]]:
        importers: dict[str, set[str]] = defaultdict(set)
        for file, imported in self.imports.items():
            for one in imported:
                importers[one].add(file)
        return importers

    def tests_of(self, file: str, scope: str, text: str = "") -> list[tuple[float, str]]:
        """Return test files with their distance from `text` in `scope` of `file`, nearest first.

        The file itself counts as a test where it has examples in its docstrings.
        """
        distances = {file: 0}
        waiting = deque([file])
        while waiting:
            here = waiting.popleft()
            for importer in self._importers[here]:
                step = 0 if here.startswith("tests/helpers") else 1
                if distances.get(importer, 99) > distances[here] + step:
                    distances[importer] = distances[here] + step
                    waiting.append(importer)
        names = {part for part in scope.split(".") if part and not part.startswith("__")}
        words = self._rare_words(text)
        found = []
        for test, distance in distances.items():
            if Path(test).name.startswith("test_"):
                named = bool(names & self._words[test])
                shared = len(words & self._parts(test))
                found.append((distance - _NAMED * named - _SHARED * shared, test))
        if ">>> " in self._texts[file]:
            found.append((-_NAMED, file))
        return sorted(found)

    def _rare_words(self, text: str) -> set[str]:
        tests = [file for file in self._texts if Path(file).name.startswith("test_")]
        words = _parts_of(re.findall(r"\w+", text))
        return {
            word
            for word in words
            if 0 < sum(word in self._parts(test) for test in tests) <= _RARE * len(tests)
        }

    @cache  # noqa: B019 - one graph in a run
    def _parts(self, file: str) -> frozenset[str]:
        return _parts_of(self._words[file])

    def is_compiled(self, file: str) -> bool:
        """Return whether a change of the file has kernels compiled again."""
        waiting, seen = [file], {file}
        while waiting:
            here = waiting.pop()
            if not here.startswith("tests/") and _KERNEL.search(self._texts[here]):
                return True
            new = self._importers[here] - seen
            seen |= new
            waiting += new
        return False

    def _imports_of(self, file: str) -> set[str]:
        found: set[str] = set()
        for node in ast.walk(self._trees[file]):
            if isinstance(node, ast.Import):
                for alias in node.names:
                    found.add(self._file_of(alias.name))
            elif isinstance(node, ast.ImportFrom) and node.module:
                for alias in node.names:
                    found |= self._defining(node.module, alias.name)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                beside = f"{Path(file).parent}/{node.value}.py"
                if file.startswith("fmu_src/") and beside in self._texts:
                    found.add(beside)  # a slave, which the FMU's files name
                if match := _MODULE.match(node.value):
                    found |= self._defining(*match[0].rpartition(".")[::2])
            elif isinstance(node, ast.Attribute):
                owner = ast.unparse(node.value)
                if owner.partition(".")[0] in ("gl", "gearlube"):
                    module = ".".join(["gearlube", *owner.split(".")[1:]])
                    found |= self._defining(module, node.attr)
        return found - {"", file, *self._faces}

    def _file_of(self, module: str) -> str:
        stem = module.replace(".", "/")
        for file in (f"{stem}.py", f"{stem}/__init__.py"):
            if file in self._texts:
                return file
        return ""

    def _defining(self, module: str, name: str) -> set[str]:
        """Return the file of the module that defines a name, which may be a module itself."""
        if inner := self._file_of(f"{module}.{name}"):
            return {inner}
        file = self._file_of(module)
        if file not in self._faces and not file.endswith("__init__.py"):
            return {file}
        for node in ast.walk(self._trees[file]):
            if isinstance(node, ast.ImportFrom) and node.module:
                for alias in node.names:
                    if (alias.asname or alias.name) == name:
                        return self._defining(node.module, alias.name)
        return {file}
