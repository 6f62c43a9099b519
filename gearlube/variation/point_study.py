"""What a variation asks of a study, and a block of its points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from gearlube.variation.design import Design, Point, Spread, Value
from gearlube.variation.keys import Keys
from gearlube_core.arrays import Array
from gearlube_core.errors import GearLubeError, is_of_machine
from gearlube_core.storage.process_pool import single_threaded

FINISHED, FAILED = 1, 0
MISSING = -1  # not computed, or lost to the machine: the next run computes it


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


class Block(NamedTuple):
    """Results of neighbouring points.

    values has the shape (points, quantities).
    """

    values: Array
    status: NDArray[np.int8]
    messages: list[str]


def computed_block(study: PointStudy, design: Design, block: int, number: int) -> Block:
    """Return the results of the points of block `number`, each `block` long.

    A point that fails has a row of NaN and the reason; its status is MISSING where the reason is
    memory, disk or the program.
    """
    points = range(number * block, min((number + 1) * block, design.size))
    values = np.full((len(points), len(study.quantities)), np.nan)
    status = np.full(len(points), FAILED, dtype=np.int8)
    messages = [""] * len(points)
    with single_threaded():
        for row, point in enumerate(points):
            try:
                values[row] = study.compute(design.point(point))
                status[row] = FINISHED
            except Exception as error:
                known = isinstance(error, GearLubeError)
                messages[row] = str(error) if known else f"{type(error).__name__}: {error}"
                status[row] = MISSING if is_of_machine(error) else FAILED
    return Block(values, status, messages)
