"""Results of a calibration: the axle file, values for its FMU, draws, figures and the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np
from scipy.stats import binom

from drivetrain.axle_file.axle_file import AxleFile, CarAxle
from drivetrain.axle_file.read_axle import read_axle
from fmu_src.axle_arguments import start_arguments
from fmu_src.variables import HYPOID_AXLE
from gearlube.output.csv_text import csv_text, number_text
from gearlube.output.toml_text import toml_text
from gearlube.plotting.figure_files import save_figure_folder
from gearlube.plotting.style import BLUE, GREY, house_style, new_figure
from gearlube.report.inputs import noted_inputs
from gearlube.report.measured_run import (
    Compared,
    comparison_with_measured,
    measured_figure,
    png_bytes,
    residuals_text,
)
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Number,
    Report,
    Table,
)
from gearlube.studies.calibrate.posterior import Posterior
from gearlube.studies.calibrate.run import BIAS, Calibration, axle_at, loss_torques
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.units import celsius_to_kelvin

_BEARING = ("pinion.bearing.", "gear.bearing.")
_VISCOSITIES = ("oil.viscosity_40_degc_mm2_s", "oil.viscosity_100_degc_mm2_s")
_SEALS = ("seals.pinion_torque_n_m", "seals.wheel_torque_n_m")
# fields of the axle file that are proportional to an input
_FIELDS = {
    "roughness": ("gear_set.roughness_rms_um",),
    "preload": tuple(f"{shaft}preload_n" for shaft in _BEARING),
    "rib_friction": tuple(f"{shaft}rib_boundary_friction" for shaft in _BEARING),
    "rib_roughness": tuple(f"{shaft}rib_roughness_um" for shaft in _BEARING),
    "bearing_drag": tuple(f"{shaft}{name}" for shaft in _BEARING for name in ("f0", "f1")),
    "seals": (*_SEALS, "seals.hub_torque_n_m"),
    "viscosity": _VISCOSITIES,
    "alpha": ("oil.alpha_per_gpa",),
    "eyring_stress": ("oil.eyring_stress_mpa",),
}
_INSTEAD = {  # fields that say the same in another way
    **dict(zip(_SEALS, ("seals.pinion_diameter_mm", "seals.wheel_diameter_mm"), strict=True)),
    **dict(zip(_VISCOSITIES, ("oil.walther_a", "oil.walther_b"), strict=True)),
}
_DRAWN = 200
_REPEATED = 0.02  # of the loss; scaled laws leave the torque of the teeth as it is, fields do not
_CONFLICT = 2.0  # standard deviations of the prior
_CHANCE = 0.02
_SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"


class WrittenAxle(NamedTuple):
    """The calibrated axle as a file.

    `factors` are those of inputs without a field, by name; `off` is the largest relative
    difference of its loss, with these factors, from that of the calibrated axle.
    """

    axle: CarAxle
    factors: dict[str, float]
    off: float


def write_calibration(
    found: Calibration, described: CarAxle, path: str, folder: Path
) -> WrittenAxle:
    """Write calibrated.toml, calibrated.ssv, draws.csv, residuals.csv and figures into a folder.

    `path` is that of the axle file or the name of a shipped one, `described` what it was read as.
    """
    written = _write_axle(found, described, path, folder / "calibrated.toml")
    _write_ssv(described, written.axle, folder / "calibrated.ssv")
    uncertain, names = found.settings.uncertain, found.settings.inputs
    rows = [
        [number_text(one.multiplier(float(z))) for one, z in zip(uncertain, draw, strict=True)]
        for draw in found.posterior.draws[:_DRAWN]
    ]
    write_text(csv_text([f"{name}_factor" for name in names], rows), folder / "draws.csv")
    write_text(residuals_text(_beside(found)), folder / "residuals.csv")
    figures = {"measured": measured_figure(_beside(found)), "inputs": inputs_figure(found)}
    save_figure_folder(figures, folder / "figures")
    return written


def inputs_figure(found: Calibration) -> Any:
    """Return how well each input is known before and after, as factors of its value."""
    uncertain, after = found.settings.uncertain, found.posterior
    rows = np.arange(len(uncertain), dtype=float)
    with house_style():
        figure = new_figure(7.6, 0.55 * rows.size + 1.6)
        ax = figure.subplots()
        for shift, colour, label, mean, sd in (
            (-0.12, GREY, "before", np.zeros(rows.size), np.ones(rows.size)),
            (0.12, BLUE, "after the measurements", after.mean, after.sd),
        ):
            ends = [_factors(uncertain, mean + side * sd) for side in (-2.0, 0.0, 2.0)]
            ax.hlines(rows + shift, ends[0], ends[2], color=colour, lw=4.0)
            ax.plot(ends[1], rows + shift, "o", color=colour, ms=6.0, label=f"{label}, with 95 %")
        ax.axvline(1.0, color="black", lw=0.8)
        ax.set_xscale("log")
        ticks = np.array([0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0])
        ticks = ticks[(ticks > ax.get_xlim()[0]) & (ticks < ax.get_xlim()[1])]
        ax.set_xticks(ticks, [f"{one:g}" for one in ticks])
        ax.minorticks_off()
        unseen = [" (not seen)" * bool(one) for one in after.unseen]
        ax.set_yticks(rows, [one.words + no for one, no in zip(uncertain, unseen, strict=True)])
        ax.set_ylim(rows[-1] + 0.5, -0.5)
        ax.set_xlabel("times its value in the axle file [-]")
        figure.legend(loc="outside lower center", ncols=2)
    return figure


def calibration_report(found: Calibration, written: WrittenAxle, axle: CarAxle) -> Report:
    """Return the report of a calibration."""
    compared = comparison_with_measured(_beside(found), "the calibrated axle")
    measured, settings = found.settings.measured, found.settings
    rms = 100.0 * float(np.sqrt(np.mean((measured.value / found.before - 1.0) ** 2)))
    figure = Figure(
        name="inputs",
        title="Inputs before and after",
        caption="Each bar holds 95 %. Where the blue bar is as long as the grey one, the "
        "measurements say nothing of the input.",
        picture=png_bytes(inputs_figure(found)),
    )
    return replace(
        compared,
        study="calibrate",
        title=f"Calibration of {axle.name}",
        subtitle=f"{len(settings.inputs)} inputs fitted to {measured.value.size} points of "
        f"{Path(measured.path).name}.",
        findings=_findings(found, written),
        numbers=[
            *compared.numbers,
            Number("rms before, over what is predicted", rms, "%"),
            Number("held-out points within the band of 90 %", 100.0 * found.inside, "%"),
        ],
        figures=[figure, *compared.figures],
        tables=[_inputs(found), *compared.tables],
        inputs=noted_inputs(axle.inputs),
        limits=(
            "Errors of points in common: the gain of the sensor with "
            f"{100.0 * settings.gain:g} %, its zero with {settings.offset:g} N·m, the model with "
            f"{100.0 * settings.model_error:g} %, alike at near torques (standard deviations).",
            "The factors of the inputs (k = 2) are taken as known before the measurements. What "
            "is not fitted is taken as exact.",
            *compared.limits[1:2],
        ),
        files=("calibrated.toml", "calibrated.ssv", "draws.csv", *compared.files),
    )


def _beside(found: Calibration) -> Compared:
    return Compared(
        measured=found.settings.measured,
        left_out="",
        predicted=found.after,
        low=found.low,
        high=found.high,
        swings={},
    )


def _ends(after: Posterior, uncertain: Sequence[Uncertain]) -> list[Array]:
    """Return factors at the mean, and at the lower and the upper end of 95 %."""
    return [_factors(uncertain, after.mean + side * after.sd) for side in (0.0, -2.0, 2.0)]


def _factors(uncertain: Sequence[Uncertain], normals: Array) -> Array:
    pairs = zip(uncertain, normals, strict=True)
    return np.array([one.multiplier(float(normal)) for one, normal in pairs])


def posterior_findings(after: Posterior, uncertain: Sequence[Uncertain]) -> list[Finding]:
    """Return what the measurements say of each input, and what they leave open."""
    words = {one.name: one.words for one in uncertain}
    means, lows, highs = _ends(after, uncertain)
    result = []
    for k, one in enumerate(uncertain):
        if after.unseen[k]:
            said = f"The data do not see the input {one.name} ({one.words})."
            kept = f"It keeps its value and its factor of {one.factor:g}."
            result.append(Finding(WARNING, said, kept))
            continue
        said = f"{one.words[0].upper()}{one.words[1:]}: {means[k]:.3g} times its value"
        result.append(Finding(NOTE, f"{said}, {lows[k]:.3g} to {highs[k]:.3g} with 95 %."))
        if abs(after.mode[k]) > _CONFLICT:
            said = f"The fit takes {one.name} {abs(after.mode[k]):.1f} standard deviations from"
            why = f"Its factor was {one.factor:g} ({one.why}). Another error may hide in it."
            result.append(Finding(WARNING, f"{said} what was known before.", why))
    for first, second, correlation, alike in after.confounded():
        known = "difference" if correlation > 0.0 else "sum"
        why = (
            f"{words[first]} and {words[second]} act alike on these points (correlation "
            f"{correlation:.2f}, collinearity {min(alike, 999.0):.0f}). Measure at other speeds "
            "and temperatures, or one of them by itself."
        )
        result.append(Finding(WARNING, f"{first} and {second}: {known} known, parts not.", why))
    others = int(np.sum(after.optima > after.optima.min() + 1e-3))
    if others:
        said = f"{others} of {after.optima.size} starts ended at another, worse fit."
        result.append(Finding(NOTE, said))
    if not after.reliable:
        why = (
            f"They count as {after.effective:.0f}, with Pareto k of {after.tail:.2f}; 1000 and 0.7 "
            "are the limits. Fit fewer inputs."
        )
        result.append(Finding(WARNING, "The draws of the inputs are not reliable.", why))
    return result


def _findings(found: Calibration, written: WrittenAxle) -> list[Finding]:
    inside = round(found.inside * found.held)
    believed = binom.cdf(inside, found.held, 0.9) >= _CHANCE
    said = f"{inside} of {found.held} held-out points lie in the band of 90 % that the others"
    why = "" if believed else "The model or the uncertainties miss something: see the residuals."
    result = [
        Finding(GOOD if believed else WARNING, f"{said} predict.", why),
        *posterior_findings(found.posterior, found.settings.uncertain),
    ]
    if found.bias > BIAS:
        said = f"The emulator is off by {found.bias:.2f} of the spread of the fit."
        result.append(Finding(WARNING, said, "Below a third is wanted. Give more --runs."))
    if written.factors:
        left = ", ".join(f"{name} {factor:.3g}" for name, factor in written.factors.items())
        said = f"The axle file has no field for {', '.join(written.factors)}."
        result.append(Finding(NOTE, said, f"Multiply by hand: {left}."))
    if written.off > _REPEATED:
        said = f"calibrated.toml is up to {100.0 * written.off:.2g} % off the calibrated axle."
        why = "A field of the axle file does not act as the input does."
        result.append(Finding(WARNING, said, why))
    return result


def _inputs(found: Calibration) -> Table:
    after, uncertain = found.posterior, found.settings.uncertain
    sides = _ends(after, uncertain)
    return Table(
        title="Inputs",
        columns=[
            Column("input"),
            Column("what it is"),
            Column("factor before"),
            *(Column(name) for name in ("times its value", "from", "to", "contraction")),
        ],
        rows=[
            [one.name, one.words, one.factor, *(float(s[k]) for s in sides), float(c)]
            for k, (one, c) in enumerate(zip(uncertain, after.contraction, strict=True))
        ],
        caption="From and to hold 95 %. The contraction is 1 less the square of the spread after "
        "over that before: below 0.3 the measurements do not see the input.",
    )


def _write_axle(found: Calibration, described: CarAxle, path: str, to: Path) -> WrittenAxle:
    settings, inputs = found.settings, found.posterior.seen_mean()
    file, here = AxleFile.given(path), Path(path).parent
    values = _values(file, described)
    changes: dict[str, Any] = {}
    for field in AxleFile.files:
        named = _field(file, field)
        if named and (here / named).is_file():
            changes[field] = str((here / named).resolve())
    left, kept = {}, inputs.copy()
    factors = _factors(settings.uncertain, inputs).tolist()
    for k, (name, factor) in enumerate(zip(settings.inputs, factors, strict=True)):
        fields = [one for one in _FIELDS.get(name, ()) if values.get(one)]
        if factor != 1.0 and fields:
            changes |= {one: float(f"{factor * values[one]:.7g}") for one in fields}
        elif factor != 1.0:
            left[name], kept[k] = factor, 0.0
    changes |= {
        other: None for field, other in _INSTEAD.items() if field in changes and _field(file, other)
    }
    data = file.varied(changes).model_dump(exclude_defaults=True)
    write_text("# Calibrated with measurements: gearlube calibrate\n" + toml_text(data), to)
    written = read_axle(to)
    wanted, scale = axle_at(settings, kept)
    loss = scale @ loss_torques(wanted, settings.measured)
    repeated = loss_torques(written.axle, settings.measured).sum(axis=0)
    return WrittenAxle(written, left, float(np.abs(repeated / loss - 1.0).max()))


def _field(file: AxleFile, field: str) -> Any:
    section, _, key = field.partition(".")
    return getattr(getattr(file, section), key)


def _values(file: AxleFile, described: CarAxle) -> dict[str, Any]:
    """Return the fields with their values, given or not, that an input may change."""
    own = file.oil.file is None  # the fields of an oil file are none of the axle file
    notes = [one for one in described.inputs if own or not one.field.startswith("oil.")]
    values = {note.field: note.value for note in notes}
    if own:
        oil = described.axle.oil
        for field, degc in zip(_VISCOSITIES, (40.0, 100.0), strict=True):
            values[field] = 1e6 * oil.dynamic_viscosity(celsius_to_kelvin(degc)) / oil.density
        values["oil.alpha_per_gpa"] = 1e9 * oil.alpha
        # a local one is no number
        values["oil.eyring_stress_mpa"] = 0.0 if oil.eyring_slope else 1e-6 * oil.eyring_stress
    if not described.axle.bearing_torque_loss.startswith("palmgren"):
        values |= dict.fromkeys(_FIELDS["bearing_drag"])
    return values


def _write_ssv(before: CarAxle, after: CarAxle, path: Path) -> None:
    """Write the parameters of the axle's FMU that changed as a file of SSP values."""
    names = {one.argument: one.name for one in HYPOID_AXLE if one.type == "Real" and one.argument}
    old, new = start_arguments(before.axle), start_arguments(after.axle)
    ElementTree.register_namespace("ssv", _SSV)
    root = ElementTree.Element(f"{{{_SSV}}}ParameterSet", version="1.0", name="calibrated")
    parameters = ElementTree.SubElement(root, f"{{{_SSV}}}Parameters")
    for argument, value in new.items():
        if argument in names and value != old.get(argument):
            one = ElementTree.SubElement(parameters, f"{{{_SSV}}}Parameter", name=names[argument])
            ElementTree.SubElement(one, f"{{{_SSV}}}Real", value=repr(float(value)))
    ElementTree.indent(root)
    write_text(ElementTree.tostring(root, encoding="unicode", xml_declaration=False) + "\n", path)
