"""Host of one FMU that counts, as Python ends, what the FMU's library has left to release."""

from __future__ import annotations

import atexit
import ctypes
import sys
from pathlib import Path

import numpy as np
from fmu_host import Host

CONTROL_BLOCK = 16  # bytes before the object that std::make_shared puts in the same allocation


def shared_states(library: Path) -> int:
    """Count the pointers of the form std::shared_ptr in the static data of a loaded library.

    Both of its words point into one allocation, the object behind its control block.
    """
    found = 0
    for line in Path("/proc/self/maps").read_text().splitlines():
        if line.endswith(str(library)) and " rw-p " in line:
            start, end = (int(number, 16) for number in line.split()[0].split("-"))
            words = np.frombuffer(ctypes.string_at(start, end - start), dtype=np.uint64)
            target, block = words[:-1], words[1:]
            found += int(np.sum((block != 0) & (target == block + CONTROL_BLOCK)))
    return found


def main(folder: Path) -> None:
    (library,) = folder.glob("binaries/linux64/*.so")
    # Registered first, so it runs last.
    atexit.register(lambda: sys.stdout.write(f"as Python ends: {shared_states(library)}\n"))
    host = Host(folder)
    sys.stdout.write(f"with an instance: {shared_states(library)}\n")
    host.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
