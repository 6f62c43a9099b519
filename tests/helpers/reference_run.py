"""The reference experiment inside an FMU, run by a host that knows the FMI Cross-Check alone."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np

from fmu_src.native.related_files import FOLDER


def check_reference(fmu: Path, folder: Path, more: float = 0.0) -> np.ndarray:
    """Run the experiment, compare each output with its results, and return these.

    `more` is allowed beside the tolerance of the file, for outputs that are 0 in theory.
    """
    place = Path(fmpy.extract(str(fmu), str(folder))) / FOLDER
    (file,) = place.glob("*_ref.opt")
    options = dict(line.split(", ") for line in file.read_text().splitlines())
    expected, given = (
        fmpy.read_csv(str(file.with_name(file.name.replace("_ref.opt", ending))))
        for ending in ("_ref.csv", "_in.csv")
    )
    names = list(expected.dtype.names[1:])
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=float(options["StopTime"]),
        output_interval=float(options["OutputInterval"]),
        input=given,
        output=names,
    )
    changed = [name for name in given.dtype.names[1:] if np.ptp(given[name]) > 0.0]
    assert changed
    for name in names:
        limit = float(options["RelTol"]) * np.abs(expected[name]).max() + more
        np.testing.assert_allclose(result[name], expected[name], rtol=0.0, atol=limit, err_msg=name)
    return expected
