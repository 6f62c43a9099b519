"""Points on the workers of an existing Dask cluster."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import xarray as xr
from distributed import Client, Worker, WorkerPlugin, get_worker

from gearlube.studies.sweep.executors import Crew, PointFunction
from gearlube.studies.sweep.settings import SweepSettings
from gearlube.studies.sweep.unpack import unpack
from gearlube_core.errors import GearLubeError, ParameterError

RETRIES = 3  # times a point is tried again after its worker has died
_CONNECT_TIMEOUT = 20.0  # s


class FmuOnWorker(WorkerPlugin):
    """Carries an FMU as bytes to every worker, also to those that join later.

    It is written and unzipped once into the worker's own folder, which the worker removes.
    """

    def __init__(self, content: bytes) -> None:
        self.content = content
        self.name = f"gearlube-fmu-{hashlib.sha256(content).hexdigest()[:16]}"
        self.directory = Path()

    def setup(self, worker: Worker) -> None:
        """Write and unzip the FMU on `worker`."""
        home = Path(worker.local_directory)
        home.mkdir(parents=True, exist_ok=True)
        archive = home / f"{self.name}.fmu"
        archive.write_bytes(self.content)
        self.directory = unpack(archive, home / self.name)


def run_on_worker(
    plugin: str, point: PointFunction, speed_kmh: float, preload: float, settings: SweepSettings
) -> xr.Dataset:
    """Run `point` with the FMU that the plugin of that name brought to this worker."""
    carrier: Any = get_worker().plugins[plugin]
    return point(carrier.directory, speed_kmh, preload, settings)


@contextmanager
def cluster_crew(fmu: Path, scheduler: str, point: PointFunction) -> Iterator[Crew]:
    """Run points on the cluster at `scheduler`; its workers must have gearlube installed."""
    if not fmu.is_file():
        raise ParameterError(f"A cluster needs the FMU as one file, {fmu} is none.")
    try:
        client = Client(scheduler, timeout=_CONNECT_TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        raise GearLubeError(
            f"No Dask scheduler answered at {scheduler} within {_CONNECT_TIMEOUT:g} s: {error}. "
            "Start one with `dask scheduler` and workers with `dask worker ADDRESS --nthreads 1`."
        ) from error
    plugin = FmuOnWorker(fmu.read_bytes())
    try:
        client.register_plugin(plugin, name=plugin.name)
        executor = client.get_executor(retries=RETRIES, pure=False)
        try:
            yield Crew(executor, run_on_worker, (plugin.name, point))
        finally:
            executor.shutdown(wait=False)
            client.unregister_worker_plugin(plugin.name)
    finally:
        client.close()
