"""What a variation asks of a study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol, Self

from gearlube.variation.design import Point, Spread, Value
from gearlube.variation.keys import Keys


class Quantity(NamedTuple):
    """A number that a study gives at each point."""

    name: str
    unit: str
    meaning: str


class PointStudy(Protocol):
    """A study at one point; workers get a copy of it, so it must be possible to pickle it."""

    @property
    def name(self) -> str:
        """As typed after `gearlube vary`."""
        ...

    @property
    def subject(self) -> str:
        """Name of what is varied."""
        ...

    @property
    def block(self) -> int:
        """Usual number of points that a worker computes and keeps together: seconds of work."""
        ...

    @property
    def shown(self) -> tuple[str, ...]:
        """Quantities of the figures, the most important first."""
        ...

    @property
    def keys(self) -> Keys:
        """What can be varied."""
        ...

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """What `compute` returns, in this order."""
        ...

    @property
    def identity(self) -> str:
        """Everything beside the design that decides the results, as text."""
        ...

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all files read that points name, by the values of the axes."""
        ...

    def scatter(self) -> tuple[Spread, ...]:
        """Return the spreads of the tolerances in the file; raise ParameterError without any."""
        ...

    def check(self, point: Point) -> None:
        """Raise ParameterError or TableError where a point is wrong; quick."""
        ...

    def compute(self, point: Point) -> Sequence[float]:
        """Return the quantities at a point; raise GearLubeError where it fails."""
        ...
