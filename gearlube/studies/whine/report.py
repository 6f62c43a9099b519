"""The report of a whine study: findings, figures, tables, inputs, limits."""

from __future__ import annotations

from textwrap import wrap
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.plotting.words import parameter_words, tolerance_words
from gearlube.report.charts import Axis, Line, heat_map, line_chart
from gearlube.report.inputs import file_inputs, origin_of, remark_findings
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Input,
    Number,
    Report,
    Table,
)
from gearlube.studies.whine.figures import most_moving, order_changes
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.units import rads_to_rpm

_RPM = rads_to_rpm(1.0)
_STRAIGHT = 0.3  # change over the amplitude above which a first-order change is only a hint
_NAMED = 3
_SPEED = Axis("pinion speed", "rpm")
_MICRO = 1e6
_LETTERS = 18  # of a line of a label, so that a phone has room for the map
_LIMITS = (
    "The pair turns with two degrees of freedom on rigid shafts and bearings; there is no flank "
    "friction. A car has more natural frequencies.",
    "Changes are to first order: those of a small error. A change of more than a third of the "
    "amplitude is a hint only.",
    "One torque, drive flanks. All teeth are equal.",
    "The mesh table has the orders that its positions resolve: fewer than half of them.",
)


class Mover(NamedTuple):
    """Largest change of one mesh order over the speeds by the tolerance of one parameter."""

    parameter: str
    tolerance: float
    unit: str
    change: float  # of the mesh force, with sign [N]
    speed_rpm: float  # where
    amplitude: float  # of the mesh force there [N]

    @property
    def words(self) -> str:
        """The parameter and its tolerance as sentences name them."""
        name = parameter_words(self.parameter).replace(": ", " ")
        return f"{name}, +{tolerance_words(self.tolerance, self.unit)}"


def movers(dataset: xr.Dataset, order: int) -> list[Mover]:
    """Return the parameters of a whine dataset, what moves the force of a mesh order most first.

    Parameters that move nothing, or at no speed, are left out.
    """
    part = dataset.sel(order=order)
    force, speed = part["force"].values, _RPM * part["pinion_speed"].values
    found = []
    for name in part["parameter"].values:
        one = part.sel(parameter=name)
        tolerance = float(one["tolerance"])
        change = tolerance * one["force_rate"].values
        if not np.any(np.abs(np.nan_to_num(change)) > 0.0):
            continue
        at = int(np.nanargmax(np.abs(change)))
        found.append(
            Mover(
                str(name),
                tolerance,
                str(one["unit"].values),
                float(change[at]),
                float(speed[at]),
                float(force[at]),
            )
        )
    return sorted(found, key=lambda one: -abs(one.change))


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a whine study, the most important first.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_whine/whine.nc"))[0].headline  # doctest: +SKIP
    'The largest mesh force is that of mesh order 1: 412 N, at 4100 rpm.'
    """
    return [_largest(dataset), *_moved(dataset), *_motions(dataset)]


def _crest(dataset: xr.Dataset, order: int) -> tuple[float, float]:
    """Return the largest force of an order [N] and its pinion speed [rpm]."""
    force = dataset["force"].sel(order=order).values
    at = int(np.nanargmax(force))
    return float(force[at]), float(_RPM * dataset["pinion_speed"].values[at])


def _largest(dataset: xr.Dataset) -> Finding:
    crests = {int(order): _crest(dataset, int(order)) for order in dataset["order"].values}
    order = max(crests, key=lambda one: crests[one][0])
    others = "; ".join(
        f"order {one}: {quantity_text(force, 'N')} at {speed:.0f} rpm"
        for one, (force, speed) in crests.items()
        if one != order
    )
    meets = meeting_speed(dataset, order)
    return Finding(
        NOTE,
        f"The largest mesh force is that of mesh order {order}: "
        f"{quantity_text(crests[order][0], 'N')}, at {crests[order][1]:.0f} rpm.",
        f"This order meets the natural frequency, {dataset.attrs['natural_frequency']:.0f} Hz, at "
        f"{meets:.0f} rpm. {others[:1].upper()}{others[1:]}{'.' if others else ''}",
    )


def meeting_speed(dataset: xr.Dataset, order: int) -> float:
    """Return the pinion speed [rpm] at which a mesh order meets the natural frequency."""
    attributes = dataset.attrs
    return float(60.0 * attributes["natural_frequency"] / (order * attributes["pinion_teeth"]))


def _moved(dataset: xr.Dataset) -> list[Finding]:
    found = []
    for order in dataset["order"].values:
        most = movers(dataset, int(order))
        if not most:
            continue
        top = most[0]
        share = abs(top.change) / top.amplitude
        next_ones = "; ".join(
            f"{one.words}: {quantity_text(one.change, 'N')} at {one.speed_rpm:.0f} rpm"
            for one in most[1:_NAMED]
        )
        detail = f"Next: {next_ones}. " if next_ones else ""
        if share > _STRAIGHT:
            detail += (
                f"It is a first-order change of {100.0 * share:.0f} % of the force there: sign "
                "and ranking are right, the size is a rough estimate. Halve "
                "the tolerance, or compute the "
                "changed pair."
            )
        found.append(
            Finding(
                WARNING if share > 1.0 else NOTE,
                f"Mesh order {order} is most sensitive to {top.words}: "
                f"{quantity_text(top.change, 'N')} at {top.speed_rpm:.0f} rpm, "
                f"{100.0 * share:.0f} % of its force.",
                detail.strip(),
            )
        )
    return found


def _motions(dataset: xr.Dataset) -> list[Finding]:
    missing = dataset["force"].isel(order=0).isnull().values
    unstable = ~missing & (dataset["stable"].values < 0.5)
    if not missing.any() and not unstable.any():
        return [Finding(GOOD, f"At all {missing.size} speeds the pair has a stable motion.")]
    speed = _RPM * dataset["pinion_speed"].values
    found = []
    for kept, words, cure in (
        (missing, "no periodic motion was found", "They are gaps in the figures."),
        (
            unstable,
            "the motion is not stable",
            "The real motion differs from the computed one there.",
        ),
    ):
        if kept.any():
            found.append(
                Finding(
                    WARNING,
                    f"At {int(kept.sum())} of {kept.size} speeds {words}, from "
                    f"{speed[kept].min():.0f} to {speed[kept].max():.0f} rpm.",
                    f"{cure} `gearlube resonance` follows all motions of such a pair.",
                )
            )
    return found


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers of a whine study, with the same names in every run."""
    found = [Number("natural frequency", float(dataset.attrs["natural_frequency"]), "Hz", 4)]
    for order in dataset["order"].values:
        force, speed = _crest(dataset, int(order))
        most = movers(dataset, int(order))
        error = 1e6 * float(dataset["transmission_error"].sel(order=order).max())
        found += [
            Number(f"largest mesh force, order {order}", force, "N"),
            Number(f"pinion speed of that force, order {order}", speed, "rpm", 4),
            Number(f"largest transmission error, order {order}", error, "µrad"),
            Number(
                f"largest change of the force by one tolerance, order {order}",
                abs(most[0].change) if most else float("nan"),
                "N",
            ),
        ]
    return found


def whine_report(dataset: xr.Dataset) -> Report:
    """Return the report of a whine study."""
    attributes = dataset.attrs
    speed = _RPM * dataset["pinion_speed"].values
    kind = attributes.get("kind", "hypoid")
    model = HypoidGearFile if kind == "hypoid" else HelicalGearFile
    file = model.model_validate_json(attributes["gear_file"])
    moved = "settings, reliefs and misalignments" if kind == "hypoid" else "reliefs and slopes"
    settings = [
        Input("pinion torque", f"{attributes['torque']:g}", "N·m", *origin_of("torque")),
        Input(
            "pinion speeds",
            f"{speed[0]:.0f} to {speed[-1]:.0f}, {speed.size} of them",
            "rpm",
            *origin_of("speeds_rpm"),
        ),
        Input(
            "positions of a mesh period", str(dataset.sizes["phase"]), "", *origin_of("positions")
        ),
    ]
    return Report(
        study="whine",
        title=f"Whine of the {kind} pair {attributes['name']}",
        subtitle=f"Mesh orders of the torsional pair at {attributes['torque']:g} N·m on the pinion "
        f"from {speed[0]:.0f} to {speed[-1]:.0f} rpm, and what {dataset.sizes['parameter']} "
        f"{moved} change of them.",
        findings=[*remark_findings(attributes), *findings(dataset)],
        numbers=numbers(dataset),
        figures=_figures(dataset),
        tables=[_table(dataset, int(order)) for order in dataset["order"].values],
        inputs=[*settings, *file_inputs(file)],
        limits=_LIMITS,
        files=("whine.nc", "whine.csv", "figures/whine.png"),
    )


def _figures(dataset: xr.Dataset) -> list[Figure]:
    force, error = (
        line_chart(_lines(dataset[name], scale), _SPEED, axis)
        for name, scale, axis in (
            ("force", 1.0, Axis("mesh force, amplitude", "N", log=True)),
            ("transmission_error", _MICRO, Axis("transmission error, amplitude", "µrad", log=True)),
        )
    )
    return [
        Figure(
            name="force",
            title="Mesh force over the speed",
            caption="Amplitudes of the mesh orders. A peak is where an order meets the natural "
            "frequency of the mesh.",
            chart=force,
        ),
        Figure(
            name="changes",
            title="What small errors change of the first order",
            caption="Change of the amplitude of mesh order 1 by a growth of each parameter by its "
            "tolerance; point at a cell to read it. Red: louder, blue: quieter. Parameters with "
            "the largest mean over the speeds are on top.",
            chart=_changes(dataset),
        ),
        Figure(
            name="transmission_error",
            title="Transmission error over the speed",
            caption="Amplitudes of the mesh orders of the moving pair, rotation of the pinion.",
            chart=error,
        ),
    ]


def _lines(values: xr.DataArray, scale: float) -> list[Line]:
    speed = _RPM * values["pinion_speed"].values
    return [
        Line(name=f"mesh order {order}", x=speed, y=scale * values.sel(order=order).values)
        for order in values["order"].values
    ]


def _changes(dataset: xr.Dataset) -> Any:
    shown = most_moving(dataset)
    changes = order_changes(dataset)[:, shown].T
    limit = float(np.nanmax(np.abs(changes))) or 1.0
    rows = np.arange(len(shown), dtype=float)
    names = [
        f"{parameter_words(str(part['parameter'].values))} "
        f"+{tolerance_words(float(part['tolerance']), str(part['unit'].values))}"
        for part in (dataset.isel(parameter=int(k)) for k in shown)
    ]
    chart = heat_map(
        _RPM * dataset["pinion_speed"].values,
        rows,
        changes,
        (_SPEED, Axis(""), Axis("change", "N")),
        limits=(-limit, limit),
        height=180 + 32 * len(shown),
    )
    chart.update_traces(
        colorscale="RdBu",
        reversescale=True,
        colorbar={
            "orientation": "h",
            "y": 1.0,
            "yanchor": "bottom",
            "title": {"side": "top"},
            "nticks": 5,
        },
        customdata=np.repeat(np.array(names)[:, None], changes.shape[1], axis=1),
        hovertemplate="%{customdata}: %{z:.3g} N at %{x:.0f} rpm<extra></extra>",
    )
    words = [parameter_words(str(dataset["parameter"].values[k])) for k in shown]
    labels = ["<br>".join(wrap(one, _LETTERS)) for one in words]
    chart.update_yaxes(tickvals=rows.tolist(), ticktext=labels, automargin=True)
    return chart


def _table(dataset: xr.Dataset, order: int) -> Table:
    return Table(
        title=f"What small errors change of mesh order {order}",
        caption="Largest change of the mesh force over the speeds, to first order, by a growth of "
        "the parameter by its tolerance; what changes most on top.",
        columns=(
            Column("parameter"),
            Column("grows by"),
            Column("change of the force", "N"),
            Column("at", "rpm", 4),
            Column("force there", "N"),
            Column("change", "%"),
        ),
        rows=[
            [
                parameter_words(one.parameter),
                tolerance_words(one.tolerance, one.unit),
                one.change,
                one.speed_rpm,
                one.amplitude,
                100.0 * one.change / one.amplitude,
            ]
            for one in movers(dataset, order)
        ],
        folded=order != int(dataset["order"][0]),
    )
