"""What was run: speed and torque over time, and the losses."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.loss_words import source_colour, source_words
from gearlube.plotting.style import BLUE, house_style, new_figure
from gearlube.report.numbers import quantity_text
from gearlube.studies.runup import levels


def overview(dataset: xr.Dataset) -> Any:
    """Return pinion speed, torque and stacked losses over the time of the ramp."""
    with house_style():
        figure = new_figure(9.4, 6.6)
        speed, torque, loss = figure.subplots(3, 1, sharex=True, height_ratios=[1, 1, 1.6])
        speed.plot(dataset["block_time"], levels.rpm(dataset), color=BLUE)
        speed.set_ylabel("pinion speed\n[rpm]")
        torque.plot(dataset["torque_time"], dataset["pinion_torque"], color=BLUE)
        torque.set_ylabel("torque on the\npinion [N·m]")
        low, high = torque.get_ylim()
        torque.set_ylim(min(low, 0.0), max(high, 0.0) * 1.05)
        names = [str(name) for name in dataset["source"].values]
        powers = dataset["loss"].values.T
        losing = [i for i in range(len(names)) if float(np.abs(powers[i]).max()) > 0.0]
        loss.stackplot(
            dataset["slow_time"],
            powers[losing],
            labels=[
                f"{source_words(names[i])}, up to {quantity_text(float(powers[i].max()), 'W')}"
                for i in losing
            ],
            colors=[source_colour(names[i]) for i in losing],
            lw=0.0,
        )
        loss.set_ylabel("power lost [W]")
        loss.set_xlabel("time [s]")
        loss.set_xlim(0.0, float(dataset.attrs["setting_duration"]))
        loss.legend(loc="upper left", ncols=2)
        figure.suptitle(f"Course of the {levels.heading(dataset)}")
    return figure
