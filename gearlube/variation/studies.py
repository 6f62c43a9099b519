"""The studies that can be varied, by their names."""

from __future__ import annotations

from dataclasses import replace

from gearlube.variation.design import Design, Spread
from gearlube.variation.file_variants import AxleVariants, files_named
from gearlube.variation.point_study import PointStudy
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

STUDIES = ("map", "sweep", "cycle", "bearing")
_AXLE, _BEARING = "mohammadpour_2015", "wingertszahn_2023"


def point_study(name: str, file: str | None = None, *, quick: bool = False) -> PointStudy:
    """Return a study of a file, or of the shipped one.

    Parameters
    ----------
    name : {"map", "sweep", "cycle", "bearing"}
    file : str, optional
        Axle file or bearing file, or the name of a shipped one.
    quick : bool
        Short records of the sweep.

    Examples
    --------
    >>> point_study("map").quantities[0]
    Quantity(name='loss', unit='W', meaning='power lost in all')
    """
    check_option("STUDY", name, STUDIES)
    if quick and name != "sweep":
        raise ParameterError(f"--quick is for the sweep, got it with {name}. Leave it out.")
    if name == "bearing":
        from gearlube.variation.points.bearing import BearingPoint
        from gearlube_core.bearings.bearing_file import BearingFile

        return BearingPoint(file=BearingFile.given(file or _BEARING)).with_oils(())
    axle = AxleVariants.read(file or _AXLE)
    if name == "sweep":
        from gearlube.variation.points.march import MarchPoint

        return MarchPoint(axle=axle, quick=quick)
    if name == "cycle":
        from gearlube.variation.points.cycle import CyclePoint

        return CyclePoint(axle=axle)
    from gearlube.variation.points.losses import LossPoint

    return LossPoint(axle=axle)


def scatter(study: PointStudy) -> tuple[Spread, ...]:
    """Return the spreads of the tolerances in a study's axle file; see `scatter_of`."""
    from gearlube.variation.points.bearing import BearingPoint
    from gearlube.variation.scatter import scatter_of

    axle = getattr(study, "axle", None)
    if isinstance(study, BearingPoint) or axle is None:
        raise ParameterError(
            "--scatter is for axle files, got it with a bearing file, which has no tolerances. "
            "Give the ranges by --vary KEY=low:high."
        )
    return scatter_of(axle)


def prepared(study: PointStudy, design: Design) -> PointStudy:
    """Return the study with all files that the points of a design name, read.

    Raises
    ------
    ParameterError, TableError
        A file is missing or wrong.
    """
    from gearlube.variation.points.bearing import BearingPoint
    from gearlube.variation.points.cycle import CYCLE, CyclePoint
    from gearlube.variation.points.losses import LossPoint
    from gearlube.variation.points.march import MarchPoint

    texts = {axis.key: axis.values for axis in design.axes}
    if isinstance(study, BearingPoint):
        return study.with_oils(str(one) for one in texts.get("oil", ()))
    if not isinstance(study, LossPoint | MarchPoint | CyclePoint):
        return study
    axle = study.axle.with_files(files_named(texts))
    if isinstance(study, CyclePoint):
        study = study.with_cycles(str(one) for one in texts.get(CYCLE.name, (CYCLE.usual,)))
    return replace(study, axle=axle)
