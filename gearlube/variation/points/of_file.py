"""Common parts of the studies of an axle, and of those of one gear or bearing file."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Generic, Self, TypeVar

import numpy as np

from gearlube.variation.design import Point, Spread, Value
from gearlube.variation.file_variants import AxleVariants, axle_keys, content_hash, files_named
from gearlube.variation.keys import Key, Keys, Kind, file_keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.scatter import scatter_of, values_of
from gearlube_core.arrays import Array
from gearlube_core.dynamics.helical_pair.linear.periodic_response import harmonics
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import chosen_model
from gearlube_core.film_model.model import FilmModel
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil

ORDERS = (1, 2, 3)
File = TypeVar("File", bound=InputFile)


@dataclass(frozen=True, kw_only=True)
class AxlePoint:
    """A study of an axle at one point; each study adds its operands, check and computation.

    Parameters
    ----------
    axle : AxleVariants
    """

    operands: ClassVar[Keys]
    quantities: ClassVar[tuple[Quantity, ...]]

    axle: AxleVariants

    @property
    def subject(self) -> str:
        """Name of what is varied."""
        return self.axle.file.name

    @property
    def keys(self) -> Keys:
        """Fields of the axle file, parameters of the FMU, and the operands."""
        return {**axle_keys(), **self.operands}

    @property
    def identity(self) -> str:
        """Axle file and its tables."""
        return self.axle.identity

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all files read that the values of the axes name."""
        return replace(self, axle=self.axle.with_files(files_named(texts)))

    def scatter(self) -> tuple[Spread, ...]:
        """Return the spreads of the axle file's tolerances.

        A field that the file leaves out scatters about its default.
        """
        file = self.axle.file
        return scatter_of(file.name, file.tolerances, self.values() if file.tolerances else {})

    def values(self) -> dict[str, Any]:
        """Return the values of the axle file, defaults included, and the usual operands."""
        usual = {key.name: key.usual for key in self.operands.values()}
        notes = self.axle.car_axle({}, notes=True).inputs
        return {**usual, **{note.field: note.value for note in notes}}


def operand(
    name: str,
    unit: str,
    meaning: str,
    usual: float | str,
    low: float = float("-inf"),
    high: float = float("inf"),
    kind: Kind = "number",
) -> Key:
    """Return the key of an operand."""
    return Key(name, kind, unit, meaning, "operand", usual, low, high)


def value(point: Point, key: Key) -> Any:
    """Return the value of an operand at a point, the usual one where it is not varied."""
    return point.get(key.name, key.usual)


def order_quantities(name: str, unit: str, meaning: str) -> tuple[Quantity, ...]:
    """Return the quantities of a signal: peak to peak, and the amplitude of each mesh order."""
    return (
        Quantity(f"{name}_pp", unit, f"{meaning}, peak to peak"),
        *(Quantity(f"{name}_mesh_{k}", unit, f"{meaning}, mesh order {k}") for k in ORDERS),
    )


def order_values(signal: Array) -> list[float]:
    """Return peak to peak and amplitudes of a signal over one mesh period, equal steps.

    Examples
    --------
    >>> phase = np.arange(24) / 24
    >>> [round(one, 9) for one in order_values(3.0 * np.cos(4.0 * np.pi * phase))]
    [6.0, 0.0, 3.0, 0.0]
    """
    return [float(np.ptp(signal)), *map(float, harmonics(signal, len(ORDERS)))]


@dataclass(frozen=True, kw_only=True)
class FilePoint(Generic[File]):
    """A study of a file at one point; each study adds its operands, check and computation.

    Parameters
    ----------
    file : InputFile
    oils : mapping of str to Lubricant
        By the name or file in the parameter `oil`.
    films : mapping of str to FilmModel
        By the name or file in the field `film_field`.
    quick : bool
        Coarse, for a first look; for the studies that have it.
    """

    name: ClassVar[str]
    operands: ClassVar[Keys]
    quantities: ClassVar[tuple[Quantity, ...]]
    film_field: ClassVar[str]  # of the file, which names a film model
    film_kind: ClassVar[str]  # of its contact
    unused: ClassVar[tuple[str, ...]] = ()  # beginnings of fields that the study does not read

    file: File
    oils: Mapping[str, Lubricant] = field(default_factory=dict)
    films: Mapping[str, FilmModel] = field(default_factory=dict)
    quick: bool = False

    @property
    def subject(self) -> str:
        """Name of what is varied."""
        return str(getattr(self.file, "name", ""))

    @property
    def keys(self) -> Keys:
        """Fields of the file that the study reads, and the operands."""
        fields = file_keys(field_notes(type(self.file)))
        own = {name: one for name, one in fields.items() if not name.startswith(self.unused)}
        return {**own, **self.operands}

    @property
    def identity(self) -> str:
        """The file, the content of oil files and film models, and whether it is quick."""
        read = {name: content_hash(name) for name in self.oils}
        read |= {name: model.checksum for name, model in self.films.items()}
        return json.dumps([self.file.model_dump(mode="json"), read, self.quick], sort_keys=True)

    @property
    def usual_oils(self) -> tuple[str, ...]:
        """Oils where `oil` is not varied."""
        usual = self.operands["oil"].usual if "oil" in self.operands else None
        return (usual,) if isinstance(usual, str) else ()

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all files read that the values of the axes name, or the usual."""
        read = self.with_oils(str(one) for one in texts.get("oil", self.usual_oils))
        named = [str(one) for one in texts.get(self.film_field, ())]
        if (text := self._film_text(self.file)) is not None:
            named.append(text)
        films = {one: chosen_model(one, self.film_kind, self.film_field) for one in named}
        return replace(read, films={**self.films, **films})

    def _film_text(self, file: File) -> str | None:
        named: Any = file
        for part in self.film_field.split("."):
            named = getattr(named, part)
        return None if named is None else str(named)

    def film_model(self, file: File) -> FilmModel | None:
        """Return the film model that a variant of the file names; None: the one in the package."""
        text = self._film_text(file)
        if text is None:
            return None
        return self.films.get(text) or chosen_model(text, self.film_kind, self.film_field)

    def with_oils(self, names: Iterable[str]) -> Self:
        """Return the study with these oils read as well, by name or file."""
        return replace(self, oils={**self.oils, **{n: read_oil(n).lubricant for n in names}})

    def varied(self, point: Point) -> File:
        """Return the file with the fields of a point that are its own."""
        own = {name: one for name, one in point.items() if name not in self.operands}
        if not own:
            return self.file
        # one part has no tolerances; they need not be checked again for each
        return self.file.model_copy(update={"tolerances": {}}).varied(own)

    def scatter(self) -> tuple[Spread, ...]:
        """Return the spreads of the file's tolerances about its values."""
        tolerances = getattr(self.file, "tolerances", {})
        unread = [name for name in tolerances if name.startswith(self.unused)]
        if unread:
            raise ParameterError(
                f"The file has a tolerance of {unread[0]}, but the study {self.name} does not use "
                "this field. Remove the tolerance; `--keys` lists what can be varied."
            )
        return scatter_of(self.subject, tolerances, self.values())

    def values(self) -> dict[str, Any]:
        """Return the values of the file and the usual operands."""
        usual = {key.name: key.usual for key in self.operands.values()}
        return {**usual, **values_of(self.file.model_dump())}

    def oil(self, name: str) -> Lubricant:
        """Return an oil by its name or file."""
        held = self.oils.get(name)
        return read_oil(name).lubricant if held is None else held
