"""Workers of an existing Dask cluster."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass

from distributed import Client, WorkerPlugin

from gearlube_core.errors import GearLubeError

RETRIES = 3  # times a task is tried again after its worker has died
_CONNECT_TIMEOUT = 20.0  # s


class NamedPlugin(WorkerPlugin):
    """A plugin that brings something to every worker, also to those that join later."""

    name: str


@dataclass(frozen=True, slots=True)
class DaskPool:
    """Workers of the cluster at `scheduler`; they must have gearlube installed."""

    scheduler: str
    plugin: NamedPlugin

    @contextmanager
    def open(self, tasks: int) -> Iterator[Executor]:
        """Bring the plugin to the workers and give an executor.

        Raises
        ------
        GearLubeError
            No scheduler answers at the address.
        """
        try:
            client = Client(self.scheduler, timeout=_CONNECT_TIMEOUT, set_as_default=False)
        except (OSError, ValueError) as error:
            raise GearLubeError(
                f"No Dask scheduler answered at {self.scheduler} within {_CONNECT_TIMEOUT:g} s: "
                f"{error}. Start one with `dask scheduler` and workers with "
                "`dask worker ADDRESS --nthreads 1`."
            ) from error
        try:
            client.register_plugin(self.plugin, name=self.plugin.name)
            executor = client.get_executor(retries=RETRIES, pure=False)
            try:
                yield executor
            finally:
                executor.shutdown(wait=False)
                client.unregister_worker_plugin(self.plugin.name)
        finally:
            client.close()
