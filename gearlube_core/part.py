"""Parts and laws that a user names: each registers itself, and all that names them asks here.

A part is one file. A dataclass that derives from the base of its kind is its declaration: name,
numbers, what it makes for the kernels. In the package its file stands in the folder of its kind.
Outside it is imported, or named as an entry point of the group of its kind, which commands and
their workers find too.
"""

from __future__ import annotations

import inspect
import logging
from abc import ABC
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatch
from functools import cached_property
from importlib import import_module
from importlib.metadata import entry_points
from importlib.util import find_spec
from pkgutil import iter_modules
from typing import Any, ClassVar, Generic, TypeVar

from gearlube_core.errors import ParameterError
from gearlube_core.input_file.input_file import InputNote
from gearlube_core.number import Checked, numbers_of

logger = logging.getLogger(__name__)

_Base = TypeVar("_Base", bound="Part")


@dataclass(kw_only=True)
class Kind(Generic[_Base]):
    """A kind of parts: all that are registered, by name."""

    what: str  # for errors, such as "friction law"
    group: str  # of entry points
    package: str  # of the parts that ship
    files: str  # pattern of the names of their files
    parts: dict[str, type[_Base]] = field(default_factory=dict)

    def add(self, part: type[_Base], name: str) -> None:
        """Register a part; of a file that is read again the new one counts."""
        known = self.parts.get(name)
        if known is not None and known.__module__ != part.__module__:
            raise ParameterError(
                f"A {self.what} must have a name of its own, got {name!r} of {part.__module__}, "
                f"which {known.__module__} has. Rename one of them."
            )
        self.parts[name] = part

    @cached_property
    def _shipped(self) -> list[str]:
        """Import the files of the package that may hold parts; return the names of these."""
        spec = find_spec(self.package)
        for found in iter_modules(spec.submodule_search_locations if spec else None):
            if fnmatch(found.name, self.files):
                import_module(f"{self.package}.{found.name}")
        ours = {name: one for name, one in self.parts.items() if self.is_ours(one)}
        bases = {
            next(c for c in one.__mro__ if "kind" in vars(c)).__module__ for one in ours.values()
        }
        modules = {one.__module__ for one in ours.values()}
        if not bases <= modules:
            return list(ours)
        # the same order whichever file was imported first: the parts beside the base stand first
        return sorted(
            ours, key=lambda name: (ours[name].__module__ not in bases, ours[name].__module__)
        )

    def is_ours(self, part: type[_Base]) -> bool:
        """Return whether a part stands in the package."""
        return part.__module__.startswith(f"{self.package}.")

    def known(self, wanted: str = "") -> Mapping[str, type[_Base]]:
        """Return the parts by name, those of the package first.

        Entry points are loaded only for a `wanted` name that is not there yet.
        """
        shipped = self._shipped
        if wanted and wanted not in self.parts:
            for plugin in entry_points(group=self.group):
                try:
                    plugin.load()
                except Exception as reason:
                    logger.warning(
                        "The entry point %s of %s (%s) cannot be loaded: %s: %s. What it holds is "
                        "left out.", plugin.name, self.group, plugin.value,
                        type(reason).__name__, reason,
                    )  # fmt: skip
        return {name: self.parts[name] for name in shipped} | self.parts

    def named(self, field_name: str, name: str, numbers: Mapping[str, Any]) -> _Base:
        """Return a part with numbers that are not its defaults, in SI units.

        Raises
        ------
        ParameterError
            There is no part of this name, or a number is none of the part's or out of its range.
        """
        known = self.known(name)
        if name not in known:
            raise ParameterError(
                f"{field_name} must be one of {', '.join(known)}; got {name!r}. A {self.what} "
                "of your own must be imported first, or be an entry point of the group "
                f"{self.group}."
            )
        part = known[name]
        for given in numbers:
            if given not in numbers_of(part):
                listed = ", ".join(numbers_of(part)) or "none"
                raise ParameterError(
                    f"The numbers of the {self.what} {name} are {listed}; got {given!r}. Leave it "
                    "out, or choose the one that has it."
                )
        return part(**numbers)


@dataclass(frozen=True, kw_only=True)
class Part(Checked, ABC):
    """A part or a law with its numbers; a subclass with a name registers itself."""

    name: ClassVar[str] = ""
    text: ClassVar[str] = ""  # for reference pages
    kind: ClassVar[Kind[Any]]

    def __init_subclass__(cls, name: str = "", text: str = "") -> None:
        cls.name, cls.text = name, text
        if name:
            cls.kind.add(cls, name)

    @property
    def numbers(self) -> dict[str, float]:
        """Values of the declared numbers by name, in SI units; without those that are None."""
        values = {name: getattr(self, name) for name in numbers_of(type(self))}
        return {name: float(value) for name, value in values.items() if value is not None}

    def notes(self, prefix: str, given: Collection[str]) -> list[InputNote]:
        """Return a note on each number, in SI units; `given` are the names that a file gives."""
        numbers = numbers_of(type(self))
        return [
            InputNote(f"{prefix}{name}", value, numbers[name].unit, "given", "")
            if name in given
            else InputNote(
                f"{prefix}{name}", value, numbers[name].unit, "assumed",
                numbers[name].source or f"default of {self.name}",
            )
            for name, value in self.numbers.items()
        ]  # fmt: skip

    @property
    def ships(self) -> bool:
        """Whether the part stands in the package."""
        return self.kind.is_ours(type(self))

    @property
    def files(self) -> tuple[str, ...]:
        """The file of the part; none of one that was typed into an interpreter."""
        try:
            return (inspect.getfile(type(self)),)
        except (OSError, TypeError):
            return ()


def files_of(*parts: Part) -> tuple[str, ...]:
    """Return the files of parts."""
    return tuple(file for part in parts for file in part.files)
