"""The figures of a study of a helical pair, in reading order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure
from gearlube.report.numbers import number_text
from gearlube.report.pictures import Picture, save_picture
from gearlube.studies.helical.figures.friction import (
    film_on_lines,
    film_over_mesh,
    friction_force_harmonics,
    friction_harmonics,
)
from gearlube.studies.helical.figures.geometry import (
    contact_characteristics,
    contact_plane,
    lay_angles,
    relieved_lines,
    sliding_on_line,
    unmodified_lines,
)
from gearlube.studies.helical.figures.geometry_gaps import (
    crown_forms,
    equal_relief,
    facet_gaps,
    relief_gaps,
)
from gearlube.studies.helical.figures.layout import (
    PERIODS,
    cases,
    closed,
    mark_orders,
    stems,
    title,
)
from gearlube.studies.helical.figures.load_sharing import (
    harris_map,
    load_sharing,
    loaded_stiffness,
    spread,
)
from gearlube.studies.helical.figures.speed_sweep import (
    campbell,
    instability,
    order_cuts,
    separation,
)
from gearlube.studies.helical.pair_losses import in_operation
from gearlube_core.film_model.model import MOST_OUTSIDE
from gearlube_core.storage.atomic_file import write_figure

# each takes the datasets of `geometry_dataset` that are drawn side by side
GEOMETRY_CATALOGUE: dict[str, Callable[[Sequence[xr.Dataset]], Any]] = {
    "contact_plane": contact_plane,
    "lines_unmodified": unmodified_lines,
    "lines_relieved": relieved_lines,
    "contact_characteristics": contact_characteristics,
    "sliding_on_line": sliding_on_line,
    "crown_forms": crown_forms,
    "relief_gaps": relief_gaps,
    "equal_relief": equal_relief,
    "facet_gaps": facet_gaps,
    "lay_angles": lay_angles,
}

_NEEDED = {
    "sliding_on_line": "line_sliding",
    "crown_forms": "crown_form",
    "relief_gaps": "line_gap_by_form",
    "equal_relief": "relief_line",
    "lay_angles": "lay_pinion",
}

_MOST = 4
_MOTIONS = "u: shift of a gear; x along the line of action, y across it, z along the shaft."


def pair_losses(dataset: xr.Dataset) -> Any:
    """Return the loss torque over speed, a line for each torque, a panel for each temperature."""
    temperatures = spread(dataset["temperature"].values, _MOST)
    torques = spread(dataset["torque"].values, _MOST)
    banded = float(in_operation(dataset)["torque"]) if "loss_torque_low" in dataset else None
    with house_style():
        figure = new_figure(max(4.2 * len(temperatures) + 1.2, 6.4), 4.6)
        panels = np.atleast_1d(figure.subplots(1, len(temperatures), sharey=True))
        for ax, temperature in zip(panels, temperatures, strict=True):
            for row, torque in enumerate(torques):
                one = dataset.sel(temperature=temperature, torque=torque)
                colour = SERIES[row % len(SERIES)]
                ax.plot(
                    one["speed"],
                    one["loss_torque"],
                    color=colour,
                    marker=MARKERS[row % len(MARKERS)],
                    label=f"{torque:.4g} N·m",
                )
                if "by_formulas" in one:
                    by = one.where(one["by_formulas"] > 0)
                    hollow = {"color": "white", "marker": MARKERS[row % len(MARKERS)], "ls": ""}
                    ax.plot(by["speed"], by["loss_torque"], mec=colour, zorder=3, **hollow)
                if torque == banded:
                    ends = one["loss_torque_low"], one["loss_torque_high"]
                    look = {"color": colour, "alpha": 0.18, "lw": 0.0}
                    ax.fill_between(one["speed"], *ends, label="95 % of the draws", **look)
            ax.set(xlabel="pinion speed [rpm]", title=f"oil {temperature:g} °C")
        panels[0].set_ylim(bottom=0.0)  # of all panels, once all are drawn
        panels[0].set_ylabel("loss torque at the pinion [N·m]")
        handles, names = panels[0].get_legend_handles_labels()
        figure.legend(
            handles, names, title="pinion torque", ncols=_MOST, loc="outside lower center"
        )
        films = ""
        if "by_formulas" in dataset:
            films = (
                f"Solved films; hollow: formulas, more than {MOST_OUTSIDE:.0%} of load outside.\n"
            )
        figure.suptitle(
            f"Sliding and rolling of the teeth.\n{films}"
            f"Not modelled: {dataset.attrs['not_modelled']}.",
            fontsize=8.5,
        )
    return figure


def _amplitude(response: xr.Dataset, name: str, case: str, scale: float) -> Any:
    if f"{name}_harmonic" in response:
        return scale * response[f"{name}_harmonic"].sel(case=case).values
    base = response[f"{name.removesuffix('_rate')}_harmonic"].sel(case=case)
    speed = 2.0 * np.pi * response.attrs["mesh_frequency"] * response["harmonic"].values
    return scale * base.values * speed


def bearing_forces(response: xr.Dataset) -> Any:
    """Return the forces of the pinion's bearings. Compare [he_2007 fig. 7], in lbf."""
    rows = (
        ("F_xp", "$F_{x}$", 1.0, "N"),
        ("F_yp", "$F_{y}$", 1.0, "N"),
        ("F_zp", "$F_{z}$", 1.0, "N"),
    )
    return _histories(response, rows, "Forces of both bearings on the pinion")


def _histories(
    response: xr.Dataset, rows: tuple[tuple[str, str, float, str], ...], what: str
) -> Any:
    phase, order = response["phase"].values, response["harmonic"].values
    shown = cases(response)
    with house_style():
        figure = new_figure(10.0, 2.35 * len(rows) + 0.9)
        axes = figure.subplots(len(rows), 2, sharex="col", gridspec_kw={"width_ratios": (1.0, 1.2)})
        for (left, right), (name, symbol, scale, unit) in zip(axes, rows, strict=True):
            means = []
            sets = []
            for case, label, colour in shown:
                values = scale * response[name].sel(case=case).values
                x, y = closed(phase, values - values.mean())
                left.plot(x, y, color=colour, label=label, lw=1.3)
                means.append(number_text(float(values.mean())))
                sets.append((_amplitude(response, name, case, scale), colour, label))
            left.set_ylabel(f"{symbol} minus mean [{unit}]")
            if not name.endswith("_rate"):
                left.set_title(f"means {', '.join(means)} {unit}", fontsize=8.5, loc="right")
            stems(right, order, sets)
            mark_orders(right, response)
            right.set_ylabel(f"amplitude of {symbol} [{unit}]")
        axes[-1, 0].set(xlim=(0.0, 2.0), xlabel=PERIODS)
        axes[-1, 1].set_xlabel("mesh order n; dotted: natural frequencies")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside lower center")
        figure.suptitle(title(response, what), fontsize=11.0)
    return figure


def displacements(response: xr.Dataset) -> Any:
    """Return the pinion's translations. Compare [he_2007 fig. 6]."""
    rows = (
        ("u_xp", "$u_{xp}$", 1e6, "µm"),
        ("u_yp", "$u_{yp}$", 1e6, "µm"),
        ("u_zp", "$u_{zp}$", 1e6, "µm"),
    )
    return _histories(response, rows, "Displacements of the pinion")


# `needs` is the dataset of the study that a figure is drawn from
HELICAL_CATALOGUE: dict[str, Picture] = {
    "load_sharing": Picture(
        load_sharing,
        "Load sharing and highest pressure",
        "One tooth pair from entry to exit. Pressures beyond the axis come from sharp edges.",
        "contact",
    ),
    "harris_map": Picture(
        harris_map,
        "Loaded transmission error",
        "Its range and its mesh orders over the torque. Where they are smallest, the reliefs fit "
        "best.",
        "contact",
    ),
    "tooth_stiffness_loaded": Picture(
        loaded_stiffness,
        "Stiffness of the mesh and of its pairs",
        "From the loaded contact with elastic teeth. Its swing over the mesh excites vibration.",
        "contact",
    ),
    "campbell": Picture(
        campbell,
        "Campbell diagram of the bearing forces",
        "Lines: mesh orders. Dotted: natural frequencies. Large bright dots: loud. A resonance is "
        "where an order crosses a natural frequency and its dots grow.",
        "sweep",
    ),
    "order_cuts": Picture(
        order_cuts,
        "Mesh orders over speed",
        "Each order by itself, for several coefficients of friction and with the oil film.",
        "sweep",
    ),
    "displacements": Picture(
        displacements,
        "Motions at the operating point",
        f"Over two mesh periods. {_MOTIONS}",
        "response",
    ),
    "bearing_forces": Picture(
        bearing_forces,
        "Bearing forces at the operating point",
        "Forces that the gears pass on to the housing, and their mesh orders.",
        "response",
    ),
    "friction_harmonics": Picture(
        friction_harmonics,
        "Motions against friction",
        f"Mesh orders at one speed. {_MOTIONS}",
        "friction_sweep",
    ),
    "friction_force_harmonics": Picture(
        friction_force_harmonics,
        "Bearing forces against friction",
        "Mesh orders at one speed. Friction acts along y, across the line of action.",
        "friction_sweep",
    ),
    "instability": Picture(
        instability,
        "Parametric instability",
        "Red: small disturbances grow, because the stiffness varies. Blue: they die out.",
        "stability",
    ),
    "separation": Picture(
        separation,
        "Tooth separation",
        "Transmission error with teeth that can leave each other: its peak bends to lower speeds. "
        "Between two folds the motion depends on where the speed came from.",
        "separation",
    ),
    "film_on_lines": Picture(
        film_on_lines,
        "Film and friction of a tooth pair from entry to exit",
        "A pair enters on the left. Friction is zero on the dashed pitch line, where the teeth "
        "only roll.",
        "film",
    ),
    "film_over_mesh": Picture(
        film_over_mesh,
        "Friction over the mesh and over speed",
        "Green: oil film. Below: mean coefficient of friction and smallest film (Dowson 1968) over "
        "speed.",
        "film",
    ),
    "losses": Picture(
        pair_losses,
        "Losses of the pair",
        "Sliding and rolling of the teeth, at static loads. Band, at the torque in operation: 95 % "
        "of the draws of the uncertain data. Bearings, seals and churning are not included.",
        "losses",
    ),
}


def save_helical_figures(datasets: Mapping[str, xr.Dataset], directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files.

    Those of the geometry lie in `geometry`, those of pairs beside the one studied in `thesis`.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, one in HELICAL_CATALOGUE.items():
        if one.needs in datasets:
            path = directory / f"{name}.png"
            save_picture(one.draw(datasets[one.needs]), path)
            files.append(path)
    if "geometry" in datasets:
        files += save_geometry_figures([datasets["geometry"]], directory / "geometry")
    beside = [dataset for name, dataset in datasets.items() if name.startswith("geometry_")]
    if beside:
        files += save_geometry_figures(beside, directory / "thesis")
    return files


def drawn_datasets(name: str, datasets: Sequence[xr.Dataset]) -> list[xr.Dataset]:
    """Return those of the datasets that hold what a figure of the catalogue draws.

    None where it has no meaning for the pairs; their attribute `left_out` says why.
    """
    if name == "lines_relieved":
        return [dataset for dataset in datasets if dataset.sizes["relief"] > 1]
    needed = _NEEDED.get(name)
    return [dataset for dataset in datasets if needed is None or needed in dataset]


def save_geometry_figures(datasets: Sequence[xr.Dataset], directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files."""
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for name, draw in GEOMETRY_CATALOGUE.items():
        drawn = drawn_datasets(name, datasets)
        if drawn:
            path = directory / f"{name}.png"
            write_figure(draw(drawn), path)
            files.append(path)
    return files
