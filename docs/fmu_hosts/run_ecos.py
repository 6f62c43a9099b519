"""Run by `hosts`: one FMU, or an SSP archive, in Ecos; writes the Real values as JSON."""

import json
import sys

from ecospy import EcosSimulation, EcosSimulationStructure
from ecospy.EcosParameterSet import EcosParameterSet


def main(job: dict) -> list[float]:
    """Run the job and return the values asked for."""
    if job.get("ssp"):
        settings = {"ssp_path": job["ssp"]}
    else:
        structure = EcosSimulationStructure()
        structure.add_model("pair", job["fmu"])
        parameters = EcosParameterSet()
        for name, value in job["named_reals"].items():
            parameters.add_real(f"pair::{name}", value)
        for name, value in job["named_integers"].items():
            parameters.add_int(f"pair::{name}", value)
        structure.add_parameter_set("start", parameters)
        settings = {"structure": structure}
    with EcosSimulation(step_size=job["step_size"], **settings) as simulation:
        simulation.init(parameter_set=job.get("parameter_set", "start"))
        simulation.step(job["steps"])
        return [simulation.get_real(name) for name in job["names"]]


if __name__ == "__main__":
    sys.stdout.write("\n" + json.dumps(main(json.load(sys.stdin))) + "\n")
