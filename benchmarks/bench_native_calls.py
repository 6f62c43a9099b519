"""Cost of single calls of native FMUs: `python -m benchmarks.bench_native_calls`.

`--reference LIBRARY GUID REFERENCE H` adds the FMI 2 library of another FMU, for instance one of
the Reference FMUs of the Modelica Association, compiled with the same level of optimisation: the
Real with that value reference is read, and steps of H seconds are taken. Linux.
"""

from __future__ import annotations

import argparse
import logging
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.bench_native_fmu import compiled
from fmu_src.native.build import libraries, native_guid
from fmu_src.native.models import native_model
from fmu_src.native.platforms import PLATFORMS, platform_of_this_machine
from tests.helpers.fmu_cases import CASES
from tests.helpers.small_native_builds import unpacked
from tests.helpers.small_native_model import small_native_model

_LOGGER = logging.getLogger("bench_native_calls")
_SOURCE = Path(__file__).with_name("native_calls.c")
_SHORTEST = "1e-9"  # s; the least that a step of a model costs


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument(
        "--reference", nargs=4, action="append", default=[],
        metavar=("LIBRARY", "GUID", "REFERENCE", "H"),
    )  # fmt: skip
    others: list[list[str]] = parser.parse_args().reference
    small = small_native_model(motion=frozenset({"pinion.speed"}))
    models = [(small, "pinion.speed"), *((native_model(c.definition), "mesh.dte") for c in CASES)]
    rows = [(Path(one[0]).stem, [*one, "-1", "0"]) for one in others]
    (platform,) = (one for one in PLATFORMS if one.name == platform_of_this_machine())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for model, read in models:
            built = libraries(model, [platform])[platform.name]
            path = unpacked(model, folder / model.definition.name, built, platform)
            references = model.definition.references
            own = [str(path), str(native_guid(model)), str(references[read]), _SHORTEST, "-1", "0"]
            if model is small:  # as little physics as it can have
                own[-2:] = [str(references["solver.substeps"]), "1"]
            rows.append((model.definition.name, own))
        command = [str(compiled(folder, _SOURCE)), *(word for _, own in rows for word in own)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    for (title, _), line in zip(rows, done.stdout.splitlines(), strict=True):
        load, again, get, step = map(float, line.split())
        _LOGGER.info(
            "%s: load and initialise %.2f ms, again %.3f ms, read %.1f ns, shortest step %.3f us",
            title, load, again, get, step,
        )  # fmt: skip


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
