"""The sections of a case file for its surfaces: heights, ridges, dents, waves, roughness."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from gearlube_core.ehl.gap import Dent, Ridge, Waviness
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_file import Section
from gearlube_core.surface.extrusion import Lay, periodic_section
from gearlube_core.surface.files import read_surface
from gearlube_core.surface.gaussian_filter import filtered
from gearlube_core.surface.generator import generated_profile
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.heights import HeightMap, Profile, Surface
from gearlube_core.surface.measured_heights import (
    MeasuredMap,
    MeasuredProfile,
    read_map,
    read_profile,
)
from gearlube_core.surface.moving import MovingSurface
from gearlube_core.surface.stand_ins import stand_in
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
_MICRO = 1e-6  # m
_WAVE_POINTS = 256  # of one period of a wave
_POINTS = 10.0  # of the shortest generated wave
_SPACING = 1e-6  # m, of generated heights without a shortest wave
_SOURCES = ("file", "stand_in", "ra_um", "amplitude_um")

SurfaceLength = Annotated[float, Field(gt=0.0, le=1e5, allow_inf_nan=False), Usual(0.5, 20000.0)]
Period = Annotated[float, Field(ge=1.0, le=1e5, allow_inf_nan=False), Usual(2.0, 20000.0)]
RoughHeight = Annotated[float, Field(gt=0.0, le=100.0, allow_inf_nan=False), Usual(0.005, 20.0)]
LayAngle = Annotated[float, Field(gt=-89.0, lt=89.0, allow_inf_nan=False)]
Turns = Annotated[int, Field(ge=-1000, le=1000)]
Moment = Annotated[float, Field(ge=-10.0, le=150.0, allow_inf_nan=False)]
Seed = Annotated[int, Field(ge=0)]


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


class RoughSurface(Section):
    """A rough surface that repeats along x and over the length; it moves with its solid."""

    file: FileName | None = Field(
        default=None,
        description="File with heights: a profile (CSV) or a map (npz, NetCDF, SDF, X3P, SUR, "
        "AL3D); its path is relative to the case file",
    )
    stand_in: Literal["A", "B", "C"] | None = Field(
        default=None,
        description="A made-up profile of case A, B or C of Jamali 2015, whose measured "
        "profiles are not published; the faster surface gets the part that belongs to the "
        "faster one",
    )
    ra_um: RoughHeight | None = Field(default=None, description="Makes a random profile: its Ra")
    amplitude_um: RoughHeight | None = Field(
        default=None, description="Makes a cosine wave: half its height from trough to crest"
    )
    period_um: Period | None = Field(
        default=None,
        description="Period along x: of a wave, of a random profile, or of the part that is cut "
        "from a profile file, which without it is one period as a whole",
    )
    start_um: SurfaceLength | None = Field(
        default=None,
        description="About where that part of a profile file begins; left out: at 0",
    )
    correlation_um: SurfaceLength = Field(
        default=8.0,
        description="Correlation length of a random profile: where its autocorrelation has "
        "fallen to 0.2",
    )
    skewness: Moment = Field(
        default=0.0,
        description="Skewness Rsk of a random profile; below 0: deep valleys, few peaks",
    )
    kurtosis: Moment = Field(
        default=3.0, description="Kurtosis Rku of a random profile; 3: Gaussian heights"
    )
    shortest_um: SurfaceLength | None = Field(
        default=None, description="Shortest wave of a random profile; left out: 8 um"
    )
    seed: Seed = Field(
        default=1,
        description="Seed of the random numbers of a made-up or random profile; the same seed "
        "gives the same profile",
    )
    same_ra: bool = Field(
        default=False,
        description="Scale the part of a made-up profile to the Ra of the whole profile, 0.31 um",
    )
    cutoff_um: SurfaceLength | None = Field(
        default=None,
        description="Cut-off lambda_s of a Gaussian filter, which removes shorter waves",
    )
    turns: Turns | None = Field(
        default=None,
        description="Slope of the crests: number of periods by which a crest moves along x over "
        "the length; 0 (also if lay_deg is left out too): crests along y",
    )
    lay_deg: LayAngle | None = Field(
        default=None,
        description="Slope of the crests as an angle from y towards x; give it or turns",
    )

    @model_validator(mode="after")
    def _one_source(self) -> RoughSurface:
        given = [name for name in _SOURCES if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(
                f"give one of {', '.join(_SOURCES)}, got {' and '.join(given) or 'none'}"
            )
        if given[0] in ("ra_um", "amplitude_um") and self.period_um is None:
            raise ValueError(f"period_um is missing; {given[0]} needs it")
        if self.start_um is not None and (self.file is None or self.period_um is None):
            raise ValueError("start_um needs a file and period_um, the length of the part")
        if self.turns is not None and self.lay_deg is not None:
            raise ValueError("give one of turns and lay_deg, got both")
        return self

    def heights(self, fast: bool) -> Surface:
        """Return the heights of one period, mean zero [m]; `fast`: of the faster surface."""
        heights = self._whole(fast)
        if self.cutoff_um is not None:
            cutoff = self.cutoff_um * _MICRO
            if isinstance(heights, Profile):
                heights = filtered(heights, cutoff_short=cutoff).roughness
            else:
                heights = filtered(heights, cutoff_short=cutoff).roughness
        return replace(heights, height=heights.height - heights.height.mean())

    def moving(self, length: float, speed: float, fast: bool) -> MovingSurface:
        """Return the surface over a length [m] along y at its speed [m/s]."""
        heights = self.heights(fast)
        period = heights.length if isinstance(heights, Profile) else heights.lengths[0]
        if self.lay_deg is not None:
            lay = Lay.closing(period, length, self.lay_deg * DEGREE)
        else:
            lay = Lay(period=period, width=length, turns=self.turns or 0)
        return MovingSurface(heights=heights, lay=lay, speed=speed)

    def _whole(self, fast: bool) -> Surface:
        period = (self.period_um or 0.0) * _MICRO
        if self.stand_in is not None:
            fast_part, slow_part = _stand_in(self.stand_in, self.seed, self.same_ra)
            return fast_part if fast else slow_part
        if self.file is not None:
            return self._of_file(read_surface(self.file), period)
        if self.amplitude_um is not None:
            phase = 2.0 * math.pi * np.arange(_WAVE_POINTS) / _WAVE_POINTS
            return Profile(
                height=self.amplitude_um * _MICRO * np.cos(phase),
                spacing=period / _WAVE_POINTS,
                periodic=True,
                name="wave",
            )
        shortest = None if self.shortest_um is None else self.shortest_um * _MICRO
        spacing = _SPACING if shortest is None else shortest / _POINTS
        request = RoughnessRequest(
            arithmetic_mean=(self.ra_um or 0.0) * _MICRO,
            correlation_length=self.correlation_um * _MICRO,
            skewness=self.skewness,
            kurtosis=self.kurtosis,
            shortest_wave=shortest,
        )
        count = math.ceil(period / spacing)
        return generated_profile(request, period, count, np.random.default_rng(self.seed)).surface

    def _of_file(self, surface: Surface, period: float) -> Surface:
        if isinstance(surface, HeightMap):
            if self.period_um is not None:
                raise ParameterError(
                    f"period_um is only for a profile, but {surface.name} is a map. Leave "
                    "period_um out: a map is one period."
                )
            return replace(surface, periodic=(True, True))
        if self.period_um is None:
            return replace(surface, periodic=True)
        return periodic_section(surface, (self.start_um or 0.0) * _MICRO, period)


@lru_cache(maxsize=16)
def _stand_in(case: str, seed: int, same_mean: bool) -> tuple[Profile, Profile]:
    made = stand_in(case, seed, same_mean=same_mean)
    return made.fast, made.slow
