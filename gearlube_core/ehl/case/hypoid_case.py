"""Case files of hypoid flanks, in engineers' units."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from gearlube_core.ehl.case.film_case import FilmCase, Heat, Text, Wedge
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.input_file.input_file import Section
from gearlube_core.mesh_table.netcdf import read_mesh_table
from gearlube_core.mesh_table.shipped import shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

Speed = Annotated[float, Field(ge=1.0, le=47000.0, allow_inf_nan=False)]
Torque = Annotated[float, Field(ge=-10000.0, le=10000.0, allow_inf_nan=False)]
Temperature = Annotated[float, Field(ge=-60.0, le=200.0, allow_inf_nan=False)]
Roughness = Annotated[float, Field(ge=0.01, le=10.0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.01, le=0.9, allow_inf_nan=False)]
Phase = Annotated[float, Field(ge=-1.5, le=1.5, allow_inf_nan=False)]
Nodes = Annotated[int, Field(ge=17, le=1025)]
Tolerance = Annotated[float, Field(gt=0.0, le=1e-3, allow_inf_nan=False)]


class HypoidSolver(Section):
    """How the films of a flank are solved."""

    nodes_minor: Nodes = Field(default=257, description="Along the minor axis of the contact")
    nodes_major: Nodes = Field(default=65, description="Along the major axis")
    steps: Annotated[int, Field(ge=2, le=100000)] = Field(
        default=160, description="Time steps of the march"
    )
    steady: Annotated[int, Field(ge=2, le=1000)] = Field(
        default=17, description="Positions with a steady film"
    )
    wedge: Wedge = Field(default="quick", description="Stencil of the wedge")
    tolerance: Tolerance = Field(default=1e-5, description="Unbalanced flow")


class HypoidCase(FilmCase):
    """One tooth pair of a hypoid axle through its engagement.

    Examples
    --------
    >>> HypoidCase.named("mohammadpour_2015").varied({"solver.steady": 5}).solver.steady
    5
    """

    title: ClassVar[str] = "hypoid flank"
    prefix: ClassVar[str] = "hypoid_"

    mesh_table: Text = Field(
        default="mohammadpour_2015", description="Shipped mesh table, or a file (.nc)"
    )
    gear_file: Text | None = Field(
        default=None,
        description="Gear file of the table, shipped or .toml; for the point of contact's motion",
    )
    pinion_speed_rpm: Speed = Field(description="Mean speed of the pinion")
    pinion_torque_n_m: Torque = Field(
        description="Above 0 on the drive flank, below on the coast flank"
    )
    load: Literal["dynamic", "static"] = Field(
        default="dynamic", description="Of the running axle, or torque over arm times load share"
    )
    entrainment: Literal["mesh_table", "moving_contact"] = Field(
        default="mesh_table",
        description="Surface speeds in the fixed frame, as the axle takes them, or against the "
        "point of contact, which moves along the tooth",
    )
    oil: Text = Field(default="mohammadpour_2015", description="Of the library")
    flow: Literal["eyring", "newtonian"] = Field(
        default="eyring",
        description="Of the film; newtonian: the Eyring stress acts on friction alone",
    )
    temperature: Heat = Field(
        default="isothermal",
        description="thermal: also steady films with the energy balance of oil and flanks; "
        "transient thermal films are not implemented",
    )
    oil_temperature_degc: Temperature = Field(default=95.0, description="At the inlet")
    roughness_um: Roughness = Field(
        default=0.5, description="Composite root mean square, for the axle's friction"
    )
    smallest_load: Share = Field(
        default=0.1, description="Over the largest load of the pair, where the cycle begins, ends"
    )
    first_phase: Phase = Field(
        default=-1.5, description="Not before this [mesh periods from the middle of the window]"
    )
    last_phase: Phase = Field(default=1.5, description="Not after this [mesh periods]")
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
