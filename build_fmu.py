"""Build the FMUs: `python build_fmu.py --out DIR [--model M] [--python] [--check]`."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

from fmu_src.native.build_target import compile_for_any_machine
from gearlube_core.errors import GearLubeError

_LOGGER = logging.getLogger("build_fmu")


def main(arguments: list[str] | None = None) -> int:
    """Build, check if asked to, and return the exit status."""
    parser = argparse.ArgumentParser(
        description="Build HypoidAxle.fmu, HelicalPair.fmu and Driveline.fmu."
    )
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where to put them")
    parser.add_argument("--model", help="hypoid-axle, helical-pair or driveline; by default all")
    parser.add_argument(
        "--mesh-table", type=Path, metavar="FILE", help="mesh table (.nc) of another hypoid pair"
    )
    parser.add_argument("--axle", metavar="FILE", help="axle file (.toml) of another hypoid axle")
    parser.add_argument(
        "--gear", type=Path, metavar="FILE", help="gear file (.toml) of another helical pair"
    )
    parser.add_argument(
        "--line-mesh", type=Path, metavar="FILE", help="line mesh (.nc) of that helical pair"
    )
    parser.add_argument(
        "--python", action="store_true", help="FMUs that compute in the installed package"
    )
    parser.add_argument("--platform", action="append", help="such as x86_64-windows")
    parser.add_argument("--fmi", action="append", help="version of the standard: 2 or 3")
    parser.add_argument("--check", action="store_true", help="validate with fmpy and fmutool")
    parser.add_argument(
        "--page", type=Path, metavar="FILE", help="refresh the tables in docs/fmu.md"
    )
    options = parser.parse_args(arguments)
    if not options.python:
        compile_for_any_machine()
    from fmu_src.build import axle_definition, build_models, pair_definition
    from fmu_src.check import problems
    from fmu_src.documentation import update_page
    from fmu_src.native.build import FMI_VERSIONS, NativeOptions
    from fmu_src.native.platforms import PLATFORM_NAMES

    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    found: list[str] = []
    try:
        native = None
        if not options.python:
            native = NativeOptions(
                platforms=options.platform or PLATFORM_NAMES,
                fmi=options.fmi or FMI_VERSIONS,
                report=_LOGGER.info,
            )
        files = options.mesh_table, options.gear, options.line_mesh
        for path in build_models(
            options.out, options.model, *files, axle=options.axle, native=native
        ):
            _LOGGER.info("built %s (%d kB)", path, path.stat().st_size // 1024)
            found += problems(path) if options.check else []
        for definition in (axle_definition, pair_definition) if options.page else ():
            update_page(options.page, definition())
    except GearLubeError as error:
        _LOGGER.error("%s", error)
        return 2
    for problem in found:
        _LOGGER.error("%s", problem)
    if options.check and not found:
        _LOGGER.info("no problem found by fmpy and fmutool")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
