"""Make the sounds and figures of docs/sound.md: `python -m docs.sound.make`, about five minutes.

With Python 3.13 or newer all metrics are computed.

The axle of Mohammadpour et al. 2015 runs up with two bearing preloads. The sounds lie beside this
script, the figures in docs/images; what one hears is written into the page between its marks.
"""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import gearlube as gl
from docs.page import IMAGES, Page
from fmu_src.axle_arguments import axle_parameters
from gearlube.studies.sound.order_tracks import Sound
from gearlube_core.units import kmh_to_ms

HERE = Path(__file__).parent
PRELOADS = (2500.0, 6000.0)  # N
FROM, TO, DURATION = 30.0, 110.0, 7.0  # km/h, km/h, s
WAV_RATE = 24000  # Hz, what a browser plays and 340 kB hold
FIGURES = ("spectrogram", "levels", "heard_orders")


def run_up(preload: float, folder: Path) -> Path:
    """Run the axle up with a bearing preload [N] and return the folder of the run."""
    car = gl.read_axle("mohammadpour_2015")
    car = replace(car, axle=axle_parameters({"bearing_preload": preload}, car.axle))
    start, end = (car.driveline.road_load.pinion_speed(kmh_to_ms(speed)) for speed in (FROM, TO))
    out = folder / f"preload {preload:g} N"
    settings = gl.RunupSettings(
        car_axle=car, start_speed=start, end_speed=end, duration=DURATION, order_resolution=0.5
    )
    gl.run_runup(settings, folder=out)
    return out


def write(sound: Sound, folder: Path) -> None:
    """Copy sounds and figures of a folder and write the findings into the page."""
    for old in HERE.glob("*.wav"):
        old.unlink()
    lines = []
    for run in sound.runs:
        shutil.copy(folder / run.wav, HERE / run.wav)
        lines.append(f"- [{run.dataset.attrs['name']}](sound/{run.wav})")
    for name in FIGURES:
        shutil.copy(folder / "figures" / f"{name}.png", IMAGES / f"sound_{name}.png")
    page = Page("sound")
    page.paragraph("<!-- begin: written by docs.sound.make -->", "\n".join(lines))
    page.paragraph("Findings of the command:", "\n".join(f"- {x}" for x in sound.findings[:5]))
    page.write()


def main() -> None:
    """Run the axle up twice and make both sounds."""
    with TemporaryDirectory() as made:
        folder = Path(made)
        first, second = (run_up(preload, folder) for preload in PRELOADS)
        settings = gl.studies.SoundSettings(wav_rate=WAV_RATE)
        sound = gl.studies.run_sound(first, settings, against=second, folder=folder / "sound")
        write(sound, folder / "sound")


if __name__ == "__main__":
    main()
