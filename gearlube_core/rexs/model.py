"""A REXS file as components with attributes, and the relations between them."""

from __future__ import annotations

import json
import math
import zipfile
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lxml import etree

from gearlube_core.checks import read_content
from gearlube_core.errors import ParameterError, unread
from gearlube_core.units import DEGREE

# unit of the data base of [fva_2022] and how much of it one of another is
_SAME = {
    "mm": {"mm": 1.0, "m": 1e3, "cm": 10.0, "mum": 1e-3, "um": 1e-3, "µm": 1e-3, "in": 25.4},
    "deg": {"deg": 1.0, "°": 1.0, "rad": 1.0 / DEGREE},
    "none": {"none": 1.0},
    "N / m": {"N / m": 1.0, "N / mm": 1e3, "N / mum": 1e6},
    "N mm / rad": {"N mm / rad": 1.0, "N m / rad": 1e3},
    "N / mm^2": {"N / mm^2": 1.0, "MPa": 1.0},
    "kg / dm^3": {"kg / dm^3": 1.0, "kg / m^3": 1e-3},
    "kg": {"kg": 1.0},
    "kg m^2": {"kg m^2": 1.0, "kg mm^2": 1e-6},
    "1 / min": {"1 / min": 1.0},
    "N m": {"N m": 1.0, "N mm": 1e-3},
    "C": {"C": 1.0},
}

_MODELS = (".rexs", ".rexsj", ".xml")  # files of an archive that hold a model
_UNREADABLE = (ValueError, KeyError, TypeError, AttributeError, RecursionError)
_LARGEST = 500_000_000  # bytes of an unpacked model


@dataclass(slots=True)
class Component:
    """A machine element with its attributes; it keeps track of which of them were read."""

    number: int
    kind: str
    name: str
    attributes: dict[str, tuple[str, str]]  # text, of arrays their numbers, and unit
    used: set[str] = field(default_factory=set)

    def __str__(self) -> str:
        return f"{self.kind} {self.number}" + (f" ({self.name})" if self.name else "")

    def value(self, attribute: str, unit: str = "none") -> float | None:
        """Return a number in `unit`, one of the data base, or None where it is not given.

        Raises
        ------
        ParameterError
            The attribute is no number, or its unit is of another kind.
        """
        if attribute not in self.attributes:
            return None
        self.used.add(attribute)
        text, own = self.attributes[attribute]
        what = f"{attribute} of {self}"
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise ParameterError(f"{what} must be a number, got {text!r}. Correct the file")
        return converted(number, "" if own == "none" else own, unit, what)

    def vector(self, attribute: str) -> tuple[float, float, float] | None:
        """Return three numbers in the unit of the data base, or None where they are not given."""
        text = self.word(attribute)
        if not text:
            return None
        try:
            u, v, w = (float(one) for one in text.split())
        except ValueError:
            u = v = w = math.nan
        if not math.isfinite(u + v + w):
            raise ParameterError(
                f"{attribute} of {self} must be three numbers, got {text!r}. Correct the file"
            )
        own = self.attributes[attribute][1]
        factor = converted(1.0, own, "mm", f"{attribute} of {self}") if own else 1.0
        return factor * u, factor * v, factor * w

    def count(self, attribute: str) -> int | None:
        """Return a whole number, or None where it is not given."""
        number = self.value(attribute)
        if number is not None and number != round(number):
            raise ParameterError(f"{attribute} of {self} must be a whole number, got {number:g}")
        return None if number is None else round(number)

    def word(self, attribute: str) -> str:
        """Return a text, empty where it is not given."""
        if attribute not in self.attributes:
            return ""
        self.used.add(attribute)
        return self.attributes[attribute][0]

    @property
    def unused(self) -> list[str]:
        """Attributes that nobody has asked for."""
        return [name for name in self.attributes if name not in self.used]


@dataclass(frozen=True, slots=True, kw_only=True)
class RexsModel:
    """Components and relations of a REXS file.

    References
    ----------
    [fva_2022]: structure of files.
    """

    path: Path
    source: str
    components: dict[int, Component]
    relations: list[tuple[str, list[tuple[str, int]]]]  # type; roles and components
    load_spectra: int  # how many the file has
    cases: list[dict[int, Component]]  # what load cases say of components

    @classmethod
    def read(cls, path: str | Path) -> RexsModel:
        """Read a file; raise ParameterError where it is not REXS of version 1.

        What the file is, XML, JSON or a ZIP archive of one of them, is seen from its content.
        """
        path = Path(path)
        try:
            whole = read_content(path, "REXS file", largest=_LARGEST)
            archived = zipfile.is_zipfile(path)
            name, content = _unpacked(path) if archived else (path.name, whole)
        except (OSError, zipfile.BadZipFile, RuntimeError, zlib.error) as reason:
            raise ParameterError(f"{unread('REXS file', path, reason)}.") from None
        kind = _kind(Path(name), content)
        try:
            if kind == "ZIP":
                raise ValueError("the archive is cut or damaged")
            root = _xml(content) if kind == "XML" else _xml_of(json.loads(content))
        except (*_UNREADABLE, etree.XMLSyntaxError) as reason:
            raise ParameterError(
                f"{path} is not a readable {kind} file of REXS: {str(reason).rstrip('.')}. "
                "Export it again."
            ) from None
        version = root.get("version", "")
        if etree.QName(root).localname != "model" or not version.startswith("1."):
            raise ParameterError(
                f"{path} must be a REXS model of version 1, got <{etree.QName(root).localname}> "
                f"with version {version or 'not given'!r}. Export it as REXS 1.4"
            )
        try:
            components = [_component(one) for one in root.findall("{*}components/{*}component")]
            cases = [
                {part.number: part for part in map(_component, one.findall("{*}component"))}
                for one in root.findall("{*}load_spectrum/{*}load_case")
            ]
            relations = [
                (one.get("type", ""), [(ref.get("role", ""), int(ref.get("id"))) for ref in one])
                for one in root.findall("{*}relations/{*}relation")
            ]
        except (TypeError, ValueError):
            raise ParameterError(
                f"{path}: every component and every ref must have a whole number as its id. "
                "Correct the file"
            ) from None
        program = " ".join(root.get(f"application{key}", "") for key in ("Id", "Version")).strip()
        return cls(
            path=path,
            source=f"REXS {version} file {path.name}" + (f" of {program}" if program else ""),
            components={one.number: one for one in components},
            relations=relations,
            load_spectra=len(root.findall("{*}load_spectrum")),
            cases=cases,
        )

    def related(self, kind: str, role: str, number: int) -> list[dict[str, int]]:
        """Return relations of a type in which a component has a role, as roles and components."""
        return [
            dict(refs) for name, refs in self.relations if name == kind and (role, number) in refs
        ]

    def of_kind(self, *kinds: str) -> list[Component]:
        """Return the components of these types, in the order of the file."""
        return [one for one in self.components.values() if one.kind in kinds]


def _kind(path: Path, content: bytes) -> str:
    """Return what a file is by its first letters: XML, JSON or ZIP; by its name in doubt."""
    first = content.lstrip(b"\xef\xbb\xbf \t\r\n")[:1]
    known = {b"<": "XML", b"{": "JSON", b"[": "JSON"}
    if content.startswith(b"PK"):
        return "ZIP"
    return known.get(first) or {".rexsj": "JSON", ".rexsz": "ZIP"}.get(path.suffix.lower(), "XML")


def _unpacked(path: Path) -> tuple[str, bytes]:
    """Return name and content of the one model of an archive."""
    with zipfile.ZipFile(path) as archive:
        models = [
            one
            for one in archive.infolist()
            if Path(one.filename).suffix.lower() in _MODELS and "__MACOSX" not in one.filename
        ]
        if len(models) != 1 or models[0].file_size > _LARGEST:
            found = ", ".join(f"{one.filename} ({one.file_size} bytes)" for one in models) or "none"
            raise ParameterError(
                f"{path} must hold one REXS model (.rexs, .rexsj) of up to {_LARGEST} bytes, got "
                f"{found}. Unpack it and give one of its files"
            )
        return models[0].filename, archive.read(models[0])


def _xml(content: bytes) -> etree._Element:
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True)
    return etree.fromstring(content, parser)


def _xml_of(data: Any) -> etree._Element:
    """Return the model of JSON as XML; arrays have no text, as those of XML files."""
    try:
        return _tree(data["model"])
    except (KeyError, TypeError, AttributeError):
        kinds = ((list, "a list"), (dict, "an object without all of them"))
        got = next((words for kind, words in kinds if isinstance(data, kind)), "a single value")
        raise ValueError(
            'it must be an object with "model", and in it lists of "components" and "relations", '
            f"each an object with the keys of REXS, got {got}"
        ) from None


def _tree(model: dict[str, Any]) -> etree._Element:
    names = ("version", "applicationId", "applicationVersion")
    root = etree.Element("model", {name: str(model.get(name, "")) for name in names})
    relations, components = (etree.SubElement(root, one) for one in ("relations", "components"))
    for one in model["relations"]:
        relation = etree.SubElement(relations, "relation", type=one["type"])
        for ref in one["refs"]:
            etree.SubElement(relation, "ref", id=str(ref["id"]), role=ref["role"])
    _add_components(components, model["components"])
    spectra: Any = model.get("load_spectrum") or []
    for one in spectra if isinstance(spectra, list) else [spectra]:
        spectrum = etree.SubElement(root, "load_spectrum")
        for case in one.get("load_cases") or ():
            _add_components(etree.SubElement(spectrum, "load_case"), case.get("components") or ())
    return root


def _add_components(root: etree._Element, given: Iterable[dict[str, Any]]) -> None:
    for one in given:
        about = {"id": str(one["id"]), "type": one["type"], "name": one.get("name") or ""}
        component = etree.SubElement(root, "component", about)
        for said in one.get("attributes") or ():
            attribute = etree.SubElement(
                component, "attribute", id=said["id"], unit=said.get("unit") or ""
            )
            value = next((value for key, value in said.items() if key not in ("id", "unit")), None)
            if isinstance(value, bool):
                attribute.text = str(value).lower()
            elif isinstance(value, str | int | float):
                attribute.text = str(value)
            for number in value if isinstance(value, list) else ():
                etree.SubElement(attribute, "c").text = str(number)


def _component(element: etree._Element) -> Component:
    attributes = {
        one.get("id", ""): (_text(one), one.get("unit", "").strip())
        for one in element.findall("{*}attribute")
    }
    return Component(
        int(element.get("id")), element.get("type", ""), element.get("name", ""), attributes
    )


def _text(attribute: etree._Element) -> str:
    numbers = [one.text or "" for one in attribute.iterfind(".//{*}c")]
    return " ".join(numbers) if numbers else (attribute.text or "").strip()


def converted(value: float, unit: str, wanted: str, what: str) -> float:
    """Return a value in the unit that is wanted.

    Parameters
    ----------
    value : float
    unit : str
        As the file says; empty: that of the data base, which is the one that is wanted.
    wanted : str
        One of the data base.
    what : str
        Names the attribute in errors.

    Raises
    ------
    ParameterError
        The unit is of another kind.

    Examples
    --------
    >>> converted(0.25, "m", "mm", "face_width")
    250.0
    """
    factors = _SAME[wanted]
    if unit and unit not in factors:
        raise ParameterError(
            f"{what} must have a unit out of {', '.join(factors)}, got {value:g} {unit!r}. Correct "
            "the unit in the file"
        )
    return value * factors[unit or wanted]
