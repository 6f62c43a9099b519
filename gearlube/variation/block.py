"""Computing a block of points, in any process."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlube.variation.design import Design
from gearlube.variation.point_study import PointStudy
from gearlube_core.arrays import Array
from gearlube_core.errors import GearLubeError, is_of_machine
from gearlube_core.storage.process_pool import single_threaded

FINISHED, FAILED = 1, 0
MISSING = -1  # not computed, or lost to the machine: the next run computes it


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
