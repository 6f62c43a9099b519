"""Settings of a resonance study."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.hypoid_torsional.parameters import (
    HypoidTorsionalParameters,
    Radii,
    karagiannis_2012_pair,
)
from gearlube_core.dynamics.ranges import TORQUE_MARGIN
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.table import MeshTable

# in the order in which they are run; "dry" models are checked by sweeps in time
MODELS = {
    "two_dof": "2-DOF, dry",
    "one_dof": "1-DOF, dry",
    "two_dof_mean_radii": "2-DOF, dry, constant radii",
    "two_dof_lubricated": "2-DOF, lubricated",
}
SWEPT = ("two_dof", "one_dof")
ORBITS_AT = (0.3, 0.65, 1.0)  # mesh over natural frequency, [karagiannis_2012 fig. 8] to 14
HOT = 373.15  # K, [karagiannis_2012 fig. 21]


@dataclass(frozen=True, slots=True, kw_only=True)
class ResonanceSettings:
    """Gear pair, oil and frequency range of a resonance study, for `run_resonance`.

    Parameters
    ----------
    mesh : MeshTable, optional
        Default: the table that ships.
    radii : {"consistent", "paper", "mean"}
        See `HypoidTorsionalParameters`.
    pinion_torque : float
        Mean torque on the pinion [N.m].
    oil_temperature : float
        Temperature of the oil [K].
    roughness_rms : float
        Composite roughness of the flanks [m].
    friction : {"thermal_eyring", "off"}
        "off" leaves out the lubricated model and the flank contacts.
    first, last : float
        Range of mesh frequency divided by natural frequency [-], 0.05 to 3.
    frequencies : int
        Number of equally spaced rows of each response curve; the branch adds points between them.
    sweep_frequencies : int
        Number of frequencies of the time sweeps; 0: none.
    section_starts : int
        Number of start points of the Poincare section; 0: none.
    load_at : float, optional
        If given, the response is also followed over the pinion torque, at this mesh frequency
        divided by natural frequency [-], 0.05 to 3.
    changes : tuple of (str, float)
        Fields of `HypoidTorsionalParameters` that differ from the papers' pair, by name and in SI
        units: inertias, backlash, damping.
    steps_per_mesh_period, lubricated_steps : int
        Steps of the integrator, without and with friction. Steps in which flanks touch or part are
        split there. With the default, Floquet multipliers are exact to 1e-4, with friction to 3e-4.

    Examples
    --------
    >>> from gearlube_core.mesh_table.netcdf import shipped_mesh_table
    >>> ResonanceSettings(mesh=shipped_mesh_table("mohammadpour_2015"), friction="off").friction
    'off'
    """

    mesh: MeshTable | None = None
    radii: Radii = "consistent"
    pinion_torque: float = 50.0
    oil_temperature: float = 313.15
    roughness_rms: float = 0.5e-6
    friction: str = "thermal_eyring"
    first: float = 0.2
    last: float = 1.6
    frequencies: int = 200
    sweep_frequencies: int = 60
    section_starts: int = 24
    load_at: float | None = None
    changes: tuple[tuple[str, float], ...] = ()
    steps_per_mesh_period: int = 256
    lubricated_steps: int = 128

    def __post_init__(self) -> None:
        check_option("friction", self.friction, ("thermal_eyring", "off"))
        cure = "Mesh over natural frequency; 0.2 to 1.6 holds the main resonance."
        check_within("range", self.first, 0.05, 3.0, "", cure)
        check_within("range", self.last, 0.05, 3.0, "", cure)
        if not self.last > 1.01 * self.first:
            raise ParameterError(f"range must rise, got {self.first:g} to {self.last:g}. {cure}")
        check_within("frequencies", self.frequencies, 2, 5000)
        check_within("sweep_frequencies", self.sweep_frequencies, 0, 5000)
        check_within("section_starts", self.section_starts, 0, 1000)
        if self.load_at is not None:
            check_within("load_at", self.load_at, 0.05, 3.0, "", "0.9 shows the bistable range.")
        self.parameters("two_dof")
        if self.mesh is not None and self.pinion_torque > TORQUE_MARGIN * self.mesh.torque[-1]:
            raise ParameterError(
                f"pinion_torque must be at most {TORQUE_MARGIN:g} times the highest torque of the "
                f"mesh table, {self.mesh.torque[-1]:g} N.m, got {self.pinion_torque:g} N.m. "
                "Run `gearlube contact` with higher torques."
            )

    @property
    def warnings(self) -> tuple[str, ...]:
        """Quantities outside the range of their table, one sentence each."""
        if self.mesh is None or self.pinion_torque <= self.mesh.torque[-1]:
            return ()
        return (
            f"The pinion torque of {self.pinion_torque:g} N.m is beyond the mesh table, which ends "
            f"at {self.mesh.torque[-1]:g} N.m: its data hold at the end. Run `gearlube contact` "
            "with higher torques.",
        )

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the models that are run, see `MODELS`."""
        return tuple(
            name for name in MODELS if self.friction != "off" or name != "two_dof_lubricated"
        )

    @property
    def relative(self) -> Array:
        """Mesh over natural frequency of the requested rows [-], shape (frequencies,)."""
        return np.linspace(self.first, self.last, self.frequencies)

    @property
    def orbits_at(self) -> tuple[float, ...]:
        """Mesh over natural frequency at which motions are stored [-]."""
        return tuple(value for value in ORBITS_AT if self.first <= value <= self.last)

    def steps(self, model: str) -> int:
        """Return the integrator steps per mesh period of a model."""
        return (
            self.lubricated_steps if model == "two_dof_lubricated" else (self.steps_per_mesh_period)
        )

    def parameters(
        self, model: str, oil_temperature: float | None = None
    ) -> HypoidTorsionalParameters:
        """Return the gear pair of a model, at another oil temperature [K] if given."""
        changes: dict[str, Any] = dict(self.changes)
        return replace(
            karagiannis_2012_pair(self.mesh),
            **changes,
            form="one_dof" if model == "one_dof" else "two_dof",
            radii="mean" if model == "two_dof_mean_radii" else self.radii,
            pinion_torque=self.pinion_torque,
            friction="thermal_eyring" if model == "two_dof_lubricated" else "off",
            oil_temperature=oil_temperature or self.oil_temperature,
            roughness_rms=self.roughness_rms,
        )


def quick_settings(settings: ResonanceSettings) -> ResonanceSettings:
    """Return settings for a first look: few frequencies, coarse steps with friction."""
    return replace(
        settings,
        frequencies=min(settings.frequencies, 25),
        sweep_frequencies=min(settings.sweep_frequencies, 12),
        section_starts=min(settings.section_starts, 6),
        steps_per_mesh_period=128,
        lubricated_steps=96,
    )
