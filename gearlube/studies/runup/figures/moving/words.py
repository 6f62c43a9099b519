"""Labels of an animation: its instant, and the smallest and largest value of each quantity."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube_core.arrays import Array
from gearlube_core.units import kelvin_to_celsius, rads_to_rpm

RINGS = {1: "pinion, bearing 1", 2: "pinion, bearing 2", 3: "gear, bearing 3", 4: "gear, bearing 4"}
AXES = {1: ("z", "y"), 2: ("z", "y"), 3: ("x", "y"), 4: ("x", "y")}  # at 0 and 90 degrees
_SIDES = {1: "drive flank", -1: "coast flank", 0: "teeth apart"}
_FULL = 359.5  # degrees, which count as all around


def heading(dataset: xr.Dataset) -> str:
    """Return speed, torque and oil, "2770 rpm, 80 N·m at the pinion, oil at 80 °C"."""
    attrs = dataset.attrs
    return (
        f"{rads_to_rpm(attrs['mean_pinion_speed']):.0f} rpm, {attrs['pinion_torque']:.3g} N·m at "
        f"the pinion, {attrs['oil']} at {kelvin_to_celsius(attrs['oil_temperature']):.0f} °C"
    )


def instant(dataset: xr.Dataset, frame: int) -> str:
    """Return mesh phase and time of a frame, "0.38 (0.63 ms)"."""
    time = 1e3 * float(dataset["frame_time"][frame])
    phase = round(float(dataset["mesh_phase"][frame]), 2) + 0.0  # no -0.00
    return f"{phase:.2f} ({time:.2f} ms)"


def flank_of(dataset: xr.Dataset, frame: int) -> str:
    """Return which flank carries in a frame, or that the teeth are apart."""
    return _SIDES[int(dataset["side"][frame])]


def one_flank(dataset: xr.Dataset) -> bool:
    """Whether the same flank carries in all frames."""
    return bool((dataset["side"] == dataset["side"][0]).all())


def span(values: Array, unit: str) -> str:
    """Return "12 to 240 N" of the finite values, one value where all are equal to 3 digits."""
    low, high = (quantity_text(float(f(values)), unit) for f in (np.nanmin, np.nanmax))
    number = low.rsplit(" ", 1)[0] if unit else low
    return high if low == high else f"{number} to {high}"


def flank_sentence(dataset: xr.Dataset) -> str:
    """Return the smallest and largest load, film and friction of a contact."""
    if not np.isfinite(dataset["flank_load"].values).any():
        return "No tooth pair carries load: the teeth are apart in all frames."
    friction, side = dataset["flank_friction"].values, dataset["side"].values
    carrying = sorted({int(one) for one in side if one})
    one_side = len(carrying) == 1
    where = f"the {_SIDES[carrying[0]]}" if one_side else "drive and coast flanks by turns"
    without = int((side == 0).sum())
    apart = f" The teeth are apart in {without} of {side.size} frames." if without else ""
    return (
        f"On {where} a contact carries {span(dataset['flank_load'].values, 'N')}; its film is "
        f"{span(1e6 * dataset['flank_film'].values, 'µm')} thick, its friction coefficient "
        f"{np.nanmin(friction):.3f} to {np.nanmax(friction):.3f}.{apart}"
    )


def loaded_zones(dataset: xr.Dataset) -> Array:
    """Return the mean angle over which the rollers of each bearing carry load [degrees]."""
    load = dataset["roller_load"].values
    known = np.isfinite(load)
    return np.asarray(360.0 * ((load > 0.0) & known).sum((0, 2)) / known.sum((0, 2)))


def zone_words(zone: float) -> str:
    """Return "all around", "none" or the angle of a loaded zone."""
    if zone <= 0.0:
        return "none"
    return "all around" if zone > _FULL else f"{zone:.0f}°"


def roller_sentence(dataset: xr.Dataset) -> str:
    """Return the smallest and largest load and film of a roller, and the loaded zones."""
    load = dataset["roller_load"].values
    most = int(np.nanargmax(np.nanmax(load, axis=(0, 2))))
    words = [f"A roller carries {span(load, 'N')}, most in bearing {int(dataset['ring'][most])}"]
    if "roller_film" in dataset and np.isfinite(dataset["roller_film"].values).any():
        words.append(
            f"its film is {span(1e6 * dataset['roller_film'].values, 'µm')} thick "
            f"({dataset.attrs['roller_film_law']})"
        )
    zones = {
        int(ring): zone_words(float(zone))
        for ring, zone in zip(dataset["ring"].values, loaded_zones(dataset), strict=True)
    }
    if len(set(zones.values())) == 1:
        where = f"Loaded zone of all bearings: {zones[1]}"
    else:
        listed = ", ".join(f"{ring}: {zone}" for ring, zone in zones.items())
        where = f"Loaded zone of bearing {listed}"
    return f"{'; '.join(words)}. {where}."
