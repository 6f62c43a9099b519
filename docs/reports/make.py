"""Write docs/images/report.png: `python -m docs.reports.make FOLDER`, the head of its report.

Needs chromium, or another browser of that family by `--browser`.
"""

from __future__ import annotations

import argparse
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from docs.page import IMAGES

PICTURE = IMAGES / "report.png"
SIZE = (1400, 1760)  # px: findings, key numbers and the first figure


def screenshot(page: Path, picture: Path, browser: str = "chromium") -> None:
    """Draw the head of a page as a PNG."""
    with TemporaryDirectory() as profile:
        subprocess.run(
            [
                browser,
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--disable-background-networking",
                "--hide-scrollbars",
                "--virtual-time-budget=20000",  # the figures are drawn after the page has loaded
                f"--user-data-dir={profile}",
                f"--window-size={SIZE[0]},{SIZE[1]}",
                f"--screenshot={picture}",
                page.resolve().as_uri(),
            ],
            check=True,
            capture_output=True,
        )


def main() -> None:
    """Draw the report of a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--browser", default="chromium")
    given = parser.parse_args()
    screenshot(given.folder / "report.html", PICTURE, given.browser)


if __name__ == "__main__":
    main()
