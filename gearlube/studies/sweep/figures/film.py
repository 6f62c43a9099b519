"""Flank load, film and temperature over a mesh cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure, typical_speeds
from gearlube_core.units import kelvin_to_celsius

_ROWS = (
    ("flank_load", "load [kN]", lambda x: 1e-3 * x),
    ("flank_film_thickness", "film thickness [µm]", lambda x: 1e6 * x),
    ("flank_film_ratio", "film ratio λ [-]", lambda x: x),
    ("flank_temperature", "film temperature [°C]", kelvin_to_celsius),
)
_LOADED = 0.01  # share of the largest load above which a flank is drawn
_STYLES = ("-", (0, (5, 2)), (0, (1, 1.2)))


def film_over_mesh_cycle(dataset: xr.Dataset, preload: int = 0) -> Any:
    """Return load, film thickness, film ratio and temperature while tooth pairs pass the mesh.

    Columns are a low, a medium and a high speed of the sweep. `preload` is a position.
    Each flank is drawn while it carries load.
    """
    columns = typical_speeds(dataset)
    phase = dataset["mesh_phase"].values
    with house_style():
        figure = new_figure(9.6, 8.0)
        axes = figure.subplots(
            len(_ROWS), max(len(columns), 1), sharex=True, sharey="row", squeeze=False
        )
        for at, speed in enumerate(columns):
            point = dataset.isel(preload=preload, speed=speed)
            load = point["flank_load"].values
            loaded = load > _LOADED * np.nanmax(load)
            for ax, (name, label, scaled) in zip(axes[:, at], _ROWS, strict=True):
                for flank, style in enumerate(_STYLES):
                    values = np.where(loaded[flank], scaled(point[name].values[flank]), np.nan)
                    ax.plot(
                        phase,
                        values,
                        color=SERIES[flank],
                        ls=style,
                        label=f"tooth pair {flank + 1}",
                    )
                if at == 0:
                    ax.set_ylabel(label)
            axes[0, at].set_title(f"{float(point['speed_kmh']):g} km/h")
            axes[-1, at].set_xlabel("mesh cycles [-]")
        for ax in axes[0]:
            ax.set_ylim(bottom=0.0)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=3, loc="outside lower center", handlelength=3.0)
        force = float(dataset["preload"][preload])
        figure.suptitle(
            f"Flank films while tooth pairs pass the mesh, preload {force:g} N", fontsize=11.5
        )
    return figure
