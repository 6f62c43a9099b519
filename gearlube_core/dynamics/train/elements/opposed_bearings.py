"""Two opposed bearings of a shaft, of any type that is registered."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import (
    N_EXPANSION,
    Bearing,
    RollerFilms,
    ShaftBearings,
    ShaftMotion,
    SolvedRaceways,
    bearing_loads,
    expanded_forces,
    shaft_energy,
)
from gearlube_core.bearings.followed_shaft import (
    BEARING_LAWS,
    DRAG_COST,
    EXPANSION_REACH,
    N_FOLLOWED,
    N_FORCES,
    PALMGREN,
    TORQUE_LOSSES,
    drag_holds,
    drag_is_known,
    drag_near,
    drag_of_motion,
    expand_about,
    follow_forces,
    forget_forces,
    moving_parts,
    raceways_of_shaft,
    renew_drag,
)
from gearlube_core.bearings.losses.race_rolling import roller_film_model
from gearlube_core.bearings.parameters import ROLLERS_MAX, cage_torque
from gearlube_core.bearings.roller_nodes import N_ROLLER_NODES
from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.checks import check_option
from gearlube_core.dynamics.train.element import RATE, RZ, Listed, W
from gearlube_core.dynamics.train.elements.checks import fits_model, fits_rollers
from gearlube_core.dynamics.train.part import Element
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.model import FilmModel
from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.inlining import inside
from gearlube_core.kernels.jit import kernel
from gearlube_core.number import Number, Output, check_fields
from gearlube_core.oil.lubricant_state import LubricantState

# places of `at` behind body, cage, both losses and the bound: what is kept, three axes, size of the
# film model
_KEPT, _AXES, _FILM = 5, 6, 9
# places in the memory behind the forces: drag of the present step [N.m], its bound [W], 1 where
# films of outputs are those that are kept, spring of a search of the rest [N/m], work space of
# single rollers, of their nodes, the film model
_DRAG, _BOUND, _ASKED, _SPRING, _ROLLERS = range(N_FORCES, N_FORCES + 5)
_NODES = _ROLLERS + ROLLERS_MAX
_MEMORY = _NODES + N_ROLLER_NODES
_FAR = 1e-4  # m, beyond any clearance, where stiffness hardly depends on the load
_OWN = 4  # outputs of both bearings together
_SOLVED = _OWN + 3  # likewise of the rollers
FORCES = tuple(Output(f"force.{c}", "N", f"force along {c} on the body", 1e3) for c in "xyz")
OF_ONE = (  # outputs of a single bearing
    *FORCES,
    Output("roller_load_max", "N", "largest load of a roller", 1e3),
    Output("roller_load_min", "N", "least load of a roller", 1e3),
    Output("film_thickness", "m", "thinnest film of a roller, with solved films", 1e-6, "um"),
    Output("film_bound", "1", "bound of that film, relative", 0.05),
)


class _OpposedBearings(NamedTuple):
    bearings: ShaftBearings
    preload: float  # [N]
    law: float  # place in TORQUE_LOSSES
    orders: float  # of the reference frequency of the hysteresis, over that of rotation
    least_frequency: float  # [Hz]
    reach: float  # move of the shaft that ends an expansion [m]
    on_cage: float  # share of the moment on the cages that the shaft carries: 1, or 0 as printed

    @kernel
    def at_rest(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        for i in range(N_FOLLOWED + (N_ROLLER_NODES if at[_FILM] > 0 else 0)):
            s[at[_KEPT] + i] = 0.0

    @kernel
    def ease(self, at: Any, memory: Array, s: Array, oil: LubricantState, share: float) -> float:
        if self.preload > 0.0:
            return 0.0
        room = part(memory, _ROLLERS, ROLLERS_MAX)
        memory[_SPRING] = share * 2.0 * usual_stiffness(self.bearings, oil, room)
        return 1.0

    @kernel
    def begin(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        forget_forces(part(memory, 0, N_FORCES))

    @kernel
    def expand(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> None:
        m = _motion(at, s)
        expand_about(self.bearings, m, _frequency(self, m), oil, part(memory, 0, N_FORCES))

    @kernel
    def each_step(self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float) -> float:
        m = _motion(at, s)
        if h > 0.0:  # else `expand` follows
            f_ref, forces = _frequency(self, m), part(memory, 0, N_FORCES)
            follow_forces(self.bearings, m, f_ref, oil, h, self.reach, forces)
        kept, cost = part(s, at[_KEPT], N_FOLLOWED), 0.0
        if self.law <= PALMGREN or (h == 0.0 and not drag_is_known(kept)):
            drag = drag_of_motion(self.bearings, m, self.preload, self.law, oil, _model(at, memory))
        else:
            if not drag_holds(m, oil.temperature, kept):
                films = _films(at, memory, s)
                cost = DRAG_COST * renew_drag(
                    self.bearings, m, self.preload, self.law, oil, films, kept
                )
            drag = drag_near(m, kept)
        memory[_DRAG], memory[_BOUND] = drag.torque, drag.bound
        return cost

    @kernel
    def add_forces(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, stage: int, ds: Array
    ) -> None:
        body, cage, damping, drag = at[0], at[1], at[2], at[3]
        memory[_ASKED] = 0.0 if stage == 0 else 1.0
        m = _motion(at, s)
        f_1, f_2, f_a, lost = expanded_forces(self.bearings, m, part(memory, 0, N_EXPANSION))
        v, spring = body + RATE, memory[_SPRING]
        ds[v + at[_AXES]] += f_1 - spring * m.r1
        ds[v + at[_AXES + 1]] += f_2 - spring * m.r2
        ds[v + at[_AXES + 2]] += f_a - spring * m.axial
        carried = self.on_cage * self.bearings.cage_ratio * cage_torque(m.r1, m.r2, f_1, f_2)
        ds[v + RZ] += carried - memory[_DRAG]
        ds[cage] = self.bearings.cage_ratio * m.speed
        ds[damping] += lost
        ds[drag] += memory[_DRAG] * m.speed
        ds[at[4]] += memory[_BOUND]

    @kernel
    def time_to_jump(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, h: float
    ) -> float:
        return h / moving_parts(_motion(at, s), h)

    @kernel
    def stored_energy(self, at: Any, memory: Array, s: Array, oil: LubricantState) -> float:
        return shaft_energy(self.bearings, _motion(at, s), oil)

    @kernel
    def write(
        self, at: Any, memory: Array, s: Array, oil: LubricantState, out: Array, first: int
    ) -> None:
        m = _motion(at, s)
        f_1, f_2, f_a, _ = expanded_forces(self.bearings, m, part(memory, 0, N_EXPANSION))
        out[first + at[_AXES]], out[first + at[_AXES + 1]], out[first + at[_AXES + 2]] = (
            f_1,
            f_2,
            f_a,
        )
        out[first + 3] = memory[_DRAG]
        found = _raceways(self, m, at, memory, s, oil)
        out[first + _OWN] = found.load
        out[first + _OWN + 1] = found.load_outside / found.load if found.load > 0.0 else 0.0
        _show(self, m, at, memory, oil, out, first)
        film = first + _SOLVED + 5
        out[film], out[film + 1] = found.first_film, found.first_bound
        film += len(OF_ONE)
        out[film], out[film + 1] = found.second_film, found.second_bound

    @kernel
    def show(
        self,
        at: Any,
        memory: Array,
        s: Array,
        oil: LubricantState,
        stage: int,
        out: Array,
        first: int,
    ) -> None:
        """See `Kernels.show`: forces on either bearing and loads of its rollers."""
        _show(self, _motion(at, s), at, memory, oil, out, first)

    @kernel
    def check(self, at: Any, memory: Array, s: Array, oil: LubricantState, kept: int) -> float:
        r1, r2, axial, film = at[_AXES], at[_AXES + 1], at[_AXES + 2], at[_FILM]
        fits = max(r1, max(r2, axial)) <= 2 and r1 != r2 and r2 != axial and axial != r1
        fits = fits and fits_rollers(self.bearings, self.law, film)
        fits = fits and kept == N_FOLLOWED + (N_ROLLER_NODES if film > 0 else 0)
        fits = fits and memory.size == _MEMORY + film and fits_model(part(memory, _MEMORY, film))
        return 1.0 if fits else 0.0


@kernel
def usual_stiffness(bearings: ShaftBearings, oil: LubricantState, rollers: Array) -> float:
    """Return the radial stiffness of one bearing far beyond its clearance [N/m].

    `rollers` is work space of shape (ROLLERS_MAX,).
    """
    force = 0.0
    for k in range(2):
        m = ShaftMotion(_FAR * (1.0 + k), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        force = bearing_loads(bearings, m, 1.0, oil, 1.0, rollers)[0] - force
    return abs(force) / _FAR


@kernel
def _show(
    self: _OpposedBearings,
    m: ShaftMotion,
    at: Any,
    memory: Array,
    oil: LubricantState,
    out: Array,
    first: int,
) -> None:
    rollers, f_ref = part(memory, _ROLLERS, ROLLERS_MAX), _frequency(self, m)
    for k in range(2):
        here = first + _SOLVED + k * len(OF_ONE)
        one = bearing_loads(self.bearings, m, f_ref, oil, 1.0 - 2.0 * k, rollers)
        out[here + at[_AXES]], out[here + at[_AXES + 1]] = one[0], one[1]
        out[here + at[_AXES + 2]] = one[2]
        out[here + 3], out[here + 4] = one[4], one[5]
        if k == 0:
            out[first + _OWN + 2] = one[3]


@inside
def _films(at: Any, memory: Array, s: Array) -> RollerFilms:
    """Return the film model and its nodes; both empty where the law has none."""
    nodes = N_ROLLER_NODES if at[_FILM] > 0 else 0
    return RollerFilms(_model(at, memory), part(s, at[_KEPT] + N_FOLLOWED, nodes), 1.0)


@inside
def _model(at: Any, memory: Array) -> Array:
    return part(memory, _MEMORY, at[_FILM])


@kernel
def _raceways(
    self: _OpposedBearings, m: ShaftMotion, at: Any, memory: Array, s: Array, oil: LubricantState
) -> SolvedRaceways:
    # what is kept of the films stays as it is
    kept = _films(at, memory, s)
    nodes = part(memory, _NODES, kept.nodes.size)
    for i in range(nodes.size):
        nodes[i] = kept.nodes[i]
    films = RollerFilms(kept.model, nodes, memory[_ASKED])
    return raceways_of_shaft(self.bearings, m, self.law, oil, films)


@kernel
def _motion(at: Any, s: Array) -> ShaftMotion:
    u, v = at[0], at[0] + RATE
    r1, r2, axial = at[_AXES], at[_AXES + 1], at[_AXES + 2]
    return ShaftMotion(
        s[u + r1], s[u + r2], s[u + axial], s[v + r1], s[v + r2], s[v + axial], s[at[1]], s[u + W]
    )  # fmt: skip


@inside
def _frequency(self: _OpposedBearings, m: ShaftMotion) -> float:
    return max(self.orders * abs(m.speed) / (2.0 * math.pi), self.least_frequency)


@dataclass(frozen=True, slots=True, kw_only=True)
class OpposedBearings(Element):
    """Both bearings of a body, mounted against each other about its centre.

    They carry no tilt: the body holds rx and ry, or has another support against it.

    Parameters
    ----------
    name, body : str
    bearing : Bearing
        Of any type among `bearing_types`.
    torque_loss : str
        Law of the drag, as `bearing_torque_loss` of the axle.
    film_model : FilmModel, optional
        Of rollers, for "solved_films"; default: that of the package.
    orders : float
        Cycles in a turn that the hysteresis of the rollers is taken at, such as the teeth of the
        gear, 1 to 1000.
    least_frequency : float
        Lower clamp of that frequency [Hz], 1 to 1e4.
    steps_per_highest_period : int
        Of the train, which decides how long an expansion of the forces serves.
    axes : tuple of 3 int
        Which of x, y, z are the two radial axes, the first one turned towards the second, and the
        axial one: (0, 1, 2) for a shaft along z.
    cage_moment : bool
        Whether the shaft carries the moment that loaded rollers exert on their orbiting cage. The
        printed [mohammadpour_2015 (1)] has none, and its rollers then do work on nothing.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
    >>> bearing = mohammadpour_2015_axle().bearing
    >>> pair = OpposedBearings(name="bearings", body="input", bearing=bearing)
    >>> pair.losses
    ('bearing_damping', 'bearing_torque')
    """

    name: str
    body: str
    bearing: Bearing
    torque_loss: str = "none"
    film_model: FilmModel | None = None
    orders: Annotated[
        float, Number("1", 1.0, 1000.0, text="Cycles in a turn for the hysteresis of the rollers")
    ] = 20.0
    least_frequency: Annotated[
        float, Number("Hz", 1.0, 1e4, text="Lower clamp of the frequency of these cycles")
    ] = 50.0
    steps_per_highest_period: int = 16
    axes: tuple[int, int, int] = (0, 1, 2)
    cage_moment: bool = True
    kind: ClassVar = "opposed_bearings"
    interpreted: ClassVar = (Listed(_OpposedBearings, (TaperedRollerParameters,), 10),)
    on: ClassVar = ("body",)
    angles: ClassVar = ("cage",)
    losses: ClassVar = ("bearing_damping", "bearing_torque")
    bounds: ClassVar = ("bearing_bound",)
    outputs: ClassVar = (
        *FORCES,
        Output("torque", "N.m", "drag"),
        Output("rollers.load", "N", "load of all rollers, with solved films", 1e3),
        Output("rollers.share_outside", "1", "share of it outside the film model"),
        Output("rollers.first_load", "N", "load of roller 1 of the first bearing", 1e3),
        *(
            one._replace(name=f"{which}.{one.name}", text=f"{one.text}, {which} bearing")
            for which in ("first", "second")
            for one in OF_ONE
        ),
    )

    def __post_init__(self) -> None:
        check_fields(self)
        check_option(f"torque_loss of {self.name}", self.torque_loss, TORQUE_LOSSES)
        if sorted(self.axes) != [0, 1, 2]:
            raise ParameterError(
                f"axes of {self.name} must be 0, 1 and 2, each once, got {list(self.axes)}."
            )

    def variants(self) -> tuple[type, ...]:
        """Return the class of the bearings."""
        return (type(self.bearing.parameters()),)

    def numbers(self) -> _OpposedBearings:
        """Return the constants of the kernels."""
        reach = EXPANSION_REACH / self.steps_per_highest_period**2
        return _OpposedBearings(
            self.bearing.parameters(),
            self.bearing.preload_force(),
            float(TORQUE_LOSSES.index(self.torque_loss)),
            float(self.orders),
            float(self.least_frequency),
            reach,
            float(self.cage_moment),
        )

    def sizes(self) -> tuple[int, ...]:
        """Return the axes and the size of the film model."""
        return (*self.axes, self._film_model().size)

    def _film_model(self) -> Array:
        return roller_film_model(BEARING_LAWS.get(self.torque_loss, ""), self.film_model)

    def memory(self) -> Array:
        """Return room for the expansion of the forces and the drag, then the film model."""
        return np.concatenate([np.zeros(_MEMORY), self._film_model()])

    def kept_size(self) -> int:
        """Return the places of what is kept of the drag and of the films of rollers."""
        return N_FOLLOWED + (N_ROLLER_NODES if self.torque_loss == "solved_films" else 0)
