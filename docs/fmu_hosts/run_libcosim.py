"""Run by `hosts`: one FMU, or an SSP folder, in libcosim; writes the Real values as JSON."""

import json
import sys

from libcosimpy.CosimEnums import CosimVariableType  # noqa: F401  (loads the C library early)
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


def main(job: dict) -> list[float]:
    """Run the job and return the values asked for."""
    nanoseconds = round(job["step_size"] * 1e9)
    if job.get("ssp"):
        execution = CosimExecution.from_ssp_file(ssp_path=job["ssp"], step_size=nanoseconds)
    else:
        execution = CosimExecution.from_step_size(step_size=nanoseconds)
        slave = CosimLocalSlave(fmu_path=job["fmu"], instance_name="pair")
        slave = execution.add_local_slave(slave)
        for reference, value in job["reals"]:
            execution.real_initial_value(slave, reference, value)
        for reference, value in job["integers"]:
            execution.integer_initial_value(slave, reference, value)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    if not execution.step(job["steps"]):
        raise SystemExit("libcosim: a step was refused")
    values = []
    for name, references in job["references"].items():
        slave = execution.slave_index_from_instance_name(name)
        values += observer.last_real_values(slave, references)
    return list(values)


if __name__ == "__main__":
    sys.stdout.write("\n" + json.dumps(main(json.load(sys.stdin))) + "\n")
