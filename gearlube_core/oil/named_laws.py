"""Laws of the oil in a film by name: each registers itself, and all that names laws asks here.

A dataclass that derives from `ViscosityLaw`, `DensityLaw` or `ShearLaw` has the numbers of a law
and makes the NamedTuple for the kernels, see `film_laws`. It stands in any file that is imported,
or named as an entry point of the group `gearlube.laws`::

    @dataclass(frozen=True, kw_only=True)
    class MyDensity(DensityLaw, name="my_density"):
        K0: Annotated[float, Number("Pa", 1e8, 1e10)] = 1.2e9

        def __call__(self):
            return MyDensityKernels(self.K0)

Oil files, case files and `film_oil` take it by its name. Formulas of friction, as in axle and pair,
take laws of viscosity and shear from outside the package, see `formula_laws`. Instead of the laws
below they have those that their sources print.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar

from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, numbers_of
from gearlube_core.oil.eyring_1936 import NEWTONIAN, Eyring
from gearlube_core.oil.film_laws import (
    DOWSON_HIGGINSON_1966,
    INCOMPRESSIBLE,
    DowsonHigginson,
    RoelandsHoupert,
    barus,
    roelands,
)
from gearlube_core.oil.houpert_1985 import houpert_log_viscosity, houpert_parameters
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.roelands_1966 import ROELANDS_KAPPA
from gearlube_core.part import Kind, Part


def _kind(what: str) -> Kind[Any]:
    return Kind(what=what, group="gearlube.laws", package="gearlube_core.oil", files="*_law*")


@dataclass(frozen=True, kw_only=True)
class ViscosityLaw(Part):
    """A law of viscosity by name."""

    kind: ClassVar[Kind[ViscosityLaw]] = _kind("viscosity law")
    least_viscosity: ClassVar[float] = 0.0  # at ambient pressure [Pa s]
    formulas_know: ClassVar[bool] = False  # formulas have their own law for it, or its numbers

    @abstractmethod
    def __call__(self, eta0: float, alpha: float) -> Any:
        """Return the law for kernels of an oil: viscosity [Pa s], slope of its logarithm [1/Pa]."""

    def at(self, oil: Lubricant, temperature: float) -> tuple[ViscosityLaw, float]:
        """Return the law for an oil at a temperature [K], and eta0 there [Pa s]."""
        return self, oil.dynamic_viscosity(temperature)


@dataclass(frozen=True, kw_only=True)
class DensityLaw(Part):
    """A law of density by name."""

    kind: ClassVar[Kind[DensityLaw]] = _kind("density law")

    @abstractmethod
    def __call__(self) -> Any:
        """Return the law for kernels."""

    def at(self, temperature: float) -> DensityLaw:
        """Return the law at a temperature of the oil [K]."""
        return self


@dataclass(frozen=True, kw_only=True)
class ShearLaw(Part):
    """A law of shear by name."""

    kind: ClassVar[Kind[ShearLaw]] = _kind("shear law")
    needs_stress: ClassVar[bool] = True  # the Eyring stress of the oil

    @abstractmethod
    def __call__(self, tau0: float) -> Any:
        """Return the law for kernels; `tau0` is the Eyring stress of the oil [Pa]."""


class Barus(ViscosityLaw, name="barus"):
    """eta = eta0 exp(alpha p)."""

    formulas_know = True

    def __call__(self, eta0: float, alpha: float) -> RoelandsHoupert:
        """Return the law for kernels."""
        return barus(alpha)


class Roelands(ViscosityLaw, name="roelands"):
    """eta = eta0 exp{A [(1 + chi p)^Z - 1]}."""

    formulas_know = True
    least_viscosity = 1.0001 * ROELANDS_KAPPA

    def __call__(self, eta0: float, alpha: float) -> RoelandsHoupert:
        """Return the law for kernels."""
        return roelands(eta0, alpha, self.numbers.get("temperature_exponent", 0.0))


@dataclass(frozen=True, kw_only=True)
class Houpert(Roelands, name="houpert"):
    """The same over temperature; of a lubricant through its viscosities at 40 and 100 degC."""

    temperature_exponent: Annotated[float, Number("1", 0.0, 5.0, text="Exponent S0")] = 0.0

    def at(self, oil: Lubricant, temperature: float) -> tuple[ViscosityLaw, float]:
        """Return the law and eta0; its own constant 9.67 and kappa agree to 4e-5."""
        fit = houpert_parameters(oil)
        eta0 = ROELANDS_KAPPA * math.exp(houpert_log_viscosity(fit, 0.0, temperature))
        return replace(self, temperature_exponent=fit.S0), eta0


class DowsonHigginsonDensity(DensityLaw, name="dowson_higginson"):
    """rho = rho0 (1 + gamma p)/(1 + lambda p)."""

    def __call__(self) -> DowsonHigginson:
        """Return the law for kernels."""
        return DOWSON_HIGGINSON_1966


class Incompressible(DensityLaw, name="incompressible"):
    """rho = rho0."""

    def __call__(self) -> DowsonHigginson:
        """Return the law for kernels."""
        return INCOMPRESSIBLE


class EyringShear(ShearLaw, name="eyring"):
    """du/dz = (tau0/eta) sinh(tau/tau0)."""

    def __call__(self, tau0: float) -> Eyring:
        """Return the law for kernels."""
        return Eyring(tau0)


class Newtonian(ShearLaw, name="newtonian"):
    """du/dz = tau/eta."""

    def __call__(self, tau0: float) -> Eyring:
        """Return the law for kernels."""
        return NEWTONIAN


def chosen_laws(
    numbers: Mapping[str, float] | None = None, **names: tuple[type[Part], str | None]
) -> dict[str, Any]:
    """Return laws by field.

    Parameters
    ----------
    numbers
        Numbers of the laws by name, in SI units.
    **names
        By field: kind of law, and its name; None: none is chosen.

    Raises
    ------
    ParameterError
        There is no such law, a number is out of its range, or not one law has it.
    """
    kinds = {
        field: base.kind.known(name).get(name) for field, (base, name) in names.items() if name
    }
    known = {field: numbers_of(kind) for field, kind in kinds.items() if kind is not None}
    for number in numbers or ():
        owners = [field for field, own in known.items() if number in own]
        if len(owners) != 1:
            listed = ", ".join(sorted({one for own in known.values() for one in own}))
            said = f"the chosen laws have {listed or 'no numbers'}"
            if owners:
                said = f"{' and '.join(owners)} both have it"
            raise ParameterError(
                f"law_numbers must name numbers of the oil's laws, each of one law alone, got "
                f"{number!r}; {said}. Correct the name, or leave it out."
            )
    return {
        field: base.kind.named(
            field, name, {n: v for n, v in (numbers or {}).items() if n in known.get(field, ())}
        )
        for field, (base, name) in names.items()
        if name
    }
