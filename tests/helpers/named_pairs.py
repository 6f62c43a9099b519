"""The gear pairs of the two sources, from their gear files."""

from __future__ import annotations

from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.pair import HelicalPair

PAIRS = ("he_2007", "jamali_2015_a", "jamali_2015_b")


def named_pair(name: str) -> HelicalPair:
    """Return a gear pair by name: he_2007, jamali_2015_a or jamali_2015_b."""
    check_option("name", name, PAIRS)
    return HelicalGearFile.named(name).helical_pair()
