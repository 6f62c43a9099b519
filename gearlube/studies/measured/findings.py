"""Findings of measured flanks and of errors of single teeth as sentences with numbers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.plotting.words import parameter_words
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number

_MICRO = 1e6
_COARSE = 1e-6  # m, rms: what a smooth surface leaves at most, of the size of a mesh order
_SURE = 3.0  # times its uncertainty, from which on a fitted change is one
MEMBERS = ("pinion", "gear")


def flank_findings(flanks: xr.Dataset) -> list[Finding]:
    """Return the findings of measured flanks, see `flank_dataset`.

    Examples
    --------
    >>> found = xr.load_dataset("gearlube_measured/flanks.nc")  # doctest: +SKIP
    >>> flank_findings(found)[0].headline  # doctest: +SKIP
    'The flanks are up to 21.3 µm from nominal, on gear drive; ...'
    """
    names = [str(name) for name in flanks["flank"].values]
    found = [_answer(flanks, names)] if names else []
    if not found:
        found = [Finding(NOTE, "No deviations of flanks were given, so the flanks are nominal.")]
    if "setting" in flanks:
        found.append(_settings(flanks))
    if flanks.attrs["single_teeth"]:
        found.append(
            Finding(
                NOTE,
                "Pitch, eccentricity or waves of single teeth are not in the gear file.",
                "`gearlube contact` treats all teeth as equal; after it, `gearlube measured "
                "--table` adds the differences from tooth to tooth.",
            )
        )
    return found


def _answer(flanks: xr.Dataset, names: list[str]) -> Finding:
    size = [float(np.abs(_MICRO * flanks["deviation"].sel(flank=name)).max()) for name in names]
    worst = int(np.argmax(size))
    rest, apart = (_MICRO * float(flanks[one].max()) for one in ("rest_rms", "scatter_rms"))
    rough = [name for name in names if float(flanks["rest_rms"].sel(flank=name)) > _COARSE]
    return Finding(
        WARNING if rough else GOOD,
        f"The flanks are up to {quantity_text(size[worst], 'µm')} from nominal, on "
        f"{names[worst]}; a smooth surface of degree {flanks.attrs['degree']} leaves at most "
        f"{quantity_text(rest, 'µm', 2)} rms of it.",
        "Means of the measured teeth, which are up to "
        f"{quantity_text(apart, 'µm', 2)} rms from their mean."
        + (
            f" On {', '.join(rough)} the rest is as large as a mesh order: raise the degree, or "
            "look for a wrong point."
            if rough
            else ""
        ),
    )


def _settings(flanks: xr.Dataset) -> Finding:
    names = flanks["setting"].values
    listed = []
    for k, name in enumerate(names):
        part = flanks.isel(setting=k)
        listed.append(
            f"{parameter_words(str(name)).replace(': ', ' ')} "
            f"{number_text(float(part['setting_change']))} ± "
            f"{number_text(float(part['setting_uncertainty']), 2)} "
            f"{_unit(part['setting_unit'].values)}".rstrip()
        )
    before, after = (
        _MICRO * float(np.sqrt(np.mean(flanks[one].values ** 2)))
        for one in ("fit_before", "fit_after")
    )
    sure = np.abs(flanks["setting_change"].values) > _SURE * flanks["setting_uncertainty"].values
    unsure = [parameter_words(str(one)) for one in names[~sure]]
    return Finding(
        NOTE if sure.all() else WARNING,
        f"Other settings explain the deviations from {quantity_text(before, 'µm')} rms down to "
        f"{quantity_text(after, 'µm', 2)}: {', '.join(listed)}.",
        "The table has corrective settings."
        + (f" Not significantly different from zero: {', '.join(unsure)}." if unsure else ""),
    )


def _unit(unit: object) -> str:
    return {"1": "", "deg": "°"}.get(str(unit), str(unit))


def flank_numbers(flanks: xr.Dataset) -> list[Number]:
    """Return the key numbers of measured flanks, with the same names in every run."""
    if not flanks.sizes["flank"]:
        return []
    rest, apart = (_MICRO * float(flanks[one].max()) for one in ("rest_rms", "scatter_rms"))
    return [
        *(
            Number(
                f"largest deviation, {name}",
                float(np.abs(_MICRO * flanks["deviation"].sel(flank=name)).max()),
                "µm",
            )
            for name in flanks["flank"].values
        ),
        Number("rest of the smooth surface, at most", rest, "µm rms"),
        Number("teeth from their mean, at most", apart, "µm rms"),
    ]


def members_of(teeth: xr.Dataset) -> list[str]:
    """Return the members whose teeth differ."""
    return [one for one in MEMBERS if f"{one}_amplitude" in teeth]


def largest_sideband(teeth: xr.Dataset, member: str) -> tuple[int, float, float]:
    """Return the largest sideband of the first mesh order: its order, amplitude [m], torque [N·m].

    Sidebands are the orders of the member's turn within half of its teeth from the mesh order.
    """
    count = int(teeth.attrs[f"{member}_teeth"])
    amplitude = teeth[f"{member}_amplitude"]
    order = amplitude[f"{member}_order"].values
    beside = (np.abs(order - count) <= count // 2) & (order != count)
    values = np.where(beside, amplitude.values, -1.0)
    level, at = np.unravel_index(int(np.argmax(values)), values.shape)
    return int(order[at]), float(values[level, at]), float(teeth["torque"].values[level])


def tooth_findings(teeth: xr.Dataset) -> list[Finding]:
    """Return the findings of errors of single teeth, see `tooth_error_dataset`."""
    found = []
    for member in members_of(teeth):
        amplitude = _MICRO * teeth[f"{member}_amplitude"].values
        level, at = np.unravel_index(int(np.argmax(amplitude)), amplitude.shape)
        order, size, torque = largest_sideband(teeth, member)
        count = int(teeth.attrs[f"{member}_teeth"])
        largest = int(teeth[f"{member}_order"].values[at])
        found += [
            Finding(
                NOTE,
                f"The largest order of the {member} is {largest}: "
                f"{quantity_text(float(amplitude[level, at]), 'µm')} at "
                f"{float(teeth['torque'].values[level]):g} N·m.",
                "Order 1 is once a turn, as eccentricity makes it; mesh orders are multiples of "
                f"{count}.",
            ),
            Finding(
                NOTE,
                f"The largest sideband of the {member} beside its mesh order {count} is order "
                f"{order}: {quantity_text(_MICRO * size, 'µm')} at {torque:g} N·m.",
                "Sidebands are heard as a modulation of the whine.",
            ),
        ]
    rest = _MICRO * teeth["rest_rms"].values
    found.append(
        Finding(
            NOTE,
            "The part that repeats only when the same teeth meet again (hunting turn) is at most "
            f"{quantity_text(float(rest.max()), 'µm', 2)} rms.",
            "It is not in the mesh table.",
        )
    )
    return found


def tooth_numbers(teeth: xr.Dataset) -> list[Number]:
    """Return the key numbers of errors of single teeth, with the same names in every run."""
    found = []
    for member in members_of(teeth):
        amplitude = teeth[f"{member}_amplitude"]
        once = _MICRO * float(amplitude.sel({f"{member}_order": 1}).max())
        found += [
            Number(f"once a turn of the {member}, at most", once, "µm"),
            Number(
                f"largest sideband of the {member}",
                _MICRO * largest_sideband(teeth, member)[1],
                "µm",
            ),
        ]
    rest = Number("hunting turn alone", _MICRO * float(teeth["rest_rms"].max()), "µm rms")
    return [*found, rest]
