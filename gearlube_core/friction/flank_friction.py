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

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film import point_film
from gearlube_core.friction.flank_law import FlankLaw, FlankLawMaker
from gearlube_core.part import Kind, Part


@dataclass(frozen=True, kw_only=True)
class FlankFriction(Part):
    """A law of flank friction with its numbers; a subclass with a name registers itself.

    Every field is a `Number` with a default. Axle files give them as `model.friction_numbers`, FMUs
    as `friction.NAME`, error bars vary those with a factor.
    """

    kind: ClassVar[Kind[FlankFriction]] = Kind(
        what="friction law",
        group="gearlube.laws",
        package="gearlube_core.friction",
        files="flank_law*",
    )
    rubs: ClassVar[bool] = True  # False: the law gives films alone
    solved_film: ClassVar[bool] = False  # whether a solved film can replace that of the law
    pressure: ClassVar[str] = "elliptical"  # mean pressure that the law is given, or "circular"
    # groups M and L of Moes within which the film of the law holds
    film_load: ClassVar[tuple[float, float]] = point_film.LOAD_RANGE
    film_material: ClassVar[tuple[float, float]] = point_film.MATERIAL_RANGE

    @abstractmethod
    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> FlankLaw:
        """Return the law for the kernels, for the roughness and the solids of a pair."""


@dataclass(frozen=True, kw_only=True)
class _Made(FlankFriction):
    """A law that a function of its user makes."""

    make: FlankLawMaker

    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> FlankLaw:
        return self.make(surface, solid)


def friction_laws(wanted: str = "") -> Mapping[str, type[FlankFriction]]:
    """Return the laws of flank friction by name, see `Kind.known`."""
    return FlankFriction.kind.known(wanted)


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
    return FlankFriction.kind.named("friction", friction, numbers)
