"""Which compiled function a train takes: one of its own list, or the one of all lists."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Literal, get_args

from gearlube_core.checks import check_option
from gearlube_core.dynamics.train.assemble import Assembly
from gearlube_core.dynamics.train.drivers import generated, interpreted
from gearlube_core.dynamics.train.element import Listed
from gearlube_core.dynamics.train.march import train_kernel
from gearlube_core.dynamics.train.part import shipped_kinds
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import announced
from gearlube_core.oil.formula_laws import FORMULA_LAWS, OilLaws

_ONCE = "Compiling the code of {}, once on this machine: about {:g} s."
Driver = Literal["automatic", "generated", "interpreted"]


@cache
def _generated(
    listed: tuple[Listed, ...], shape: tuple[int, ...], laws: OilLaws
) -> Callable[..., float]:
    return announced(train_kernel(generated(listed, shape), laws), _ONCE.format("this train", 15))


def generated_kernel(made: Assembly) -> Callable[..., float]:
    """Return the function of `train_kernel` that is compiled for the list of an assembly.

    Lists of the same elements, with tables of any size, share one.
    """
    return _generated(made.listed, made.shape, made.laws)


@cache
def interpreted_kernel() -> Callable[..., float]:
    """Return the function of `train_kernel` for all lists of elements and oils of the package."""
    return announced(
        train_kernel(interpreted(shipped_kinds()), FORMULA_LAWS), _ONCE.format("all trains", 80)
    )


def kernel_of(made: Assembly, driver: Driver, names: Sequence[str] = ()) -> Callable[..., float]:
    """Return the compiled function of a train by a driver, see `Train`.

    Parameters
    ----------
    made : Assembly
    driver : {"automatic", "generated", "interpreted"}
    names : sequence of str
        Of the elements, for errors.

    Raises
    ------
    ParameterError
        The train is to be interpreted, and an element or its oil is none of the package.
    """
    check_option("driver", driver, get_args(Driver))
    own = [i for i, one in enumerate(made.listed) if one not in shipped_kinds()]
    known = not own and made.laws == FORMULA_LAWS
    if driver == "interpreted" and not known:
        what = f"the element {names[own[0]]!r}" if own else "the oil"
        raise ParameterError(
            "driver must be automatic or generated for a train with kernels from outside the "
            f"package, got interpreted, and {what} has such kernels."
        )
    by_rows = known and driver != "generated"
    return interpreted_kernel() if by_rows else generated_kernel(made)
