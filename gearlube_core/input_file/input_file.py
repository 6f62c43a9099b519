"""Base of all input files: reading from TOML, variation, and errors for each wrong field."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, ValidationError

from gearlube_core.errors import ParameterError, why
from gearlube_core.input_file.field_notes import as_meant, field_notes, sentence
from gearlube_core.input_file.file_kind import other_kind

# a line whose value is a number with a comma
_DECIMAL_COMMA = re.compile(r"^[^#\n=]*=[ \t]*(-?\d+),(\d+)[ \t]*(?:#.*)?$", re.MULTILINE)


class Section(BaseModel):
    """A section of an input file: no unknown fields, no conversion of types."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class InputFile(Section):
    """A whole input file; each kind of file adds its fields."""

    package: ClassVar[str]  # whose folder data/ holds the shipped files
    title: ClassVar[str] = "gear file"  # what errors call such a file
    unmodelled: ClassVar[Mapping[str, str]] = {}  # words in unknown fields, and what to say of them
    prefix: ClassVar[str] = ""  # of the shipped files of this kind, not part of their names

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a file; raise ParameterError that names every field that is wrong."""
        return cls.from_data(read_toml(path), str(path)).placed(Path(path).parent)

    def placed(self, folder: Path) -> Self:
        """Return the file with paths that hold from here on; `folder` is where the file lies."""
        return self

    @classmethod
    def shipped(cls) -> tuple[str, ...]:
        """Return the names of the files of this kind that ship with the package."""
        entries = (files(cls.package) / "data").iterdir()
        stems = (e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml"))
        return tuple(sorted(s.removeprefix(cls.prefix) for s in stems if s.startswith(cls.prefix)))

    @classmethod
    def shipped_text(cls, name: str) -> str:
        """Return a file that ships with the package as it is."""
        if name not in cls.shipped():
            raise ParameterError(
                f"No {cls.title} is called {name!r}. Shipped: {', '.join(cls.shipped())}. "
                "A file's name ends in .toml."
            )
        resource = files(cls.package) / "data" / f"{cls.prefix}{name}.toml"
        return resource.read_text(encoding="utf-8")

    @classmethod
    def named(cls, name: str) -> Self:
        """Return a file that ships with the package, by its name."""
        return cls.from_data(tomllib.loads(cls.shipped_text(name)), name)

    @classmethod
    def given(cls, name: str) -> Self:
        """Return the file at a path, where the name is one or ends in .toml, or a shipped one."""
        is_file = name.endswith(".toml") or Path(name).is_file()
        return cls.from_toml(name) if is_file else cls.named(name)

    @classmethod
    def from_data(cls, data: dict[str, Any], where: str) -> Self:
        """Return the file of parsed TOML `data`; `where` names it in errors."""
        try:
            return cls.model_validate(data)
        except ValidationError as reason:
            notes = field_notes(cls)
            other = other_kind(data, notes)
            if other is not None:
                raise ParameterError(
                    f"{where} is not the file that is asked for ({cls.title}): its fields are "
                    f"those of {other.words}. {other.use}"
                ) from None
            errors = [*reason.errors(), *cls._behind(data, reason)]
            lines = [sentence(error, notes, cls.unmodelled) for error in errors]
            raise ParameterError(
                f"{where} has {len(lines)} wrong field(s). " + " ".join(lines)
            ) from None

    @classmethod
    def _behind(cls, data: dict[str, Any], reason: ValidationError) -> list[Any]:
        """Return the errors that misspelt fields hide: those of the data as they are meant.

        Fields that contradict each other show only where all fields of a section are known.
        """
        meant = as_meant(data, reason.errors(), field_notes(cls))
        if meant is None:
            return []
        try:
            cls.model_validate(meant)
        except ValidationError as then:
            known = [(error["loc"], error["type"]) for error in reason.errors()]
            return [one for one in then.errors() if (one["loc"], one["type"]) not in known]
        return []

    def varied(self, changes: dict[str, Any]) -> Self:
        """Return a copy with dotted fields changed, checked as a file is; None takes one away."""
        data = self.model_dump(exclude_none=True)
        for field, value in changes.items():
            *sections, key = field.split(".")
            section = data
            for part in sections:
                section = section.setdefault(part, {})
            section[key] = value
            if value is None:
                del section[key]
        return self.from_data(data, f"{data.get('name', 'The file')} varied")


def read_toml(path: str | Path) -> dict[str, Any]:
    """Return the data of a TOML file; raise ParameterError where it cannot be read."""
    text = ""
    try:
        text = Path(path).read_text(encoding="utf-8")
        return tomllib.loads(text)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as reason:
        cure = ""
        if isinstance(reason, FileNotFoundError):
            cure = " A path inside a file counts from the folder of that file."
        elif (comma := _DECIMAL_COMMA.search(text)) is not None:
            cure = f" Write {comma[1]}.{comma[2]}, with a point."
        raise ParameterError(f"{path} is not a readable TOML file: {why(reason)}.{cure}") from None
