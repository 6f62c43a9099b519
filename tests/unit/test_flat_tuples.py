"""Nested NamedTuples as flat arrays and back."""

from typing import NamedTuple

import numpy as np
import pytest
from numba import njit

from gearlube_core.bearings.tapered_roller_kernels import TaperedRollerParameters
from gearlube_core.dynamics.hypoid_axle import mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import AxleParameters
from gearlube_core.friction.flank_laws import MixedFlankFriction
from gearlube_core.kernels.flat_tuples import (
    count_floats,
    flatten,
    tuple_from_array,
    tuple_to_array,
)


class Inner(NamedTuple):
    a: float
    b: float


class Middle(NamedTuple):
    first: Inner
    c: float
    second: Inner


class Outer(NamedTuple):
    d: float
    middle: Middle
    inner: Inner
    e: float


AXLE_KINDS = TaperedRollerParameters, MixedFlankFriction
NESTED = Outer(1.0, Middle(Inner(2.0, 3.0), 4.0, Inner(5.0, 6.0)), Inner(7.0, 8.0), 9.0)


@njit
def restore_outer(array):
    return tuple_from_array(array, Outer)


class StepControl(NamedTuple):
    """Any five floats."""

    one: float
    two: float
    three: float
    four: float
    five: float


@njit
def restore_axle(array):
    return tuple_from_array(array, AxleParameters, TaperedRollerParameters, MixedFlankFriction)


@njit
def restore_control(array):
    return tuple_from_array(array, StepControl)


@njit
def named_fields(array):
    outer = tuple_from_array(array, Outer)
    return outer.middle.second.b, outer.inner.a, outer.e


def test_floats_lie_in_the_order_of_the_fields():
    np.testing.assert_array_equal(flatten(NESTED), np.arange(1.0, 10.0))
    assert flatten(NESTED).dtype == np.float64


@pytest.mark.parametrize(("kind", "count"), [(Inner, 2), (Middle, 5), (Outer, 9)])
def test_floats_are_counted_through_all_levels(kind, count):
    assert count_floats(kind) == count


@pytest.mark.parametrize("restore", [restore_outer, restore_outer.py_func])
def test_a_nested_tuple_comes_back_whole(restore):
    assert restore(flatten(NESTED)) == NESTED


def test_fields_keep_their_names_inside_a_kernel():
    assert named_fields(flatten(NESTED)) == (6.0, 7.0, 9.0)


def test_floats_beyond_the_tuple_are_left_alone():
    longer = np.append(flatten(NESTED), np.nan)
    assert restore_outer(longer) == NESTED


def test_the_parameters_of_the_axle_come_back_to_the_bit():
    parameters = mohammadpour_2015_axle().kernel_parameters()
    array = flatten(parameters)
    assert array.size == count_floats(AxleParameters, TaperedRollerParameters, MixedFlankFriction)
    assert restore_axle(array) == parameters


def test_infinities_and_signed_zeros_come_back_to_the_bit():
    control = StepControl(np.inf, -np.inf, -0.0, 5e-324, 1.0)
    back = restore_control(flatten(control))
    np.testing.assert_array_equal(np.array(back).view(np.int64), np.array(control).view(np.int64))


def test_the_result_is_a_copy():
    array = flatten(NESTED)
    restored = restore_outer(array)
    array[:] = 0.0
    assert restored == NESTED


@njit
def restored_and_written(array, out):
    tuple_to_array(tuple_from_array(array, AxleParameters, *AXLE_KINDS), out[1:])


def test_a_kernel_writes_tuples_in_the_order_of_flatten():
    floats = flatten(mohammadpour_2015_axle().kernel_parameters())
    for write in (restored_and_written, restored_and_written.py_func):
        out = np.full(floats.size + 2, -1.0)
        write(floats, out)
        np.testing.assert_array_equal(out, [-1.0, *floats, -1.0])
