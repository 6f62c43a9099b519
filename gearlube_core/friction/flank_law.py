"""Interface of a flank friction law for models of meshing gears.

A law is a NamedTuple of floats with the method of `FlankLaw`. Its fields are the data of
the flanks. A new law is one new file; `flank_friction.friction_laws` gives them by name.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.friction.flank_data import ContactGeometry, FlankState
from gearlube_core.friction.flank_film import NO_MODEL_FILM, BoundedFlank, FlankEllipse, ModelFilm
from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class FlankLaw(Protocol):
    """Film and friction of one flank; a NamedTuple of floats with this method.

    The method is a kernel (`kernels.jit.kernel`): it does not allocate and does not raise.
    """

    def flank_state(
        self,
        load: float,
        entrainment_speed: float,
        sliding_speed: float,
        geometry: ContactGeometry,
        oil: LubricantState,
    ) -> FlankState:
        """Return film, friction and temperature; arguments as in `flank.flank_friction`.

        Friction forces are magnitudes: they oppose sliding.
        """


# makes a law for the roughness and the solids of a pair
FlankLawMaker = Callable[[SurfaceParameters, SolidParameters], FlankLaw]

# of the law that is given; see `kernels.by_class`
flank_state = by_class()(FlankLaw.flank_state)


@kernel
def _no_model(law: FlankLaw) -> bool:
    return False


@by_class(_no_model)
def takes_film_model(law: FlankLaw) -> bool:
    """Return whether film and friction of the oil are those of a film model with this law."""
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _no_film(
    law: FlankLaw,
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    ellipse: FlankEllipse,
    oil: LubricantState,
    film_model: Array,
) -> ModelFilm:
    return NO_MODEL_FILM


@by_class(_no_film)
def model_film(
    law: FlankLaw,
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    ellipse: FlankEllipse,
    oil: LubricantState,
    film_model: Array,
) -> ModelFilm:
    """Return film and friction of a flank by a film model; a law without this kernel has none.

    Parameters
    ----------
    law
        The law of friction.
    load, entrainment_speed, sliding_speed, geometry, oil
        As in `FlankLaw.flank_state`.
    ellipse
        The rest of the contact's geometry.
    film_model : ndarray
        Of `flank_film.flank_film_model`; written into.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name


@kernel
def _unbounded(
    law: FlankLaw,
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    film: ModelFilm,
    oil: LubricantState,
    film_model: Array,
) -> BoundedFlank:
    state = flank_state(law, load, entrainment_speed, sliding_speed, geometry, oil)
    return BoundedFlank(state, 0.0, 0.0, 0.0)


@by_class(_unbounded)
def bounded_flank(
    law: FlankLaw,
    load: float,
    entrainment_speed: float,
    sliding_speed: float,
    geometry: ContactGeometry,
    film: ModelFilm,
    oil: LubricantState,
    film_model: Array,
) -> BoundedFlank:
    """Return the state of a flank with its bounds; a law without this kernel has no bounds.

    Parameters
    ----------
    law, load, entrainment_speed, sliding_speed, geometry, oil, film_model
        As in `model_film`.
    film
        Of `model_film`, at this contact or interpolated.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name
