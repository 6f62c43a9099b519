"""The studies that can be varied, by their names."""

from __future__ import annotations

from gearlube.variation.design import Design, Spread
from gearlube.variation.file_variants import AxleVariants
from gearlube.variation.point_study import PointStudy
from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError

# each study's file, where none is given
SHIPPED = {
    "map": "mohammadpour_2015",
    "sweep": "mohammadpour_2015",
    "cycle": "mohammadpour_2015",
    "bearing": "wingertszahn_2023",
    "helical": "he_2007",
    "contact": "mohammadpour_2015",
    "resonance": "mohammadpour_2015",
}
STUDIES = tuple(SHIPPED)
OF_AXLE = ("map", "sweep", "cycle")  # their file is an axle file
_QUICK = ("sweep", "helical", "contact", "resonance")


def point_study(name: str, file: str | None = None, *, quick: bool = False) -> PointStudy:
    """Return a study that `run_variation` can run at many points, of a file or of the shipped one.

    Parameters
    ----------
    name : {"map", "sweep", "cycle", "bearing", "helical", "contact", "resonance"}
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
