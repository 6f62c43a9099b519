"""Draw and tabulate the whole marches on the columns of the thesis, for 32, 64 and 128 rows.

python -m docs.rough_line_contact.whole_marches [FOLDER]: seconds, from the marches that `marches`
has finished there. Draws docs/images/rough_rows.png, and prints what the filters leave
of the profiles, too.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from docs.page import IMAGES, begin
from docs.rough_line_contact.marches import VARIANTS, case_of, filtered, folder_of
from gearlube.plotting.style import SERIES, house_style, new_figure

ROWS = (32, 64, 128)
ROUGH = 2888  # steps until the whole contact is rough
GIGAPASCAL, NANOMETRE = 1e9, 1e-9


def label_of(rows: int) -> str:
    """Return how a march is named in figures and tables."""
    more = VARIANTS[f"his columns, {rows} rows"][1]
    return f"{rows} rows, waves from {more['surface_1.cutoff_um']:g} µm"


def pressures(found: dict[int, xr.Dataset]) -> Any:
    """Draw the largest pressure over the step, as figure 7.18 of the thesis."""
    with house_style():
        figure = new_figure(8.0, 4.4)
        ax = figure.subplots()
        for k, (rows, run) in enumerate(found.items()):
            ax.plot(run["pressure_max"] / GIGAPASCAL, color=SERIES[k], lw=1.2, label=label_of(rows))
        ax.axvline(ROUGH, color="0.4", lw=0.8, ls="--")
        ax.text(ROUGH + 30, 0.15, "rough everywhere", color="0.3", fontsize=8.5)
        ax.set(xlabel="time step", ylabel="largest pressure [GPa]", ylim=(0.0, None))
        ax.margins(x=0.0)
        ax.legend(loc="upper left")
        ax.set_title("More rows resolve shorter waves, and these carry the peaks of pressure")
    return figure


def table(found: dict[int, xr.Dataset]) -> list[str]:
    """Return the lines of a table: pressures, films, contact and work of each march."""
    words = (
        "march",
        "largest pressure at step 2500",
        f"the same after {ROUGH}, least and largest",
        "smallest film",
        "zone below 10 nm",
        "load on solids, least and largest",
        "steps not converged",
        f"Newton, Krylov after {ROUGH}",
    )
    lines = [" | ".join(words)]
    for rows, run in found.items():
        rough = run.isel(time=slice(ROUGH, None))
        peak, solid = rough["pressure_max"].values / GIGAPASCAL, 100.0 * rough["solid_share"].values
        zone = 100.0 * float(rough["contact_share"].sel(threshold=10e-9, method="nearest").mean())
        work = (float(rough[name].mean()) for name in ("newton_steps", "krylov_steps"))
        lines.append(
            " | ".join(
                (
                    label_of(rows),
                    f"{float(run['pressure_max'][2500]) / GIGAPASCAL:.2f} GPa",
                    f"{peak.min():.2f} to {peak.max():.2f} GPa",
                    f"{float(rough['film_min'].min()) / NANOMETRE:.1f} nm",
                    f"{zone:.2f} %",
                    f"{solid.min():.2f} to {solid.max():.2f} %",
                    f"{int((~run['converged'].values.astype(bool)).sum())}",
                    ", ".join(f"{one:.1f}" for one in work),
                )
            )
        )
    return [f"| {line} |" for line in lines]


def left_by_filters() -> list[str]:
    """Return the lines of a table: height and slope of both profiles under each filter."""
    lines = ["| waves from | Rq, µm | rms slope, deg |"]
    for rows in (*ROWS, None):
        case = case_of(f"his columns, {rows or max(ROWS)} rows")
        if rows is None:
            case = case.varied(filtered(None))
        heights, slopes = [], []
        for surface, fast in ((case.surface_1, True), (case.surface_2, False)):
            profile = surface.heights(fast)
            # the profile repeats
            slope = np.gradient(np.tile(profile.height, 3), profile.spacing)[profile.height.size :]
            heights.append(profile.height.std() * 1e6)
            slopes.append(np.rad2deg(np.sqrt((slope[: profile.height.size] ** 2).mean())))
        cutoff = case.surface_1.cutoff_um
        words = (
            "no filter" if cutoff is None else f"{cutoff:g} µm",
            ", ".join(f"{one:.2f}" for one in heights),
            ", ".join(f"{one:.1f}" for one in slopes),
        )
        lines.append(f"| {' | '.join(words)} |")
    return lines


def main(work: Path) -> None:
    """Draw and print."""
    files = {rows: folder_of(work, f"his columns, {rows} rows") / "rough.nc" for rows in ROWS}
    found = {
        rows: xr.load_dataset(file, engine="scipy") for rows, file in files.items() if file.exists()
    }
    pressures(found).savefig(IMAGES / "rough_rows.png", dpi=110)
    sys.stdout.write("\n".join((*table(found), "", *left_by_filters(), "")))


if __name__ == "__main__":
    main(begin("rough_line_contact"))
