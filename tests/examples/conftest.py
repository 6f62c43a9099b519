"""Commands draw all their figures here, small and without layout, which take most of the time."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def _small(small_pictures: None) -> None:
    """Every test of this folder has them."""
