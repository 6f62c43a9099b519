"""Self-description of a native FMU: experiment, parameter sets, limits, report, meta-data.

The files obey FMI-LS-REF 1.0.0-beta.1 (manifest), SSP 1.0 and 2.0 (.ssv) and SSP Traceability
1.0.0-rc.2 (.srmd). All follow from the table of variables and from one run of the Python model.
"""

from __future__ import annotations

import csv
import hashlib
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from fmu_src.definition import Definition
from fmu_src.identity import source_digest
from fmu_src.model_description import number_text, xml_bytes
from fmu_src.native.model import NativeModel
from fmu_src.native.model_description_3 import manifest_root
from gearlube_core.arrays import Array
from gearlube_core.dynamics.train.stepped_model import MAX_STEP

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST, META_DATA = f"{FOLDER}/fmi-ls-manifest.xml", f"{FOLDER}/gearlube.srmd"
STANDARD = "1.0.0-beta.1"
TOLERANCE = 1e-6  # of each output's largest value, between this run and one in another host
BALANCE = 1e-5  # of the work put in, that may be missing between work, heat and stored energy

_STEP, _STEPS = 1e-3, 50  # s
_CHANGED_AT = 25  # steps, when some inputs change
_CHANGES = {".torque": 1.2, ".speed_request": 1.02}  # of inputs, over their start values then
_EXACT = 17  # digits of the inputs: less would turn a pair that is nearly balanced
_SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
_SRMD = "http://ssp-standard.org/SSPTraceability1/SimulationResourceMetaData"
_STC = "http://ssp-standard.org/SSPTraceability1/SSPTraceabilityCommon"
_XLINK = "http://www.w3.org/1999/xlink"
_GUIDE = Path(__file__).parents[1] / "pages" / "fmi-ls-ref.txt"
_CARRIED_BY = {"roughness": "roughness_rms", "preload": "bearing_preload"}  # argument of a datum
_STORED = "energy.stored"
_TYPES = {
    "csv": "text/csv",
    "opt": "text/csv",
    "html": "text/html",
    "srmd": "application/x-srmd-meta-data",
    "ssv": "application/x-ssp-parameter-set",
    "txt": "text/plain",
}
# end or beginning of a path, role, description
_ROLES = (
    ("_ref.opt", "experiment/smoke-test", "Times, steps and tolerance of a run from the start "
     "values, as in the FMI Cross-Check; each output must come out again within RelTol of its "
     "largest value"),
    ("_in.csv", "testcase", "Inputs of the experiment: a row holds for the step that begins there"),
    ("_ref.csv", "result", "Outputs of the experiment, from the Python model that the library is "
     "compiled from"),
    ("default.ssv", "parameter", "All parameters at their start values"),
    (f"{FOLDER}/oil_", "parameter", "The oil with the name of the file"),
    ("requirements.csv", "requirement", "Limits of use, and what the experiment has to meet"),
    ("report.csv", "report", "What the experiment met when this FMU was built"),
    ("uncertainty.csv", "experiment/uncertainty-analysis", "Uncertain data of the losses: a true "
     "value lies within value/factor to value*factor with 95 %, its logarithm is normal. Losses "
     "that are named are scaled by it. HypoidAxle has all in loss.low and loss.high"),
    (".srmd", "meta-data", "Origin, validity and checksums"),
    ("documentation/index.html", "document", "Equations in words, ranges and all variables"),
    ("fmi-ls-ref.txt", "document", "How to use the files of this manifest"),
    ("documentation/licenses/", "document", "Licence of a part"),
    ("resources/", "model", "File that the model is made of"),
)  # fmt: skip


class Run(NamedTuple):
    """The reference experiment, a row for each communication point."""

    time: Array
    inputs: Array  # set there, for the step that begins there
    outputs: Array  # there


def reference_run(model: NativeModel) -> Run:
    """Return a run of the model in Python with all parameters at their start values."""
    definition = model.definition
    inputs = [v for v in definition.variables if v.causality == "input"]
    start = [float(v.start or 0.0) for v in inputs]
    factors = [_CHANGES.get(f".{v.name.rpartition('.')[2]}", 1.0) for v in inputs]
    later = [value * factor for value, factor in zip(start, factors, strict=True)]
    parameters = {
        v.name: v.decoded(v.start or 0.0) for v in definition.variables if v.is_model_parameter
    }
    running = (model.in_python or definition.start_model)(parameters, start)
    given, found = [], []
    for k in range(_STEPS + 1):
        now = start if k < _CHANGED_AT else later
        given.append(now)
        found.append(np.array(running.outputs))  # a train computes all of them each time
        if k < _STEPS:
            running.step(_STEP, *now)
    return Run(np.arange(_STEPS + 1) * np.float64(_STEP), np.array(given), np.array(found))


def described(model: NativeModel, archive: Mapping[str, bytes], run: Run) -> dict[str, bytes]:
    """Return the files that describe an FMU, by name in its archive.

    Parameters
    ----------
    model : NativeModel
    archive : mapping of str to bytes
        All other files of the FMU.
    run : Run
        From `reference_run`.
    """
    requirements = _requirements(model)
    files = _parameter_sets(model.definition) | _experiment(model.definition, run)
    head: tuple[str, ...] = ("id", "variable", "low", "high", "unit", "requirement")
    files["requirements.csv"] = _csv(head, requirements)
    head = ("id", "lowest", "highest", "met")
    files["report.csv"] = _csv(head, _report(model.definition, requirements, run))
    if model.uncertain:
        files["uncertainty.csv"] = _uncertainty(model)
    content = {f"{FOLDER}/{name}": data for name, data in files.items()}
    content["documentation/fmi-ls-ref.txt"] = _GUIDE.read_bytes()
    content[MANIFEST] = _manifest([*content, META_DATA, *archive])
    content[META_DATA] = _meta_data(model, {**archive, **content})
    return content


def _csv(head: Sequence[str], rows: Iterable[Sequence[str]]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([head, *rows])
    return text.getvalue().encode()


def _experiment(definition: Definition, run: Run) -> dict[str, bytes]:
    """Return the files of the run as the FMI Cross-Check names them.

    Every output that is a Real and no element of a series is there, with seven digits; the inputs
    are exact.
    """
    outputs = {
        v.name: definition.output_names.index(v.name)
        for v in definition.variables
        if v.causality == "output" and v.type == "Real" and "[" not in v.name
    }
    names = [v.name for v in definition.variables if v.causality == "input"]
    options = {
        "StartTime": 0.0,
        "StopTime": _STEPS * _STEP,
        "StepSize": _STEP,
        "RelTol": TOLERANCE,
        "OutputInterval": _STEP,
    }
    text = "".join(f"{name}, {value:g}\n" for name, value in options.items())
    of_run = run.outputs[:, list(outputs.values())]
    return {
        f"{definition.name}_ref.opt": text.encode(),
        f"{definition.name}_in.csv": _table(names, run.time, run.inputs, _EXACT),
        f"{definition.name}_ref.csv": _table([*outputs], run.time, of_run, 7),
    }


def _table(names: Sequence[str], time: Array, values: Array, digits: int) -> bytes:
    lines = [",".join(f'"{name}"' for name in ("time", *names))]
    for t, row in zip(time.tolist(), values.tolist(), strict=True):
        lines.append(",".join([f"{t:.7g}", *(f"{value:.{digits}g}" for value in row)]))
    return "".join(f"{line}\n" for line in lines).encode()


def _parameter_sets(definition: Definition) -> dict[str, bytes]:
    """Return the start values, and one set for each oil; options by number, as all hosts can."""
    options = {v.name: v for v in definition.variables if v.type == "Enumeration"}
    values = []
    for v in definition.variables:
        if v.causality == "parameter" and v.name not in options and "[" not in v.name:
            start = options.get(v.option_of, v).start or 0.0
            flag = v.type == "Boolean"
            values.append(
                (v.name, v.type, str(bool(start)).lower() if flag else number_text(start))
            )
    sets = {"default.ssv": _ssv("default", values)} if values else {}
    if "oil.name" in options:
        for number, oil in enumerate(options["oil.name"].literals, start=1):
            sets[f"oil_{oil}.ssv"] = _ssv(oil, [("oil.name.number", "Integer", str(number))])
    return sets


def _ssv(name: str, values: Iterable[tuple[str, str, str]]) -> bytes:
    """Return a parameter set, marked 1.0: hosts of SSP 1.0 and of SSP 2.0 read it."""
    ElementTree.register_namespace("ssv", _SSV)
    root = ElementTree.Element(f"{{{_SSV}}}ParameterSet", version="1.0", name=name)
    parent = ElementTree.SubElement(root, f"{{{_SSV}}}Parameters")
    for parameter, kind, value in values:
        one = ElementTree.SubElement(parent, f"{{{_SSV}}}Parameter", name=parameter)
        ElementTree.SubElement(one, f"{{{_SSV}}}{kind}", value=value)
    return xml_bytes(root)


def _uncertainty(model: NativeModel) -> bytes:
    """Return the uncertain data of the losses, with the parameter of the FMU that holds each."""
    variables = model.definition.variables
    of_argument = {v.argument: v.name for v in variables if v.argument and v.type == "Real"}
    head = ("datum", "parameter", "factor", "scaled_losses", "meaning", "reason")
    rows = [
        (one.name, of_argument.get(_CARRIED_BY.get(one.name, one.name), ""), f"{one.factor:g}",
         " ".join(one.sources), one.words, one.why)
        for one in model.uncertain
    ]  # fmt: skip
    return _csv(head, rows)


def _requirements(model: NativeModel) -> list[tuple[str, ...]]:
    """Return rows of id, variable, limits, unit and words."""
    rows: list[tuple[str, ...]]
    rows = [("step", "", "0", f"{MAX_STEP:g}", "s", "Length of a communication step, above 0")]
    for v in model.definition.variables:
        if v.causality == "input":
            words = "Values beyond are refused"
            rows.append((f"input.{v.name}", v.name, *_limits(*v.range), v.unit, words))
    for one in model.ranges:
        words = f"{one.what[0].upper()}{one.what[1:]}. Beyond: {one.beyond}"
        limits = _limits(one.low, one.high)
        rows.append((f"validity.{one.output}", one.output, *limits, one.unit, words))
    words = "Difference from a result here in the experiment, over its largest value"
    rows.append(("reference", "", "0", f"{TOLERANCE:g}", "1", words))
    if _STORED in model.definition.output_names:
        words = "Work put in less heat and stored energy in the whole experiment, over the work"
        rows.append(("energy", "", "0", f"{BALANCE:g}", "1", words))
    return rows


def _limits(*limits: float) -> Iterator[str]:
    """Give limits as text; empty where there is none."""
    return (f"{value:.9g}" if np.isfinite(value) else "" for value in limits)


def _report(
    definition: Definition, requirements: Iterable[Sequence[str]], run: Run
) -> Iterator[tuple[str, ...]]:
    """Give rows of id, the extremes in the run, and whether they lie within the limits.

    A quantity that is 0 while it is not in use counts only where it is in use. The run of a host
    alone can say whether the reference comes out again.
    """
    names = [v.name for v in definition.variables if v.causality == "input"]
    for key, name, low, high, *_ in requirements:
        if key in ("step", "energy"):
            values = np.array([_STEP] if key == "step" else _missing_energy(definition, run))
        elif key.startswith("input."):
            values = run.inputs[:, names.index(name)]
        elif name:
            values = run.outputs[:, definition.output_names.index(name)]
            values = values[values != 0.0]
        else:
            continue
        if not values.size:
            yield key, "", "", "not in use"
            continue
        within = float(low or "-inf") <= values.min() and values.max() <= float(high or "inf")
        digits = 1 if key == "energy" else 6
        ends = (f"{value:.{digits}g}" for value in (values.min(), values.max()))
        yield key, *ends, "yes" if within else "no"


def _missing_energy(definition: Definition, run: Run) -> list[float]:
    """Return the part of the work that is neither heat nor stored; nothing without any work.

    All energies but the work of the pinion, and of the ports of a train, leave.
    """
    missing, largest = 0.0, 0.0
    for name, change in zip(definition.output_names, run.outputs[-1] - run.outputs[0], strict=True):
        if name.startswith("energy."):
            enters = name == "energy.pinion_work" or name.endswith(".work")
            missing += change if enters else -change
            largest = max(largest, abs(change)) if enters else largest
    return [float(abs(missing) / largest)] if largest else []


def _manifest(paths: Iterable[str]) -> bytes:
    """Return the manifest, with the files that have a role."""
    words = "Layered Standard providing information on related files included in an FMU."
    root = manifest_root("fmiReferences", "org.fmi-standard.fmi-ls-ref", STANDARD, words)
    for path in sorted(paths):
        for end, role, words in _ROLES:
            if path.endswith(end) or path.startswith(end):
                kind = _TYPES.get(path.rpartition(".")[2], "application/octet-stream")
                related = {"type": kind, "source": _from_folder(path), "role": role}
                ElementTree.SubElement(root, "Related", {**related, "description": words})
                break
    return xml_bytes(root)


def _from_folder(path: str) -> str:
    return path.removeprefix(f"{FOLDER}/") if path.startswith(FOLDER) else f"../../{path}"


def _meta_data(model: NativeModel, archive: Mapping[str, bytes]) -> bytes:
    """Return the SRMD file of the FMU around it: entries in words, and a checksum of each file."""
    definition, release = model.definition, version("gearlube")
    for prefix, space in {"srmd": _SRMD, "stc": _STC, "xlink": _XLINK}.items():
        ElementTree.register_namespace(prefix, space)
    root = ElementTree.Element(
        f"{{{_SRMD}}}SimulationResourceMetaData", version="1.0.0", name=definition.name,
        description=definition.description, author="The gearlube developers", fileversion=release,
        license="MIT", generationTool=f"gearlube {release}",
    )  # fmt: skip
    words = {
        "purpose": definition.description,
        "validity": "requirements.csv; outside, the outputs range.* and the log say so",
        "verification": "gearlube tests the model against closed forms and published results, see "
        "its pages Validation, Measured and Trust",
    }
    if model.entry is not None:
        words["code"] = f"SHA-256 {source_digest(definition).hex()} of kernels and shipped data"
    rows = [("gearlube.model", keyword, "", text) for keyword, text in words.items()]
    for path, content in sorted(archive.items()):
        checksum = hashlib.sha3_256(content).hexdigest()
        rows.append(("gearlube.checksum", "SHA3-256", _from_folder(path), checksum))
    parents: dict[str, ElementTree.Element] = {}
    for kind, keyword, link, text in rows:
        if kind not in parents:
            parents[kind] = ElementTree.SubElement(root, f"{{{_STC}}}Classification", type=kind)
        entry = ElementTree.SubElement(parents[kind], f"{{{_STC}}}ClassificationEntry")
        entry.attrib.update({"keyword": keyword} | ({f"{{{_XLINK}}}href": link} if link else {}))
        entry.text = text
    return xml_bytes(root)
