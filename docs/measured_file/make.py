"""Rewrite the spectrum of docs/measured_file.md: python -m docs.measured_file.make [workdir].

From the made data of `gearlube measured --example` to the contact of the measured flanks, the mesh
table with the errors of single teeth and the axle that runs with it: some five minutes. What is
finished is kept in the folder given as argument, by default build/measured_file.
"""

from __future__ import annotations

import csv
import math
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from docs.page import IMAGES, begin
from gearlube.plotting.style import BLUE, GREY, VERMILLION, house_style, new_figure
from gearlube.studies.contact.run import run_contact
from gearlube.studies.measured.run import run_measured
from gearlube.studies.measured.teeth import run_tooth_errors
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, HypoidAxle, mohammadpour_2015_axle
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_geometry.measured.measured_flanks import EXAMPLE
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.spectra import AngleWindow, order_spectrum, resample

FILE = EXAMPLE / "axle_17.toml"
NUMBERS = Path(__file__).with_name("spectrum.csv")
PICTURE, TEETH_PICTURE = "measured_spectrum.png", "measured_teeth.png"
CYCLE = CycleSettings(torques=(20.0, 50.0, 100.0, 200.0), positions=12)
SPEED, TORQUE = 145.0, 60.0  # of the pinion: about 60 km/h [rad/s], [N.m]
HOLD = 0.3  # N.m s/rad, of the wheel on its mean speed; the mesh mode does not feel it
OIL = 368.15  # K
STEP = 5e-5  # s
SETTLING = 1.0  # s
TURNS = 36  # of the pinion: the hunting turn
SAMPLES = 512  # a turn
COLUMNS = ("alike_n", "differing_n")
_LEAST = 1e-3  # N, foot of the lines
# order of the pinion: what it is
LINES = {
    "1": (1.0, "pinion, once a turn"),
    "12": (12.0, "mesh less one of the pinion"),
    "13 - 13/36": (13.0 - 13 / 36, "mesh less one of the gear"),
    "13": (13.0, "mesh"),
    "13 + 13/36": (13.0 + 13 / 36, "mesh plus one of the gear"),
    "14": (14.0, "mesh plus one of the pinion"),
    "31": (31.0, "31 waves of the pinion"),
    "83 x 13/36": (83 * 13 / 36, "83 waves of the gear"),
}


def spectrum(table: MeshTable) -> tuple[Array, Array]:
    """Return orders of the pinion and amplitudes of the mesh force [N], over the hunting turn."""
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), mesh=table))
    ratio = table.ratio
    axle.initialise(
        pinion_speed=SPEED,
        pinion_torque=TORQUE,
        wheel_torque=TORQUE * ratio,
        oil_temperature=OIL,
    )
    columns = [OUTPUT_INDEX[name] for name in ("pinion.angle", "mesh.force", "wheel.speed")]
    rows = []
    steps = math.ceil((SETTLING + 1.02 * TURNS * 2.0 * math.pi / SPEED) / STEP)
    wheel_torque = 0.97 * TORQUE * ratio
    for _ in range(steps):
        axle.step(STEP, TORQUE, wheel_torque, OIL)
        rows.append(axle.outputs[columns])
        wheel_torque += STEP * HOLD * 20.0 * (rows[-1][2] - SPEED / ratio)
    angle, force, _ = np.array(rows).T
    window = AngleWindow(
        start=float(angle[-1] - 2.0 * math.pi * (TURNS + 0.05)),
        revolutions=TURNS,
        samples_per_revolution=SAMPLES,
        mean_speed=float((angle[-1] - angle[-2]) / STEP),
    )
    found = order_spectrum(resample(angle, force, window), window)
    return found.order, found.amplitude


def tables(work: Path) -> tuple[MeshTable, MeshTable]:
    """Return the mesh table of the measured flanks, with teeth alike and with their errors."""
    flanks = run_measured(FILE, folder=work)
    contact = work / "contact" / f"{flanks.file.name}.nc"
    settings = ContactSettings(cycle=CYCLE)
    run_contact(flanks.gear_file(), settings, folder=work / "contact")
    teeth = run_tooth_errors(FILE, contact, folder=work / "teeth")
    return read_mesh_table(contact), teeth.mesh_table


def picture(alike: tuple[Array, Array], differing: tuple[Array, Array]) -> Any:
    """Return the spectra of the mesh force, teeth alike and with their errors."""
    with house_style():
        figure = new_figure(11.0, 4.6)
        axes = figure.subplots()
        for (order, amplitude), colour, label, width in (
            (differing, VERMILLION, "teeth with pitch, eccentricity and waves", 1.0),
            (alike, BLUE, "all teeth alike", 2.2),
        ):
            seen = (order > 0.2) & (order < 42.0)
            axes.vlines(order[seen], _LEAST, amplitude[seen], color=colour, lw=width, label=label)
        for mesh in (13.0, 26.0, 39.0):
            axes.axvline(mesh, color=GREY, lw=0.8, zorder=0)
        for place, text in (
            (31.0, "31 waves per turn\nof the pinion"),
            (83 * 13 / 36, "83 waves per turn\nof the gear"),
        ):
            top = float(np.interp(place, *differing))
            axes.annotate(
                text, (place, top), (place + (1.2 if place > 30.5 else -3.4), 3.0 * top),
                fontsize=8.5, arrowprops={"arrowstyle": "-", "color": "black", "lw": 0.6},
            )  # fmt: skip
        axes.set(
            yscale="log", xlim=(0.0, 42.0), ylim=(3e-2, 100.0), ylabel="mesh force, amplitude [N]",
            xlabel="order (periods per turn of the pinion); grey: mesh orders",
        )  # fmt: skip
        axes.legend(loc="upper left")
    return figure


def lines_rows() -> list[list[str]]:
    """Return the rows of the stored spectrum."""
    with NUMBERS.open(encoding="utf-8", newline="") as file:
        return [
            [row["order"], row["what"], *(f"{float(row[name]):.2f}" for name in COLUMNS)]
            for row in csv.DictReader(file)
        ]


def main() -> None:
    """Run or resume the study; write the numbers and the pictures."""
    work = begin("measured_file")
    alike, differing = (spectrum(table) for table in tables(work))
    picture(alike, differing).savefig(IMAGES / PICTURE)
    shutil.copyfile(work / "teeth" / "tooth_errors.png", IMAGES / TEETH_PICTURE)
    with NUMBERS.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["order", "what", *COLUMNS])
        for name, (order, what) in LINES.items():
            pair = (float(np.interp(order, *one)) for one in (alike, differing))
            writer.writerow([name, what, *(f"{value:.3f}" for value in pair)])


if __name__ == "__main__":
    main()
