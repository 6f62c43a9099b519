"""Film over roughness: what was solved for smooth surfaces, held against the roughness given."""

from __future__ import annotations

import xarray as xr

from gearlube.report.film_ratio import FULL_FILM, film_ratio_level, film_ratio_words
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import NOTE, Finding

ROUGHNESS = "roughness_rms"  # attribute of a film: composite rms roughness [m], where it was given
RATIO_FILMS = ("central film", "smallest film")


def least_films(dataset: xr.Dataset) -> dict[str, float]:
    """Return the least central and the smallest film [m], those that the dataset has."""
    prefix = "steady_" if dataset.attrs["contact"] == "hypoid" else ""
    found = {}
    for name, variable in zip(RATIO_FILMS, ("central_film", "minimum_film"), strict=True):
        if variable in dataset.attrs:
            found[name] = float(dataset.attrs[variable])
        elif prefix + variable in dataset:
            found[name] = float(dataset[prefix + variable].min())
    return found


def film_ratios(dataset: xr.Dataset) -> dict[str, float]:
    """Return the least films over the composite roughness [-]; empty without a roughness."""
    if ROUGHNESS not in dataset.attrs:
        return {}
    roughness = float(dataset.attrs[ROUGHNESS])
    return {name: film / roughness for name, film in least_films(dataset).items()}


def film_ratio_finding(dataset: xr.Dataset) -> Finding:
    """Return what carries the load, or that no roughness was given and which one would matter."""
    ratios = film_ratios(dataset)
    if not ratios:
        film = next(iter(least_films(dataset).values()))
        limit = quantity_text(1e6 * film / FULL_FILM, "µm", 2)
        return Finding(
            NOTE,
            "No roughness was given, so the film ratio λ is not known.",
            f"The film is mixed below λ = {FULL_FILM:g}: with a composite rms roughness above "
            f"{limit}. Give it with --roughness-um, or as roughness_um in the case.",
        )
    name, ratio = next(iter(ratios.items()))
    others = "".join(
        f" The {other} has {value:.2g}." for other, value in ratios.items() if other != name
    )
    roughness = quantity_text(1e6 * float(dataset.attrs[ROUGHNESS]), "µm", 2)
    return Finding(
        film_ratio_level(ratio),
        f"The film ratio λ of the {name} is {ratio:.2g}.",
        f"{film_ratio_words(ratio)} Film of smooth surfaces over a composite rms roughness of "
        f"{roughness}.{others}",
    )
