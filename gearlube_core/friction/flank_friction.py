"""Laws of flank friction by name: each registers itself, and all that names laws asks here.

A law is one file. A dataclass that derives from `FlankFriction` is its declaration: name, numbers,
range of its film. It makes the NamedTuple of floats whose kernels are those of `flank_law`. In the
package the file stands in this folder and is called `flank_law_...`. Outside it is imported, or
named as an entry point of the group `gearlube.laws`, which commands and their workers find too::

    @dataclass(frozen=True, kw_only=True)
    class Coulomb(FlankFriction, name="coulomb", text="one coefficient, film of Chittenden"):
        mu: Annotated[float, Number("1", 0.0, 0.5, text="Coefficient of the flanks")] = 0.05

        def __call__(self, surface, solid):
            return CoulombFlank(self.mu, surface, solid)
"""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from pkgutil import iter_modules
from typing import ClassVar

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.errors import ParameterError
from gearlube_core.film import point_film
from gearlube_core.friction.flank_law import FlankLaw, FlankLawMaker
from gearlube_core.number import check_fields, numbers_of

logger = logging.getLogger(__name__)

_LAWS: dict[str, type[FlankFriction]] = {}


@dataclass(frozen=True, kw_only=True)
class FlankFriction(ABC):
    """A law of flank friction with its numbers; a subclass with a name registers itself.

    Every field is a `Number` with a default. Axle files give them as `model.friction_numbers`, FMUs
    as `friction.NAME`, error bars vary those with a factor.
    """

    name: ClassVar[str] = ""
    text: ClassVar[str] = ""  # for reference pages
    rubs: ClassVar[bool] = True  # False: the law gives films alone
    solved_film: ClassVar[bool] = False  # whether a solved film can replace that of the law
    pressure: ClassVar[str] = "elliptical"  # mean pressure that the law is given, or "circular"
    # groups M and L of Moes within which the film of the law holds
    film_load: ClassVar[tuple[float, float]] = point_film.LOAD_RANGE
    film_material: ClassVar[tuple[float, float]] = point_film.MATERIAL_RANGE

    def __init_subclass__(cls, name: str = "", text: str = "") -> None:
        cls.name, cls.text = name, text
        if not name:
            return
        if name in _LAWS and _LAWS[name].__module__ != cls.__module__:
            raise ParameterError(
                f"A law of flank friction must have a name of its own, got {name!r} of "
                f"{cls.__module__}, which {_LAWS[name].__module__} has. Rename one of them."
            )
        _LAWS[name] = cls  # of a file that is read again the new one counts

    def __post_init__(self) -> None:
        check_fields(self)

    @abstractmethod
    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> FlankLaw:
        """Return the law for the kernels, for the roughness and the solids of a pair."""

    @property
    def numbers(self) -> dict[str, float]:
        """Values of the law's numbers by name, in SI units."""
        return {name: float(getattr(self, name)) for name in numbers_of(type(self))}


@dataclass(frozen=True, kw_only=True)
class _Made(FlankFriction):
    """A law that a function of its user makes."""

    make: FlankLawMaker

    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> FlankLaw:
        return self.make(surface, solid)


@cache
def _import_laws() -> None:
    """Import the files of the package that may hold laws."""
    for found in iter_modules([str(Path(__file__).parent)]):
        if found.name.startswith("flank_law"):
            import_module(f"{__package__}.{found.name}")


def friction_laws(wanted: str = "") -> Mapping[str, type[FlankFriction]]:
    """Return the laws of flank friction by name, those of the package first.

    Entry points are loaded only for a `wanted` name that is not there yet.
    """
    _import_laws()
    if wanted and wanted not in _LAWS:
        for plugin in entry_points(group="gearlube.laws"):
            try:
                plugin.load()
            except Exception as reason:
                logger.warning(
                    "The entry point %s of gearlube.laws (%s) cannot be loaded: %s: %s. Its laws "
                    "are left out.", plugin.name, plugin.value, type(reason).__name__, reason,
                )  # fmt: skip
    ours = {
        name: law for name, law in _LAWS.items() if law.__module__.startswith(f"{__package__}.")
    }
    return ours | _LAWS


def friction_law(friction: str | FlankLawMaker, **numbers: float) -> FlankFriction:
    """Return a law of flank friction.

    Parameters
    ----------
    friction : str or callable
        Name of a law, the law itself, or any function that makes the law for the kernels.
    **numbers
        Numbers of a named law that are not its defaults, in SI units.

    Raises
    ------
    ParameterError
        There is no law of this name, or a number is none of the law's or out of its range.
    """
    if not isinstance(friction, str):
        return friction if isinstance(friction, FlankFriction) else _Made(make=friction)
    found = friction_laws(friction)
    if friction not in found:
        raise ParameterError(
            f"friction must be one of {', '.join(found)}; got {friction!r}. A law of your own must "
            "be imported first, or be an entry point of the group gearlube.laws."
        )
    law = found[friction]
    for name in numbers:
        if name not in numbers_of(law):
            known = ", ".join(numbers_of(law)) or "none"
            raise ParameterError(
                f"The numbers of the friction law {friction} are {known}; got {name!r}. Leave it "
                "out, or choose the law that has it."
            )
    return law(**numbers)
