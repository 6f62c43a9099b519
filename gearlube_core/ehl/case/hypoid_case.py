"""Case files of hypoid flanks, in engineers' units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.ehl.case.sections import FilmCase, Heat, Text, Wedge
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.input_file.field_notes import Declared, Usual
from gearlube_core.input_file.input_file import Section
from gearlube_core.mesh_table.netcdf import read_mesh_table, shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

Speed = Annotated[float, Field(ge=1.0, le=47000.0, allow_inf_nan=False), Usual(10.0, 20000.0)]
Torque = Annotated[float, Field(ge=-10000.0, le=10000.0, allow_inf_nan=False), Usual(1.0, 5000.0)]
Temperature = Annotated[float, Field(ge=-60.0, le=200.0, allow_inf_nan=False), Usual(-50.0, 180.0)]
Roughness = Annotated[float, Declared(ROUGHNESS, "roughness_um"), Usual(0.02, 5.0)]
Share = Annotated[float, Field(ge=0.01, le=0.9, allow_inf_nan=False)]
Phase = Annotated[float, Field(ge=-1.5, le=1.5, allow_inf_nan=False)]
Nodes = Annotated[int, Field(ge=17, le=1025)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-3, allow_inf_nan=False)]


class HypoidSolver(Section):
    """How the films of a flank are solved."""

    nodes_minor: Nodes = Field(
        default=257, description="Number of nodes along the minor axis of the contact"
    )
    nodes_major: Nodes = Field(
        default=65, description="Number of nodes along the major axis of the contact"
    )
    steps: Annotated[int, Field(ge=2, le=100000)] = Field(
        default=160, description="Number of time steps from entry to exit"
    )
    steady: Annotated[int, Field(ge=2, le=1000)] = Field(
        default=17, description="Number of positions at which a steady film is computed too"
    )
    wedge: Wedge = "quick"
    tolerance: Tolerance = Field(
        default=1e-5,
        description="A film is accepted when the relative error of the flow balance is below this",
    )


class HypoidCase(FilmCase):
    """Case of one tooth pair of a hypoid axle, from entry to exit, for `run_hypoid`.

    Examples
    --------
    >>> HypoidCase.named("mohammadpour_2015").varied({"solver.steady": 5}).solver.steady
    5
    """

    title: ClassVar[str] = "hypoid flank"
    prefix: ClassVar[str] = "hypoid_"
    files: ClassVar[tuple[str, ...]] = ("mesh_table", "gear_file")

    mesh_table: Text = Field(
        default="mohammadpour_2015",
        description="Name of a shipped mesh table, or a mesh table file (.nc), its path relative "
        "to the case file",
    )
    gear_file: Text | None = Field(
        default=None,
        description="Gear file that belongs to the mesh table, shipped or .toml, its path "
        "relative to the case file; only needed for the motion of the contact point",
    )
    pinion_speed_rpm: Speed = Field(description="Mean speed of the pinion")
    pinion_torque_n_m: Torque = Field(
        description="Torque on the pinion; above 0: the drive flank, below 0: the coast flank"
    )
    load: Literal["dynamic", "static"] = Field(
        default="dynamic",
        description="Load of the tooth pair. dynamic: from the running axle; static: torque "
        "divided by its arm, times the load share",
    )
    entrainment: Literal["mesh_table", "moving_contact"] = Field(
        default="mesh_table",
        description="Frame of the surface speeds. mesh_table: the fixed frame, as in the axle "
        "model; moving_contact: relative to the contact point, which moves along the tooth",
    )
    oil: Text = Field(default="mohammadpour_2015", description="Name of an oil of the library")
    flow: Literal["eyring", "newtonian"] = Field(
        default="eyring",
        description="How the oil of the film flows. eyring: shear thinning; newtonian: the "
        "Eyring stress acts on friction only",
    )
    temperature: Heat = Field(
        default="isothermal",
        description="thermal: steady films with the energy balance of oil and flanks too; "
        "transient thermal films are not implemented",
    )
    oil_temperature_degc: Temperature = Field(
        default=95.0, description="Temperature of the oil at the inlet"
    )
    roughness_um: Roughness = Field(
        default=0.5,
        description="Composite RMS roughness of both flanks, for the friction in the axle model",
    )
    smallest_load: Share = Field(
        default=0.1,
        description="The cycle begins and ends where the load is this share of the largest load "
        "of the pair",
    )
    first_phase: Phase = Field(
        default=-1.5,
        description="The cycle does not begin before this phase, in mesh periods from the "
        "middle of the contact window",
    )
    last_phase: Phase = Field(
        default=1.5,
        description="The cycle does not end after this phase, in mesh periods from the middle "
        "of the contact window",
    )
    solver: HypoidSolver = HypoidSolver()

    def table(self) -> MeshTable:
        """Return the mesh table."""
        is_file = self.mesh_table.endswith(".nc") or Path(self.mesh_table).exists()
        return read_mesh_table(self.mesh_table) if is_file else shipped_mesh_table(self.mesh_table)

    def settings(self) -> PointSolverSettings:
        """Return how the films are solved."""
        return PointSolverSettings(wedge=self.solver.wedge, tolerance=self.solver.tolerance)

    @property
    def pinion_speed(self) -> float:
        """Mean speed of the pinion [rad/s]."""
        return rpm_to_rads(self.pinion_speed_rpm)

    @property
    def oil_temperature(self) -> float:
        """Temperature of the oil [K]."""
        return celsius_to_kelvin(self.oil_temperature_degc)
