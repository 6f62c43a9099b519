"""The studies that can be varied, what a variation asks of them, and a block of their points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from gearlube.variation.design import Design, Point, Spread, Value
from gearlube.variation.file_variants import AxleVariants
from gearlube.variation.keys import Keys
from gearlube_core.arrays import Array
from gearlube_core.checks import check_option
from gearlube_core.errors import GearLubeError, ParameterError, is_of_machine
from gearlube_core.storage.process_pool import single_threaded

FINISHED, FAILED = 1, 0
MISSING = -1  # not computed, or lost to the machine: the next run computes it
# each study's file, where none is given
SHIPPED = {
    "map": "mohammadpour_2015",
    "sweep": "mohammadpour_2015",
    "whine": "mohammadpour_2015",
    "cycle": "mohammadpour_2015",
    "bearing": "wingertszahn_2023",
    "helical": "he_2007",
    "contact": "mohammadpour_2015",
    "resonance": "mohammadpour_2015",
}
STUDIES = tuple(SHIPPED)
OF_AXLE = ("map", "sweep", "whine", "cycle")  # their file is an axle file
_QUICK = ("sweep", "whine", "helical", "contact", "resonance")


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
        """Names of all parameters that can be varied."""
        ...

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """Quantities that `compute` returns, in this order."""
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

    def values(self) -> Mapping[str, Any]:
        """Return the values about which parameters scatter, by name."""
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


def point_study(name: str, file: str | None = None, *, quick: bool = False) -> PointStudy:
    """Return a study that `run_variation` can run at many points, of a file or of the shipped one.

    Parameters
    ----------
    name : {"map", "sweep", "whine", "cycle", "bearing", "helical", "contact", "resonance"}
    file : str, optional
        Axle, bearing or gear file, or a mesh table for resonance; or the name of a shipped one.
    quick : bool
        True: short records of the sweep; coarse teeth and few positions or frequencies of gear
        pairs.

    Examples
    --------
    >>> point_study("map").quantities[0]
    Quantity(name='loss', unit='W', meaning='total power lost')
    """
    check_option("STUDY", name, STUDIES)
    if quick and name not in _QUICK:
        raise ParameterError(
            f"--quick is only for {', '.join(_QUICK)}, not for {name}. Leave it out."
        )
    file = SHIPPED[name] if file is None else file
    if name == "bearing":
        from gearlube.variation.points.bearing import BearingPoint
        from gearlube_core.bearings.bearing_file import BearingFile

        return BearingPoint(file=BearingFile.given(file)).prepared({})
    if name == "helical":
        from gearlube.variation.points.helical import HelicalPoint
        from gearlube_core.helical_geometry.gear_file import HelicalGearFile

        return HelicalPoint(file=HelicalGearFile.given(file), quick=quick).prepared({})
    if name == "contact":
        from gearlube.variation.points.contact import ContactPoint
        from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

        return ContactPoint(file=HypoidGearFile.given(file), quick=quick)
    if name == "resonance":
        from gearlube.variation.points.resonance import ResonancePoint

        return ResonancePoint(table=file, quick=quick).prepared({})
    axle = AxleVariants.read(file)
    if name == "sweep":
        from gearlube.variation.points.march import MarchPoint

        return MarchPoint(axle=axle, quick=quick)
    if name == "whine":
        from drivetrain.axle_file.read_axle import gear_file_of
        from gearlube.variation.points.whine import WhinePoint

        return WhinePoint(axle=axle, gears=gear_file_of(file), quick=quick).prepared({})
    if name == "cycle":
        from gearlube.variation.points.cycle import CyclePoint

        return CyclePoint(axle=axle)
    from gearlube.variation.points.losses import LossPoint

    return LossPoint(axle=axle)


def scatter(study: PointStudy) -> tuple[Spread, ...]:
    """Return the spreads of the tolerances in a study's file about the values of its fields.

    Raises
    ------
    ParameterError
        There are no tolerances, or a field has no value to scatter about.

    Examples
    --------
    >>> from gearlube.variation.points.of_file import FilePoint
    >>> study = point_study("bearing")
    >>> assert isinstance(study, FilePoint)
    >>> tolerances = {"rib.roughness_um": {"plus_minus": 0.03}}
    >>> study = type(study)(file=study.file.varied({"tolerances": tolerances}))
    >>> scatter(study)[0].key
    'rib.roughness_um'
    """
    return study.scatter()


def prepared(study: PointStudy, design: Design) -> PointStudy:
    """Return the study with all files that the points of a design name, read.

    Raises
    ------
    ParameterError, TableError
        A file is missing or wrong.
    """
    return study.prepared({axis.key: axis.values for axis in design.axes})
