"""Limits of the numbers that describe an oil in input files, in the units of their fields."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

Text = Annotated[str, Field(min_length=1)]
Viscosity = Annotated[float, Field(ge=2.0, le=1e5, allow_inf_nan=False)]
Density = Annotated[float, Field(ge=500.0, le=2000.0, allow_inf_nan=False)]
PressureViscosity = Annotated[float, Field(ge=1.0, le=100.0, allow_inf_nan=False)]
Stress = Annotated[float, Field(ge=0.01, le=1000.0, allow_inf_nan=False)]
Strength = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Conductivity = Annotated[float, Field(ge=0.02, le=2.0, allow_inf_nan=False)]
HeatCapacity = Annotated[float, Field(ge=100.0, le=1e4, allow_inf_nan=False)]
Temperature = Annotated[float, Field(ge=-60.0, le=250.0, allow_inf_nan=False)]
