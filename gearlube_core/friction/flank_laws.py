"""Mixed friction of flanks, Mohammadpour et al. 2015, and its variants."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import (
    ARANA_FRICTION,
    BOUNDARY_FRICTION,
    SHARE_EXPONENT,
    SurfaceParameters,
)
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.film_model import net
from gearlube_core.friction.evans_johnson_1986 import solid_resistance
from gearlube_core.friction.flank import LOAD_FLOOR, flank_friction
from gearlube_core.friction.flank_data import (
    AS_PRINTED,
    CONSISTENT,
    PRINTED_TRACTION,
    ZHOU_HOEPRICH_SHARE,
    ContactGeometry,
    FlankState,
)
from gearlube_core.friction.flank_film import (
    BoundedFlank,
    FlankEllipse,
    ModelFilm,
    flank_model_film,
)
from gearlube_core.friction.flank_friction import FlankFriction
from gearlube_core.friction.flank_law import flank_state
from gearlube_core.friction.mixed_friction import (
    SPEED_FLOOR,
    FormulaBounds,
    asperity_contact,
    boundary_friction,
    formula_error,
    friction_with_asperities,
)
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState

# How far off the formulas are where the model does not hold: of 95 % of the contacts solved there
# with at least 0.1 GPa, see docs/film_model/outside.py. How much thinner than the formula's a film
# may be, relative (with cold oil and little load it is up to ten times as thick); and the most
# friction of a film, over that of an isothermal Eyring film as thick as the formula's.
FORMULA_FILM_BOUND = 0.38
FORMULA_FRICTION_TOP = 1.1
FORMULA, SOLVED = range(2)  # places in FILM_MODELS
FILM_MODELS = ("formula", "solved")  # where film and friction of the oil are from


@kernel
def _with_error(state: FlankState, outside: float, film_bound: float, error: float) -> BoundedFlank:
    """Return a state with its bounds, that of friction from a force [N]; no friction, no bound."""
    friction = state.viscous_friction + state.boundary_friction
    return BoundedFlank(state, outside, film_bound, error / friction if friction > 0.0 else 0.0)


@kernel
def solved_flank_friction(
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    film: ModelFilm,
    lubricant: LubricantState,
    surface: SurfaceParameters,
    solid: SolidParameters,
    form: int,
    film_model: Array,
) -> BoundedFlank:
    """Return film, friction and temperature of one flank contact by a film model, with bounds.

    f_v = mu (F - W_a),  f_b = tau_l0 A_a + gamma W_a, with h and mu of the solved film

    Parameters
    ----------
    load, entrainment_speed, sliding_speed, geometry, lubricant, surface, solid, form
        As in `flank.flank_friction`; the form decides about asperities alone.
    film
        What the film model gives for the contact.
    film_model : ndarray
        Numbers of the film model, for its bounds.

    Returns
    -------
    BoundedFlank
        Bounds of the film and of the sum of viscous and boundary friction.

    Notes
    -----
    Towards the outside of the model's domain h and f go over into those of `flank_friction` with
    the weight `outside`; beyond, all is as there. The bound of friction is that of the film's own
    friction, plus what asperities change where the film is thinner by its bound: a thinner film
    raises their load.
    """
    w, error = film.outside, 0.0
    F, slip = max(load, 0.0), abs(sliding_speed)
    formula = FlankState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if w > 0.0:
        formula = flank_friction(
            load, entrainment_speed, sliding_speed, geometry, lubricant, surface, solid, form
        )
        bounds = FormulaBounds(FORMULA_FILM_BOUND, FORMULA_FRICTION_TOP)
        error = w * formula_error(F, slip, formula, lubricant, surface, solid, form, bounds)
        if w >= 1.0:
            return _with_error(formula, 1.0, FORMULA_FILM_BOUND, error)
    F_film = max(F, LOAD_FLOOR)
    speed = max(abs(entrainment_speed), SPEED_FLOOR)
    v = 1.0 - w
    h = math.exp(film.log_film)
    p = geometry.pressure_coefficient * math.exp(math.log(F_film) / 3.0)
    effusivity_squared = solid.conductivity * solid.density * solid.heat_capacity
    modulus = 2.0 * solid.contact_modulus
    solved = friction_with_asperities(
        math.exp(film.log_friction),
        F,
        F_film,
        p,
        h,
        h / surface.sigma,
        slip,
        solid_resistance(geometry.R_e, p, speed, modulus, effusivity_squared),
        F_film / p,
        lubricant,
        surface,
        solid,
        form,
    )
    model_bound = film_model[net.BOUNDS]
    W_a, A_a = asperity_contact(
        F, F / p, h * (1.0 - model_bound) / surface.sigma, surface, solid, form
    )
    more = boundary_friction(W_a, A_a, slip, lubricant, surface) - solved.boundary_friction
    error += v * (film_model[net.BOUNDS + 1] * solved.viscous_friction + max(more, 0.0))
    f_v = v * solved.viscous_friction + w * formula.viscous_friction
    f_b = v * solved.boundary_friction + w * formula.boundary_friction
    state = FlankState(
        v * h + w * formula.film_thickness,
        v * solved.film_ratio + w * formula.film_ratio,
        f_v,
        f_b,
        v * solved.friction_coefficient + w * formula.friction_coefficient,
        v * solved.temperature_rise + w * formula.temperature_rise,
        p,
    )
    return _with_error(state, w, v * model_bound + w * FORMULA_FILM_BOUND, error)


class MixedFlankFriction(NamedTuple):
    """Mixed friction of Mohammadpour et al. 2015; see `flank.flank_friction`.

    With the film SOLVED its film and the friction of the oil are those of a film model, see
    `solved_flank_friction`.
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
        """Return film and friction of one flank by the film model."""
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
        state = flank_state(self, load, entrainment_speed, sliding_speed, geometry, oil)
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


@dataclass(frozen=True, kw_only=True)
class AranaShare(
    MixedFriction,
    name="arana_2019",
    text="one coefficient for asperities, which carry 1 - erf of the film ratio of the load",
):
    """The mixed law mu = xi mu_b + (1 - xi) mu_film with xi = (1 - erf Lambda)^k.

    mu_b replaces tau_l0 and gamma of the oil. Its default and its range are of ground spur and
    helical gears; that they hold for hypoid gears and their oils is assumed.

    Parameters
    ----------
    boundary_friction : float
        mu_b [-].
    share_exponent : float
        k, see `arana_share` [-].

    References
    ----------
    [arana_2019]

    Examples
    --------
    >>> from gearlube_core.friction.flank_friction import friction_law
    >>> friction_law("arana_2019", boundary_friction=0.1).numbers
    {'boundary_friction': 0.1, 'share_exponent': 1.0}
    """

    solved_film = True
    boundary_friction: Annotated[float, BOUNDARY_FRICTION] = ARANA_FRICTION
    share_exponent: Annotated[float, SHARE_EXPONENT] = 1.0

    def flanks(self, surface: SurfaceParameters) -> SurfaceParameters:
        """Return a surface whose asperities are those of this law."""
        return surface._replace(
            share_exponent=float(self.share_exponent), boundary=float(self.boundary_friction)
        )

    def __call__(self, surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
        """Return the law for the kernels."""
        return super().__call__(self.flanks(surface), solid)
