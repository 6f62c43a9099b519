"""What holds for all tests: what pytest must not collect, and workers side by side."""

from __future__ import annotations

import gc
import os
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from threadpoolctl import threadpool_limits

from tests.helpers.session_folder import open_session_folder

# helpers hold no tests and no examples
collect_ignore = ["helpers"]

# the first call of a kernel compiles it, however fast it is afterwards; drawn examples are the same
# in every run, so that a change fails by what it changed: --hypothesis-profile search draws others
settings.register_profile("compiled kernels", deadline=None, derandomize=True)
settings.register_profile("search", deadline=None, max_examples=2000)
settings.load_profile("compiled kernels")

# `rel=` alone would also allow an absolute 1e-12: more than many a curvature, flow or area in SI
type(pytest.approx(1.0)).DEFAULT_ABSOLUTE_TOLERANCE = 0.0

# pytest compares arrays number by number in Python; it still does where they differ, for its words
_ApproxArray: Any = type(pytest.approx(np.zeros(1)))
_compare_one_by_one = _ApproxArray.__eq__


def _equal_arrays(wanted: Any, found: Any) -> bool:
    expected, size = wanted.expected, getattr(found, "shape", None)
    if size == expected.shape and {found.dtype.kind, expected.dtype.kind} <= {"f", "i"}:
        relative = wanted.rel if wanted.rel is not None else 1e-6 if wanted.abs is None else 0.0
        with np.errstate(invalid="ignore"):
            limit = np.maximum(relative * np.abs(expected), wanted.abs or 0.0)
            near = (np.abs(found - expected) <= limit) & np.isfinite(expected)
        if (near | (found == expected)).all():
            return True
    return bool(_compare_one_by_one(wanted, found))


_ApproxArray.__eq__ = _equal_arrays

# threads of linear algebra in several processes wait for one another, which takes ten times the
# processor time of small matrices; a plugin of pytest has loaded numpy, with its threads, by now
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# numba colours every reason why a function does not fit, also of those that it never shows: a
# twentieth of the time of compilation where colorama, which comes with a package of tests, is
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")
threadpool_limits(1, user_api="blas")

_folder = open_session_folder()


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove what the processes of this run have shared."""
    if _folder is not None:
        _folder.cleanup()


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect without looking for garbage: syntax trees and modules take a third longer with it.

    Later it is looked for seldom: compilation, which makes many objects that stay, takes a sixth
    longer otherwise.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(100_000, 20, 100)
        gc.enable()


class _LastFileFirst(pytest.Dir):
    """A folder whose files are collected in reverse order."""

    def collect(self) -> list[pytest.Item | pytest.Collector]:
        return list(super().collect())[::-1]


@pytest.hookimpl(tryfirst=True)
def pytest_collect_directory(path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Let every second worker read the files of a folder from the last to the first.

    Each worker collects all tests. A file that one has read lies on disk as bytecode for the other,
    so each compiles one half of the files.
    """
    worker = os.environ.get("PYTEST_XDIST_WORKER", "gw0")
    return _LastFileFirst.from_parent(parent, path=path) if int(worker[2:]) % 2 else None


@pytest.hookimpl(wrapper=True)
def pytest_collect_file() -> Generator[None, list[pytest.Collector], list[pytest.Collector]]:
    """Look for tests here and not for examples in docstrings: those stand in the packages."""
    collectors = yield
    return [collector for collector in collectors if type(collector) is pytest.Module]


@pytest.hookimpl(tryfirst=True)
@pytest.hookimpl(trylast=True)  # without the tests that are left out
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Give all workers one order: tests of film solvers first, those that build FMUs in the middle.

    Each of two workers begins with one half of the list. So one compiles the kernels of films, the
    other those of FMUs, and hardly any kernel is compiled twice. The last tests are shared out in
    small parts, each of which sets up its modules again: they are cheap ones.
    """

    def is_not_of_films(path: str) -> bool:
        return "ehl" not in path and "_law_" not in path

    def builds_fmus(item: pytest.Item) -> bool:
        return item.path.parent.name in ("fmu", "native")

    items.sort(key=lambda item: (is_not_of_films(str(item.path)), str(item.path)))
    fmus = [item for item in items if builds_fmus(item)]
    others = [item for item in items if not builds_fmus(item)]
    middle = (len(items) + 1) // 2
    items[:] = others[:middle] + fmus + others[middle:]


@pytest.fixture(scope="session", autouse=True)
def small_pictures() -> Iterator[None]:
    """Figures are written without layout and ticks, with few pixels: these are matplotlib's work.

    All else is drawn. Axes with a formatter of numbers that is not matplotlib's choice keep ticks.
    """
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.ticker import FuncFormatter

    save, draw = Figure.savefig, Axis.draw

    def draw_label(axis: Axis, renderer: Any) -> None:
        if isinstance(axis.get_major_formatter(), FuncFormatter):
            draw(axis, renderer)
        elif axis.get_visible():
            axis.label.draw(renderer)

    def save_small(figure: Figure, path: Any, **options: Any) -> None:
        figure.set_layout_engine("none")
        with pytest.MonkeyPatch.context() as while_saving:
            while_saving.setattr(Axis, "draw", draw_label)
            save(figure, path, **(options | {"dpi": 30}))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", save_small)
        yield
