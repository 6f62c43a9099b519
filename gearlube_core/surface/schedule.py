"""Time steps of a contact that becomes rough [jamali_2015 7.7]."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlube_core.checks import check_positive
from gearlube_core.errors import ParameterError

_ROUNDING = 1e-9  # of a step


@dataclass(frozen=True, slots=True, kw_only=True)
class RoughSchedule:
    """Time steps of a contact that becomes rough: steps until it is rough, and steps after that.

    Parameters
    ----------
    time_step
        Length of a time step [s].
    until_rough, rough
        Numbers of steps until both surfaces are rough and after that, from 0.

    Raises
    ------
    ParameterError
        The time step is not above zero, or a number of steps is below zero or not whole.

    Examples
    --------
    >>> schedule = RoughSchedule.by_travel(length=2.377e-4, fast=7.93, slow=5.49)
    >>> schedule.rough
    1600
    """

    time_step: float
    until_rough: int
    rough: int

    def __post_init__(self) -> None:
        check_positive("time_step", self.time_step, "s")
        for name in ("until_rough", "rough"):
            number = getattr(self, name)
            if isinstance(number, bool) or number != int(number) or number < 0:
                raise ParameterError(f"{name} must be a whole number from 0 on, got {number!r}.")

    @classmethod
    def by_travel(
        cls,
        *,
        length: float,
        fast: float,
        slow: float,
        until_rough: float = 5.0,
        rough: float = 4.0,
        steps: float = 400.0,
    ) -> RoughSchedule:
        """Return the schedule of distances that the surfaces move.

        Parameters
        ----------
        length
            Hertzian half-width a [m].
        fast, slow
            Speeds of the faster and the slower surface [m/s].
        until_rough
            Half-widths that the slower surface moves until both are rough.
        rough
            Half-widths that the faster surface moves from then on.
        steps
            In which the faster surface moves a half-width; 400 are half a node of a/200 a step.

        Notes
        -----
        The defaults are those of [jamali_2015 7.7]: with a slide-roll ratio of 0.3632 they give
        its 2888 and 1600 steps. There "slower" is printed for the 4 a, and 400 steps for 2 a.
        """
        check_positive("length", length, "m")
        check_positive("slow", slow, "m/s")
        check_positive("steps", steps)
        if fast < slow:
            raise ParameterError(f"fast must be at least slow, {slow:g} m/s, got {fast:g} m/s.")
        first = math.ceil(until_rough * steps * fast / slow - _ROUNDING)
        then = math.ceil(rough * steps - _ROUNDING)
        return cls(time_step=length / (steps * fast), until_rough=first, rough=then)

    @property
    def steps(self) -> int:
        """Number of all steps."""
        return self.until_rough + self.rough

    def time(self, step: int) -> float:
        """Return the time after a number of steps [s]."""
        return step * self.time_step
