"""The section of the axle file on pinion or gear; its mass and inertia may be those of frusta."""

from __future__ import annotations

import math
from typing import Annotated, Any, NamedTuple

from pydantic import Field, model_validator

from drivetrain.axle_file.bearing_section import BearingSection
from drivetrain.axle_file.field_units import field_value, unit_of
from drivetrain.axle_file.model_section import ModelSection
from gearlube_core.input_file.field_notes import Usual
from gearlube_core.input_file.input_note import InputNote, Origin

Mass = Annotated[float, Field(ge=0.05, le=2000.0, allow_inf_nan=False), Usual(0.5, 500.0)]
Inertia = Annotated[float, Field(ge=1e-6, le=500.0, allow_inf_nan=False), Usual(0.0001, 20.0)]
Length = Annotated[float, Field(gt=0.0, le=2000.0, allow_inf_nan=False), Usual(1.0, 500.0)]
Diameter = Annotated[float, Field(gt=0.0, le=3000.0, allow_inf_nan=False), Usual(3.0, 1000.0)]
Bore = Annotated[float, Field(ge=0.0, le=3000.0, allow_inf_nan=False), Usual(1.0, 500.0)]
Frusta = Annotated[tuple[Length, ...], Field(strict=False, min_length=1, max_length=40)]
Diameters = Annotated[tuple[Diameter, ...], Field(strict=False, min_length=1, max_length=40)]
Bores = Annotated[tuple[Bore, ...], Field(strict=False, min_length=1, max_length=40)]

_LISTS = ("frusta_lengths_mm", "frusta_first_diameters_mm", "frusta_last_diameters_mm")
_KEYS = ("mass_kg", "inertia_kg_m2")


class SolidOfRevolution(NamedTuple):
    """Mass [kg] and inertia about the axis [kg m2]."""

    mass: float
    inertia: float


def stacked_frusta(
    lengths: tuple[float, ...],
    first: tuple[float, ...],
    last: tuple[float, ...],
    bores: tuple[float, ...],
    density: float,
) -> SolidOfRevolution:
    """Return mass and inertia of frusta of cones on one axis, each with a bore.

    m = rho pi l [(r1^2 + r1 r2 + r2^2)/3 - rb^2]
    I = rho pi l [(r1^4 + r1^3 r2 + r1^2 r2^2 + r1 r2^3 + r2^4)/10 - rb^4/2]

    Parameters
    ----------
    lengths, first, last, bores
        Length along the axis, diameters of the two ends, and of the bore [m], shape (n,).
    density
        [kg/m3]
    """
    mass = inertia = 0.0
    for length, one, two, bore in zip(lengths, first, last, bores, strict=True):
        r1, r2, rb = 0.5 * one, 0.5 * two, 0.5 * bore
        area = (r1**2 + r1 * r2 + r2**2) / 3.0 - rb**2
        mass += density * math.pi * length * area
        fourth = sum(r1 ** (4 - k) * r2**k for k in range(5)) / 10.0 - 0.5 * rb**4
        inertia += density * math.pi * length * fourth
    return SolidOfRevolution(mass, inertia)


class Member(ModelSection):
    """Pinion or gear with all that turns and moves with it."""

    mass_kg: Mass | None = Field(
        default=None,
        description="Mass of the member with its shaft and all parts on it; left out: from its "
        "frusta",
    )
    inertia_kg_m2: Inertia | None = Field(
        default=None,
        description="Moment of inertia of the member with its shaft and all parts on it, about "
        "its axis; left out: from its frusta",
    )
    frusta_lengths_mm: Frusta | None = Field(
        default=None,
        description="Blank and shaft described as cone frusta on one axis, of the steel: length "
        "of each frustum",
    )
    frusta_first_diameters_mm: Diameters | None = Field(
        default=None, description="Outside diameter of each frustum at one end"
    )
    frusta_last_diameters_mm: Diameters | None = Field(
        default=None, description="Outside diameter of each frustum at the other end"
    )
    frusta_bores_mm: Bores | None = Field(
        default=None, description="Bore diameter of each frustum; left out: solid"
    )
    bearing: BearingSection | None = None

    @model_validator(mode="after")
    def _check_frusta(self) -> Member:
        keys = (*_LISTS, "frusta_bores_mm") if self.has("frusta_bores_mm") else _LISTS
        sizes = [len(getattr(self, key) or ()) for key in keys]
        if len(set(sizes)) > 1:
            raise ValueError(
                f"{', '.join(keys)} must have the same number of entries, got "
                f"{', '.join(map(str, sizes))}; give one of each for every frustum"
            )
        ends = zip(
            self.frusta_bores_mm or (),
            self.frusta_first_diameters_mm or (),
            self.frusta_last_diameters_mm or (),
            strict=False,
        )
        for k, (bore, one, two) in enumerate(ends):
            if bore >= min(one, two):
                raise ValueError(
                    f"frusta_bores_mm must be below both diameters of their frustum, got "
                    f"{bore:g} mm in frustum {k + 1} of {one:g} and {two:g} mm; 0 is a solid one"
                )
        return self

    def solid(self, density: float) -> SolidOfRevolution | None:
        """Return mass and inertia of the frusta of a density [kg/m3]; None: the file has none."""
        if self.frusta_lengths_mm is None:
            return None
        lengths, first, last = (self.si(key) for key in _LISTS)
        bores = self.si("frusta_bores_mm") if self.has("frusta_bores_mm") else (0.0,) * len(lengths)
        return stacked_frusta(lengths, first, last, bores, density)

    def member_changes(self, role: str, density: float) -> dict[str, Any]:
        """Return mass and inertia of pinion or gear as the axle has them, given or of the frusta.

        `density` is that of the steel [kg/m3].
        """
        solid = self.solid(density)
        changes = {} if solid is None else {"mass": solid.mass, "inertia": solid.inertia}
        changes |= {self.attribute(key): self.si(key) for key in _KEYS if self.has(key)}
        return {f"{role}_{name}": value for name, value in changes.items()}

    def member_notes(self, role: str, axle: object, density: float, why: str) -> list[InputNote]:
        """Return notes on mass, inertia and frusta; `why` is where the defaults are from."""
        solid = self.solid(density)
        origin: Origin = "assumed" if solid is None else "inferred"
        if solid is not None:
            why = f"{len(self.si('frusta_lengths_mm'))} frusta, density {density:g} kg/m3"
        notes = []
        for key in _KEYS:
            value = field_value(key, getattr(axle, f"{role}_{self.attribute(key)}"))
            given = self.has(key)
            notes.append(
                InputNote(
                    f"{role}.{key}",
                    value,
                    unit_of(key),
                    "given" if given else origin,
                    "" if given else why,
                )
            )
        for key in (*_LISTS, "frusta_bores_mm"):
            if self.has(key):
                value = getattr(self, key)
                notes.append(InputNote(f"{role}.{key}", value, unit_of(key), "given", ""))
        return notes
