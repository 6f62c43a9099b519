"""A train from a file: every number that the kernels count with or index by is looked at before."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from drivetrain.train.train_file import TrainFile
from gearlube_core.dynamics.train.assemble import Assembly, assemble
from gearlube_core.dynamics.train.check import check_kernel
from gearlube_core.dynamics.train.drivers import interpreted
from gearlube_core.dynamics.train.elements.joint import Joint
from gearlube_core.dynamics.train.elements.port import Port
from gearlube_core.dynamics.train.housing import Housing
from gearlube_core.dynamics.train.part import shipped_elements, shipped_kinds
from gearlube_core.dynamics.train.plan import (
    AT,
    FIRST_ROW,
    KIND,
    MEMORY,
    N_MEMORY,
    N_PLACES,
    NUMBER,
    WHICH,
    sizes_of,
)
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.shafts.section import ShaftSection
from tests.helpers.frame_model import box_frame, reduced
from tests.helpers.small_trains import OIL

HOUSED = "a shaft in a housing"
NAMES = (*TrainFile.shipped(), HOUSED)


@cache
def assembled(name: str) -> Assembly:
    if name != HOUSED:
        return TrainFile.named(name).case().train.assembly
    tube = ShaftSection(start=0.0, end=0.3, outer_diameter=0.04)
    shaft = Shaft(name="shaft", sections=(tube,), nodes={"low": 0.0, "high": 0.25})
    case = Housing(name="case", model=reduced(box_frame(), modes=0), highest_frequency=1e3)
    seats = [
        Joint(name=one, first=f"shaft.{one}", second=f"case.a_{one}", K_xx=1e8)
        for one in shaft.nodes
    ]
    return assemble([case, shaft], [*seats, Port(name="motor", body="shaft")], OIL)


def is_train(made: Assembly, **changed: np.ndarray) -> bool:
    arrays = {"numbers": made.numbers, "memory": made.memory, "plan": made.plan} | changed
    oil = lubricant_state(OIL.parameters(), 330.0)
    return bool(_kernel()(oil, arrays["numbers"], arrays["memory"], arrays["plan"]))


@cache
def _kernel() -> Callable[..., bool]:
    return check_kernel(interpreted(shipped_kinds()))


def free_places(plan: np.ndarray) -> set[int]:
    """Return places of the plan that may hold another number: of bodies, losses, ports beside.

    Whether the forces of an element are linear is one, too, if others touch its bodies.
    """
    found, at = set(), FIRST_ROW
    for _ in range(sizes_of(plan).elements):
        one = shipped_elements()[plan[at + KIND]][0]
        first = at + AT
        found.add(at + WHICH)
        found |= set(range(first, first + len(one.on)))
        own = len(one.states) + len(one.angles) + len(one.lags)
        first += len(one.on) + own + len(one.works)
        lost = len(one.losses) + len(one.bounds)
        found |= set(range(first, first + lost))
        if one.beside:
            found.add(first + lost + 1)
        at += AT + int(plan[at + N_PLACES])
    return found


@pytest.mark.parametrize("name", NAMES)
def test_shipped_trains_are_taken(name: str):
    assert is_train(assembled(name))


@pytest.mark.parametrize("name", NAMES)
def test_any_other_number_in_a_plan_is_refused(name: str):
    """Another body, loss or port in its range makes another train; those are tried below."""
    made = assembled(name)
    free = free_places(made.plan)
    taken = []
    for i in range(made.plan.size):
        for number in (-1, 0, 1, 2, made.plan[i] + 1, made.plan[i] - 1, 10**6, 2**31, -(2**63)):
            plan = made.plan.copy()
            plan[i] = number
            if number != made.plan[i] and i not in free and is_train(made, plan=plan):
                taken.append((i, number))
    # axes of opposed bearings are a permutation, so that no single other number is one
    assert taken == []


@pytest.mark.parametrize("name", NAMES)
def test_bodies_losses_and_ports_lie_where_they_can(name: str):
    made = assembled(name)
    sizes = made.sizes
    for i in free_places(made.plan):
        for number in (12 * sizes.bodies, 13, sizes.states, sizes.integrated - sizes.energies - 1):
            plan = made.plan.copy()
            plan[i] = number
            assert not is_train(made, plan=plan), (i, number)


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_that_is_cut_or_longer_is_refused(name: str):
    made = assembled(name)
    for plan in (made.plan[:5], made.plan[:-1], np.append(made.plan, 0), made.plan[:FIRST_ROW]):
        assert not is_train(made, plan=np.ascontiguousarray(plan))
    assert not is_train(made, numbers=made.numbers[:-1].copy())
    assert not is_train(made, memory=made.memory[:-1].copy())


@pytest.mark.parametrize("number", [np.nan, np.inf, -1.0, 0.0, 2.5, 1e9])
def test_rollers_that_cannot_be_counted_are_refused(number: float):
    made = assembled("hypoid_axle")
    numbers, at = made.numbers.copy(), FIRST_ROW
    while shipped_elements()[made.plan[at + KIND]][0].kind != "opposed_bearings":
        at += AT + made.plan[at + N_PLACES]
    rollers = shipped_elements()[made.plan[at + KIND]][1].variants[0]._fields.index("n_rollers")
    assert 3.0 <= numbers[made.plan[at + NUMBER] + rollers] <= 100.0
    numbers[made.plan[at + NUMBER] + rollers] = number
    assert not is_train(made, numbers=numbers)


def test_a_line_mesh_whose_lines_do_not_fit_its_size_is_refused():
    made = assembled("e_axle")
    at = FIRST_ROW
    while shipped_elements()[made.plan[at + KIND]][0].kind != "helical_mesh":
        at += AT + made.plan[at + N_PLACES]
    first, count = made.plan[at + MEMORY], made.plan[at + N_MEMORY]
    refused = 0
    for place in range(first, first + min(count, 400)):
        memory = made.memory.copy()
        memory[place] += 1.0
        refused += not is_train(made, memory=memory)
    assert refused == 4  # lines, phases, stations, and a film that is solved without a model
