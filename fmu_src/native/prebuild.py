"""Puts the libraries of the shipped models into the package: `python -m fmu_src.native.prebuild`.

A wheel that is built after it holds them. An FMU of the same kind is then built without compiler.
"""

from __future__ import annotations

import shutil
import sys

from fmu_src.native.build_target import compile_for_any_machine


def main() -> None:
    """Build the libraries of all platforms, and remove those of other versions."""
    compile_for_any_machine()
    from fmu_src.build import axle_definition, pair_definition
    from fmu_src.native.build import libraries, prebuilt_folder
    from fmu_src.native.kept import PREBUILT, keep_library
    from fmu_src.native.models import native_model
    from fmu_src.native.train import train_model

    models = [native_model(axle_definition()), native_model(pair_definition())]
    models.append(train_model("e_axle"))  # whose library is that of all trains
    made = {prebuilt_folder(one): libraries(one, report=_say) for one in models}
    shutil.rmtree(PREBUILT, ignore_errors=True)
    for folder, built in made.items():
        for platform, library in built.items():
            keep_library(folder, platform, library)
    sizes = [path.stat().st_size for path in PREBUILT.rglob("*.kept")]
    _say(f"{len(sizes)} libraries, {sum(sizes) / 1e6:.1f} MB, in {PREBUILT}")


def _say(text: str) -> None:
    sys.stderr.write(f"{text}\n")


if __name__ == "__main__":
    main()
