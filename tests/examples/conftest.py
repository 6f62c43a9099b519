"""Commands draw all their figures here, small and without layout, which take most of the time."""

from __future__ import annotations

from typing import Any

import pytest
from matplotlib.figure import Figure

_SAVE = Figure.savefig


def _save_small(figure: Figure, path: Any, **options: Any) -> None:
    figure.set_layout_engine("none")
    _SAVE(figure, path, **(options | {"dpi": 30}))


@pytest.fixture(autouse=True)
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are drawn whole, with fewer pixels; what lies where is matplotlib's."""
    monkeypatch.setattr(Figure, "savefig", _save_small)
