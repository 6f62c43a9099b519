"""Names the scripts among the tests that pytest must not collect, and puts tests in order."""

from __future__ import annotations

import pytest

# started by tests in processes of their own, in an environment made for them
collect_ignore = ["fmu/importer_ecos.py", "fmu/importer_libcosim.py"]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the tests of film solvers first, all others after them.

    Each of two workers begins with one half of the list. So one compiles the kernels of films, the
    other those of axles, gears and bearings, and hardly any kernel is compiled twice.
    """
    items.sort(key=lambda item: "ehl" not in str(item.path) and "_law_" not in str(item.path))
