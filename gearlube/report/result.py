"""Results of studies: `.plot()` draws the first figure, `.report(folder)` writes the report."""

from __future__ import annotations

import math
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar, NamedTuple, Self

import xarray as xr
from xarray.plot.accessor import DatasetPlotAccessor

from gearlube.output.units import unit_of
from gearlube.report.page import write_report
from gearlube.report.pictures import save_picture
from gearlube_core.errors import ParameterError
from gearlube_core.units import ZERO_CELSIUS

_STUDY = "study"  # attribute of a dataset


class _Shown(NamedTuple):
    """What shows a dataset, each as module:name in gearlube.

    `figures` is a catalogue, or a function that returns a figure or a catalogue; `report` returns
    the report, if `pictured` with the pictures of the catalogue in a folder.
    """

    figures: str
    report: str = ""
    pictured: bool = False


# unit of a result, in the spelling of `unit_text`: SI unit, factor, offset
_SI = {
    "rpm": ("rad/s", math.pi / 30.0, 0.0),
    "degC": ("K", 1.0, ZERO_CELSIUS),
    "km/h": ("m/s", 1.0 / 3.6, 0.0),
    "h": ("s", 3600.0, 0.0),
    "ms": ("s", 1e-3, 0.0),
    "mm": ("m", 1e-3, 0.0),
    "um": ("m", 1e-6, 0.0),
    "kJ": ("J", 1e3, 0.0),
    "MPa": ("Pa", 1e6, 0.0),
    "GPa": ("Pa", 1e9, 0.0),
    "W/mm2": ("W/m2", 1e6, 0.0),
    "%": ("1", 0.01, 0.0),
}
_UNIT_IN_NAME = ("_kmh", "_rpm", "_degc")
_SHOWN = {
    "map": _Shown(
        "studies.loss_map.figures:first_figure", "studies.loss_map.report:loss_map_report"
    ),
    "cycle": _Shown(
        "studies.drive_cycle.figures:cycle_figure", "studies.drive_cycle.report:cycle_report"
    ),
    "sweep": _Shown(
        "studies.sweep.figures.catalogue:CATALOGUE", "studies.sweep.report:sweep_report"
    ),
    "runup": _Shown(
        "studies.runup.figures.catalogue:CATALOGUE", "studies.runup.report:report_of_one"
    ),
    "bearing": _Shown(
        "studies.bearing.figures:BEARING_CATALOGUE", "studies.bearing.report:bearing_report"
    ),
    "whine": _Shown("studies.whine.figures:whine_figure", "studies.whine.report:whine_report"),
    "ehl": _Shown(
        "studies.films.figures.catalogue:drawn_figures", "studies.films.report:film_report", True
    ),
    "contact": _Shown(
        "studies.contact.figures.catalogue:CONTACT_CATALOGUE",
        "studies.contact.run:contact_report",
        True,
    ),
    "design": _Shown(
        "studies.design.figures:DESIGN_CATALOGUE", "studies.design.run:design_report", True
    ),
    "optimise": _Shown(
        "studies.optimise.figures:drawn_figures", "studies.optimise.report:optimise_report", True
    ),
    "damage": _Shown("damage.figures:damage_figures", "damage.report:damage_report", True),
    "drivetrain": _Shown("studies.drivetrain.figures:power_figure"),
    "train run-up": _Shown("studies.drivetrain.ramp:waterfall_figure"),
    "train map": _Shown("studies.drivetrain.losses:loss_figure"),
    "train cycle": _Shown("studies.drivetrain.cycle:cycle_figure"),
}


class Result(xr.Dataset):
    """A dataset of a study, with its first figure and its report.

    It is an `xarray.Dataset` in all else; what `sel`, `isel` and the like return is a `Result` too.
    `plot.scatter` and the other methods of xarray's `plot` are there.

    Examples
    --------
    >>> losses = xr.Dataset(coords={"speed": ("speed", [3000.0], {"units": "rpm"})})
    >>> found = Result.of(losses, "map").si()["speed"]
    >>> found.values.round(1), found.attrs["units"]
    (array([314.2]), 'rad/s')
    """

    __slots__ = ()

    @classmethod
    def of(cls, dataset: xr.Dataset, study: str) -> Self:
        """Return a dataset of a study as its result."""
        found = cls(dataset.data_vars, dataset.coords, {**dataset.attrs, _STUDY: study})
        found.encoding = dataset.encoding
        return found

    @property
    def plot(self) -> Any:  # type: ignore[override]
        """The first figure of the study: `result.plot()` is a figure of matplotlib."""
        return _Plot(self)

    def si(self) -> xr.Dataset:
        """Return a dataset with all values in SI units, except those whose name has a unit."""
        found = xr.Dataset(self.data_vars, self.coords, self.attrs)
        for name, one in found.variables.items():
            unit, factor, offset = _SI.get(unit_of(one) or "", ("", 1.0, 0.0))
            if unit and not str(name).endswith(_UNIT_IN_NAME):
                changed = one.dims, one.values * factor + offset, {**one.attrs, "units": unit}
                assign = found.assign_coords if name in found.coords else found.assign
                found = assign({name: changed})
        return found

    def report(self, folder: str | Path) -> Path:
        """Write FOLDER/report.html as the command of the study does; return its path.

        What only the command knows is missing: its line, and of some studies the file's inputs.

        Raises
        ------
        ParameterError
            The study has no report of its own.
        """
        shown, folder = _SHOWN[self.attrs[_STUDY]], Path(folder)
        if not shown.report:
            raise ParameterError(
                "A result must be of a study with a report, got one part of a train. Call plot(); "
                "`gearlube drivetrain` reports all parts together."
            )
        if not shown.pictured:
            return write_report(_named(shown.report)(self), folder)
        (folder / "figures").mkdir(parents=True, exist_ok=True)
        for name, one in _catalogue(self).items():
            save_picture(_drawn(one, self), folder / "figures" / f"{name}.png")
        return write_report(_named(shown.report)(self, folder / "figures"), folder)


class _Plot(DatasetPlotAccessor):
    def __call__(self) -> Any:
        dataset: Any = self._ds
        return _drawn(next(iter(_catalogue(dataset).values())), dataset)


class WithResult:
    """Results whose field `shown` is a `Result`: its figure and its report are theirs."""

    __slots__ = ()
    shown: ClassVar[str]

    def plot(self) -> Any:
        """Return the first figure of the study, a figure of matplotlib."""
        return getattr(self, self.shown).plot()

    def report(self, folder: str | Path) -> Path:
        """Write FOLDER/report.html as the command of the study does; return its path."""
        path: Path = getattr(self, self.shown).report(folder)
        return path


def _catalogue(dataset: xr.Dataset) -> Mapping[str, Any]:
    """Return the figures of a dataset by name, drawn or as what draws them."""
    found = _named(_SHOWN[dataset.attrs[_STUDY]].figures)
    if callable(found):
        found = found(dataset)
    if isinstance(found, tuple):
        return {one.name: one for one in found}
    return found if isinstance(found, Mapping) else {"figure": found}


def _drawn(one: Any, dataset: xr.Dataset) -> Any:
    draw = getattr(one, "draw", one)  # a drawn figure has a method of that name, which needs more
    return draw(dataset) if callable(draw) and not hasattr(one, "savefig") else one


def _named(place: str) -> Any:
    module, name = place.split(":")
    return getattr(import_module(f"gearlube.{module}"), name)
