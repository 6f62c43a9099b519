"""Run of `gearlube ehl` within a test, and what it has written."""

import csv

import xarray as xr
from typer.testing import CliRunner

from gearlube import command as cli
from gearlube.report.stored import read_report
from gearlube.studies.films.figures.catalogue import drawn_figures


def run(*arguments):
    return CliRunner().invoke(cli.app, ["ehl", *map(str, arguments)])


def written(out, kind):
    dataset = xr.load_dataset(out / f"{kind}.nc", engine="scipy")
    figures = {path.stem for path in (out / "figures").glob("*.png")}
    assert figures == set(drawn_figures(dataset))
    for name, variable in {**dataset.data_vars, **dataset.coords}.items():
        if not str(name).startswith("formula_"):
            assert variable.attrs["units"], name
            assert variable.attrs["long_name"], name
    assert read_report(out)["study"] == f"ehl {kind}"
    with (out / "summary.csv").open(newline="") as file:
        return dataset, list(csv.DictReader(file))
