"""Settings of a study of a helical pair."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Annotated, Literal

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.hertz import line_mean_pressure
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.dynamics.helical_pair.gear_file_pair import (
    constant_density_mesh,
    gear_file_film_model,
    gear_file_oil,
    helical_pair_parameters,
    iso_mesh,
    named_oil,
)
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.separation.problem import SeparationProblem
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.chosen_model import check_oil
from gearlube_core.film_model.model import LINE, FilmModel
from gearlube_core.friction.flank_laws import AranaShare
from gearlube_core.friction.line_points import line_points, uniform_line_load
from gearlube_core.helical_contact.mesh_cycle import CycleSettings
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.number import Number, check_fields, numbers_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity

MESHES = ("contact", "density")
FRICTIONS = ("film", "constant", AranaShare.name)
PARTS = ("all", "contact", "dynamics", "geometry", "losses")
RPM = math.pi / 30.0  # rad/s
LINE_DENSITY = Number("N/m2", 1e7, 1e13, "About 1.3e10 N/m2 is usual for steel.")

# Pa; case-hardened flanks take 1.6 times 1.65 GPa for a few cycles [iso_6336_2; iso_6336_5]
_MOST_PRESSURE = 4e9
HARMONICS = 15  # [he_2007 sec. 6]
SHOWN_MU = (0.01, 0.1)  # [he_2007], figures 6 to 8
LOAD_STEPS = (0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5)  # of the pinion torque
_REACH = 1.1  # highest mesh frequency over that of the mesh's own mode
_COARSE = CondensationSettings(
    profile_hats=5,
    lengthwise_hats=7,
    density=MeshDensity(profile=8, lengthwise=12, thickness=3, fillet=3, rim=2),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalSettings:
    """Operating point, ranges and options of a helical study, for `run_helical`.

    Parameters
    ----------
    file : HelicalGearFile
        The pair, its supports and damping.
    pinion_torque, pinion_speed : float
        Operating point [N.m], [rad/s].
    mu : tuple of float
        Coefficients of friction of the sweeps [-], rising from 0 to 1.
    speeds : tuple of float
        Pinion speeds of the sweep [rad/s], rising; empty: `speed_count` speeds up to 1.1 times the
        resonance of the mesh.
    speed_count : int
        Number of speeds of the sweep if `speeds` is empty.
    mesh : {"contact", "density"}
        Stiffness of the vibrating pair: that of the loaded contact, or one constant density along
        all lines.
    density : float, optional
        Stiffness density for mesh "density" [N/m2]; None: from ISO 6336-1.
    friction : {"arana_2019", "film", "constant"}
        "constant": constant coefficients only; the others: friction of the oil film too, with
        asperities by the share of Arana et al. or by Greenwood and Tripp.
    boundary_friction, share_exponent : float, optional
        Of the asperities with "arana_2019" [-]; default: those of the law.
    torques : tuple of float
        Pinion torques of the loaded contact [N.m]; empty: `LOAD_STEPS`.
    positions : int
        Number of mesh phases of the loaded contact.
    oil : str or Lubricant, optional
        Name of an oil of the library, or any other oil; None: that of the gear file.
    film_model : {"formula", "solved"}, optional
        Film and friction of the oil, see `HelicalMarchParameters`; None: that of the gear file.
    line_film_model : FilmModel, optional
        Model of solved films; None: that of the gear file, else the one in the package.
    oil_temperature, roughness_rms : float
        Oil temperature [K], composite roughness of both flanks [m].
    parts : {"all", "contact", "dynamics", "geometry", "losses"}
        Parts of the study that are run.
    oil_temperatures : tuple of float
        Oil temperatures of the losses [K], rising; empty: only oil_temperature.
    draws, seed : int
        Number of samples of the uncertain data for the error bars of the losses, 0 to 10000, and
        the seed of the random numbers.
    stability_columns, stability_rows : int
        Size of the maps of parametric instability.
    separation_speeds : int
        Number of speeds of the response with tooth separation; 0: none.
    body : HelicalBodySettings
        Elastic teeth.

    Examples
    --------
    >>> file = HelicalGearFile.named("he_2007")
    >>> settings = HelicalSettings(file=file, pinion_torque=200.0, pinion_speed=104.7)
    >>> settings.positions
    24
    """

    file: HelicalGearFile
    pinion_torque: Annotated[float, Number("N.m", 1e-3, 1e6, "Give its magnitude.")]
    pinion_speed: Annotated[float, Number("rad/s", 1e-2, 1e5, "Give its magnitude.")]
    mu: tuple[float, ...] = tuple(float(v) for v in np.round(np.linspace(0.0, 0.3, 31), 10))
    speeds: tuple[float, ...] = ()
    speed_count: Annotated[int, Number("1", 2, 2000)] = 60
    mesh: str = "contact"
    density: float | None = None
    friction: str = AranaShare.name
    boundary_friction: float | None = None
    share_exponent: float | None = None
    torques: tuple[float, ...] = ()
    positions: int = 24
    oil: str | Lubricant | None = None
    film_model: Literal["formula", "solved"] | None = None
    line_film_model: FilmModel | None = None
    oil_temperature: float = 353.15
    roughness_rms: float = 0.5e-6
    parts: str = "all"
    oil_temperatures: tuple[float, ...] = ()
    draws: Annotated[int, Number("1", 0, 10_000, "60 are usual.")] = 60
    seed: int = 1
    stability_columns: int = 120
    stability_rows: int = 33
    separation_speeds: Annotated[int, Number("1", 0, 5000)] = 120
    body: HelicalBodySettings = field(default_factory=HelicalBodySettings)

    def __post_init__(self) -> None:
        if self._of_share() and self.friction != AranaShare.name:
            named = " and ".join(f"--{name.replace('_', '-')}" for name in self._of_share())
            raise ParameterError(
                f"Only --friction {AranaShare.name} takes {named}, got --friction "
                f"{self.friction}, whose asperities have the numbers of the oil. Leave it out."
            )
        for name, options in (("mesh", MESHES), ("friction", FRICTIONS), ("parts", PARTS)):
            check_option(name, getattr(self, name), options)
        check_fields(self)
        for name, unit, high in (("mu", "", 1.0), ("speeds", "rad/s", 1e5)):
            values = getattr(self, name)
            for value in values:
                check_within(name, value, 0.0 if name == "mu" else 1e-2, high, unit)
            if any(np.diff(values) <= 0.0):
                raise ParameterError(f"{name} must rise, got {values}. Sort them.")
        if not self.mu:
            raise ParameterError("mu must have at least one coefficient, got none. Try 0:0.3:0.01.")
        if self.density is not None:
            if self.mesh == "contact":
                raise ParameterError(
                    "density cannot be given with mesh contact, which computes the stiffness, got "
                    f"{self.density:g} N/m2. Leave it out, or take mesh density."
                )
            LINE_DENSITY.check("density", self.density)
        _check_pressure(self)
        if self.with_contact:
            self.cycle()
        low, high = 0.999 * self.load_steps[0], 1.001 * self.load_steps[-1]
        if self.with_dynamics and self.mesh == "contact":
            cure = (
                "The pair vibrates on the stiffness of its loaded contact at that torque: give "
                "torques around it, or take mesh density (ISO 6336-1)."
            )
            check_within("pinion_torque", self.pinion_torque, low, high, "N.m", cure)
        _check_film_model(self)
        for temperature in self.oil_temperatures:
            self.film().oil.check_temperature(temperature, "oil_temperatures")
        if any(np.diff(self.oil_temperatures) <= 0.0):
            raise ParameterError(
                f"oil_temperatures must rise, got {self.oil_temperatures}. Sort them."
            )
        for name in ("stability_columns", "stability_rows"):
            check_within(name, getattr(self, name), 2, 2000)
        if self.with_dynamics:
            self.parameters()

    @property
    def with_contact(self) -> bool:
        """Whether loaded contact is analysed."""
        return self.parts in ("all", "contact") or (
            self.parts == "dynamics" and self.mesh == "contact"
        )

    @property
    def with_dynamics(self) -> bool:
        """Whether vibration is computed."""
        return self.parts in ("all", "dynamics")

    @property
    def with_geometry(self) -> bool:
        """Whether geometry is written."""
        return self.parts in ("all", "geometry")

    @property
    def with_losses(self) -> bool:
        """Whether the losses of the pair alone are computed."""
        return self.parts in ("all", "losses")

    @property
    def load_steps(self) -> tuple[float, ...]:
        """Pinion torques of the loaded contact [N.m], rising."""
        return self.torques or tuple(step * self.pinion_torque for step in LOAD_STEPS)

    @property
    def stiffness_density(self) -> float:
        """Stiffness density of the mesh "density" [N/m2]."""
        return float(self.constant_mesh().density.max())

    def constant_mesh(self) -> LineMesh:
        """Return the mesh with one constant stiffness density."""
        pair = self.file.helical_pair()
        if self.density is None:
            return iso_mesh(pair, self.pinion_torque)
        return constant_density_mesh(pair, self.density, "given")

    def film(self) -> FilmFriction:
        """Return the oil and the flank data for film friction."""
        return FilmFriction(
            oil=gear_file_oil(self.file) if self.oil is None else named_oil(self.oil),
            oil_temperature=self.oil_temperature,
            solid=STEEL_MOHAMMADPOUR_2015,
            roughness_rms=self.roughness_rms,
            asperities=(
                AranaShare(**self._of_share()) if self.friction == AranaShare.name else None
            ),
            film=self.film_model or self.file.film.model,
            line_film_model=self.line_film_model or gear_file_film_model(self.file),
        )

    def _of_share(self) -> dict[str, float]:
        """Return the numbers of the share of the asperities that were asked for."""
        given = {name: getattr(self, name) for name in numbers_of(AranaShare)}
        return {name: value for name, value in given.items() if value is not None}

    def parameters(self, mesh: LineMesh | None = None) -> HelicalPairParameters:
        """Return the vibrating pair with mu = 0; its mesh has one density if left out.

        `film` is set where the oil film is asked for.
        """
        pair = helical_pair_parameters(
            self.file, pinion_torque=self.pinion_torque, mesh=mesh or self.constant_mesh()
        )
        return replace(pair, film=self.film()) if self.friction != "constant" else pair

    def cycle(self) -> CycleSettings:
        """Return the positions and loads of the loaded contact."""
        return CycleSettings(torques=self.load_steps, positions=self.positions)

    def swept_speeds(self, parameters: HelicalPairParameters) -> Array:
        """Return the pinion speeds of the sweep [rad/s]."""
        if self.speeds:
            return np.array(self.speeds)
        resonance = SeparationProblem(replace(parameters, contact="one_sided")).natural_speed
        top = _REACH * resonance / RPM
        step = max(10.0 * round(top / self.speed_count / 10.0), 10.0)
        return RPM * step * np.arange(1.0, self.speed_count + 1.0)


def quick_settings(settings: HelicalSettings) -> HelicalSettings:
    """Return settings for a first look: few points, coarse teeth."""

    def thinned(values: tuple[float, ...], count: int) -> tuple[float, ...]:
        if len(values) <= count:
            return values
        return tuple(values[i] for i in np.linspace(0, len(values) - 1, count).round().astype(int))

    return replace(
        settings,
        mu=thinned(settings.mu, 7),
        speeds=thinned(settings.speeds, 15),
        speed_count=min(settings.speed_count, 15),
        torques=settings.torques or thinned(settings.load_steps, 4),
        positions=min(settings.positions, 8),
        draws=min(settings.draws, 10),
        stability_columns=min(settings.stability_columns, 40),
        stability_rows=min(settings.stability_rows, 7),
        separation_speeds=min(settings.separation_speeds, 60),
        body=replace(settings.body, condensation=_COARSE),
    )


def _check_pressure(settings: HelicalSettings) -> None:
    """Raise ParameterError if the largest pressure of even lines at the pitch point is too high."""
    pair = settings.file.helical_pair()
    solid = settings.film().solid
    twist = math.cos(pair.base_helix_angle)
    radius = pair.pitch_point * (1.0 - pair.pitch_point / pair.tangent_length) / twist
    line_load = 1.0 / (pair.pinion_base_radius * twist * pair.mean_contact_length)  # of 1 N.m
    of_one = 4.0 / math.pi * line_mean_pressure(line_load, radius, contact_modulus(solid, solid))
    most = (_MOST_PRESSURE / of_one) ** 2
    cure = "It would press the flanks with more than 4 GPa. Check the unit: N.m at the pinion."
    for name, value in (
        ("pinion_torque", settings.pinion_torque),
        ("torques", settings.load_steps[-1]),
    ):
        check_within(name, value, 0.0, most, "N.m", cure)


_ALL_OUTSIDE = 0.999  # of the load: the film model does not apply


def _check_film_model(settings: HelicalSettings) -> None:
    """Refuse solved films where all load lies outside the domain of the film model.

    Raises
    ------
    ParameterError
    """
    film = settings.film()
    if film.film != "solved":
        return
    if film.line_film_model is not None:
        check_oil(film.line_film_model, film.oil, film.solid, "The film model")
    points = line_points(settings.file.helical_pair(), 4, 2)
    load = np.asarray(uniform_line_load(points, settings.pinion_torque))
    cycle = film.cycle(points, load, settings.pinion_speed, settings.pinion_torque)
    if cycle.share_outside > _ALL_OUTSIDE:
        raise ParameterError(
            "film.model solved must have an oil and an operating point within the domain of the "
            f"film model {film.film_models[LINE].name}, got {film.oil.name} at "
            f"{film.oil_temperature - 273.15:.4g} degC, {settings.pinion_torque:g} N.m and "
            f"{settings.pinion_speed:.4g} rad/s with all load outside. `gearlube film-model show` "
            "shows the domain. Take an oil and an operating point inside it; or train a model for "
            "this oil, `gearlube film-model train --contact line --oil OIL`, and give it with "
            "--film-model or as film.line_model; or take film.model formula."
        )
