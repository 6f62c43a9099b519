"""Base of all input files: reading from TOML, variation, and errors for each wrong field."""

from __future__ import annotations

import codecs
import json
import logging
import re
import tomllib
from collections.abc import Collection, Mapping, Sequence
from importlib.resources import files
from os.path import isdir, isfile  # false for a name that no file can have
from pathlib import Path
from typing import Any, ClassVar, Literal, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, ValidationError

from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import as_meant, field_notes, unusual_numbers
from gearlube_core.input_file.refusal import MOST_LISTED, check_places, named_places, refusal

Origin = Literal["given", "inferred", "assumed"]


class InputNote(NamedTuple):
    """One input of a model and where its value is from.

    `value` is in `unit`; `why` is empty where the file gives a value that is plausible.
    """

    field: str  # dotted name in the file
    value: Any
    unit: str
    origin: Origin
    why: str

    @property
    def value_text(self) -> str:
        """The value as a table shows it."""
        return _text(self.value)


def _text(value: Any) -> str:
    if isinstance(value, tuple | list):
        return ", ".join(_text(one) for one in value) or "none"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def notes_as_text(notes: Sequence[InputNote]) -> str:
    """Return notes as one text, for an attribute of a dataset."""
    return json.dumps([[n.field, n.value_text, n.unit, n.origin, n.why] for n in notes])


logger = logging.getLogger(__name__)

# a line whose value is a number with a comma
_DECIMAL_COMMA = re.compile(r"^[^#\n=]*=[ \t]*(-?\d+),(\d+)[ \t]*(?:#.*)?$", re.MULTILINE)

_LARGEST = 2_000_000  # bytes of a file
_MOST = 50_000  # fields and numbers in it
_LONGEST = 10_000  # characters of a text
_GREATEST = 10**18  # whole number
_SHOWN = 80  # characters of a wrong name or text
_DEEPEST = 20  # parts of a key
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]")
# parts of bounded length, each taken once and whole, so that the search stays linear
_DEEP_KEY = re.compile(
    r"""(?<![\w-])(?:(?:[\w-]{1,200}+|"(?:[^"\\\n]|\\.){0,200}+"|'[^'\n]{0,200}+')"""
    rf"[ \t]{{0,20}}+\.[ \t]{{0,20}}+){{{_DEEPEST},}}"
)


class Section(BaseModel):
    """A section of an input file: no unknown fields, no conversion of types."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class InputFile(Section):
    """A whole input file; each kind of file adds its fields."""

    package: ClassVar[str]  # whose folder data/ holds the shipped files
    title: ClassVar[str] = "gear file"  # what errors call such a file
    unmodelled: ClassVar[Mapping[str, str]] = {}  # words in unknown fields, and what to say of them
    prefix: ClassVar[str] = ""  # of the shipped files of this kind, not part of their names
    files: ClassVar[tuple[str, ...]] = ()  # dotted fields that name a file, or what ships
    absolute_files: ClassVar[bool] = True  # whether `from_toml` makes their paths absolute

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a file; what it names counts from its folder, and has absolute paths thereafter.

        What is allowed but hardly meant is logged as warnings, see `warn`.

        Raises
        ------
        ParameterError
            Names every field that is wrong, or the file that is missing and who names it.
        """
        data = read_toml(path, cls.title)
        places = cls._places(data, Path(path).parent.absolute())
        found = cls.from_data(data, str(path))
        check_places(path, places)
        found.warn(path)
        return found

    def warn(self, where: str | Path) -> None:
        """Log unusual numbers, remarks and guesses of a file that `where` names, as warnings."""
        for one in (*self.unusual_numbers().values(), *self.remarks(), *self.guesses()):
            logger.warning("%s: %s", where, one)

    def unusual_numbers(self) -> dict[str, str]:
        """Return the numbers that the file gives and hardly means: sentences by dotted name."""
        return unusual_numbers(self.model_dump(exclude_unset=True), field_notes(type(self)))

    def remarks(self) -> list[str]:
        """Return warnings about what the file describes as a whole; a kind of file has its own."""
        return []

    def guesses(self) -> list[str]:
        """Return the guesses of the file as sentences; each kind of file has its own."""
        return []

    @classmethod
    def file_fields(cls, data: Mapping[str, Any]) -> tuple[str, ...]:
        """Return the dotted fields of these data that name a file, or what ships."""
        return cls.files

    @classmethod
    def _places(cls, data: dict[str, Any], folder: Path) -> dict[str, Path]:
        """Return the paths of files that data name, by field; write them into the data."""
        places = named_places(data, cls.file_fields(data), folder)
        for field, place in places.items() if cls.absolute_files else ():
            *sections, key = field.split(".")
            section: Any = data
            for part in sections:
                section = section[part]
            section[key] = str(place)
        return places

    @classmethod
    def shipped(cls) -> tuple[str, ...]:
        """Return the names of the files of this kind that ship with the package."""
        return shipped_names(cls.package, cls.prefix)

    @classmethod
    def shipped_text(cls, name: str) -> str:
        """Return a file that ships with the package as it is."""
        if name not in cls.shipped():
            raise _unknown(name, cls.title, cls.shipped())
        resource = files(cls.package) / "data" / f"{cls.prefix}{name}.toml"
        return resource.read_text(encoding="utf-8")

    @classmethod
    def named(cls, name: str) -> Self:
        """Return a file that ships with the package, by its name."""
        return cls.from_data(tomllib.loads(cls.shipped_text(name)), name)

    @classmethod
    def given(cls, name: str) -> Self:
        """Return the file at a path, where the name is one or ends in .toml, or a shipped one."""
        return cls.from_toml(name) if _is_path(name, cls.shipped()) else cls.named(name)

    @classmethod
    def from_data(cls, data: dict[str, Any], where: str) -> Self:
        """Return the file of parsed TOML `data`; `where` names it in errors."""
        try:
            return cls.model_validate(data)
        except ValidationError as reason:
            errors = reason.errors()
            if len(errors) <= MOST_LISTED:
                errors += cls._behind(data, reason)
            notes = field_notes(cls)
            raise refusal(data, where, errors, notes, cls.title, cls.unmodelled) from None

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


def shipped_names(package: str, prefix: str = "") -> tuple[str, ...]:
    """Return the names of the files in the folder data of a package, those with a prefix.

    >>> shipped_names("drivetrain.train")[0]
    'e_axle'
    """
    entries = (files(package) / "data").iterdir()
    stems = (e.name.removesuffix(".toml") for e in entries if e.name.endswith(".toml"))
    return tuple(sorted(s.removeprefix(prefix) for s in stems if s.startswith(prefix)))


def check_given(name: str, title: str, shipped: Collection[str]) -> None:
    """Raise ParameterError for a name that is neither a path nor one of a shipped file."""
    if not _is_path(name, shipped) and name not in shipped:
        raise _unknown(name, title, shipped)


def _is_path(name: str, shipped: Collection[str]) -> bool:
    return name.endswith(".toml") or isfile(name) or (isdir(name) and name not in shipped)


def _unknown(name: str, title: str, shipped: Collection[str]) -> ParameterError:
    known = ", ".join(shipped)
    return ParameterError(
        f"No {title} is called {name!r}. Shipped: {known}. A file's name ends in .toml."
    )


def read_toml(path: str | Path, what: str = "file") -> dict[str, Any]:
    """Return the data of a TOML file; raise ParameterError where it cannot be read.

    `what` is the kind of file in errors.
    """
    return toml_data(read_content(path, what, largest=_LARGEST), str(path))


def _check_texts(data: dict[str, Any], head: str) -> None:
    """Refuse more entries or longer texts than any file needs, and control characters in texts."""
    found: list[tuple[str, Any]] = [("", data)]
    for name, value in found:  # which grows by what each value holds
        if isinstance(value, dict):
            found += [(f"{name}.{key}".lstrip("."), one) for key, one in value.items()]
        elif isinstance(value, list):
            found += [(name, one) for one in value]
        elif isinstance(value, str) and (len(value) > _LONGEST or _CONTROL.search(value)):
            what = "a text without control characters"
            if len(value) > _LONGEST:
                what = f"a text of at most {_LONGEST} characters"
            raise ParameterError(
                f"{head} {name[:_SHOWN]} must be {what}, got {value[:_SHOWN]!r}. Shorten it."
            )
        elif isinstance(value, int) and abs(value) > _GREATEST:
            raise ParameterError(
                f"{head} {name[:_SHOWN]} must be a whole number of at most 18 digits, got one of "
                f"{len(str(abs(value)))}. Write it as 1e20, for instance."
            )
        if len(found) > _MOST:
            raise ParameterError(
                f"{head} it must have at most {_MOST} entries, got more. Leave some out."
            )


def toml_data(content: bytes, where: str) -> dict[str, Any]:
    """Return the data in the bytes of a TOML file, which `where` names in errors."""
    head = f"{where} is not a readable TOML file:"
    if b"\0" in content:
        wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        got = "it is in UTF-16" if wide else "it holds bytes that are no text"
        raise ParameterError(f"{head} {got}. Save it as text in UTF-8.")
    text = ""
    try:
        text = content.decode("utf-8-sig")
        deep = _DEEP_KEY.search(text)
        data = {} if deep else tomllib.loads(text)
    except UnicodeDecodeError as reason:
        line = content.count(b"\n", 0, reason.start) + 1
        raise ParameterError(
            f"{head} line {line} holds the byte 0x{content[reason.start]:02x}, which is not "
            "UTF-8; it may be cp1252 (ANSI of Windows). Save it as text in UTF-8."
        ) from None
    except tomllib.TOMLDecodeError as reason:
        comma = _DECIMAL_COMMA.search(text)
        cure = f" Write {comma[1]}.{comma[2]}, with a point." if comma else ""
        raise ParameterError(f"{head} {reason}.{cure}") from None
    except ValueError:
        raise ParameterError(
            f"{head} a whole number has too many digits. Write it as 1e20, for instance."
        ) from None
    except RecursionError:
        raise ParameterError(
            f"{head} its lists or tables are too deep. Write fewer levels."
        ) from None
    if deep:
        raise ParameterError(f"{head} a key has more than {_DEEPEST} parts. Shorten it.")
    _check_texts(data, head)
    if not data:
        raise ParameterError(f"{where} is empty: it has no field. Write the fields into it.")
    return data
