"""Mixed friction of flanks, Mohammadpour et al. 2015, and its variants."""

from __future__ import annotations

from typing import ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_bound import BoundedFlank, FlankEllipse, ModelFilm
from gearlube_core.friction.flank_data import (
    AS_PRINTED,
    CONSISTENT,
    PRINTED_TRACTION,
    ZHOU_HOEPRICH_SHARE,
    ContactGeometry,
    FlankState,
)
from gearlube_core.friction.flank_film import flank_model_film
from gearlube_core.friction.flank_friction import FlankFriction
from gearlube_core.friction.solved_flank import solved_flank_friction
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

FORMULA, SOLVED = range(2)  # places in FILM_MODELS
FILM_MODELS = ("formula", "solved")  # where film and friction of the oil are from


class MixedFlankFriction(NamedTuple):
    """Mixed friction of Mohammadpour et al. 2015; see `flank.flank_friction`.

    With the film SOLVED its film and the friction of the oil are those of a film model, see
    `solved_flank.solved_flank_friction`.
    """

    surface: SurfaceParameters
    solid: SolidParameters
    form: float  # CONSISTENT, AS_PRINTED, PRINTED_TRACTION or ZHOU_HOEPRICH_SHARE [-]
    film: float = 0.0  # FORMULA or SOLVED [-]
    limiting_slope: float = 0.0  # of a solved film: limiting stress over pressure; 0: none [-]

    @kernel
    def flank_state(
        self,
        load: float,
        entrainment_speed: float,
        sliding_speed: float,
        geometry: ContactGeometry,
        oil: LubricantState,
    ) -> FlankState:
        """Return film, friction and temperature of one flank by the formulas."""
        return flank_friction(
            load,
            entrainment_speed,
            sliding_speed,
            geometry,
            oil,
            self.surface,
            self.solid,
            int(self.form),
        )

    @kernel
    def takes_film_model(self) -> bool:
        """Return whether film and friction of the oil are those of a film model."""
        return self.film == SOLVED

    @kernel
    def model_film(
        self,
        load: float,
        entrainment_speed: float,
        sliding_speed: float,
        geometry: ContactGeometry,
        ellipse: FlankEllipse,
        oil: LubricantState,
        film_model: Array,
    ) -> ModelFilm:
        """Return what the film model says of one flank."""
        return flank_model_film(
            load,
            entrainment_speed,
            sliding_speed,
            geometry,
            ellipse,
            oil,
            self.solid,
            self.limiting_slope,
            film_model,
        )

    @kernel
    def bounded_flank(
        self,
        load: float,
        entrainment_speed: float,
        sliding_speed: float,
        geometry: ContactGeometry,
        film: ModelFilm,
        oil: LubricantState,
        film_model: Array,
    ) -> BoundedFlank:
        """Return film, friction and temperature of one flank with bounds."""
        if self.film == SOLVED:
            return solved_flank_friction(
                load,
                entrainment_speed,
                sliding_speed,
                geometry,
                film,
                oil,
                self.surface,
                self.solid,
                int(self.form),
                film_model,
            )
        state = flank_friction(
            load,
            entrainment_speed,
            sliding_speed,
            geometry,
            oil,
            self.surface,
            self.solid,
            int(self.form),
        )
        return BoundedFlank(state, 0.0, 0.0, 0.0)


class MixedFriction(FlankFriction):
    """A variant of the law of Mohammadpour et al. 2015; an FMU switches between them."""

    form: ClassVar[int] = CONSISTENT

    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
        """Return the law for the kernels."""
        return MixedFlankFriction(surface, solid, float(self.form))


class Consistent(MixedFriction, name="consistent", text="misprints of the paper corrected"):
    """The law with the corrected misprints of the paper."""

    solved_film = True


class AsPrinted(MixedFriction, name="as_printed", text="as the paper prints it"):
    """The law as printed in the paper."""

    form = AS_PRINTED


class Off(MixedFriction, name="off", text="no friction; films as consistent"):
    """No friction; the films are those of `Consistent`."""

    solved_film = True
    rubs = False


class PrintedTraction(
    MixedFriction,
    name="printed_traction_circular",
    text="traction as printed, at the mean pressure of a circular contact; all else consistent",
):
    """The law with the traction coefficient as printed in (13), all else consistent.

    The reading of the paper that gives its efficiency.
    """

    form = PRINTED_TRACTION
    pressure = "circular"


class ZhouHoeprichShare(
    MixedFriction,
    name="zhou_hoeprich_1991",
    text="as consistent, but the asperities carry all load when there is no film",
):
    """The law with asperities that carry exp(-B Lambda^C) of the load, all else consistent.

    Source: [zhou_hoeprich_1991 (45)]
    """

    form = ZHOU_HOEPRICH_SHARE
    solved_film = True
