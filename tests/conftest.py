"""Lets tests import the shared operating points."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

# scripts that tests start in processes of their own, in an environment made for them
collect_ignore = ["fmu/importer_ecos.py", "fmu/importer_libcosim.py"]
