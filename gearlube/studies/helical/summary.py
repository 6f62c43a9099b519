"""Main numbers of a study of a helical pair, as rows of quantity, value and unit."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.studies.helical.figures.load_sharing import spread
from gearlube.studies.helical.pair_losses import in_operation
from gearlube.studies.helical.settings import RPM, SHOWN_MU
from gearlube.studies.helical.stages import HelicalResults

MOST_POINTS = 12  # of the losses
_MOTIONS = ("delta_z", "u_xp", "u_yp", "u_zp")
_FORCES = ("F_xp", "F_yp", "F_zp")


class Row(NamedTuple):
    """One number of the summary."""

    topic: str
    quantity: str
    value: float
    unit: str


def summary_rows(results: HelicalResults) -> list[Row]:
    """Return the numbers of a study in the order of its stages."""
    pair, found = results.settings.file.helical_pair(), results.datasets
    rows = [
        Row("pair", "transverse contact ratio", pair.transverse_contact_ratio, "1"),
        Row("pair", "overlap ratio", pair.overlap_ratio, "1"),
        Row("pair", "total contact ratio", pair.total_contact_ratio, "1"),
    ]
    for name, of in (
        ("contact", _contact),
        ("response", _response),
        ("sweep", _sweep),
        ("stability", _stability),
        ("separation", _separation),
        ("film", _film),
        ("losses", _losses),
    ):
        if name in found:
            rows += of(found[name])
    return [row for row in rows if math.isfinite(row.value)]  # a study may lack a number


def remarks(results: HelicalResults) -> list[str]:
    """Return warnings about the results, one sentence each."""
    found, sentences = results.datasets, []
    if results.settings.file.completed:
        fields = ", ".join(results.settings.file.completed)
        sentences.append(f"Not in the pair's source, completed: {fields}.")
    if "contact" in found and found["contact"].attrs["iso_outside"] != "none":
        sentences.append(f"ISO 6336-1 does not hold here: {found['contact'].attrs['iso_outside']}.")
    return sentences


def summary_csv(rows: list[Row]) -> str:
    """Return rows as comma-separated text with a header."""
    return csv_text(
        Row._fields, ([row.topic, row.quantity, f"{row.value:.6g}", row.unit] for row in rows)
    )


def _contact(contact: xr.Dataset) -> list[Row]:
    torque = contact.attrs["pinion_torque"]
    at = contact.sel(torque=torque, method="nearest")
    where = f"at {float(at['torque']):.4g} N.m"
    mean = float(at["K"].mean())
    return [
        Row("loaded contact", f"mean mesh stiffness along x, secant, {where}", mean, "N/m"),
        Row(
            "loaded contact",
            f"mean mesh stiffness along x, tangent, {where}",
            float(at["K_tangent"].mean()),
            "N/m",
        ),
        Row(
            "loaded contact",
            "ISO 6336-1 mesh stiffness along x",
            contact.attrs["iso_mesh_stiffness"],
            "N/m",
        ),
        Row(
            "loaded contact",
            f"secant stiffness, range over mean, {where}",
            float((at["K"].max() - at["K"].min()) / mean),
            "1",
        ),
        Row(
            "loaded contact",
            f"transmission error, peak to peak, {where}",
            float(at["transmission_error_ptp"]),
            "m",
        ),
        Row(
            "loaded contact",
            f"highest share outside the plane of contact, {where}",
            float(at["corner_share"].max()),
            "1",
        ),
    ]


def _response(response: xr.Dataset) -> list[Row]:
    rows = [
        Row(
            "operating point",
            "mean mesh stiffness along x, of the vibrating pair",
            response.attrs["mean_mesh_stiffness"],
            "N/m",
        )
    ]
    for case in response["case"].values:
        at, label = response.sel(case=case), _case(str(case))
        for names, unit in ((_MOTIONS, "m"), (_FORCES, "N")):
            for name in names:
                swing = float(np.ptp(at[name].values))
                rows.append(Row("operating point", f"{name} peak to peak, {label}", swing, unit))
        rows.append(
            Row("operating point", f"friction power, {label}", float(at["friction_power"]), "W")
        )
    return rows


def _case(label: str) -> str:
    return "oil film" if label == "film" else f"mu {label}"


def _sweep(sweep: xr.Dataset) -> list[Row]:
    at = sweep.sel(mu=SHOWN_MU[-1], method="nearest")
    rows = []
    for name, unit in (("delta_z", "m"), ("F_xp", "N"), ("F_yp", "N"), ("F_zp", "N")):
        order = at[f"{name}_harmonic"].sel(harmonic=1)
        if not np.isfinite(order).any():
            continue
        top = int(np.nanargmax(order))
        where = f"first mesh order of {name}, mu {float(at['mu']):g}"
        rows.append(Row("speed sweep", f"largest {where}", float(order[top]), unit))
        rows.append(
            Row(
                "speed sweep",
                f"speed of the largest {where}",
                float(sweep["speed"][top] / RPM),
                "rpm",
            )
        )
    margin = float(sweep["stability_margin"].min())
    return [*rows, Row("speed sweep", "least 1 - |Floquet multiplier|", margin, "1")]


def _stability(stability: xr.Dataset) -> list[Row]:
    rows = []
    for name, words in (
        ("growth_variation", "with the pair's damping"),
        ("growth_variation_light", "with light damping"),
    ):
        unstable = (stability[name] > 0.0).any("mesh_frequency").values
        first = stability["variation"].values[unstable]
        if first.size:
            what, factor = "least factor on the mesh variation that is unstable", first[0]
        else:
            what, factor = "stable up to the largest factor", stability["variation"].values[-1]
        rows.append(Row("stability", f"{what}, {words}", float(factor), "1"))
    return rows


def _separation(separation: xr.Dataset) -> list[Row]:
    rows = []
    for ratio in separation["damping"].values:
        at, where = separation.sel(damping=ratio), f"damping ratio {ratio:g}"
        apart = float(np.nanmax(at["separation_share"]))
        top = float(np.nanmax(at["peak_to_peak"]))
        rows.append(Row("separation", f"largest delta_z peak to peak, {where}", top, "m"))
        rows.append(Row("separation", f"longest time without contact, {where}", apart, "1"))
        folds = (at["special_kind"] == "fold").sum()
        rows.append(Row("separation", f"folds of the branch, {where}", float(folds), "1"))
    return rows


def _film(film: xr.Dataset) -> list[Row]:
    return [
        Row(
            "oil film",
            "constant coefficient of friction of the same loss",
            film.attrs["operating_mean_coefficient"],
            "1",
        ),
        Row("oil film", "power loss, static loads", film.attrs["operating_power_loss"], "W"),
        Row("oil film", "loss factor H_V", film.attrs["loss_factor"], "1"),
        *_solved(film),
    ]


def losses_rows(losses: xr.Dataset, most: int = MOST_POINTS) -> list[xr.Dataset]:
    """Return all points of the losses; of more than `most`, some at the torque in operation."""
    if losses["efficiency"].size > most:
        own = in_operation(losses)
        losses = losses.sel(temperature=[own["temperature"]], torque=[own["torque"]])
        speeds = spread(losses["speed"].values, most - 1)
        losses = losses.sel(speed=np.union1d(speeds, own["speed"]))
    points = losses.stack(point=("temperature", "torque", "speed"))
    return [points.isel(point=i) for i in range(points.sizes["point"])]


def loss_model(one: xr.Dataset) -> str:
    """Return by what the loss of a point is, with the share of load that solved films cover."""
    if "share_outside" not in one:
        return "formulas"
    model = "formulas" if float(one["by_formulas"]) else "solved films"
    return f"{model} ({100.0 * (1.0 - float(one['share_outside'])):.3g} % of the load covered)"


def _losses(losses: xr.Dataset) -> list[Row]:
    return [
        Row(
            "losses",
            f"power lost at {float(one['torque']):.4g} N.m, {float(one['speed']):.0f} rpm, "
            f"{float(one['temperature']):.4g} degC, by {loss_model(one)}",
            float(one["loss"].sum()),
            "W",
        )
        for one in losses_rows(losses)
    ]


def _solved(film: xr.Dataset) -> list[Row]:
    of = film.attrs
    if of.get("film_model") != "solved":
        return []
    return [
        Row("oil film", "bound of the power loss", of["operating_power_loss_bound"], "W"),
        Row("oil film", "bound of the efficiency", of["operating_efficiency_bound"], "1"),
        Row("oil film", "load outside the film model", of["operating_share_outside"], "1"),
    ]
