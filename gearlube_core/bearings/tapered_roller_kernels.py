"""Two opposed tapered roller bearings as a bearing type for models of shafts."""

from __future__ import annotations

import math

from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import RollerFilms, ShaftMotion, SolvedRaceways
from gearlube_core.bearings.losses.laws import SKF
from gearlube_core.bearings.palmgren_1959 import drag_torque
from gearlube_core.bearings.parameters import COS_TABLE, SIN_TABLE, BearingParameters
from gearlube_core.bearings.raceway_drag import raceway_drag
from gearlube_core.bearings.rib_drag import rib_drag
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.shaft_energy import shaft_bearing_energy
from gearlube_core.bearings.shaft_expansion import expand_shaft_bearings, expanded_shaft_forces
from gearlube_core.bearings.shaft_forces import shaft_bearing_forces
from gearlube_core.bearings.skf_drag import skf_drag
from gearlube_core.bearings.solved_raceways import solved_raceway_drag
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class TaperedRollerParameters(BearingParameters):
    """Two opposed tapered roller bearings of one shaft; see `bearing_type.ShaftBearings`."""

    __slots__ = ()

    @kernel
    def expand_forces(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState, expansion: Array
    ) -> None:
        """Write the expansion of the forces about this motion."""
        expand_shaft_bearings(
            motion,
            f_ref,
            oil.eta0,
            oil.alpha,
            self,
            expansion,
        )

    @kernel
    def expanded_forces(
        self, motion: ShaftMotion, expansion: Array
    ) -> tuple[float, float, float, float]:
        """Return the forces on the shaft [N] and the lost power [W] near the expansion."""
        return expanded_shaft_forces(
            motion,
            self,
            expansion,
        )

    @kernel
    def shaft_forces(
        self, motion: ShaftMotion, f_ref: float, oil: LubricantState
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return the forces of either bearing [N] and the lost power of both [W]."""
        return shaft_bearing_forces(
            motion,
            f_ref,
            oil.eta0,
            oil.alpha,
            self,
        )

    @kernel
    def shaft_energy(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the elastic energy of both bearings [J]."""
        return shaft_bearing_energy(
            motion.r1,
            motion.r2,
            motion.axial,
            motion.cage_angle,
            motion.speed,
            oil.eta0,
            oil.alpha,
            self,
        )

    @kernel
    def bearing_loads(
        self,
        motion: ShaftMotion,
        f_ref: float,
        oil: LubricantState,
        side: float,
        rollers: Array,
    ) -> tuple[float, float, float, float, float, float]:
        """Return the forces of one bearing; load of roller 0, largest and smallest load [N]."""
        roller_loads(motion, f_ref, oil.eta0, oil.alpha, self, side, rollers)
        count = int(self.n_rollers)
        largest = smallest = rollers[0]
        sum_cos = sum_sin = sum_all = 0.0
        for i in range(count):
            w = rollers[i]
            largest = max(largest, w)
            smallest = min(smallest, w)
            sum_cos += w * COS_TABLE[count, i]
            sum_sin += w * SIN_TABLE[count, i]
            sum_all += w
        cos_c, sin_c = math.cos(motion.cage_angle), math.sin(motion.cage_angle)
        return (
            -self.cos_contact * (sum_cos * cos_c - sum_sin * sin_c),
            -self.cos_contact * (sum_cos * sin_c + sum_sin * cos_c),
            -side * self.sin_contact * sum_all,
            rollers[0],
            largest,
            smallest,
        )

    @kernel
    def shaft_drag(
        self, speed: float, axial_load: float, radial_load: float, law: int, oil: LubricantState
    ) -> float:
        """Return the drag torque of one bearing [N m]."""
        if law == SKF:
            return skf_drag(speed, axial_load, radial_load, oil.nu, self)
        return drag_torque(speed, axial_load, radial_load, oil.nu, self)

    @kernel
    def raceway_torque(self, motion: ShaftMotion, law: int, oil: LubricantState) -> float:
        """Return the torque of the raceways of both bearings [N m]."""
        return raceway_drag(motion, law, oil, self)

    @kernel
    def solved_raceways(
        self, motion: ShaftMotion, oil: LubricantState, films: RollerFilms
    ) -> SolvedRaceways:
        """Return torque and films of the raceways of both bearings by solved films."""
        return solved_raceway_drag(motion, oil, self, films)

    @kernel
    def beside_raceways(self, motion: ShaftMotion, oil: LubricantState) -> float:
        """Return the torque of ribs, hysteresis and oil of both bearings [N m]."""
        ends = rib_drag(motion, oil, self)
        beside = ends.rib + ends.hysteresis + ends.oil
        return -beside if motion.speed < 0.0 else beside

    def without_loss(self) -> TaperedRollerParameters:
        """Return the bearings without hysteresis."""
        return self._replace(loss=0.0)
