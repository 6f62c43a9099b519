"""Findings of a run-up as sentences with numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import range_text, usable_words
from gearlube.plotting.words import held_words, largest_losses, not_modelled
from gearlube.report.churning import regime_findings
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.runup import levels
from gearlube.studies.runup.critical import Critical, critical_speeds
from gearlube.studies.runup.without_car import HELD
from gearlube_core.arrays import Array
from gearlube_core.units import ZERO_CELSIUS, rads_to_rpm

NEAR = 0.05  # of a natural frequency, within which a crest is said to be a resonance
_MARKED = 3  # mesh orders whose critical speeds are listed
_NAMED = 3  # critical speeds that are named one by one
_OF_CAR = 0.1  # of the strain energy of a mode, from which the car counts
_PARTS = 40  # of a ramp, by speed
_NARROW = 0.15  # of a speed: a margin below it is worth a warning


@dataclass(frozen=True, slots=True, kw_only=True)
class Peak:
    """The largest bearing force of a mesh order.

    Parameters
    ----------
    mesh_order : int
    force : float
        All bearings and directions together, rms [N].
    speed_rpm, frequency : float
        Of the pinion there [rpm], of the order there [Hz].
    bearing, direction : str
        Which has the largest part.
    part : float
        That part, rms [N].
    at_end : str
        "start" or "end" where the crest lies in the first or last block, else "".
    """

    mesh_order: int
    force: float
    speed_rpm: float
    frequency: float
    bearing: str
    direction: str
    part: float
    at_end: str


def peaks(dataset: xr.Dataset) -> list[Peak]:
    """Return the crest of each mesh order, the loudest first."""
    total = levels.total_force(dataset, "bearing_force_track")
    parts = levels.track_rms(dataset, "bearing_force_track")
    speed = levels.rpm(dataset)
    found = []
    for place, order in enumerate(dataset["mesh_order"].values):
        track = total.values[:, place]
        block = int(np.argmax(track))
        here = parts.isel(block=block, mesh_order=place).values
        b, d = np.unravel_index(int(np.argmax(here)), here.shape)
        found.append(
            Peak(
                mesh_order=int(order),
                force=float(track[block]),
                speed_rpm=float(speed[block]),
                frequency=float(order * levels.teeth(dataset) * speed[block] / 60.0),
                bearing=str(dataset["bearing"].values[b]),
                direction=str(dataset["direction"].values[d]),
                part=float(here[b, d]),
                at_end={0: "start", track.size - 1: "end"}.get(block, ""),
            )
        )
    return sorted(found, key=lambda one: -one.force)


def mean_loss(dataset: xr.Dataset) -> Array:
    """Return the mean loss by source over the fastest tenth of the ramp [W]."""
    loss = dataset["loss"].values
    tenth = max(1, loss.shape[0] // 10)
    rising = float(dataset.attrs["setting_end_speed"]) > float(dataset.attrs["setting_start_speed"])
    return np.asarray((loss[-tenth:] if rising else loss[:tenth]).mean(axis=0))


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a run-up or coast-down, the most important first.

    Examples
    --------
    >>> from gearlube.studies.runup.run import load_runup
    >>> findings(load_runup("gearlube_runup"))[0].headline  # doctest: +SKIP
    'The loudest is mesh order 1: 527 N rms of bearing forces at 3993 rpm (174 km/h, 865 Hz).'
    """
    critical = [one for one in critical_speeds(dataset) if one.mesh_order <= _MARKED]
    return [
        *_loudest(dataset, critical),
        *_margins(dataset, critical),
        *_rate(critical),
        *_contact(dataset),
        *_loss(dataset),
        *_churning(dataset),
        *_ranges(dataset),
    ]


def _speed(dataset: xr.Dataset, rpm: float) -> str:
    return f"{rpm:.0f} rpm ({levels.kmh_per_rpm(dataset) * rpm:.0f} km/h)"


def _nearest(peak: Peak, critical: list[Critical]) -> Critical | None:
    of_order = [one for one in critical if one.mesh_order == peak.mesh_order]
    return min(of_order, key=lambda c: abs(c.speed_rpm / peak.speed_rpm - 1.0), default=None)


def _is_at(peak: Peak, near: Critical | None) -> bool:
    return near is not None and abs(near.speed_rpm / peak.speed_rpm - 1.0) < NEAR


def _loudest(dataset: xr.Dataset, critical: list[Critical]) -> list[Finding]:
    top, *others = peaks(dataset)
    detail = (
        f"The largest part is {quantity_text(top.part, 'N')} on the {top.bearing} in direction "
        f"{top.direction}. "
    )
    near = _nearest(top, critical)
    resonant = _is_at(top, near)
    shares = dataset["shape_share"].values
    most = int(np.argmax(shares))
    share, mode = f"{100.0 * shares[most]:.0f} %", str(dataset["mode"].values[most])
    if near is not None:
        off = round(100.0 * (near.speed_rpm / top.speed_rpm - 1.0))
        how_far = f"{abs(off)} % {'above' if off > 0 else 'below'}" if off else "at"
        detail += (
            f"The nearest critical speed of that order is {how_far} this speed: natural mode "
            f"'{near.mode}', {near.frequency:.0f} Hz"
        )
        same = near.mode == mode
        detail += f", with {share} of the kinetic energy there. " if same else ". "
    if near is None or near.mode != mode:
        detail += f"{share} of the kinetic energy there is in the mode '{mode}'. "
    if resonant and near is not None:
        detail += _of_the_car(dataset, near.mode, top.force)
    first, last = levels.rpm(dataset, "mode_speed")[[0, -1]]
    if not 0.999 * first <= top.speed_rpm <= 1.001 * last:  # in a car
        detail += "The speed lies outside the ramp because the tyres slip. "
    if top.at_end:
        detail += f"The peak lies at the {top.at_end} of the ramp: extend the ramp. "
    words = "; ".join(
        f"order {one.mesh_order} {quantity_text(one.force, 'N')} at {one.speed_rpm:.0f} rpm"
        for one in others
    )
    speed = f"{top.speed_rpm:.0f} rpm ({levels.kmh_per_rpm(dataset) * top.speed_rpm:.0f} km/h"
    return [
        Finding(
            WARNING if resonant else NOTE,
            f"The loudest is mesh order {top.mesh_order}: {quantity_text(top.force, 'N rms')} of "
            f"bearing forces at {speed}, {top.frequency:.0f} Hz).",
            f"{detail}The others: {words}.",
        )
    ]


def _of_the_car(dataset: xr.Dataset, mode: str, force: float) -> str:
    """Return how much of a mode is in the car, and the force [N] of the axle without the car."""
    strain = dataset.get("mode_car_strain")
    share = 0.0 if strain is None else float(strain.sel(mode=mode))
    if share < _OF_CAR:
        return ""
    given = str(dataset.attrs.get("inputs_assumed", ""))
    assumed = ", whose stiffnesses are assumed" if "driveline.propshaft_stiffness" in given else ""
    said = f"{100.0 * share:.0f} % of its strain energy is in springs of the car{assumed}. "
    if HELD not in dataset:
        return said
    held = float(dataset[HELD])
    return f"{said}{held_words(quantity_text(held, 'N rms'), force / held)} "


def _margins(dataset: xr.Dataset, critical: list[Critical]) -> list[Finding]:
    inside = sorted((one for one in critical if one.margin == 0.0), key=lambda one: -one.force)
    loudest, *others = peaks(dataset)
    # an order that is largest at an end of the ramp may still grow beyond it
    asked = {loudest.mesh_order, *(one.mesh_order for one in others if one.at_end)}
    outside = [one for one in critical if one.margin != 0.0 and one.mesh_order in asked]
    near = _nearest(loudest, critical)
    rest = [one for one in inside if not (one is near and _is_at(loudest, near))]  # not named yet
    found = []
    if inside:
        listed = "; ".join(
            f"order {one.mesh_order} with '{one.mode}' at {_speed(dataset, one.speed_rpm)}, "
            f"{quantity_text(one.force, 'N')}"
            for one in rest[:_NAMED]
        )
        more = len(rest) - _NAMED
        after = "" if rest == inside else ", after that of the loudest"
        named = f"By force{after}: {listed}{f'; and {more} more' if more > 0 else ''}. "
        found.append(
            Finding(
                NOTE,
                f"Mesh orders 1 to {_MARKED} meet natural frequencies at {len(inside)} "
                f"{'speed' if len(inside) == 1 else 'speeds'} of the ramp.",
                f"{named if rest else ''}The table of critical speeds has all.",
            )
        )
    if outside:
        near = min(outside, key=lambda one: abs(one.margin))
        where = "above" if near.margin > 0.0 else "below"
        narrow = abs(near.margin) < _NARROW
        found.append(
            Finding(
                WARNING if narrow else GOOD,
                f"The next critical speed of mesh order {near.mesh_order} lies {where} the ramp, "
                f"{100.0 * abs(near.margin):.0f} % beyond its end: '{near.mode}' at "
                f"{_speed(dataset, near.speed_rpm)}.",
                "This resonance already raises the level at the end of the ramp." if narrow else "",
            )
        )
    return found


def _rate(critical: list[Critical]) -> list[Finding]:
    inside = [one for one in critical if one.margin == 0.0]
    fast = [one for one in inside if one.hurry > 1.0]
    if fast:
        worst = max(fast, key=lambda one: one.hurry)
        return [
            Finding(
                WARNING,
                f"The ramp passes {len(fast)} critical speeds too fast: the worst is mesh order "
                f"{worst.mesh_order} with '{worst.mode}', {worst.hurry:.1f} times the rate that "
                "allows full build-up.",
                "These peaks are too low. Use a slower ramp. Highest rate from ISO 7626-2.",
            )
        ]
    if inside:
        worst = max(inside, key=lambda one: one.hurry)
        return [
            Finding(
                GOOD,
                "The ramp is slow enough for every resonance to build up: at most "
                f"{100.0 * worst.hurry:.0f} % of the fastest rate of ISO 7626-2.",
            )
        ]
    return []


def _contact(dataset: xr.Dataset) -> list[Finding]:
    share = float(dataset["separated_fraction"])
    if share <= 0.0:
        return [Finding(GOOD, "The teeth stay in contact at all speeds.")]
    return [
        Finding(
            WARNING,
            f"The teeth are apart for {quantity_text(100.0 * share, '%', 2)} of the time.",
            "Separation brings impacts: rattle, or clonk where the torque changes its sign.",
        )
    ]


def _loss(dataset: xr.Dataset) -> list[Finding]:
    loss = mean_loss(dataset)
    names = [str(one) for one in dataset["source"].values]
    parts = largest_losses(names, loss)
    losing = {name for name, one in zip(names, loss, strict=True) if one > 0.0}
    return [
        Finding(
            NOTE,
            f"At the fast end the axle loses {quantity_text(float(loss.sum()), 'W')}: {parts}.",
            f"Not modelled: {', '.join(not_modelled(losing))}.",
        )
    ]


def _churning(dataset: xr.Dataset) -> list[Finding]:
    if "churning_regime" not in dataset:
        return []
    time, speed = dataset["time"].values, rads_to_rpm(1.0) * dataset["pinion_speed"].values
    return regime_findings(
        dataset["churning_regime"].values,
        np.interp(dataset["slow_time"].values, time, speed),
        "rpm",
        dataset["loss"].sel(source="churning").values,
        float(dataset.attrs["setting_oil_temperature"]) - ZERO_CELSIUS,
    )


def _ranges(dataset: xr.Dataset) -> list[Finding]:
    left = str(dataset.attrs["ranges_left"])
    if not left:
        return [Finding(GOOD, "Nothing left the range of a formula or table.")]
    count = len(left.splitlines())
    words = ""
    if "range_exceeded" in dataset:
        out = dataset["range_exceeded"].values > 0
        time, speed = dataset["time"].values, rads_to_rpm(1.0) * dataset["pinion_speed"].values
        speed = np.interp(dataset["slow_time"].values, time, speed)
        parts = np.array_split(np.argsort(speed), min(_PARTS, speed.size))
        inside = np.array([not out[part].any() for part in parts])
        words = usable_words(inside, [(np.array([speed[part].mean() for part in parts]), "rpm")])
    return [
        Finding(
            WARNING,
            f"{count} {'quantity' if count == 1 else 'quantities'} left the range of a formula or "
            f"table; what is computed there is extrapolated. {words}",
            range_text(left.replace("\n", " ")),
        )
    ]


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers, the same words in every run."""
    by_order = {one.mesh_order: one for one in peaks(dataset)}
    found = []
    for order in sorted(by_order):
        one = by_order[order]
        found += [
            Number(f"largest bearing forces of mesh order {order}", one.force, "N rms"),
            Number(f"pinion speed there, order {order}", one.speed_rpm, "rpm", 4),
        ]
    overall = levels.total_force(dataset, "bearing_force_overall")
    critical = [one for one in critical_speeds(dataset) if one.mesh_order <= _MARKED]
    loudest = peaks(dataset)[0].mesh_order
    margins = [abs(c.margin) for c in critical if c.margin != 0.0 and c.mesh_order == loudest]
    inside = [one for one in critical if one.margin == 0.0]
    return [
        Number("largest bearing forces, all frequencies", float(overall.max()), "N rms"),
        *found,
        Number(
            "largest transmission error, all frequencies",
            1e6 * float(dataset["dte_overall"].max()),
            "µm rms",
        ),
        Number("critical speeds of orders 1 to 3 within the ramp", float(len(inside)), "", 1),
        Number(
            "from the end of the ramp to the next critical speed of the loudest order",
            100.0 * min(margins, default=np.nan),
            "%",
            2,
        ),
        Number("time without contact", 100.0 * float(dataset["separated_fraction"]), "%", 2),
        Number("loss at the fast end", float(mean_loss(dataset).sum()), "W"),
    ]
