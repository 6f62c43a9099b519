"""What holds for all tests: scripts that pytest must not collect, and workers side by side."""

from __future__ import annotations

import os
from typing import Any

import pytest
from hypothesis import settings

from tests.helpers.session_folder import open_session_folder

# started by tests in processes of their own, in an environment made for them
collect_ignore = ["fmu/importer_ecos.py", "fmu/importer_libcosim.py"]

# the first call of a kernel compiles it, however fast it is afterwards
settings.register_profile("compiled kernels", deadline=None)
settings.load_profile("compiled kernels")

_folder = open_session_folder()


def pytest_configure(config: pytest.Config) -> None:
    """Give each of several workers one thread of linear algebra."""
    if "PYTEST_XDIST_WORKER" in os.environ:
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove what the processes of this run have shared."""
    if _folder is not None:
        _folder.cleanup()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the tests of film solvers first, all others after them.

    Each of two workers begins with one half of the list. So one compiles the kernels of films, the
    other those of axles, gears and bearings, and hardly any kernel is compiled twice.
    """
    items.sort(key=lambda item: "ehl" not in str(item.path) and "_law_" not in str(item.path))


@pytest.fixture
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures are drawn whole, with fewer pixels; what lies where is matplotlib's."""
    from matplotlib.figure import Figure

    save = Figure.savefig

    def save_small(figure: Figure, path: Any, **options: Any) -> None:
        figure.set_layout_engine("none")
        save(figure, path, **(options | {"dpi": 30}))

    monkeypatch.setattr(Figure, "savefig", save_small)
