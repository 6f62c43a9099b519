"""The shipped e-axle on elastic shafts, with as many modes as a test asks for."""

from __future__ import annotations

import tomllib
from functools import cache

from drivetrain.train.train_file import TrainCase, TrainFile


def case(name: str = "e_axle_elastic", **of_elastic: float) -> TrainCase:
    data = tomllib.loads(TrainFile.shipped_text(name))
    for body in data["bodies"].values():
        if body.get("kind"):
            body |= of_elastic
    for mesh in ("stage_1", "stage_2"):  # the other model has neither
        data["elements"][mesh] |= {"stiffness_waves": [], "friction": 0.0}
    return TrainFile.from_data(data, "file").case()


@cache
def whole() -> TrainCase:
    """Return the axle with one element between nodes, and all modes."""
    found = case(highest_frequency_hz=1e6, longest_element_mm=1000.0)
    found.start()
    return found
