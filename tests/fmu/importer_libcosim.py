"""Run by test_fmu_importers: one FMU in libcosim; writes the Real values asked for as JSON."""

import json
import sys

from libcosimpy.CosimEnums import CosimVariableType  # noqa: F401  (loads the C library early)
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


def main(job: dict) -> list[float]:
    execution = CosimExecution.from_step_size(step_size=round(job["step_size"] * 1e9))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=job["fmu"], instance_name="pair"))
    for reference, value in job["reals"]:
        execution.real_initial_value(slave, reference, value)
    for reference, value in job["integers"]:
        execution.integer_initial_value(slave, reference, value)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    execution.step(job["steps"])
    return list(observer.last_real_values(slave, job["references"]))


if __name__ == "__main__":
    sys.stdout.write("\n" + json.dumps(main(json.load(sys.stdin))) + "\n")
