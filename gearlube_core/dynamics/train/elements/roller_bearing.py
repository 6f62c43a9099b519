"""A single tapered roller bearing anywhere on a shaft, which follows the shaft's tilt."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    NO_HYSTERESIS,
    Bearing,
    RollerFilms,
    ShaftMotion,
    SolvedRaceways,
    bearing_loads,
    shaft_drag,
)
from gearlube_core.bearings.followed_shaft import (
    BEARING_LAWS,
    DRAG_COST,
    N_FOLLOWED,
    TORQUE_LOSSES,
    drag_holds,
    drag_is_known,
    drag_near,
    drag_of_motion,
    raceways_of_shaft,
    renew_drag,
)
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.bearings.parameters import ROLLERS_MAX, cage_torque
from gearlube_core.bearings.raceway_drag import raceway_drag
from gearlube_core.bearings.roller_loads import bearing_forces
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES, solved_raceway_drag
from gearlube_core.bearings.shaft_expansion import bearing_energy
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters, rib_drag
from gearlube_core.checks import check_option
from gearlube_core.dynamics.train.element import RATE, Listed, W
from gearlube_core.dynamics.train.elements.checks import fits_model, fits_rollers
from gearlube_core.dynamics.train.elements.opposed_bearings import FORCES, OF_ONE, usual_stiffness
from gearlube_core.dynamics.train.elements.seat import Seat, SeatedBearing, add_to_both, between
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant_state import LubricantState

# places of `at` behind body, housing, cage and energies: what is kept, size of the film model
_KEPT, _FILM = 6, 7
# places in the memory: drag of the present step [N.m], its bound [W], spring of a search of the
# rest [N/m], work space of rollers and of their nodes, the film model
_DRAG, _BOUND, _SPRING, _ROLLERS = range(4)
_WORK_NODES = _ROLLERS + ROLLERS_MAX
_MODEL = _WORK_NODES + N_ROLLER_NODES
_OWN = 4  # outputs before those of `OF_ONE` that are no forces
_LOADED = {"palmgren": "palmgren_loaded"}  # it has no preload of its own
_LAWS = tuple(one for one in TORQUE_LOSSES if one not in _LOADED.values())


class _Rollers(NamedTuple):
    """Drag of one bearing alone, with kernels as those of `ShaftBearings`."""

    side: float
    bearings: TaperedRollerParameters

    @kernel
    def loaded_drag(self, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
        f_1, f_2, f_a, _ = bearing_forces(
            motion, NO_HYSTERESIS, oil.eta0, oil.alpha, self.bearings, self.side
        )
        radial, bearings = math.hypot(f_1, f_2), self.bearings
        return shaft_drag(bearings, motion.speed, abs(f_a), radial, law, oil)  # type: ignore[arg-type]

    @kernel
    def raceway_torque(self, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
        return raceway_drag(motion, law, oil, self.bearings, self.side)

    @kernel
    def solved_raceways(
        self, motion: ShaftMotion, oil: LubricantState, films: RollerFilms
    ) -> SolvedRaceways:
        return solved_raceway_drag(motion, oil, self.bearings, films, self.side)

    @kernel
    def beside_raceways(self, motion: ShaftMotion, oil: LubricantState) -> float:
        ends = rib_drag(motion, oil, self.bearings, self.side)
        beside = ends.rib + ends.hysteresis + ends.oil
        return -beside if motion.speed < 0.0 else beside


class _RollerBearing(NamedTuple):
    side: float  # +1: a displacement along +z loads it, -1: along -z
    seat: Seat
    law: float  # place in TORQUE_LOSSES
    orders: float  # of the reference frequency of the hysteresis, over that of rotation
    least_frequency: float  # [Hz]
    bearings: TaperedRollerParameters

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        for i in range(N_FOLLOWED + _nodes(at)):
            s[at[_KEPT] + i] = 0.0

    @kernel
    def ease(self, at: Any, memory: Array, s: Array, oil: LubricantState, share: float) -> float:
        if self.bearings.interference >= 0.0:
            return 0.0
        room = part(memory, _ROLLERS, ROLLERS_MAX)
        memory[_SPRING] = share * usual_stiffness(self.bearings, oil, room)  # type: ignore[arg-type]
        return 1.0

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        memory[_DRAG] = memory[_BOUND] = 0.0
        if self.law == 0.0:
            return 0.0
        m, kept, cost = _motion(self, at, s), part(s, at[_KEPT], N_FOLLOWED), 0.0
        rollers: Any = _Rollers(self.side, self.bearings)
        model = part(memory, _MODEL, at[_FILM])
        if h == 0.0 and not drag_is_known(kept):
            drag = drag_of_motion(rollers, m, 0.0, self.law, oil, model)
        else:
            if not drag_holds(m, oil.temperature, kept):
                nodes = part(s, at[_KEPT] + N_FOLLOWED, _nodes(at))
                films = RollerFilms(model, nodes, 1.0)
                cost = 0.5 * DRAG_COST * renew_drag(rollers, m, 0.0, self.law, oil, films, kept)
            drag = drag_near(m, kept)
        memory[_DRAG], memory[_BOUND] = drag.torque, drag.bound
        return cost

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, housing, cage, damping, drag = at[0], at[1], at[2], at[3], at[4]
        m = _motion(self, at, s)
        f_1, f_2, f_a, lost = _forces(self, m, oil)
        on_cage, ratio = cage_torque(m.r1, m.r2, f_1, f_2), self.bearings.cage_ratio
        k, moment = memory[_SPRING], (0.0, 0.0, -memory[_DRAG])
        force = f_1 - k * m.r1, f_2 - k * m.r2, f_a - k * m.axial
        add_to_both(ds, self.seat, body, housing, force, moment, on_cage, ratio)
        ds[cage] = ratio * m.speed + s[housing + W]
        ds[damping] += lost
        ds[drag] += memory[_DRAG] * m.speed
        ds[at[5]] += memory[_BOUND]

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        m = _motion(self, at, s)
        return bearing_energy(
            m.r1,
            m.r2,
            m.axial,
            m.cage_angle,
            m.speed,
            oil.eta0,
            oil.alpha,
            self.bearings,
            self.side,
        )

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        m = _motion(self, at, s)
        f_1, f_2, f_a, _ = _forces(self, m, oil)
        out[first], out[first + 1], out[first + 2] = f_1, f_2, f_a
        out[first + 3] = memory[_DRAG]
        loads = bearing_loads(
            self.bearings,  # type: ignore[arg-type]
            m,
            _frequency(self, m),
            oil,
            self.side,
            part(memory, _ROLLERS, ROLLERS_MAX),
        )
        nodes = part(memory, _WORK_NODES, _nodes(at))  # what is kept of them stays as it is
        for i in range(nodes.size):
            nodes[i] = s[at[_KEPT] + N_FOLLOWED + i]
        films = RollerFilms(part(memory, _MODEL, at[_FILM]), nodes, 1.0)
        rollers: Any = _Rollers(self.side, self.bearings)
        found = raceways_of_shaft(rollers, m, self.law, oil, films)
        here = first + _OWN
        out[here], out[here + 1] = loads[4], loads[5]
        # zeros on the side of the other bearing
        out[here + 2] = found.first_film + found.second_film
        out[here + 3] = found.first_bound + found.second_bound
        out[here + 4] = found.load_outside / found.load if found.load > 0.0 else 0.0

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        film = at[_FILM]
        fits = fits_rollers(self.bearings, self.law, film)
        fits = fits and kept == N_FOLLOWED + _nodes(at) and memory.size == _MODEL + film
        return 1.0 if fits and fits_model(part(memory, _MODEL, film)) else 0.0


@inside
def _nodes(at: Any) -> int:
    return N_ROLLER_NODES if at[_FILM] > 0 else 0


@kernel
def _motion(self: _RollerBearing, at: Any, s: Array) -> ShaftMotion:
    """Return the motion of the shaft against its housing in the middle of the bearing."""
    u, g = at[0], at[1]
    x, y, z, _, _ = between(self.seat, u, g, s)
    v_x, v_y, v_z, _, _ = between(self.seat, u + RATE, g + RATE, s)
    return ShaftMotion(x, y, z, v_x, v_y, v_z, s[at[2]], s[u + W] - s[g + W])


@inside
def _frequency(self: _RollerBearing, m: ShaftMotion) -> float:
    return max(self.orders * abs(m.speed) / (2.0 * math.pi), self.least_frequency)


@kernel
def _forces(
    self: _RollerBearing, m: ShaftMotion, oil: LubricantState
) -> tuple[float, float, float, float]:
    return bearing_forces(m, _frequency(self, m), oil.eta0, oil.alpha, self.bearings, self.side)


@dataclass(frozen=True, slots=True, kw_only=True)
class RollerBearing(SeatedBearing):
    """One tapered roller bearing of a shaft along z in its housing; two carry a tilting shaft.

    Every roller is summed at every stage of a step, so that it costs more than `OpposedBearings`.

    Parameters
    ----------
    name, body, housing : str
        The housing is "ground" or another body.
    bearing : TaperedRollerBearing
        Its preload holds with another one mounted against it.
    arm : float
        Where the lines of its roller forces meet the axis, along z from the centre of the body
        [m], -10 to 10.
    housing_x, housing_y, housing_z : float
        The same place from the centre of the housing [m].
    side : int
        +1 where a displacement of the shaft along +z loads it, -1 where one along -z does.
    torque_loss : str
        Law of the drag under the present loads, as `bearing_torque_loss` of the axle; "palmgren"
        is its "palmgren_loaded".
    film_model : FilmModel, optional
        Of rollers, for "solved_films"; default: that of the package.
    orders : float
        Cycles in a turn that the hysteresis of the rollers is taken at, 1 to 1000.
    least_frequency : float
        Lower clamp of that frequency [Hz], 1 to 1e4.

    Notes
    -----
    Rollers take the displacement of the shaft at `arm`; a tilt within the length of a roller is
    left out.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> bearing = mohammadpour_2015_axle().bearing
    >>> left = RollerBearing(name="left", body="shaft", bearing=bearing, arm=-0.05, side=-1)
    >>> left.numbers().side
    -1.0
    """

    bearing: Bearing
    side: Annotated[
        int,
        Number("1", -1, 1, text="1: a displacement along +z loads it, -1: one along -z"),
    ] = 1
    torque_loss: str = "none"
    film_model: FilmModel | None = None
    orders: Annotated[
        float, Number("1", 1.0, 1000.0, text="Cycles in a turn for the hysteresis of the rollers")
    ] = 20.0
    least_frequency: Annotated[
        float, Number("Hz", 1.0, 1e4, text="Lower clamp of the frequency of these cycles")
    ] = 50.0
    kind: ClassVar = "roller_bearing"
    interpreted: ClassVar = (Listed(_RollerBearing, (), 8),)
    bounds: ClassVar = ("bearing_bound",)
    outputs: ClassVar = (
        *FORCES,
        Output("torque", "N.m", "drag"),
        *OF_ONE[len(FORCES) :],
        Output("rollers.share_outside", "1", "share of the load outside the film model"),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        check_option(f"torque_loss of {self.name}", self.torque_loss, _LAWS)
        if self.side == 0:
            raise ParameterError(f"side of {self.name} must be 1 or -1, got 0.")
        if not isinstance(self.bearing.parameters(), TaperedRollerParameters):
            raise ParameterError(
                f"bearing of {self.name} must be a tapered roller bearing, got one of the type "
                f"{self.bearing.name}. OpposedBearings take any type."
            )

    def numbers(self) -> _RollerBearing:
        """Return the constants of the kernels."""
        bearings: Any = self.bearing.parameters()
        return _RollerBearing(
            float(self.side),
            self.seat,
            float(TORQUE_LOSSES.index(_LOADED.get(self.torque_loss, self.torque_loss))),
            float(self.orders),
            float(self.least_frequency),
            bearings,
        )

    def _film_model(self) -> Array:
        return roller_film_model(BEARING_LAWS.get(self.torque_loss, ""), self.film_model)

    def sizes(self) -> tuple[int, ...]:
        """Return the size of the film model."""
        return (self._film_model().size,)

    def memory(self) -> Array:
        """Return room for the drag of the present step and its rollers, then the film model."""
        return np.concatenate([np.zeros(_MODEL), self._film_model()])

    def kept_size(self) -> int:
        """Return the places of what is kept of the drag and of the films of rollers."""
        return N_FOLLOWED + (N_ROLLER_NODES if self.torque_loss == "solved_films" else 0)
