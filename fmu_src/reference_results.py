"""Reference results inside an FMU: a short run of the Python model, for hosts to compare with.

Files and names are those of the FMI Cross-Check: `NAME_ref.opt` says how the run is made,
`NAME_in.csv` holds the inputs, `NAME_ref.csv` the results.
"""

from __future__ import annotations

from fmu_src.definition import Definition

FOLDER = "extra/gearlube"
STEP = 1e-3  # s
STEPS = 50
CHANGED_AT = 25  # steps, when the torques change
TORQUES = {"pinion.torque": 1.2, "wheel.torque": 1.2}  # over their start values, from then on
EXACT = 17  # digits of the inputs: less would turn a pair that is nearly balanced
TOLERANCE = 1e-6  # of each output's largest value, between this run and one in another host


def reference_results(definition: Definition) -> dict[str, bytes]:
    """Return the files of a run of the Python model with all parameters at their start values.

    Every output that is a Real and no element of a series is there, with seven digits; the inputs
    are exact.

    Notes
    -----
    A row of the inputs is what is set at that communication point, for the step that begins there.
    """
    inputs = [v for v in definition.variables if v.causality == "input"]
    start = [float(v.start or 0.0) for v in inputs]
    later = [value * TORQUES.get(v.name, 1.0) for v, value in zip(inputs, start, strict=True)]
    parameters = {
        v.name: v.decoded(v.start or 0.0) for v in definition.variables if v.is_model_parameter
    }
    outputs = {
        v.name: definition.output_names.index(v.name)
        for v in definition.variables
        if v.causality == "output" and v.type == "Real" and "[" not in v.name
    }
    model = definition.start_model(parameters, start)
    given, rows = [], []
    for k in range(STEPS + 1):
        now = start if k < CHANGED_AT else later
        given.append(_line(k * STEP, now, EXACT))
        rows.append(_line(k * STEP, [model.outputs[i] for i in outputs.values()]))
        if k < STEPS:
            model.step(STEP, *now)
    options = {
        "StartTime": 0.0,
        "StopTime": STEPS * STEP,
        "StepSize": STEP,
        "RelTol": TOLERANCE,
        "OutputInterval": STEP,
    }
    files = {
        "ref.opt": [f"{name}, {value:g}" for name, value in options.items()],
        "in.csv": [_heading([v.name for v in inputs]), *given],
        "ref.csv": [_heading(list(outputs)), *rows],
    }
    return {
        f"{FOLDER}/{definition.name}_{ending}": "".join(f"{line}\n" for line in lines).encode()
        for ending, lines in files.items()
    }


def _heading(names: list[str]) -> str:
    return ",".join(f'"{name}"' for name in ("time", *names))


def _line(time: float, values: list[float], digits: int = 7) -> str:
    return ",".join(f"{value:.{digits}g}" for value in (time, *values))
