"""Draw the figures of docs/rough_contact.md: python -m docs.rough_contact.make.

Five minutes of one processor.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from docs.page import IMAGES
from docs.rough_contact.stress import stress_figure
from gearlube.plotting.style import MARKERS, SERIES, house_style, new_figure
from gearlube.studies.roughness.results import flow_figure
from gearlube_core.rough_patch.table import gaussian_patches, patch_table
from gearlube_core.storage.atomic_file import atomic_write

_SEEDS = (1, 2, 3, 4, 5)
_LENGTH = 20e-6  # m, correlation
_RATIOS = (0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0)


def tables(peklenik: float) -> list[xr.Dataset]:
    """Return the table of each of five patches."""
    patches = gaussian_patches(
        0.4e-6, _LENGTH, _LENGTH / peklenik, _SEEDS, nodes=128, nodes_per_length=10.0
    )
    return [patch_table([one], _RATIOS) for one in patches]


def joined(each: list[xr.Dataset]) -> xr.Dataset:
    """Return means and spreads over patches."""
    whole = xr.concat(each, "seed")
    mean, spread = whole.mean("seed"), whole.std("seed", ddof=1)
    spreads = {
        name: spread[str(name).removesuffix("_spread")] for name in mean if "_spread" in name
    }
    return mean.assign(spreads).assign_attrs(each[0].attrs)


def contact_figure(each: list[xr.Dataset]) -> Any:
    """Return contact shares over the film ratio, dry, of each patch."""
    with house_style():
        figure = new_figure(9.5, 4.0)
        left, right = figure.subplots(1, 2)
        for seed, one, colour, marker in zip(_SEEDS, each, SERIES, MARKERS, strict=False):
            style = {"ms": 4, "color": colour, "label": f"surface of seed {seed}"}
            left.semilogy(one.film_ratio, one.asperity_area, marker + "-", **style)
            load = one.asperity_pressure / one.attrs["rms_slope"]
            right.loglog(load, one.asperity_area, marker + "-", **style)
        loads = np.geomspace(1e-4, 0.2, 50)
        right.loglog(loads, 2.0 * loads, "k--", lw=1.0, label="2 times the load (small loads)")
        share = "share of the area in contact"
        left.set(xlabel="mean gap over roughness σ", ylabel=share, ylim=(1e-4, 1.0))
        right.set(xlabel="load: mean pressure over (E* times rms slope)", ylabel=share)
        figure.suptitle("Dry contact of five made surfaces with the same statistics", fontsize=10.5)
        for ax in (left, right):
            ax.legend(fontsize=8)
    return figure


def main() -> None:
    """Draw all figures."""
    isotropic, across = tables(1.0), tables(1.0 / 3.0)
    figures = {
        "rough_contact_share": contact_figure(isotropic),
        "rough_flow_factors": flow_figure([(1.0, joined(isotropic)), (1.0 / 3.0, joined(across))]),
        "rough_stress": stress_figure(),
    }
    for name, figure in figures.items():
        with atomic_write(IMAGES / f"{name}.png") as partial:
            figure.savefig(partial, format="png")


if __name__ == "__main__":
    main()
