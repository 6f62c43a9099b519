"""What is imported before it is needed: nothing large."""

from __future__ import annotations

import subprocess
import sys

import pytest

_LARGE = (
    "numpy", "scipy", "numba", "pandas", "xarray", "dask", "distributed", "matplotlib", "fmpy",
    "casadi", "skfem", "pyfftw", "trimesh", "netCDF4", "pydantic", "lxml",
)  # fmt: skip


def _imported_by(code: str) -> set[str]:
    """Return the top names of all modules that a new process has imported after `code`."""
    end = "import sys; print(); print(*{name.partition('.')[0] for name in sys.modules})"
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\n{end}"], capture_output=True, text=True, check=True
    )
    return set(done.stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    "code",
    [
        "import gearlube",
        "import gearlube_core.units, drivetrain, fmu_src",
        "from gearlube.command import app; app(['--help'], standalone_mode=False)",
        "from gearlube.command import app; app(['--version'], standalone_mode=False)",
    ],
)
def test_nothing_large_is_imported_before_a_study_starts(code: str) -> None:
    assert _imported_by(code).isdisjoint(_LARGE)


_READING = """
import os, sys, tempfile
from typer.testing import CliRunner
from gearlube.command import app
os.chdir(tempfile.mkdtemp())
open("bad.toml", "w").write("a = [1,,")
studies = "sweep runup axle/show design contact optimise measured whine helical oil map cycle"
studies += " vary/map ehl/line ehl/point ehl/hypoid ehl/helical ehl/rough bearing convert"
for study in studies.split() + ["build-fmu/--axle", "map/--oil", "bearing/tapered/--oil"]:
    done = CliRunner().invoke(app, [*study.split("/"), "bad.toml"])
    assert done.exit_code == 2, (study, done.output)
    assert os.listdir() == ["bad.toml"], study
"""


@pytest.mark.slow
def test_a_file_that_is_no_toml_is_refused_before_anything_large_is_imported() -> None:
    assert _imported_by(_READING) & set(_LARGE) <= {"pydantic"}


@pytest.mark.slow
def test_a_film_on_a_grid_is_solved_without_dask() -> None:
    """pyfftw would import dask's arrays, and with them pandas, for an interface nobody uses."""
    loaded = _imported_by("from gearlube_core.ehl.point.solver import solve_point_contact")
    assert "pyfftw" in loaded
    assert loaded.isdisjoint({"dask", "distributed", "pandas", "xarray", "matplotlib", "fmpy"})
