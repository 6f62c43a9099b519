"""Bearing types of shafts: each is one file, registers itself, and is taken by its name.

A dataclass that derives from `Bearing` is the declaration of a type: name and numbers. It makes the
NamedTuple of floats that describes the two opposed bearings of one shaft, whose kernels are those
of `ShaftBearings`. It needs `cage_ratio`, `shaft_forces` and `shaft_energy`; the other kernels have
defaults: no rollers, and the drag of `shaft_drag`, or none, by every law. In the package the file
stands in this folder and its name ends in `_bearing`. Outside it is imported, or named as an entry
point of the group `gearlube.bearings`::

    @dataclass(frozen=True, kw_only=True)
    class Springs(Bearing, name="springs", text="equal linear springs in all directions"):
        stiffness: Annotated[float, Number("N/m", 1e5, 1e10, shown="N/um", fmi="stiffness")] = 3e8

        def parameters(self):
            return SpringsOfShaft(float(self.stiffness))

Axle files select it by `type` in `[pinion.bearing]` and have its numbers as fields with the unit
`shown`; FMUs have those with an `fmi` name as `pinion.bearing.NAME` and `wheel.bearing.NAME`; error
bars vary those with a factor. Coordinates are those of `parameters`.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Protocol, Self

from gearlube_core.arrays import Array
from gearlube_core.bearings.losses.laws import PALMGREN
from gearlube_core.kernels.by_class import by_class
from gearlube_core.kernels.flat_tuples import tuple_from_array, tuple_to_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.part import Kind, Part

N_EXPANSION = 25  # largest number of floats in the expansion of the forces on one shaft
NO_HYSTERESIS = 1e12  # Hz, reference frequency beyond which rollers lose nothing


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

    def write_derived(self, preload: float, out: Array) -> None:
        """Write the floats that follow from others into their places in `out`, others as they are.

        For a native FMU, where a parameter is set in the tuple as it stands. `out` has the tuple's
        floats in their order; `preload` is that of `Bearing.preload_force` [N], and is written too
        where the tuple holds it.
        """


@dataclass(frozen=True, kw_only=True)
class Bearing(Part):
    """Numbers of a bearing type, one for both shafts of an axle."""

    kind: ClassVar[Kind[Bearing]] = Kind(
        what="bearing type",
        group="gearlube.bearings",
        package="gearlube_core.bearings",
        files="*_bearing",
    )

    @abstractmethod
    def parameters(self) -> ShaftBearings:
        """Return the floats for the kernels."""

    def preload_force(self) -> float:
        """Return the axial force of either bearing at rest [N]."""
        return 0.0


def bearing_types(wanted: str = "") -> Mapping[str, type[Bearing]]:
    """Return the bearing types by name, see `Kind.known`."""
    return Bearing.kind.known(wanted)


class _Expanded(NamedTuple):
    """Expansion of a type that has none: the oil without laws of its own."""

    f_ref: float
    eta0: float
    alpha: float
    beta: float
    nu: float
    tau0: float
    tau_l0: float
    gamma: float
    conductivity: float
    temperature: float
    volume_heat: float
    slope: float
    modulus: float
    modulus_slope: float
    eyring_slope: float


@kernel
def _no_expansion(
    bearings: Any, motion: ShaftMotion, f_ref: float, oil: LubricantState, expansion: Array
) -> None:
    kept = _Expanded(
        f_ref,
        oil.eta0,
        oil.alpha,
        oil.beta,
        oil.nu,
        oil.tau0,
        oil.tau_l0,
        oil.gamma,
        oil.conductivity,
        oil.temperature,
        oil.volume_heat,
        oil.slope,
        oil.modulus,
        oil.modulus_slope,
        oil.eyring_slope,
    )
    tuple_to_array(kept, expansion)


@kernel
def _sum_of_forces(
    bearings: Any, motion: ShaftMotion, expansion: Array
) -> tuple[float, float, float, float]:
    kept: _Expanded = tuple_from_array(expansion, _Expanded)
    oil = LubricantState(
        kept.eta0,
        kept.alpha,
        kept.beta,
        kept.nu,
        kept.tau0,
        kept.tau_l0,
        kept.gamma,
        kept.conductivity,
        kept.temperature,
        kept.volume_heat,
        kept.slope,
        kept.modulus,
        kept.modulus_slope,
        kept.eyring_slope,
    )
    F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, lost = shaft_forces(bearings, motion, kept.f_ref, oil)
    return F1_r1 + F2_r1, F1_r2 + F2_r2, F1_a + F2_a, lost


@kernel
def _force_alone(
    bearings: Any,
    motion: ShaftMotion,
    f_ref: float,
    oil: LubricantState,
    side: float,
    rollers: Array,
) -> tuple[float, float, float, float, float, float]:
    F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, _ = shaft_forces(bearings, motion, f_ref, oil)
    if side > 0.0:
        return F1_r1, F1_r2, F1_a, 0.0, 0.0, 0.0
    return F2_r1, F2_r2, F2_a, 0.0, 0.0, 0.0


@kernel
def _no_drag(
    bearings: Any,
    speed: float,
    axial_load: float,
    radial_load: float,
    law: int,
    oil: LubricantState,
) -> float:
    return 0.0


@kernel
def _drag_of_both(bearings: Any, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
    F1_r1, F1_r2, F1_a, F2_r1, F2_r2, F2_a, _ = shaft_forces(bearings, motion, NO_HYSTERESIS, oil)
    first = shaft_drag(bearings, motion.speed, abs(F1_a), math.hypot(F1_r1, F1_r2), law, oil)
    second = shaft_drag(bearings, motion.speed, abs(F2_a), math.hypot(F2_r1, F2_r2), law, oil)
    return first + second


@kernel
def _no_torque(bearings: Any, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
    return 0.0


@kernel
def _no_films(
    bearings: Any, motion: ShaftMotion, oil: LubricantState, films: RollerFilms
) -> SolvedRaceways:
    return NO_RACEWAYS


@kernel
def _drag_alone(bearings: Any, motion: ShaftMotion, oil: LubricantState) -> float:
    return loaded_drag(bearings, motion, PALMGREN, oil)


@kernel
def _nothing_derived(bearings: Any, preload: float, out: Array) -> None:
    return None


shaft_forces = by_class()(ShaftBearings.shaft_forces)
shaft_energy = by_class()(ShaftBearings.shaft_energy)
expand_forces = by_class(_no_expansion)(ShaftBearings.expand_forces)
expanded_forces = by_class(_sum_of_forces)(ShaftBearings.expanded_forces)
bearing_loads = by_class(_force_alone)(ShaftBearings.bearing_loads)
shaft_drag = by_class(_no_drag)(ShaftBearings.shaft_drag)
raceway_torque = by_class(_no_torque)(ShaftBearings.raceway_torque)
solved_raceways = by_class(_no_films)(ShaftBearings.solved_raceways)
beside_raceways = by_class(_drag_alone)(ShaftBearings.beside_raceways)
write_derived = by_class(_nothing_derived)(ShaftBearings.write_derived)
without_loss = by_class(lambda bearings: bearings)(ShaftBearings.without_loss)


@by_class(_drag_of_both)
def loaded_drag(  # type: ignore[empty-body]
    bearings: Any, motion: ShaftMotion, law: int, oil: LubricantState
) -> float:
    """Return the drag of both bearings of a shaft under their present forces [N m].

    `law` is PALMGREN or SKF of `losses.laws`. The rollers' hysteresis is no load here.
    """
