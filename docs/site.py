"""Build the documentation site: `python -m docs.site [FOLDER]`; the default is build/site.

All pages are checked and the tutorials are run. A warning is an error. A tutorial that has not
changed since the last build is not run again.
"""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main(folder: Path) -> int:
    """Write the site into `folder`; return 0 if nothing is wrong with it."""
    from sphinx.cmd.build import main as sphinx

    return sphinx(["-q", "-W", "--keep-going", "-b", "html", str(HERE), str(folder)])


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent / "build" / "site"
    sys.exit(main(target))
