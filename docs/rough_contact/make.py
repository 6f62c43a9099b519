"""Draw the figures of docs/rough_contact.md: python -m docs.rough_contact.make.

Five minutes of one processor.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from docs.page import IMAGES
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.studies.roughness.results import flow_figure
from gearlube_core.arrays import Array
from gearlube_core.contact.dang_van import QUENCHED_42CRMO4, dang_van_number, passage_history
from gearlube_core.contact.half_space_stress import HalfSpaceStress, greatest_shear
from gearlube_core.rough_patch.table import gaussian_patches, patch_table, press_patch
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.surface.extrusion import ExtrudedProfile, Lay, periodic_section
from gearlube_core.surface.generator import generated_profile
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.heights import HeightMap

LOAD, RADIUS, MODULUS, NU = 360e3, 0.014, 227.5e9 / 2.0, 0.3  # N/m, m, E* [Pa], -
# m; the contact is solved as if it repeated along x: over 8 half-widths that costs 1 %
WIDTH, NODES, ROWS = 1e-3, 801, 64
ROUGHNESS, FRICTION = 0.1e-6, 0.05  # Rq of each surface [m], shear over pressure
PERIODS = (2.0e-4, 1e-3 / 7.0)  # m, of both surfaces, one turn each: 11.3 and 8.1 deg
HALF_WIDTH = math.sqrt(4.0 * LOAD * RADIUS / (math.pi * MODULUS))
LARGEST = 2.0 * LOAD / (math.pi * HALF_WIDTH)  # of the smooth contact [Pa]
_REQUEST = RoughnessRequest(
    root_mean_square=ROUGHNESS,
    correlation_length=10e-6,
    shortest_wave=24e-6,  # ten nodes
    longest_wave=100e-6,
)
_DEPTH = "depth over half-width b"
_DEPTHS = np.append(np.linspace(0.01, 0.2, 12), np.linspace(0.25, 2.0, 18))  # half-widths


class Below(NamedTuple):
    """What lies below one contact."""

    x: Array  # [m], shape (nx,)
    pressure: Array  # [Pa], shape (nx, ny)
    depths: Array  # [m], shape (nz,)
    shear: Array  # on the section y = 0 [Pa], shape (nz, nx)
    number: Array  # of Dang Van, largest over y, shape (nz,)


def below(*, rough: bool) -> Below:
    """Return the contact of smooth or rough solids and what lies below it."""
    x = np.linspace(-4.0 * HALF_WIDTH, 4.0 * HALF_WIDTH, NODES)
    spacing = (float(x[1] - x[0]), WIDTH / ROWS)
    y = spacing[1] * np.arange(float(ROWS))
    height = -(x[:, None] ** 2) / (2.0 * RADIUS) + 0.0 * y
    if rough:
        for seed, period in enumerate(PERIODS, 1):
            made = generated_profile(_REQUEST, 1e-3, 640, np.random.default_rng(seed)).surface
            part = periodic_section(replace(made, periodic=False), 3e-4, period)
            profile = replace(part, height=part.height * (ROUGHNESS / part.height.std()))
            lay = Lay(period=period, width=WIDTH, turns=1)
            height = height + ExtrudedProfile(profile=profile, lay=lay)(x[:, None], y[None, :])
    solid = HeightMap(height=height, spacing=spacing, periodic=(True, True), name="line contact")
    mean = LOAD / (spacing[0] * NODES)
    pressure = press_patch(solid, mean, MODULUS, tolerance=1e-5).pressure
    field = HalfSpaceStress(
        pressure=pressure,
        traction_x=FRICTION * pressure,
        spacing=spacing,
        poisson_ratio=NU,
        periodic=(False, True),
    )
    depths = HALF_WIDTH * _DEPTHS
    shear, number = [], []
    for depth in depths:
        stress = field(float(depth))
        shear.append(greatest_shear(stress[:, :, 0]))
        every = passage_history(stress[:, :, :: 8 if rough else ROWS])
        number.append(float(dang_van_number(every, QUENCHED_42CRMO4, tolerance=1e-3).max()))
    return Below(x, pressure, depths, np.array(shear), np.array(number))


def stress_figure() -> Any:
    """Return the pressures, the fields of greatest shear and the fatigue numbers over depth."""
    smooth, rough = below(rough=False), below(rough=True)
    with house_style():
        figure = new_figure(11.0, 6.4)
        grid = figure.add_gridspec(2, 3, width_ratios=(1.0, 1.0, 0.9))
        upper = [figure.add_subplot(grid[0, k]) for k in range(2)]
        lower = [figure.add_subplot(grid[1, k]) for k in range(2)]
        cases = (("smooth", smooth, BLUE), ("rough", rough, VERMILLION))
        for (name, one, colour), top, ax in zip(cases, upper, lower, strict=True):
            top.plot(one.x / HALF_WIDTH, one.pressure[:, 0] / LARGEST, color=colour, lw=0.9)
            top.set(title=f"{name} surfaces", xlabel="x over half-width b", xlim=(-1.5, 1.5))
            top.set_ylabel("pressure over Hertz\npressure p₀")
            top.set_ylim(0.0, 1.05 * rough.pressure[:, 0].max() / LARGEST)
            drawn = ax.contourf(
                one.x / HALF_WIDTH,
                one.depths / HALF_WIDTH,
                one.shear / LARGEST,
                levels=np.linspace(0.0, 0.6, 25),
                cmap="viridis",
                extend="max",
            )
            ax.set(xlabel="x over half-width b", ylabel=_DEPTH, xlim=(-1.5, 1.5), ylim=(2.0, 0.0))
            ax.grid(visible=False)
            figure.colorbar(
                drawn, ax=ax, label="largest shear stress over p₀", ticks=np.arange(0.0, 0.7, 0.1)
            )
        shear, fatigue = figure.add_subplot(grid[0, 2]), figure.add_subplot(grid[1, 2])
        for name, one, colour in cases:
            shear.plot(one.shear.max(axis=1) / LARGEST, one.depths / HALF_WIDTH, color=colour)
            fatigue.plot(one.number, one.depths / HALF_WIDTH, color=colour, label=name)
        shear.axhline(0.786, color=GREY, lw=0.8, ls="--")
        shear.set(xlabel="largest shear stress over p₀", ylabel=_DEPTH, ylim=(2.0, 0.0))
        fatigue.set(xlabel="Dang Van's number", ylabel=_DEPTH, ylim=(2.0, 0.0))
        fatigue.axvline(1.0, color=GREY, lw=0.8, ls="--")
        fatigue.legend()
        figure.suptitle(
            "Roughness adds stress close to the surface alone; dashed: depth of Hertz's largest "
            "shear stress, and limit of fatigue",
            fontsize=10.5,
        )
    return figure


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


def main() -> None:
    """Draw all figures."""
    isotropic, across = tables(1.0), tables(1.0 / 3.0)
    figures = {
        "rough_flow_factors": flow_figure([(1.0, joined(isotropic)), (1.0 / 3.0, joined(across))]),
        "rough_stress": stress_figure(),
    }
    for name, figure in figures.items():
        with atomic_write(IMAGES / f"{name}.png") as partial:
            figure.savefig(partial, format="png")


if __name__ == "__main__":
    main()
