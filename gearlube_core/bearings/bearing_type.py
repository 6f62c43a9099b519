"""Interface of a bearing type for shaft models.

A bearing type is a NamedTuple of floats with the methods of `ShaftBearings`. It describes the two
opposed bearings of one shaft. A new type is one new file. The functions below the classes call
the method of the type that is given; see `kernels.by_class`.

Coordinates are those of `parameters`.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol, Self

from gearlube_core.arrays import Array
from gearlube_core.kernels.by_class import by_class
from gearlube_core.oil.lubricant import LubricantState

N_EXPANSION = 25  # largest number of floats in the expansion of the forces on one shaft


class ShaftMotion(NamedTuple):
    """Position and speed of a shaft in its bearings."""

    r1: float  # radial displacements [m]
    r2: float
    axial: float  # axial displacement [m]
    v1: float  # their rates [m/s]
    v2: float
    v_axial: float
    cage_angle: float  # angle of roller 0 [rad]
    speed: float  # of the shaft [rad/s]


class RollerFilms(NamedTuple):
    """The model of solved films of rollers, and what is kept of it."""

    model: Array  # numbers of the film model, written into; empty: none
    nodes: Array  # of one shaft, shape (N_ROLLER_NODES,), or of both, one behind the other
    kept: float  # not 0: between nodes that are kept; 0: each roller by itself, exact


class SolvedRaceways(NamedTuple):
    """Raceways of both bearings of a shaft by solved films; all floats."""

    torque: float  # with the sign of the speed [N m]
    torque_bound: float  # of the torque, not negative [N m]
    load: float  # of all rollers [N]
    load_outside: float  # of it outside the film model's domain [N]
    first_film: float  # thinnest central film in the first bearing; 0 without load [m]
    first_bound: float  # of this film, relative [-]
    second_film: float  # likewise of the second bearing
    second_bound: float


NO_RACEWAYS = SolvedRaceways(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # without rollers, or at rest


class ShaftBearings(Protocol):
    """Two opposed bearings of one shaft; a NamedTuple of floats with these methods.

    The methods are kernels (`kernels.jit.kernel`): they take and return floats, NamedTuples and
    float64 arrays, do not allocate and do not raise. `f_ref` is the reference frequency of the
    hysteresis [Hz].
    """

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed [-]; 0 for a bearing without a cage."""

    def expand_forces(
        self,
        motion: ShaftMotion,
        f_ref: float,
        oil: LubricantState,
        expansion: Array,
    ) -> None:
        """Write what `expanded_forces` needs near this motion into `expansion`, (N_EXPANSION,)."""

    def expanded_forces(
        self, motion: ShaftMotion, expansion: Array
    ) -> tuple[float, float, float, float]:
        """Return F_r1, F_r2, F_a of both bearings on the shaft [N] and the lost power [W]."""

    def shaft_forces(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return F_r1, F_r2, F_a of the first and of the second bearing [N], lost power [W]."""

    def shaft_energy(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the elastic energy of both bearings [J]."""

    def bearing_loads(
        self,
        motion: ShaftMotion,
        f_ref: float,
        oil: LubricantState,
        side: float,
        rollers: Array,
    ) -> tuple[float, float, float, float, float, float]:
        """Return F_r1, F_r2, F_a of one bearing; load of roller 0, largest and smallest load [N].

        `side` is +1 for the first bearing and -1 for the second; `rollers` is work space of shape
        (ROLLERS_MAX,). The loads are 0 for a bearing without rollers.
        """

    def shaft_drag(
        self, speed: float, axial_load: float, radial_load: float, law: int, oil: LubricantState
    ) -> float:
        """Return the drag torque of one bearing with the sign of the speed [N m].

        Under its loads [N], not negative; `law` is PALMGREN or SKF of `losses.laws`.
        """

    def raceway_torque(self, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
        """Return the torque of the raceways by a law of `losses.laws.ROLLING_LAWS` [N m].

        Of both bearings, with the sign of the speed, under the present load of each roller; 0 for
        a bearing without rollers.
        """

    def solved_raceways(
        self, motion: ShaftMotion, oil: LubricantState, films: RollerFilms
    ) -> SolvedRaceways:
        """Return the same by solved films, with the films; NO_RACEWAYS without rollers."""

    def beside_raceways(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the torque of ribs, of the steel's hysteresis and of oil on the rollers [N m].

        Of both bearings, with the sign of the speed; 0 for a bearing without rollers.
        """

    def without_loss(self) -> Self:
        """Return these bearings without hysteresis; called from Python only."""


class Bearing(Protocol):
    """A bearing in engineering words, one type for both shafts of an axle."""

    def parameters(self) -> ShaftBearings:
        """Return the floats for the kernels."""

    def preload_force(self) -> float:
        """Return the axial force of either bearing at rest [N]."""


expand_forces = by_class()(ShaftBearings.expand_forces)
expanded_forces = by_class()(ShaftBearings.expanded_forces)
shaft_forces = by_class()(ShaftBearings.shaft_forces)
shaft_energy = by_class()(ShaftBearings.shaft_energy)
bearing_loads = by_class()(ShaftBearings.bearing_loads)
shaft_drag = by_class()(ShaftBearings.shaft_drag)
raceway_torque = by_class()(ShaftBearings.raceway_torque)
solved_raceways = by_class()(ShaftBearings.solved_raceways)
beside_raceways = by_class()(ShaftBearings.beside_raceways)
