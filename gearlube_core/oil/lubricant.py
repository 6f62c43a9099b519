"""A lubricant by viscosity line, pressure coefficient, shear strength and heat; its state."""

from __future__ import annotations

from dataclasses import MISSING, dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import Annotated, Any

from gearlube_core.checks import check_finite, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Number, Positive, check_fields
from gearlube_core.oil.film_laws import log_viscosity, roelands
from gearlube_core.oil.formula_laws import (
    FORMULA_LAWS,
    OilLaws,
    OverAlpha,
    alpha_at,
)
from gearlube_core.oil.library import (
    LIBRARY_PATH,
    LOWEST_VISCOSITY,
    lubricant_data,
    read_library,
)
from gearlube_core.oil.lubricant_state import (
    LubricantParameters,
    LubricantState,
    lubricant_state,
)
from gearlube_core.oil.oil_heat import HeatUnderPressure
from gearlube_core.oil.pressure_coefficients import (
    MEAN_PRESSURE,
    AlphaIs,
    pressure_coefficient,
    slope_for,
)
from gearlube_core.oil.pressure_factor import (
    NO_FACTOR,
    PressureFactor,
    film_coefficient,
    modulus_at,
)
from gearlube_core.oil.roelands_1966 import pressure_viscosity_coefficient, roelands_exponent
from gearlube_core.oil.walther_1931 import (
    walther_coefficients,
    walther_kinematic_viscosity,
)
from gearlube_core.part import Part

# of the limiting shear stress of a solved film over pressure; 0: no limit
LIMITING_SLOPE = Number("1", 0.0, 1.0, "0.05 is usual.")
_LAW_PRESSURE = 1e9  # Pa, where laws of two temperatures are compared
_LAW_TOLERANCE = 1e-6  # of ln(eta/eta0); rounding of a power is 1e-12
_SLOPE_TOLERANCE = 1e-3  # of alpha; the constants of Roelands in use differ by 4e-5


@cache
def _roelands_slope(eta0: float, alpha: float, alpha_is: AlphaIs, to: float) -> float:
    """Return the slope [1/Pa] of the law of Roelands that has a coefficient [1/Pa]."""
    return slope_for(lambda slope: roelands(eta0, slope), alpha, alpha_is, to)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lubricant:
    """A gear oil with its data: viscosity, density, behaviour under pressure and shear, heat.

    Parameters
    ----------
    name, source
        Name in the library, and the publication from which the data come.
    walther_a, walther_b
        Line log10 log10 (nu + 0.7) = A - B log10 T, nu in mm2/s, T in K [-].
    density
        Density [kg/m3], taken as independent of temperature.
    alpha
        Pressure-viscosity coefficient [1/Pa] at `alpha_temperature` [K]. At other temperatures
        it follows from the viscosity law, else from a constant Roelands exponent.
    alpha_is, alpha_pressure
        What `alpha` is, see `pressure_coefficient`; a mean slope goes to this pressure [Pa].
    eyring_stress, eyring_slope
        Shear stress at which shear thinning begins [Pa]; with a slope Lambda above 0 [-] that at
        ambient pressure, and under pressure 2 Lambda p/ln(eta/eta0), see `stress_ratio`.
    limiting_shear_stress, boundary_friction
        Shear strength of the boundary layer between asperities, tau = tau_l0 + gamma p: tau_l0 [Pa]
        and gamma [-].
    conductivity, conductivity_temperature, conductivity_slope
        Thermal conductivity [W/(m K)] at a temperature [K], and its slope [W/(m K2)].
    heat_capacity, heat_under_pressure
        Specific heat capacity [J/(kg K)]; how both rise with pressure in films, see `OilHeat`.
    temperature_low, temperature_high
        Range of oil temperatures for which the data are meant [K].
    alpha_factor, eyring_stress_factor, high_pressure_factor
        The true value lies between value/factor and value * factor with 95 % (k = 2) [-]; None:
        not known. The last is that of the viscosity at 1 GPa with the same alpha of films.
    viscosity_law, density_law, shear_law
        Laws of solved films, see `film_laws`; None: those of `film_oil_of`. Formulas of films and
        friction take some of viscosity and shear, see `own_laws`.

    Notes
    -----
    `Lubricant.named` reads the library of published oils. `with_two_viscosities` takes the two
    viscosities of an oil data sheet.

    Examples
    --------
    >>> oil = Lubricant.named("mohammadpour_2015")
    >>> own = oil.with_two_viscosities(1.5e-4, 313.15, 1.6e-5, 373.15, name="own oil")
    >>> round(own.dynamic_viscosity(363.15), 4)  # Pa s at 90 degC
    0.0183
    """

    name: str
    source: str
    walther_a: Annotated[float, Number("1", 1.0, 30.0)]
    walther_b: Annotated[float, Number("1", 0.3, 10.0)]
    density: Annotated[float, Number("kg/m3", 500.0, 2000.0, "870 kg/m3 is 0.87 g/cm3.")]
    alpha: float
    alpha_temperature: float
    eyring_stress: float
    limiting_shear_stress: float
    boundary_friction: Annotated[float, Number("1", 0.0, 1.0)]
    conductivity: Annotated[float, Number("W/(m K)", 0.02, 2.0)]
    conductivity_temperature: float
    conductivity_slope: Annotated[float, Number("W/(m K2)", -1e-2, 1e-2)]
    heat_capacity: Annotated[float, Number("J/(kg K)", 100.0, 1e4)]
    temperature_low: Annotated[float, Positive("K")]
    temperature_high: float
    alpha_factor: float | None = None
    eyring_stress_factor: float | None = None
    viscosity_law: Part | None = None
    density_law: Part | None = None
    shear_law: Part | None = None
    alpha_is: AlphaIs = "slope"
    alpha_pressure: Annotated[float, Number("Pa", 1e7, 1e9, "200 MPa is 2e8 Pa.")] = MEAN_PRESSURE
    heat_under_pressure: HeatUnderPressure = "none"
    eyring_slope: Annotated[float, Number("1", 0.0, 0.5, "0.05 is usual.")] = 0.0
    high_pressure_factor: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        alpha_cure = f"{self.alpha:g} 1/GPa is {1e-9 * check_finite('alpha', self.alpha):g} 1/Pa."
        check_within("alpha", self.alpha, 1e-10, 1e-6, "1/Pa", alpha_cure)
        stress_cure = "2 MPa is 2e6 Pa."
        check_within("eyring_stress", self.eyring_stress, 1e4, 1e9, "Pa", stress_cure)
        check_within("limiting_shear_stress", self.limiting_shear_stress, 0, 1e9, "Pa", stress_cure)
        check_within("temperature_high", self.temperature_high, self.temperature_low, 1000.0, "K")
        for name in ("alpha_factor", "eyring_stress_factor", "high_pressure_factor"):
            factor = getattr(self, name)
            if factor is not None:
                check_within(name, factor, 1.0, 10.0, "", "1.1 is 10 % either way.")
        for name in ("alpha_temperature", "conductivity_temperature"):
            self.check_temperature(getattr(self, name), name)

    def with_two_viscosities(
        self, nu_1: float, temperature_1: float, nu_2: float, temperature_2: float, *, name: str
    ) -> Lubricant:
        """Return a copy whose viscosity line passes through two data-sheet points.

        Parameters
        ----------
        nu_1, nu_2
            Kinematic viscosities [m2/s].
        temperature_1, temperature_2
            Their temperatures [K].
        name
            Name of the new lubricant.
        """
        cure = "109.1 mm2/s (cSt) is 1.091e-4 m2/s."
        for label, nu in (("nu_1", nu_1), ("nu_2", nu_2)):
            check_within(label, nu, LOWEST_VISCOSITY, 1.0, "m2/s", cure)
        check_positive("temperature_1", temperature_1, "K", "40 degC is 313.15 K.")
        check_positive("temperature_2", temperature_2, "K", "40 degC is 313.15 K.")
        if (nu_1 - nu_2) * (temperature_2 - temperature_1) <= 0.0:
            raise ParameterError(
                f"Viscosity must fall with temperature, got {nu_1:g} m2/s at {temperature_1:g} K "
                f"and {nu_2:g} m2/s at {temperature_2:g} K."
            )
        A, B = walther_coefficients(nu_1, temperature_1, nu_2, temperature_2)
        return replace(self, name=name, walther_a=A, walther_b=B)

    @classmethod
    def from_toml(cls, path: str | Path, name: str) -> Lubricant:
        """Return the lubricant `name` of a library file laid out like `lubricants.toml`."""
        data = lubricant_data(read_library(Path(path)), name)
        known = {field.name for field in fields(cls)}
        needed = {field.name for field in fields(cls) if field.default is MISSING}
        unknown, missing = sorted(set(data) - known), sorted(needed - set(data))
        if unknown or missing:
            raise ParameterError(
                f"Lubricant {name} in {path}: missing {missing or 'nothing'}, "
                f"unknown {unknown or 'nothing'}."
            )
        if "viscosity_law" in data:
            from gearlube_core.oil.named_laws import ViscosityLaw  # which knows oils

            data["viscosity_law"] = ViscosityLaw.kind.named(
                "viscosity_law", data["viscosity_law"], {}
            )
        return cls(**data)

    @classmethod
    def named(cls, name: str) -> Lubricant:
        """Return a lubricant of the library that comes with the package.

        Examples
        --------
        >>> round(Lubricant.named("karagiannis_2012").dynamic_viscosity(313.15), 5)
        0.09492
        """
        return cls.from_toml(LIBRARY_PATH, name)

    def check_temperature(self, temperature: float, name: str = "temperature") -> float:
        """Return `temperature` [K]; raise ParameterError outside the range of the data."""
        cure = f"The data of {self.name} are meant for this range; 90 degC is 363.15 K."
        return check_within(
            name, temperature, self.temperature_low, self.temperature_high, "K", cure
        )

    def dynamic_viscosity(self, temperature: float) -> float:
        """Return the viscosity at atmospheric pressure [Pa s] at a temperature [K]."""
        self.check_temperature(temperature)
        nu = walther_kinematic_viscosity(self.walther_a, self.walther_b, temperature)
        return nu * self.density

    @property
    def roelands_z(self) -> float:
        """Pressure exponent of the Roelands law [-], with the same alpha."""
        return roelands_exponent(
            self.dynamic_viscosity(self.alpha_temperature), self.roelands_slope
        )

    @property
    def roelands_slope(self) -> float:
        """Slope of ln eta at ambient pressure and `alpha_temperature`, by Roelands [1/Pa].

        His law then has the oil's alpha, or that of films of its pressure factor.
        """
        factor, T = self.pressure_factor(), float(self.alpha_temperature)
        if factor is not None:
            alpha = film_coefficient(*modulus_at(factor, T))
            return _roelands_slope(self.dynamic_viscosity(T), alpha, "film", MEAN_PRESSURE)
        if self.alpha_is == "slope":
            return self.alpha
        eta0 = self.dynamic_viscosity(T)
        return _roelands_slope(eta0, self.alpha, self.alpha_is, self.alpha_pressure)

    def pressure_factor(self) -> PressureFactor | None:
        """Return the pressure factor, of a law that has one."""
        law: Any = self.viscosity_law
        return law.factor_of(self) if hasattr(law, "factor_of") else None

    def state(self, temperature: float) -> LubricantState:
        """Return the properties at a temperature [K], with the laws of its own."""
        made: LubricantState = lubricant_state(self.parameters(), temperature, *self.own_laws())
        return made

    def with_high_pressure(self, by: float) -> Lubricant:
        """Return a copy whose viscosity at 1 GPa is `by` times as large, alpha of films kept.

        Both at 80 degC. An oil without a pressure factor stays as it is.

        Examples
        --------
        >>> from gearlube_core.oil.film_laws import log_viscosity
        >>> oil = Lubricant.named("arana_2019_m100")
        >>> laws = [one._law_for(353.15) for one in (oil, oil.with_high_pressure(2.0))]
        >>> grown = [log_viscosity(law, 1e9, 1.0)[0] for law in laws]
        >>> round(grown[1] - grown[0], 4)  # ln 2
        0.6931
        """
        law: Any = self.viscosity_law
        if self.pressure_factor() is None:
            return self
        return replace(self, viscosity_law=replace(law, growth=law.growth * by))

    @property
    def laws(self) -> tuple[Part, ...]:
        """The laws of films that the oil names."""
        named = (self.viscosity_law, self.density_law, self.shear_law)
        return tuple(law for law in named if law is not None)

    def own_laws(self) -> tuple[OilLaws, ...]:
        """Return what formulas take of laws that they do not know: one tuple, or none.

        Raises
        ------
        ParameterError
            A viscosity law has another slope at ambient pressure than alpha, or at another
            temperature it is not the law that kernels make of it.

        Notes
        -----
        Kernels take ln(eta/eta0) as a function of alpha p, and alpha of each temperature. A law
        that is none brings the kernel `law_at`, see `formula_laws`.
        """
        laws, viscosity, shear = FORMULA_LAWS, self.viscosity_law, self.shear_law
        if viscosity is not None and not getattr(viscosity, "formulas_know", False):
            law = self._law_for(self.alpha_temperature)
            if not hasattr(law, "law_at"):
                law = OverAlpha(law, float(self.alpha))
            laws = laws._replace(viscosity=law)
            self._check_law(laws, viscosity.name)
        if shear is not None and not shear.ships:
            made: Any = shear
            laws = laws._replace(shear=made(float(self.eyring_stress)))
        return () if laws is FORMULA_LAWS else (laws,)

    def _law_for(self, temperature: float) -> Any:
        """Return the viscosity law for kernels, made for a temperature [K]."""
        law: Any = self.viscosity_law
        eta0 = self.dynamic_viscosity(temperature)
        alpha = pressure_viscosity_coefficient(eta0, self.roelands_z)
        return law.at(self, temperature)[0](eta0, alpha)

    def _check_law(self, laws: OilLaws, name: str) -> None:
        for temperature in (self.alpha_temperature, self.temperature_low, self.temperature_high):
            state = lubricant_state(self.parameters(), float(temperature), laws)
            slope = alpha_at(state.viscosity, log_viscosity(state.viscosity, 0.0, 1.0)[1])
            if not abs(slope - state.alpha) <= _SLOPE_TOLERANCE * state.alpha:
                raise ParameterError(
                    f"The slope of ln eta at ambient pressure by the viscosity law {name} must be "
                    f"alpha, {1e9 * state.alpha:.4g} 1/GPa at {temperature:g} K, got "
                    f"{1e9 * slope:.4g} 1/GPa. Give the oil the alpha of the law."
                )
            made = log_viscosity(self._law_for(temperature), _LAW_PRESSURE, 1.0)[0]
            found = log_viscosity(state.viscosity, _LAW_PRESSURE, 1.0)[0]
            if not abs(found - made) <= _LAW_TOLERANCE * abs(made):
                raise ParameterError(
                    f"ln(eta/eta0) of the viscosity law {name} must depend on "
                    "alpha p alone for formulas of films and friction, got "
                    f"{made:.6g} at {temperature:g} K and {1e-9 * _LAW_PRESSURE:g} GPa, and "
                    f"{found:.6g} by the law of {self.alpha_temperature:g} K. Give its class for "
                    "kernels the method law_at(eta0, alpha), which returns the law of another "
                    "temperature."
                )

    def parameters(self) -> LubricantParameters:
        """Return the data as the tuple of floats that kernels take."""
        return LubricantParameters(
            walther_a=float(self.walther_a),
            walther_b=float(self.walther_b),
            density=float(self.density),
            roelands_z=float(self.roelands_z),
            alpha_share=float(self._alpha_share()),
            tau0=float(self.eyring_stress),
            eyring_slope=float(self.eyring_slope),
            tau_l0=float(self.limiting_shear_stress),
            gamma=float(self.boundary_friction),
            conductivity=float(self.conductivity),
            conductivity_temperature=float(self.conductivity_temperature),
            conductivity_slope=float(self.conductivity_slope),
            heat_capacity=float(self.heat_capacity),
            factor=self.pressure_factor() or NO_FACTOR,
        )

    def _alpha_share(self) -> float:
        """Return alpha of films over the slope by Roelands, at `alpha_temperature` [-]."""
        factor, T = self.pressure_factor(), float(self.alpha_temperature)
        if factor is not None:
            return film_coefficient(*modulus_at(factor, T)) / self.roelands_slope
        if self.alpha_is == "slope":
            return 1.0  # as the sources of formulas take it
        eta0 = self.dynamic_viscosity(T)
        return (
            pressure_coefficient(roelands(eta0, self.roelands_slope), "film") / self.roelands_slope
        )


def lubricant_names() -> tuple[str, ...]:
    """Return the names of the oils of the library, which `Lubricant.named` takes.

    Examples
    --------
    >>> lubricant_names()[:4]
    ('fva_3', 'fva_3a', 'arana_2019_m100', 'arana_2019_n100')
    """
    return tuple(read_library())
