"""A viscosity law in a file of one's own serves the films of oil files, case files and Python."""

from __future__ import annotations

import math

import pytest

from tests.helpers.oil_with_own_law import ALPHA, PRESSURES, Q
from tests.helpers.own_process import INTERPRETED, report_of


def test_one_file_makes_the_law_known_to_oil_files_case_files_and_python():
    found = report_of("oil_with_own_law", **INTERPRETED)
    assert "must be a text, barus or roelands or houpert or mcewen or modulus" in found["before"]
    films = found["films"]
    for name, q in (("oil file", Q), ("case with the oil file", Q), ("case", Q), ("python", 16.0)):
        *ratios, alpha = films[name]
        # an oil's alpha goes through Roelands' exponent, whose two constants agree to 4e-5
        assert alpha == pytest.approx(ALPHA, rel=4e-5)
        # the power by hand; rounding of a power
        expected = [(1.0 + alpha * p / q) ** q for p in PRESSURES]
        assert ratios == pytest.approx(expected, rel=1e-12), name
    *barus, alpha = films["other law in the case"]
    assert barus == pytest.approx([math.exp(alpha * p) for p in PRESSURES], rel=1e-12)
    assert found["notes"] == [
        ["viscosity_law", "own_power", "", "given", ""],
        ["law_numbers.q", Q, "1", "given", ""],
    ]
    unknown, low, nobody = found["refusals"]
    assert "law_numbers must name numbers of the oil's laws" in unknown
    assert "got 'r'; the chosen laws have q. Correct the name" in unknown
    assert "q must be within 1 to 100, got 0" in low
    assert "got 'q'; the chosen laws have no numbers" in nobody
