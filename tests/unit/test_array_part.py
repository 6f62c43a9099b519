"""Parts of arrays inside kernels."""

import numpy as np
import pytest

from gearlube_core.kernels.array_part import part
from gearlube_core.kernels.jit import kernel


@kernel
def add_to_middle(array, at, size):
    middle = part(array, at, size)
    for i in range(middle.size):
        middle[i] += 10.0
    inner = part(middle, 1, size - 1)
    inner[0] *= 2.0
    return inner.size


@pytest.mark.parametrize("run", [add_to_middle, add_to_middle.py_func], ids=["compiled", "python"])
def test_a_part_is_over_the_memory_of_its_array(run):
    array = np.arange(6.0)
    assert run(array, 2, 3) == 2
    np.testing.assert_array_equal(array, [0.0, 1.0, 12.0, 26.0, 14.0, 5.0])
