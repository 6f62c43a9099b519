"""Host of one FMU that counts what the FMU's library has left to release as its process exits."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

import numpy as np

from tests.helpers.fmu_host import Host

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

    @ctypes.CFUNCTYPE(None, ctypes.c_void_p)
    def tell(_: int | None) -> None:
        os.write(sys.stdout.fileno(), b"at exit: %d\n" % shared_states(library))

    # Exit handlers run in reverse: the library's destructors are registered before `tell` and run
    # after it, what an instance registers runs before it.
    ctypes.CDLL(str(library))
    ctypes.CDLL(None)["__cxa_atexit"](tell, None, None)
    host = Host(folder)
    os.write(sys.stdout.fileno(), b"with an instance: %d\n" % shared_states(library))
    host.close()
    ctypes.CDLL(None).exit(0)  # Python would end before exit handlers run, and `tell` with it.


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
