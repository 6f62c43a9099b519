"""The sections of a case file that shape the gap: measured heights, ridge, dent, waviness."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlube_core.ehl.gap import Dent, Ridge, Waviness
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import Section
from gearlube_core.surface.measured_heights import (
    MeasuredMap,
    MeasuredProfile,
    read_map,
    read_profile,
)
from gearlube_core.units import DEGREE, MILLIMETRE

_MICROMETRE = 1e-6  # m

FileName = Annotated[str, Field(min_length=1)]
Size = Annotated[float, Field(gt=0.0, le=1000.0, allow_inf_nan=False), Usual(0.001, 20.0)]
Place = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.0, 20.0)]
Height = Annotated[float, Field(ge=-1000.0, le=1000.0, allow_inf_nan=False), Usual(0.01, 50.0)]
Amplitude = Annotated[float, Field(gt=0.0, le=1000.0, allow_inf_nan=False), Usual(0.005, 50.0)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0, allow_inf_nan=False)]
Meaning = Literal["heights", "gap"]

_MEANING = (
    "heights: material above the smooth shape, which narrows the gap; gap: the whole gap of the "
    "bare solids, up to a constant"
)


class ProfileFile(Section):
    """Measured or computed heights along a line contact."""

    file: FileName = Field(
        description="CSV file with the columns x_mm and height_um; its path is relative to the "
        "case file"
    )
    holds: Meaning = Field(default="heights", description=_MEANING)

    def surface(self) -> MeasuredProfile:
        """Return the heights of the file, in SI units."""
        return read_profile(self.file)


class MapFile(Section):
    """Measured or computed heights over a point contact."""

    file: FileName = Field(
        description="NetCDF or .npz file with x and y in mm and height in um; its path is "
        "relative to the case file"
    )
    holds: Meaning = Field(default="heights", description=_MEANING)

    def surface(self) -> MeasuredMap:
        """Return the heights of the file, in SI units."""
        return read_map(self.file)


class RidgeShape(Section):
    """A ridge or groove with a Gaussian section."""

    height_um: Height = Field(description="Height of the crest; a value below 0 makes a groove")
    width_mm: Size = Field(description="Width at half height")
    x_mm: Place = Field(default=0.0, description="x of a point on the crest")
    y_mm: Place = Field(default=0.0, description="y of a point on the crest")
    direction_deg: Angle = Field(
        default=90.0,
        description="Direction of the crest, from x towards y; 0: along x, 90: along y",
    )

    def surface(self) -> Ridge:
        """Return the ridge, in SI units."""
        return Ridge(
            height=self.height_um * _MICROMETRE,
            width=self.width_mm * MILLIMETRE,
            x=self.x_mm * MILLIMETRE,
            y=self.y_mm * MILLIMETRE,
            direction=self.direction_deg * DEGREE,
        )


class DentShape(Section):
    """A round dent or bump with a Gaussian section."""

    depth_um: Height = Field(description="Depth in the middle; a value below 0 makes a bump")
    width_mm: Size = Field(description="Diameter at half depth")
    x_mm: Place = Field(default=0.0, description="x of the middle")
    y_mm: Place = Field(default=0.0, description="y of the middle")

    def surface(self) -> Dent:
        """Return the dent, in SI units."""
        return Dent(
            depth=self.depth_um * _MICROMETRE,
            width=self.width_mm * MILLIMETRE,
            x=self.x_mm * MILLIMETRE,
            y=self.y_mm * MILLIMETRE,
        )


class WavinessShape(Section):
    """Straight harmonic waves."""

    amplitude_um: Amplitude = Field(description="Amplitude: half the height from trough to crest")
    wavelength_mm: Size = Field(description="Distance from crest to crest")
    direction_deg: Angle = Field(
        default=0.0,
        description="Direction normal to the crests, from x towards y; 0: the crests lie along y",
    )
    phase_deg: Angle = Field(
        default=0.0, description="Phase of the waves; 0: a crest passes through x = y = 0"
    )

    def surface(self) -> Waviness:
        """Return the waves, in SI units."""
        return Waviness(
            amplitude=self.amplitude_um * _MICROMETRE,
            wavelength=self.wavelength_mm * MILLIMETRE,
            direction=self.direction_deg * DEGREE,
            phase=self.phase_deg * DEGREE,
        )
