"""What the studies of one gear or bearing file have in common."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, Generic, Self, TypeVar

from gearlube.variation.design import Point, Spread, Value
from gearlube.variation.file_variants import content_hash
from gearlube.variation.keys import Keys, file_keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.scatter import scatter_of, values_of
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.oil_file import read_oil

File = TypeVar("File", bound=InputFile)


@dataclass(frozen=True, kw_only=True)
class FilePoint(Generic[File]):
    """A study of a file at one point; each study adds its operands, check and computation.

    Parameters
    ----------
    file : InputFile
    oils : mapping of str to Lubricant
        By the name or file in the parameter `oil`.
    quick : bool
        Coarse, for a first look; for the studies that have it.
    """

    name: ClassVar[str]
    operands: ClassVar[Keys]
    quantities: ClassVar[tuple[Quantity, ...]]
    unused: ClassVar[tuple[str, ...]] = ()  # beginnings of fields that the study does not read

    file: File
    oils: Mapping[str, Lubricant] = field(default_factory=dict)
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
        """The file, the content of oil files, and whether it is quick."""
        oils = {name: content_hash(name) for name in self.oils}
        return json.dumps([self.file.model_dump(mode="json"), oils, self.quick], sort_keys=True)

    @property
    def usual_oils(self) -> tuple[str, ...]:
        """Oils where `oil` is not varied."""
        usual = self.operands["oil"].usual if "oil" in self.operands else None
        return (usual,) if isinstance(usual, str) else ()

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all oils read that the values of the axes name, or the usual."""
        return self.with_oils(str(one) for one in texts.get("oil", self.usual_oils))

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
        return scatter_of(self.subject, tolerances, values_of(self.file.model_dump()))

    def oil(self, name: str) -> Lubricant:
        """Return an oil by its name or file."""
        held = self.oils.get(name)
        return read_oil(name).lubricant if held is None else held
