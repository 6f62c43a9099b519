"""What the studies of an axle have in common."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from gearlube.variation.design import Spread, Value
from gearlube.variation.file_variants import AxleVariants, axle_keys, files_named
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.scatter import scatter_of


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
        if not file.tolerances:
            return scatter_of(file.name, {}, {})
        notes = self.axle.car_axle({}, notes=True).inputs
        return scatter_of(file.name, file.tolerances, {note.field: note.value for note in notes})
