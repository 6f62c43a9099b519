"""The film model that an input names: found, of the right kind, and for the right oil."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gearlube_core.contact.solid import Solid, SolidParameters, solid_parameters
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.groups import FilmGroups
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.film_model.line_contact import line_groups_at, line_place
from gearlube_core.film_model.model import FLANK, LINE, ROLLER, FilmModel, model_names
from gearlube_core.film_model.solved_film import MODULUS_MARGIN
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import kelvin_to_celsius

_TEMPERATURES = 31  # at which an oil is compared with the domain
_CONTACTS = {FLANK: "hypoid flanks", LINE: "helical lines", ROLLER: "rollers on races"}


class _OilGroup(NamedTuple):
    """A group of `FilmGroups` that oil and steel alone decide at a pressure, in plain numbers."""

    group: str
    words: str
    unit: str
    plain: Callable[[float, float, SolidParameters], float]  # of a group's value and a temperature


_OIL_GROUPS = (
    _OilGroup("warmth", "-d ln(viscosity)/dT", "1/K", lambda g, T, _: math.exp(g) / T),
    _OilGroup("shape", "ln(eta/eta0) at 0.5 GPa over alpha p", "", lambda g, *_: math.exp(g)),
    _OilGroup("cooling", "d ln(eta)/dT at 0.5 GPa over 0", "", lambda g, *_: math.exp(g)),
    _OilGroup(
        "stress", "Eyring stress", "MPa", lambda g, _, s: 1e-6 * math.exp(g) * s.contact_modulus
    ),
    _OilGroup(
        "conductivity", "conductivity", "W/(m.K)", lambda g, _, s: math.exp(g) * s.conductivity
    ),
    _OilGroup(
        "capacity",
        "heat capacity by volume",
        "MJ/(m3.K)",
        lambda g, _, s: 1e-6 * math.exp(g) * s.density * s.heat_capacity,
    ),
)
_PRESSURE = 5e8  # Pa, at which an oil is compared


def file_of_model(text: str, folder: Path = Path()) -> Path | None:
    """Return the path of the model that a file names; None for a model of the package.

    Parameters
    ----------
    text
        Name of a model of the package, or a path (.json) relative to `folder`.
    folder
        Of the file that names it.
    """
    return folder / text if text.endswith(".json") and text not in model_names() else None


def chosen_model(text: str, kind: str, what: str, folder: Path = Path()) -> FilmModel:
    """Return the film model that an input names.

    Parameters
    ----------
    text, folder
        As of `file_of_model`.
    kind
        Kind of contact that it must be for: "flank", "line" or "roller".
    what
        Name of the input in errors.

    Raises
    ------
    FileError
        The file is missing, cut off, changed or no film model.
    ParameterError
        The model is of another kind.

    Examples
    --------
    >>> chosen_model("roller_race", "roller", "roller_model").kind
    'roller'
    """
    path = file_of_model(text, folder)
    return of_kind(FilmModel.named(text) if path is None else FilmModel.read(path), kind, what)


def model_in(text: str, content: bytes | None, kind: str, what: str, name: str) -> FilmModel:
    """Return the film model that an input names, from the bytes of its file `name` where given."""
    if content is None:
        return chosen_model(text, kind, what)
    return of_kind(FilmModel.of_content(content, name), kind, what)


def of_kind(model: FilmModel, kind: str, what: str) -> FilmModel:
    """Return a model, or raise ParameterError where it is for another kind of contact."""
    if model.kind != kind:
        raise ParameterError(
            f"{what} must be a film model of {_CONTACTS[kind]} (kind {kind}), got "
            f"{model.name} of {_CONTACTS.get(model.kind, 'other contacts')} (kind {model.kind}). "
            f"Make one with `gearlube film-model train --contact {kind}` and `fit`."
        )
    return model


def check_oil(model: FilmModel, oil: Lubricant, solid: Solid, what: str) -> None:
    """Refuse a model that says nothing of an oil at any temperature of the oil's data.

    Parameters
    ----------
    model, oil
        Film model, and the oil that it is to be used with.
    solid
        Elastic constants of both surfaces.
    what
        Name of the input in errors.

    Raises
    ------
    ParameterError
        Says which numbers of the oil or the solid lie where in the domain.

    Notes
    -----
    Compared are the groups that oil and solid alone decide at 0.5 GPa: shape and fall with
    temperature of the viscosity, Eyring stress, conductivity and heat capacity. Speed, load and
    temperature of a run are added; the share outside says how far they are covered.
    """
    misfits = _misfits(model, oil, solid)
    if misfits:
        trained = ", ".join(model.oils) or "oils that it does not name"
        raise ParameterError(
            f"{what} must be a film model that holds for the oil {oil.name}, got {model.name}, "
            f"trained for {trained}. Outside its domain: {'; '.join(misfits)}. Train one with "
            f"`gearlube film-model train --contact {model.kind} --oil OIL` and `fit`, or take the "
            "formulas."
        )


def _misfits(model: FilmModel, oil: Lubricant, solid: Solid) -> list[str]:
    """Return the reason why the model does not cover the oil; empty if it does."""
    other = oil.shear_law is not None and oil.shear_law.name != "eyring"
    if other or oil.own_laws():
        known = "(model: roelands or modulus, eyring)"
        return [f"{law.kind.what} {law.name} {known}" for law in oil.laws]
    of_solid = solid_parameters(solid, solid)
    modulus = of_solid.contact_modulus
    if abs(modulus / model.contact_modulus - 1.0) >= MODULUS_MARGIN:
        return [
            f"contact modulus E* {1e-9 * modulus:.4g} GPa (model: "
            f"{1e-9 * model.contact_modulus:.4g} GPa)"
        ]
    temperatures = np.linspace(oil.temperature_low, oil.temperature_high, _TEMPERATURES)
    groups = [_groups_of(oil, float(T), of_solid) for T in temperatures]
    numbers = np.array([[getattr(one, of.group) for of in _OIL_GROUPS] for one in groups])
    low, high = (np.array([model.domain[one.group][n] for one in _OIL_GROUPS]) for n in (0, 1))
    border = model.blocks["border"][0] * (high - low)
    beyond = (numbers <= low - border) | (numbers >= high + border)
    if not beyond.any(axis=1).all():
        return []
    always = beyond.all(axis=0)  # these decide; else no temperature has all within
    found = []
    for n, one in enumerate(_OIL_GROUPS):
        if always[n] or (beyond[:, n].any() and not always.any()):
            at = list(zip(numbers[:, n], temperatures, strict=True))
            plain = [one.plain(float(g), float(T), of_solid) for g, T in at]
            ends = [
                one.plain(float(end), float(temperatures[0]), of_solid) for end in (low[n], high[n])
            ]
            unit = f" {one.unit}" if one.unit else ""
            found.append(
                f"{one.words} {_span(plain)}{unit} from "
                f"{kelvin_to_celsius(oil.temperature_low):.0f} to "
                f"{kelvin_to_celsius(oil.temperature_high):.0f} degC (model: {_span(ends)}{unit})"
            )
    return found


def _span(values: list[float]) -> str:
    low, high = f"{min(values):.3g}", f"{max(values):.3g}"
    return low if low == high else f"{low} to {high}"


def _groups_of(oil: Lubricant, temperature: float, solid: SolidParameters) -> FilmGroups:
    """Return the groups of an oil between solids in any line contact of 0.5 GPa."""
    place = line_place(1e-2, solid.conductivity, solid.density * solid.heat_capacity)
    inlet = model_inlet(oil.state(temperature), solid, 0.0)
    groups: FilmGroups = line_groups_at(1e-6, 1e5, _PRESSURE, 1.0, 0.0, place, inlet)
    return groups
