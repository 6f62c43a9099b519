"""All figures on one page: `python -m docs.contact_sheet [FOLDER] [--run [NAME ...]]`.

FOLDER/index.html (default build/contact_sheet) shows every picture of docs/images, and every
figure of the runs in FOLDER, each in the width in which it is read. With --run an example of each
study, or of those named, is computed into FOLDER first, as far as it is missing: half an hour of
one processor for all. Look at the page after a change of the figures' style.
"""

from __future__ import annotations

import argparse
import html
import logging
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from gearlube.report.stored import PAGE
from gearlube_core.storage.atomic_file import write_text

ROOT = Path(__file__).resolve().parents[1]
logger = logging.getLogger("docs.contact_sheet")

# An example of each study: arguments of `gearlube`, without the folder of results. They run in the
# folder of the sheet, so that one may read what another wrote.
EXAMPLES = {
    "sweep": "sweep --quick",
    "runup": "runup --quick",
    "sound": "sound runup",
    "map": "map --draws 20",
    "cycle": "cycle --cycle nedc",
    "bearing": "bearing --law all",
    "vary": "vary bearing --vary shaft.speed_rpm=500:4000 load.axial_n=1000:6000 --design lhs:200",
    "design": "design",
    "contact": "contact --quick",
    "measured": "measured measured_example/axle_17.toml",
    "whine": "whine",
    "resonance": "resonance --quick",
    "helical": "helical --quick",
    "ehl_line": "ehl line",
    "ehl_point": "ehl point",
    "ehl_helical": "ehl helical jamali_2015_a --step 300",
    "ehl_hypoid": "ehl hypoid --quick --no-march",
}
_BEFORE = {"measured": "measured --example measured_example"}  # what an example needs
_READ = "46rem"  # the width of a page of the site
_STYLE = f"""
body {{ font-family: sans-serif; margin: 1rem; }}
figure {{ display: inline-block; vertical-align: top; margin: 0 1rem 1.5rem 0; }}
img {{ display: block; border: 1px solid #ddd; }}
.docs img {{ width: {_READ}; }}
.runs img {{ max-width: 70rem; }}
"""


def run_example(name: str, folder: Path) -> bool:
    """Compute an example into `folder`/`name` unless its report is there; return if it worked."""
    if (folder / name / PAGE).exists():
        return True
    lines = [_BEFORE[name]] if name in _BEFORE else []
    for line in (*lines, f"{EXAMPLES[name]} --out {name}"):
        done = subprocess.run(
            [sys.executable, "-m", "gearlube", *line.split()],
            cwd=folder,
            env=os.environ
            | {"PYTHONPATH": os.pathsep.join((str(ROOT), os.environ.get("PYTHONPATH", "")))},
            check=False,
        )
        if done.returncode:
            return False
    return True


def section(title: str, pictures: Iterable[Path], kind: str, folder: Path) -> str:
    """Return the part of the page with these pictures; empty without any."""
    shown = "".join(
        f"<figure><figcaption>{html.escape(path.stem)}</figcaption>"
        f'<img src="{html.escape(os.path.relpath(path, folder))}" alt=""></figure>\n'
        for path in pictures
    )
    return f'<h2>{html.escape(title)}</h2>\n<div class="{kind}">\n{shown}</div>\n' if shown else ""


def sheet(folder: Path) -> str:
    """Return the page of docs/images and of all runs in `folder`."""
    images = ROOT / "docs" / "images"
    parts = [section("docs/images", _pictures(images), "docs", folder)]
    for page in sorted(folder.glob(f"*/{PAGE}")):
        run = page.parent
        pictures = [*_pictures(run), *_pictures(run / "figures")]
        parts.append(section(run.name, pictures, "runs", folder))
    return (
        '<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>All figures</title>'
        f"<style>{_STYLE}</style>\n<h1>All figures</h1>\n{''.join(parts)}</html>\n"
    )


def _pictures(folder: Path) -> list[Path]:
    return sorted(one for one in folder.glob("*") if one.suffix in {".png", ".svg", ".gif"})


def main() -> int:
    """Compute what was asked for, write the page, return 0 if every example worked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=ROOT / "build" / "contact_sheet")
    parser.add_argument("--run", nargs="*", choices=EXAMPLES, metavar="NAME")
    given = parser.parse_args()
    folder = given.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    wanted = () if given.run is None else given.run or tuple(EXAMPLES)
    failed = [name for name in wanted if not run_example(name, folder)]
    write_text(sheet(folder), folder / "index.html")
    logger.info("%s", folder / "index.html")
    if failed:
        logger.error("These examples failed: %s.", ", ".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    sys.exit(main())
