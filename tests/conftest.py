"""Lets tests import the shared operating points and the scripts of the docs."""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1])]

# scripts that tests start in processes of their own, in an environment made for them
collect_ignore = ["fmu/importer_ecos.py", "fmu/importer_libcosim.py"]
