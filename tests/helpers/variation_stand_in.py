"""A study without physics, to test the bookkeeping of variations."""

import os
import time
from dataclasses import dataclass
from pathlib import Path

from gearlube.variation.keys import Key
from gearlube.variation.point_study import Quantity
from gearlube_core.checks import check_within
from gearlube_core.errors import ConvergenceError

WIDTH = Key("width_mm", "number", "mm", "Of the tooth", "operand", 10.0, 0.0, 1e3)
LENGTH = Key("length_mm", "number", "mm", "Of the tooth", "operand", 2.0)
SHAPE = Key("shape", "text", "", "Of the tooth", "operand", "straight")


@dataclass(frozen=True, kw_only=True)
class AreaStudy:
    """area = width times length; at some widths it fails, is lost, kills or stops."""

    fails_at: float | None = None
    dies_at: float | None = None  # while `folder` has no file "died"
    stops_at: float | None = None  # likewise
    loses_at: float | None = None  # likewise, with this error
    error: type[Exception] = MemoryError
    folder: Path = Path()
    seconds: float = 0.0
    extra: int = 0  # more quantities
    name: str = "area"
    subject: str = "tooth"
    block: int = 4
    shown: tuple[str, ...] = ("area",)

    @property
    def keys(self):
        return {key.name: key for key in (WIDTH, LENGTH, SHAPE)}

    @property
    def quantities(self):
        more = [Quantity(f"extra_{i}", "1", "nothing") for i in range(self.extra)]
        return (Quantity("area", "mm2", "area"), Quantity("width", "mm", "width"), *more)

    @property
    def identity(self):
        return f"{self.fails_at}"

    def prepared(self, texts):
        return self

    def check(self, point):
        check_within("length_mm", point.get("length_mm", 2.0), 0.0, 100.0, "mm", "Make it shorter.")

    def compute(self, point):
        width, length = point.get("width_mm", 10.0), point.get("length_mm", 2.0)
        time.sleep(self.seconds)
        mark = self.folder / "died"
        if width == self.fails_at:
            raise ConvergenceError(f"no tooth is {width:g} mm wide")
        if width == self.dies_at and not mark.exists():
            mark.touch()
            os._exit(9)
        if width == self.loses_at and not mark.exists():
            mark.touch()
            raise self.error("no room")
        if width == self.stops_at and not mark.exists():
            mark.touch()
            raise KeyboardInterrupt
        return (width * length, width, *([0.5] * self.extra))
