"""Run a grid of speeds and preloads: compute missing points, store every finished one."""

from __future__ import annotations

import hashlib
import logging
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product
from multiprocessing import get_context
from pathlib import Path

import xarray as xr

import drivetrain
from drivetrain.axle_file.axle_file import CarAxle
from gearlube.report.films import film_model_attributes
from gearlube.report.page import command_line
from gearlube.report.result import Result
from gearlube.studies.sweep.axle_in_fmu import (
    assumed_inputs,
    car_axle_at,
    car_axle_of,
    check_operation,
    chosen_axle,
    settings_of,
)
from gearlube.studies.sweep.datasets import described, merge, save, with_churning_regime
from gearlube.studies.sweep.fmu_axle import FmuAxle, axle_description
from gearlube.studies.sweep.natural_frequencies import crank_frequencies, natural_frequencies
from gearlube.studies.sweep.peaks import held_amplitudes, largest_peaks, speeds_at_peaks
from gearlube.studies.sweep.point import FINISHED, Place, PointFunction, failed_point, run_point
from gearlube.studies.sweep.recording import CHANNELS, operation
from gearlube.studies.sweep.settings import PRELOAD_RANGE, SPEED_RANGE, SweepSettings
from gearlube.studies.sweep.unpack import fmu_guid, fmu_kind, unpacked
from gearlube_core import __version__
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.loss_band import loss_sensitivities
from gearlube_core.errors import InterruptedRunError, ParameterError
from gearlube_core.input_file.input_file import notes_as_text
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.folders import locked_folder
from gearlube_core.storage.process_pool import KeptPool, Pool, ProcessPool, stop_on_interrupt
from gearlube_core.storage.resumable import DATASETS, ResultStore, resumable_results

_SPEED_KMH = 50.0

logger = logging.getLogger(__name__)

MOST_JOBS = 1024
_MOST_POINTS = 100_000  # some seconds each
_OF_GRID = 0.7  # of the progress, before the points around peaks
_MOST_ROUNDS = 6
_PRELOAD_CURE = "A preload must press; the paper uses 2500 and 6000 N."


@cache
def code_version() -> str:
    """Return version and digest of the drivers and of the sweep, "0.1.0+1a2b3c4d5e6f".

    The axle itself is identified by the GUID of its FMU.
    """
    root = Path(str(drivetrain.__file__)).parent
    digest = hashlib.sha256()
    for path in sorted([*root.rglob("*.py"), *Path(__file__).parent.glob("*.py")]):
        digest.update(path.name.encode())
        digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return f"{__version__}+{digest.hexdigest()[:12]}"


def _compile_axle(fmu: Path, settings: SweepSettings) -> None:
    """Initialise the FMU and take two steps.

    The machine code stays in numba's cache on disk, from where the workers load it.
    """
    with unpacked(fmu) as directory, FmuAxle(directory, CHANNELS) as axle:
        where = operation(settings, _SPEED_KMH, car_axle_of(directory).driveline)
        axle.set_parameters(settings.fmu_parameters)
        axle.set_parameters({"pinion.speed_start": where.pinion_speed})
        torques = where.driver.initial_torques()
        axle.initialise(*torques, settings.lowest_oil_temperature[1])
        for _ in range(2):
            axle.step(settings.communication_step, *torques)
            axle.read()


@dataclass(frozen=True, slots=True, kw_only=True)
class SweepModel:
    """The functions that compute a sweep.

    Parameters
    ----------
    point : callable
        Computes one point; the workers must be able to import it.
    compile_first : callable, optional
        Compiles the axle before local processes start, so that they do not all do it.
    natural_frequencies : callable, optional
        Gives the natural modes that the figures mark, at the middle speed.
    """

    point: PointFunction = run_point
    compile_first: Callable[[Path, SweepSettings], None] | None = _compile_axle
    natural_frequencies: (
        Callable[[Sequence[float], float, SweepSettings, CarAxle], xr.Dataset] | None
    ) = natural_frequencies


AXLE_MODEL = SweepModel()


def run_sweep(
    settings: SweepSettings | None = None,
    *,
    speeds_kmh: Sequence[float],
    preloads: Sequence[float],
    fmu: Path | str | None = None,
    mesh_table: Path | None = None,
    axle: Path | str | None = None,
    out: Path | str | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    peak_step_kmh: float = 0.0,
    progress: Progress = no_progress,
    model: SweepModel = AXLE_MODEL,
) -> Result:
    """Run the axle FMU over a grid of vehicle speeds and bearing preloads; return all results.

    Parameters
    ----------
    settings : SweepSettings
        Settings of all points; default: those of the axle, see `settings_of`.
    speeds_kmh, preloads : sequence of float
        Grid [km/h], [N].
    fmu : path
        The axle FMU, as a file or as an unzipped folder. None: that of this installation, built
        if necessary.
    mesh_table : path
        Mesh table (.nc) of another gear pair, built into the FMU of this installation.
    axle : path
        Axle file, or the name of a shipped one, also built into the FMU.
    out : path
        Folder of results: points/ holds every finished point; sweep.nc and summary.csv hold all.
        Points that are already there are not computed again; failed ones are. None: no files.
    jobs : int
        Number of local processes [-]; None: all processors. Not used on a cluster.
    scheduler : str
        Address of a running Dask scheduler, "tcp://host:port".
    peak_step_kmh : float
        Speeds are added around the largest mesh orders of transmission error and bearing force
        until they lie this far apart there [km/h]; 0: none.
    progress : callable
        Called after every point with the share done [-] and a sentence on the point.
    model : SweepModel
        Replaces the simulation, e.g. in tests.

    Returns
    -------
    xarray.Dataset
        Over (preload, speed); also written to out/sweep.nc.

    Raises
    ------
    ParameterError
        The grid is empty, a value is out of range, the road asks for more torque than the mesh
        table allows, or more than one of `fmu`, `mesh_table` and `axle` is given.
    InterruptedRunError
        After Ctrl-C, when the finished points have been saved.

    Examples
    --------
    Two points take some seconds:

    >>> settings = SweepSettings()
    >>> results = run_sweep(  # doctest: +SKIP
    ...     settings, speeds_kmh=[60.0], preloads=[2500.0, 6000.0], out="gearlube_sweep"
    ... )
    """
    from fmu_src.build import cached_axle_path, cached_hypoid_axle

    speeds = sorted({check_within("speed", v, *SPEED_RANGE, "km/h") for v in speeds_kmh})
    loads = sorted(
        {check_within("preload", p, *PRELOAD_RANGE, "N", _PRELOAD_CURE) for p in preloads}
    )
    if not speeds or not loads:
        raise ParameterError("A sweep needs at least one speed and one preload, got none.")
    wanted = len(speeds) * len(loads)
    check_within("speeds times preloads", wanted, 1, _MOST_POINTS, "", "Take fewer of them.")
    if jobs is not None:
        check_within("jobs", jobs, 1, MOST_JOBS, "", "Leave it out to use all processors.")
    if fmu is not None and model.compile_first is not None:
        with unpacked(Path(fmu)) as directory:
            axle_description(directory, CHANNELS)
    car_axle = chosen_axle(fmu, mesh_table, axle)
    settings = settings or settings_of(car_axle.axle)
    check_operation(car_axle, settings, speeds)
    folder = None if out is None else Path(out)
    with ExitStack() as stack:
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
            stack.enter_context(locked_folder(folder))
        to_build = fmu is None and not cached_axle_path(mesh_table, axle=axle).is_file()
        modes = _modes_aside(
            stack, model, loads, speeds[len(speeds) // 2], settings, car_axle, to_build=to_build
        )
        archive = (
            cached_hypoid_axle(mesh_table, axle=axle, report=partial(progress, 0.0))
            if fmu is None
            else Path(fmu)
        )
        progress(0.0, "starting the first points")
        directory = stack.enter_context(unpacked(archive))
        guid, kind = fmu_guid(directory), fmu_kind(directory)
        keys = _keys(product(speeds, loads), settings, guid)
        compute, workers = _workers(archive, directory, settings, model, jobs, scheduler)
        pool = KeptPool(workers, stack)
        began = time.monotonic()
        done = _OF_GRID if peak_step_kmh else 1.0
        points, computed = _points(keys, compute, pool, folder, part_of(progress, 0.0, done))
        for _ in range(_MOST_ROUNDS if peak_step_kmh else 0):
            added = speeds_at_peaks(merge(loads, speeds, points), peak_step_kmh)
            if not added:
                break
            speeds = sorted({*speeds, *added})
            now = _keys(product(added, loads), settings, guid)
            before, done = done, 0.5 * (1.0 + done)
            around, more = _points(now, compute, pool, folder, part_of(progress, before, done))
            points |= around
            computed += more
        wall_time = time.monotonic() - began
        found_modes = modes()
        held: dict[Place, xr.Dataset] = {}
        if peak_step_kmh and settings.driver == "vehicle":
            free = replace(settings, driver="hold")
            compute, _ = _workers(archive, directory, free, model, jobs, scheduler)
            tops = largest_peaks(merge(loads, speeds, points))
            places = {(top.speed_kmh, top.preload) for top in tops.values()}
            held, _ = _points(_keys(places, free, guid), compute, pool, folder, no_progress)
    of_axle = car_axle_at(car_axle, settings, loads[0])
    sweep = merge(loads, speeds, points).assign_attrs(
        {
            "title": "Speed sweep of a lubricated hypoid axle",
            "gearlube_version": code_version(),
            "fmu_guid": guid,
            "fmu_kind": kind,
            "axle": car_axle.name,
            "axle_source": car_axle.source,
            "inputs_given": notes_as_text([n for n in car_axle.inputs if n.origin == "given"]),
            "inputs_assumed": notes_as_text(assumed_inputs(car_axle, settings)),
            "mesh_table": car_axle.axle.mesh.name,
            "mesh_table_source": car_axle.axle.mesh.source,
            **film_model_attributes(of_axle.axle.film_models),
            "command_line": command_line(),
            "scheduler": scheduler or "local processes",
            "computed_points": computed,
            "wall_time": wall_time,
            **{f"setting_{name}": value for name, value in settings.as_dict().items()},
        }
    )
    if found_modes is not None:
        sweep = sweep.assign(found_modes.variables).assign_attrs(sweep.attrs)
    for name, amplitude in held_amplitudes(sweep, held).items():
        sweep[name] = amplitude
    if settings.driver == "vehicle":
        crank = crank_frequencies(car_axle.driveline, speeds)
        sweep["crank_frequency"] = ("speed", crank)
    described(with_churning_regime(sweep, of_axle.axle))
    sweep = Result.of(sweep, "sweep")
    if folder is not None:
        save(sweep, folder)
    return sweep


def _keys(places: Iterable[Place], settings: SweepSettings, guid: str) -> dict[Place, str]:
    return {
        (v, p): settings.key(speed_kmh=v, preload=p, fmu_guid=guid, version=code_version())
        for v, p in places
    }


def _modes_aside(
    stack: ExitStack,
    model: SweepModel,
    preloads: Sequence[float],
    speed_kmh: float,
    settings: SweepSettings,
    car_axle: CarAxle,
    *,
    to_build: bool,
) -> Callable[[], xr.Dataset | None]:
    """Begin the natural modes in a process of their own; return what waits for them.

    They compile kernels when the machine has none yet, beside the build of the FMU and the first
    points. Before them the process compiles what the build needs at its end.
    """
    if model.natural_frequencies is None:
        return lambda: None
    executor = stack.enter_context(
        ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=stop_on_interrupt)
    )
    if to_build:
        executor.submit(loss_sensitivities, car_axle.axle)
    found = executor.submit(model.natural_frequencies, preloads, speed_kmh, settings, car_axle)

    def result() -> xr.Dataset | None:
        try:
            return found.result()
        except BrokenExecutor as error:
            logger.warning("No natural modes, their process died: %s", error)
            return None

    return result


def _workers(
    fmu: Path,
    directory: Path,
    settings: SweepSettings,
    model: SweepModel,
    jobs: int | None,
    scheduler: str | None,
) -> tuple[Callable[[Place], xr.Dataset], Pool]:
    """Return the function that computes a point, and the workers that run it."""
    if scheduler is not None:
        from gearlube.studies.sweep.cluster import FmuOnWorker, run_on_worker
        from gearlube_core.storage.dask_pool import DaskPool

        plugin = FmuOnWorker.of_file(fmu)
        return partial(run_on_worker, plugin.name, model.point, settings), DaskPool(
            scheduler, plugin
        )
    first = model.compile_first
    before = None if first is None else partial(first, directory, settings)
    pool = ProcessPool(jobs=jobs, prepare=_mute_fmu, always_spawn=True, before=before)
    return partial(_run_here, model.point, directory, settings), pool


def _run_here(
    point: PointFunction, directory: Path, settings: SweepSettings, place: Place
) -> xr.Dataset:
    return point(directory, *place, settings)


def _mute_fmu() -> None:
    """Silence the FMU's log in a worker; failed points return its messages."""
    logging.getLogger("fmu_src").addHandler(logging.NullHandler())


def _points(
    keys: dict[Place, str],
    compute: Callable[[Place], xr.Dataset],
    pool: Pool,
    folder: Path | None,
    progress: Progress,
) -> tuple[dict[Place, xr.Dataset], int]:
    """Return all points, failed ones too, and how many of them were computed now."""
    store = ResultStore(None if folder is None else folder / "points", DATASETS)
    points: dict[Place, xr.Dataset] = {}
    computed = 0
    try:
        for place, dataset, stored in resumable_results(
            list(keys),
            keys.__getitem__,
            compute,
            store,
            pool,
            failed=_failure,
            worth_keeping=_is_finished,
        ):
            points[place] = dataset
            computed += not stored
            if not _is_finished(dataset):
                logger.warning("%g km/h, %g N failed: %s", *place, str(dataset["message"].values))
            point = f"{place[0]:g} km/h, {place[1]:g} N"
            progress(len(points) / len(keys), f"{point} (stored)" if stored else point)
    except KeyboardInterrupt:
        count = sum(map(_is_finished, points.values()))
        where = (
            "lost, as no folder is given"
            if store.folder is None
            else f"kept in {store.folder}. Run the same command again to compute the rest"
        )
        raise InterruptedRunError(
            f"Stopped: {count} of {len(keys)} points are finished and {where}."
        ) from None
    return points, computed


def _is_finished(dataset: xr.Dataset) -> bool:
    return int(dataset["status"]) == FINISHED


def _failure(place: Place, error: Exception) -> xr.Dataset:
    """Return the row of a point that ended with an error of any kind."""
    if isinstance(error, BrokenExecutor):
        return failed_point(*place, f"The process of this point died several times: {error}")
    return failed_point(*place, f"{type(error).__name__}: {error}")
