"""Limits of the numbers that describe an oil in input files, in the units of their fields."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlube_core.input_file.field_notes import Usual

Text = Annotated[str, Field(min_length=1)]
Viscosity = Annotated[float, Field(ge=2.0, le=1e5, allow_inf_nan=False), Usual(2.0, 3000.0)]
Density = Annotated[float, Field(ge=500.0, le=2000.0, allow_inf_nan=False), Usual(750.0, 1200.0)]
PressureViscosity = Annotated[float, Field(ge=1.0, le=100.0, allow_inf_nan=False), Usual(5.0, 50.0)]
Stress = Annotated[float, Field(ge=0.01, le=1000.0, allow_inf_nan=False), Usual(0.5, 50.0)]
Strength = Annotated[float, Field(ge=0.0, le=1000.0, allow_inf_nan=False), Usual(0.5, 100.0)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Conductivity = Annotated[float, Field(ge=0.02, le=2.0, allow_inf_nan=False), Usual(0.08, 0.3)]
HeatCapacity = Annotated[float, Field(ge=100.0, le=1e4, allow_inf_nan=False), Usual(1300.0, 3500.0)]
Temperature = Annotated[float, Field(ge=-60.0, le=250.0, allow_inf_nan=False), Usual(-55.0, 200.0)]
