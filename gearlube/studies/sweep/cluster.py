"""Points on the workers of an existing Dask cluster."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import xarray as xr
from distributed import Worker, get_worker

from gearlube.studies.sweep.fmu_axle import unpack
from gearlube.studies.sweep.point import Place, PointFunction
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.errors import ParameterError
from gearlube_core.storage.dask_pool import NamedPlugin


class FmuOnWorker(NamedPlugin):
    """Carries an FMU as bytes to every worker, also to those that join later.

    It is written and unzipped once into the worker's own folder, which the worker removes.
    """

    def __init__(self, content: bytes) -> None:
        self.content = content
        self.name = f"gearlube-fmu-{hashlib.sha256(content).hexdigest()[:16]}"
        self.directory = Path()

    @classmethod
    def of_file(cls, fmu: Path) -> FmuOnWorker:
        """Return the plugin for an FMU; raise ParameterError unless it is a single file."""
        if not fmu.is_file():
            raise ParameterError(
                f"A cluster needs the FMU as one file, but {fmu} is no file. Give the .fmu file."
            )
        return cls(fmu.read_bytes())

    def setup(self, worker: Worker) -> None:
        """Write and unzip the FMU on `worker`."""
        home = Path(worker.local_directory)
        home.mkdir(parents=True, exist_ok=True)
        archive = home / f"{self.name}.fmu"
        archive.write_bytes(self.content)
        self.directory = unpack(archive, home / self.name)


def run_on_worker(
    plugin: str, point: PointFunction, settings: SweepSettings, place: Place
) -> xr.Dataset:
    """Run `point` with the FMU that the plugin of that name brought to this worker."""
    carrier: Any = get_worker().plugins[plugin]
    return point(carrier.directory, *place, settings)
