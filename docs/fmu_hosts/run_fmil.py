"""Run by `hosts`: one FMU in the FMI Library, FMI 2.0 or 3.0; writes the Real values as JSON."""

import json
import sys
from ctypes import CDLL, byref, c_double, c_int, c_size_t, c_uint, c_void_p

COMMANDS = {
    2: {"real": "real", "integer": "integer", "kind": 2},
    3: {"real": "float64", "integer": "int32", "kind": 4},
}


class Fmu:
    """An FMU that the library has unpacked and loaded; an error ends the program."""

    def __init__(self, job: dict) -> None:
        self.library = CDLL(job["library"])
        self.version = int(job["standard"][0])
        self.words = COMMANDS[self.version]
        context = self.pointer(
            "fmi_import_allocate_context", self.pointer("jm_get_default_callbacks")
        )
        fmu, folder = job["fmu"].encode(), job["folder"].encode()
        self.library.fmi_import_get_fmi_version(context, fmu, folder)
        parse = f"fmi{self.version}_import_parse_xml"
        self.fmu = self.pointer(parse, context, folder, c_void_p())
        callbacks = [c_void_p()] * (self.version - 1)  # those of the library
        self.call("create_dllfmu", self.words["kind"], *callbacks)
        name = b"pair"
        if self.version == 2:
            self.call("instantiate", name, 1, c_void_p(), 0)
        else:
            none = c_void_p()
            self.call("instantiate_co_simulation", name, none, 0, 0, 0, 0, none, c_size_t(0), none)

    def pointer(self, name: str, *given: object) -> c_void_p:
        """Call a function that returns a pointer."""
        function = getattr(self.library, name)
        function.restype = c_void_p
        found = function(*given)
        if not found:
            raise SystemExit(f"{name} gave nothing")
        return c_void_p(found)

    def call(self, name: str, *given: object) -> None:
        """Call a function that returns a status."""
        status = getattr(self.library, f"fmi{self.version}_import_{name}")(self.fmu, *given)
        if status != 0:
            raise SystemExit(f"{name}: status {status}")

    def values(self, verb: str, kind: str, references: list, values: list, of: type) -> list:
        """Set or get values."""
        n = c_size_t(len(references))
        array = (of * len(references))(*values)
        more = (n,) if self.version > 2 else ()
        numbers = (c_uint * len(references))(*references)
        self.call(f"{verb}_{self.words[kind]}", numbers, n, array, *more)
        return list(array)

    def start(self) -> None:
        """Begin the initialisation."""
        none, zero = c_int(0), c_double(0.0)
        about = (none, zero, zero, none, zero)
        if self.version == 2:
            self.call("setup_experiment", *about)
        self.call("enter_initialization_mode", *(about if self.version > 2 else ()))

    def step(self, time: float, h: float) -> None:
        """Make one step."""
        flags = [byref(c_int()) for _ in range(3)]
        more = (*flags, byref(c_double())) if self.version > 2 else ()
        self.call("do_step", c_double(time), c_double(h), 1, *more)


def main(job: dict) -> list[float]:
    """Run the job and return the values asked for."""
    fmu = Fmu(job)
    fmu.start()
    for kind, of in (("real", c_double), ("integer", c_int)):
        references, values = zip(*job[f"{kind}s"], strict=True)
        fmu.values("set", kind, references, values, of)
    fmu.call("exit_initialization_mode")
    for k in range(job["steps"]):
        fmu.step(k * job["step_size"], job["step_size"])
    references = job["references"]
    return fmu.values("get", "real", references, [0.0] * len(references), c_double)


if __name__ == "__main__":
    sys.stdout.write("\n" + json.dumps(main(json.load(sys.stdin))) + "\n")
