"""Findings of a film as sentences with numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Number
from gearlube.studies.films.film_formulas import RATIO_FILMS, film_ratio_finding, film_ratios
from gearlube_core.ehl.grid_error import LARGE_ERROR
from gearlube_core.ehl.thin_film import thick_film_words

STEADY = ("line", "point", "helical")  # contacts with one film
_ERRORS = (
    ("central film", "error_central_film"),
    ("smallest film", "error_minimum_film"),
    ("largest pressure", "error_pressure_max"),
    ("friction", "error_friction"),
)
_MORE_NODES = "Take more nodes; --film-error 2% does so for lines and points."
_WIDER_DOMAIN = "Take a wider domain, or leave the default one."
_SOLVED = ("central film", "minimum film")


class Ratio(NamedTuple):
    """A film of a published formula over the solved one."""

    quantity: str
    source: str
    ratio: float


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a film, of a march or of a hypoid flank.

    Examples
    --------
    >>> findings(xr.load_dataset("gearlube_ehl_line/line.nc"))[0].headline  # doctest: +SKIP
    'The smallest film is 0.190 µm, the central one 0.211 µm; ...'
    """
    errors = largest_errors(dataset)
    if dataset.attrs["contact"] in STEADY:
        of_films = _steady(dataset)
    elif dataset.attrs["contact"] == "hypoid":
        of_films = _hypoid(dataset)
    else:
        of_films = _march(dataset)
    smallest, *others = of_films
    if of := next((name for name in ("smallest film", "films") if name in errors), ""):
        words = f"{smallest.headline.removesuffix('.')}; the error of the grid is about"
        smallest = replace(smallest, headline=f"{words} {100.0 * errors[of]:.2g} % of the {of}.")
    domain = largest_errors(dataset, "domain_")
    return [
        smallest,
        *_not_converged(dataset),
        *_thin(dataset),
        *_thick_formulas(dataset),
        *_error("grid", errors, "coarser grids", _MORE_NODES),
        *_error("domain", domain, "a domain twice as wide", _WIDER_DOMAIN),
        film_ratio_finding(dataset),
        *others,
    ]


def _not_converged(dataset: xr.Dataset) -> list[Finding]:
    of = dataset.attrs
    if of["converged"]:
        return []
    words = "The film did NOT converge: do not use its numbers."
    if of["contact"] not in STEADY:
        words = f"{of['failures']} films did NOT converge: they are marked in the figures."
    return [Finding(WARNING, words, str(of["outcome"]))]


def _signed(phase: float) -> str:
    return f"{phase:.2f}".replace("-", "−")


def largest_errors(dataset: xr.Dataset, of: str = "") -> dict[str, float]:
    """Return the estimated errors of the grid by their quantities, those that are known [-].

    `of` is "domain_" for those of the domain. That of friction is left out where nothing slides.
    """
    found = {name: float(dataset.attrs.get(of + key, math.nan)) for name, key in _ERRORS}
    if dataset.attrs.get("friction_coefficient") == 0.0:
        del found["friction"]
    if not of and "steady_grid_error" in dataset:
        found["films"] = float(dataset["steady_grid_error"].max())
    return {name: error for name, error in found.items() if math.isfinite(error)}


def _error(what: str, errors: dict[str, float], source: str, cure: str) -> list[Finding]:
    """Return how large the error of the grid or the domain is, if it is known [-]."""
    if not errors:
        return []
    worst = max(errors, key=lambda name: errors[name])
    large = errors[worst] > LARGE_ERROR
    listed = ", ".join(f"{name} {100.0 * error:.2g} %" for name, error in errors.items())
    return [
        Finding(
            WARNING if large else GOOD,
            f"The {what} makes an error of about {100.0 * errors[worst]:.2g} % of the {worst}.",
            f"Estimated from {source}: {listed}." + (f" {cure}" if large else ""),
        )
    ]


def _thin(dataset: xr.Dataset) -> list[Finding]:
    _, ended, rest = str(dataset.attrs["outcome"]).partition("Thin-film theory has ended: ")
    if not ended:
        return []
    reason = rest.partition(". ")[0].removesuffix(".")
    return [
        Finding(
            WARNING,
            "Thin-film theory has ended: do not use these numbers.",
            f"{reason[0].upper()}{reason[1:]}. Take less speed or viscosity, or more load.",
        )
    ]


def _thick_formulas(dataset: xr.Dataset) -> list[Finding]:
    if "formula_film_over_radius" not in dataset:
        return []
    each = zip(
        dataset["formula_source"].values,
        dataset["formula_quantity"].values,
        dataset["formula_film_over_radius"].values,
        strict=True,
    )
    thick = [thick_film_words(f"the {of} of {by}", float(share)) for by, of, share in each]
    said = "; ".join(filter(None, thick))
    if not said:
        return []
    return [
        Finding(
            WARNING,
            "Films of formulas are too thick for their radius: thin-film theory has ended.",
            f"{said[0].upper()}{said[1:]}. Do not compare with them.",
        )
    ]


def formula_ratios(dataset: xr.Dataset) -> list[Ratio]:
    """Return films of published formulas over solved ones."""
    if "formula_film" not in dataset:
        return []
    solved = {name: dataset.attrs[name.replace(" ", "_")] for name in _SOLVED}
    return [
        Ratio(str(quantity), str(source), float(film) / solved[str(quantity)])
        for quantity, source, film in zip(
            dataset["formula_quantity"].values,
            dataset["formula_source"].values,
            dataset["formula_film"].values,
            strict=True,
        )
        if str(quantity) in solved
    ]


def _steady(dataset: xr.Dataset) -> list[Finding]:
    of = dataset.attrs
    hertz = of["pressure_max"] / of["hertz_pressure_max"] - 1.0
    dry = "of a line with the mean load" if of["contact"] == "helical" else "of the dry contact"
    found = [
        Finding(
            NOTE,
            f"The smallest film is {quantity_text(1e6 * of['minimum_film'], 'µm')}, the central "
            f"one {quantity_text(1e6 * of['central_film'], 'µm')}.",
            _place(dataset),
        ),
        Finding(
            NOTE,
            f"The largest pressure is {quantity_text(1e-9 * of['pressure_max'], 'GPa')}.",
            f"{100.0 * hertz:+.1f} % relative to Hertz {dry}.".replace("-", "−"),
        ),
    ]
    friction = abs(of["friction_coefficient"])
    if friction > 0.0:
        power = of.get("sliding_power", math.nan)
        lost = f"{quantity_text(power, 'W')} are lost by sliding. " if power > 0.0 else ""
        warm = "With" if math.isfinite(of.get("temperature_max", math.nan)) else "Without"
        found.append(
            Finding(
                NOTE,
                f"The coefficient of friction of the film is {friction:.4f}.",
                f"{lost}{warm} heat in the film.",
            )
        )
    return found + _compared(formula_ratios(dataset), "is")


def _place(dataset: xr.Dataset) -> str:
    of = dataset.attrs
    if of["contact"] == "helical":
        return f"It is at y = {1e3 * of['minimum_film_y']:.2f} mm along the line."
    return "The surfaces are those of the case; without heights in it they are smooth."


def _compared(ratios: Sequence[Ratio], verb: str) -> list[Finding]:
    central = [one for one in ratios if one.quantity == "central film"]
    if not central:
        return []
    best = min(central, key=lambda one: abs(math.log(one.ratio)))
    others = "; ".join(f"{one.source}, {one.quantity}: {one.ratio:.2f}" for one in ratios)
    return [
        Finding(
            NOTE,
            f"The central film of {best.source} {verb} {best.ratio:.2f} times the solved one.",
            f"Formula over solution: {others}. The formulas leave out shear thinning and heat, "
            "which make a film thinner.",
        )
    ]


def _march(cycle: xr.Dataset) -> list[Finding]:
    step = cycle["step"].values
    pressure, film = 1e-9 * cycle["pressure_max"].values, 1e6 * cycle["minimum_film"].values
    high, thin = int(np.nanargmax(pressure)), int(np.nanargmin(film))
    return [
        Finding(
            NOTE,
            f"The smallest film is {quantity_text(film[thin], 'µm')}, at step {step[thin]:g}.",
            f"Over steps {step[0]:g} to {step[-1]:g} of the meshing cycle, with squeeze.",
        ),
        Finding(
            NOTE,
            f"The largest pressure is {quantity_text(pressure[high], 'GPa')}, at step "
            f"{step[high]:g}.",
        ),
    ]


def mean_ratios(dataset: xr.Dataset) -> list[Ratio]:
    """Return formulas over the solved central film of a hypoid flank, means by load."""
    weight = dataset["steady_load"].values / dataset["steady_load"].values.sum()
    solved = dataset["steady_central_film"].values
    return [
        Ratio("central film", source, float((weight * dataset[name].values / solved).sum()))
        for source, name in (
            ("Chittenden et al. 1985", "chittenden_central"),
            ("Chittenden, minor-axis component", "component_central"),
            ("Grubin 1949", "grubin"),
        )
        if name in dataset
    ]


def _hypoid(dataset: xr.Dataset) -> list[Finding]:
    phase = dataset["steady_phase"].values
    film = 1e6 * dataset["steady_minimum_film"].values
    pressure = 1e-9 * dataset["steady_pressure_max"].values
    friction = dataset["steady_traction_heated"].values
    thin, high = int(np.nanargmin(film)), int(np.nanargmax(pressure))
    found = [
        Finding(
            NOTE,
            f"The smallest steady film is {quantity_text(film[thin], 'µm')}, at phase "
            f"{_signed(phase[thin])}.",
            f"From phase {_signed(phase[0])} to {_signed(phase[-1])} the smallest films are up to "
            f"{quantity_text(np.nanmax(film), 'µm')}.",
        ),
        Finding(
            NOTE,
            f"The largest pressure is {quantity_text(pressure[high], 'GPa')}, at phase "
            f"{_signed(phase[high])}.",
        ),
        Finding(
            NOTE,
            f"The coefficient of friction of the film is {np.nanmin(friction):.4f} to "
            f"{np.nanmax(friction):.4f}.",
            _asperities(dataset),
        ),
    ]
    return found + _compared(mean_ratios(dataset), "is on average")


def _asperities(dataset: xr.Dataset) -> str:
    if "asperity_share" not in dataset:
        return "Eyring, heated across the film."
    share = 100.0 * float(dataset["asperity_share"].max())
    return f"Eyring, heated across the film. In the axle asperities add up to {share:.0f} %."


def numbers(dataset: xr.Dataset) -> list[Number]:
    """Return the key numbers, with the same names in every run of one kind of contact."""
    of, errors = dataset.attrs, largest_errors(dataset)
    worst = 100.0 * max(errors.values(), default=math.nan)
    if of["contact"] in STEADY:
        friction = abs(of["friction_coefficient"])
        return [
            Number("smallest film", 1e6 * of["minimum_film"], "µm"),
            Number("central film", 1e6 * of["central_film"], "µm"),
            Number("largest pressure", 1e-9 * of["pressure_max"], "GPa"),
            *_ratio_numbers(dataset),
            Number("coefficient of friction", friction if friction > 0.0 else math.nan),
            Number("largest estimated error", worst, "%", 2),
            *(
                Number(f"{one.source} over central film", one.ratio)
                for one in formula_ratios(dataset)
                if one.quantity == "central film"
            ),
        ]
    prefix = "steady_" if of["contact"] == "hypoid" else ""
    found = [
        Number("smallest film", 1e6 * float(dataset[f"{prefix}minimum_film"].min()), "µm"),
        *_ratio_numbers(dataset),
        Number("largest pressure", 1e-9 * float(dataset[f"{prefix}pressure_max"].max()), "GPa"),
        Number("largest estimated error", worst, "%", 2),
        Number("films not converged", int(of["failures"]), digits=1),
    ]
    if prefix:
        found += [
            Number("largest friction", float(dataset["steady_traction_heated"].max())),
            *(Number(f"{one.source} over central film", one.ratio) for one in mean_ratios(dataset)),
        ]
    return found


def _ratio_numbers(dataset: xr.Dataset) -> list[Number]:
    ratios = film_ratios(dataset)
    names = ("smallest film",) if dataset.attrs["contact"] == "helical_cycle" else RATIO_FILMS
    return [Number(f"film ratio λ, {one}", ratios.get(one, math.nan), "", 2) for one in names]
