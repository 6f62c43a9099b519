"""Tyre radii from the size code on the sidewall."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

_INCH = 0.0254  # m
_SIZE = re.compile(r"^\s*(?:P|LT)?(\d{3})\s*/\s*(\d{2})\s*Z?R\s*(\d{2})\b.*$", re.IGNORECASE)

# Rolling circumference of a radial tyre over its unladen diameter (ETRTO standards manual).
CIRCUMFERENCE_FACTOR = 3.05
# Loaded rolling radius over the unladen radius, a rule of thumb for radial car tyres.
_RADIUS_FACTOR = 0.965

ROLLING_RADII = ("circumference", "fraction")


@dataclass(frozen=True, slots=True, kw_only=True)
class Tyre:
    """A tyre reduced to its radii.

    Parameters
    ----------
    unladen_radius : float
        Half the outer diameter of the inflated, unloaded tyre [m].
    rolling_radius : float
        Laden dynamic radius r_t: vehicle speed over the angular speed of a freely rolling wheel
        [m].

    Notes
    -----
    Mohammadpour et al. 2015 name the tyre (Table A3: 195/65R16) and use "the laden dynamic tyre
    radius" in [mohammadpour_2015 (7)] without its value.
    """

    unladen_radius: float
    rolling_radius: float

    def __post_init__(self) -> None:
        check_within("unladen_radius", self.unladen_radius, 0.1, 1.0, "m", "Use metres.")
        check_within(
            "rolling_radius",
            self.rolling_radius,
            0.9 * self.unladen_radius,
            self.unladen_radius,
            "m",
            "A loaded tyre rolls a few per cent shorter than its unladen circumference.",
        )

    @classmethod
    def from_size(cls, size: str, *, rolling_radius: str = "circumference") -> Tyre:
        """Return the tyre of a metric size code such as "195/65R16".

        D = 25.4 mm * rim + 2 * width * aspect / 100

        Parameters
        ----------
        size : str
            Width [mm] / aspect ratio [%] R rim diameter [inch].
        rolling_radius : str
            "circumference": r_t = 3.05 D / (2 pi), the rolling circumference that the ETRTO
            standards give to radial tyres; "fraction": r_t = 0.965 D / 2.

        Notes
        -----
        195/65R16 has D/2 = 329.95 mm and r_t = 320.3 mm ("circumference") or 318.4 mm.
        """
        check_option("rolling_radius", rolling_radius, ROLLING_RADII)
        match = _SIZE.match(size) if isinstance(size, str) else None
        if match is None:
            raise ParameterError(
                f"The tyre size must read width/aspect R rim, got {size!r}. "
                "Write for example 195/65R16 (mm, per cent, inch)."
            )
        width_mm, aspect_percent, rim_inch = (float(group) for group in match.groups())
        check_within("tyre width", width_mm, 105.0, 355.0, "mm", "Write for example 195/65R16.")
        check_within("tyre aspect ratio", aspect_percent, 25.0, 85.0, "%", "Try 65.")
        check_within("tyre rim diameter", rim_inch, 10.0, 24.0, "inch", "Try 16.")
        radius = 0.5 * rim_inch * _INCH + width_mm * 1e-3 * aspect_percent / 100.0
        if rolling_radius == "circumference":
            rolling = CIRCUMFERENCE_FACTOR * 2.0 * radius / (2.0 * math.pi)
        else:
            rolling = _RADIUS_FACTOR * radius
        return cls(unladen_radius=radius, rolling_radius=rolling)
