"""What an FMU leaves behind in the process that hosted it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc/self/maps")
def test_the_library_has_nothing_left_to_release_before_its_destructors_run(
    fmu_folder: Path,
) -> None:
    # What is left then is released twice: by a static destructor and by the unload hook. Whether
    # the process survives that depends on the layout of its heap; what is left does not.
    script = Path(__file__).with_name("process_end.py")
    done = subprocess.run(
        [sys.executable, str(script), str(fmu_folder)], capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == ["with an instance: 1", "at exit: 0"]
