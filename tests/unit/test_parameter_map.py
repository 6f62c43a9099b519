"""How FMI parameters become packed floats."""

import numpy as np
import pytest

from fmu_src.native.parameter_map import parameter_map, write_packed
from fmu_src.variable import count, option, parameter
from gearlube_core.errors import ParameterError

LENGTH = parameter("a", "m", "A length", start=2.0, minimum=0.0, maximum=8.0, argument="length")
STEPS = count("n", "A count", 5, 1, 9, argument="steps")
FORM = option("f", "A form", "round", "square", "flat", start="square", argument="form")
SIGN = option("s", "A sign", "plus", "minus", start="plus", argument="sign")
TABLE = (LENGTH, STEPS, FORM, SIGN)
FACTORS = {"round": (3.0, 0.5), "square": (4.0, 0.5), "flat": (4.0, 0.0)}
AREA = 4  # place that the kernel of a model would write


def pack(values):
    first, second = FACTORS[values["form"]]
    sign = 1.0 if values["sign"] == "plus" else -1.0
    area = values["length"] ** 2 * first
    return np.array([values["length"], first, second, sign, area, float(values["steps"]), 7.0])


def test_options_and_numbers_reach_their_places():
    found = parameter_map(TABLE, pack, frozenset({AREA}))
    for length, steps in ((0.0, 1), (3.5, 9)):
        for i, form in enumerate(FORM.literals, start=1):
            for j, sign in enumerate(SIGN.literals, start=1):
                out = np.zeros(7)
                write_packed(np.array([length, steps, i, j]), *found.arrays, out)
                expected = pack({"length": length, "steps": steps, "form": form, "sign": sign})
                out[AREA] = expected[AREA]
                np.testing.assert_array_equal(out, expected)


def test_a_formula_without_a_kernel_is_refused():
    with pytest.raises(ParameterError, match="a must stand in the packed parameters as it is"):
        parameter_map(TABLE, pack, frozenset())


def test_two_enumerations_do_not_set_the_same_float():
    def mixed(values):
        packed = pack(values)
        packed[3] *= packed[1]
        return packed

    with pytest.raises(ParameterError, match="s must set packed floats of its own"):
        parameter_map(TABLE, mixed, frozenset({AREA}))
