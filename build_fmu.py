"""Build HypoidAxle.fmu: `python build_fmu.py --out DIR [--check] [--page docs/fmu.md]`."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

from fmu_src.build import build_hypoid_axle
from fmu_src.check import problems
from fmu_src.documentation import update_page
from fmu_src.hypoid_axle import DEFINITION
from gearlube_core.errors import GearLubeError

_LOGGER = logging.getLogger("build_fmu")


def main(arguments: list[str] | None = None) -> int:
    """Build, check if asked to, and return the exit status."""
    parser = argparse.ArgumentParser(description="Build HypoidAxle.fmu (FMI 2.0 co-simulation).")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where to put it")
    parser.add_argument(
        "--mesh-table", type=Path, metavar="FILE", help="mesh table (.nc) of another gear pair"
    )
    parser.add_argument("--check", action="store_true", help="validate with fmpy and fmutool")
    parser.add_argument(
        "--page", type=Path, metavar="FILE", help="refresh the tables in docs/fmu.md"
    )
    options = parser.parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    try:
        path = build_hypoid_axle(options.out, options.mesh_table)
        _LOGGER.info("built %s (%d kB)", path, path.stat().st_size // 1024)
        if options.page:
            update_page(options.page, DEFINITION)
        found = problems(path) if options.check else []
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
