"""Calls a native FMU library under any settings of floating point that a host may have."""

from __future__ import annotations

import ctypes
import gc
from typing import Any

from tests.helpers.native_library import NativeLibrary

NEAREST, UP, DOWN, TO_ZERO = 0x0000, 0x4000, 0x2000, 0x6000
MASKS, FLAGS, FLUSH, DENORMALS_ARE_ZERO = 0x1F80, 0x003F, 0x8000, 0x0040
# MXCSR and the control word of the older unit (Intel 64 manual, volume 1, 10.2.3 and 8.1.5)
SETTINGS = {
    "every exception traps": (NEAREST, 0x0340),
    "division by zero traps": (MASKS & ~0x0200, 0x037B),
    "upwards": (MASKS | UP, 0x0B7F),
    "downwards": (MASKS | DOWN, 0x077F),
    "to zero, flags set": (MASKS | TO_ZERO | FLAGS, 0x0F7F),
    "no denormals": (MASKS | FLUSH | DENORMALS_ARE_ZERO, 0x037F),
    "single precision": (MASKS, 0x007F),
}
_LIBM = ctypes.CDLL("libm.so.6")


class Environment(ctypes.Structure):
    """fenv_t of glibc on x86-64."""

    _fields_ = (("x87", ctypes.c_uint32 * 7), ("sse", ctypes.c_uint32))

    @classmethod
    def now(cls) -> Environment:
        found = cls()
        _LIBM.fegetenv(ctypes.byref(found))
        return found

    def set(self) -> None:
        _LIBM.fesetenv(ctypes.byref(self))

    def settings(self) -> tuple[int, int, int]:
        """MXCSR, control word and the flags of the older unit."""
        return self.sse, self.x87[0] & 0xFFFF, self.x87[1] & FLAGS


class _Function:
    """A function that is called under a host's settings; Python itself computes with its own."""

    def __init__(self, function: Any, environment: Environment) -> None:
        self.__dict__ |= {"function": function, "environment": environment}

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.function, name, value)

    def __call__(self, *arguments: Any) -> Any:
        own = Environment.now()
        collected = gc.isenabled()
        gc.disable()  # what hypothesis computes with each collection would trap
        self.environment.set()
        before = Environment.now()
        try:
            result = self.function(*arguments)
            after = Environment.now()
        finally:
            own.set()
            if collected:
                gc.enable()
        assert before.settings()[:2] == (self.environment.sse, self.environment.x87[0])
        assert after.settings() == before.settings()
        return result


class HostLibrary(NativeLibrary):
    """A library whose calls are made under a host's settings of floating point."""

    environment: Environment

    def function(self, name: str) -> Any:
        return _Function(super().function(name), self.environment)


def under(library: NativeLibrary, settings: tuple[int, int]) -> HostLibrary:
    host = object.__new__(HostLibrary)
    host.__dict__ |= library.__dict__
    host.environment = Environment.now()
    host.environment.sse, host.environment.x87[0] = settings
    return host
