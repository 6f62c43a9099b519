"""Workers of an existing Dask cluster, whose packages are imported from here alone."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import metadata
from threading import Event, Thread

from gearlube_core import __version__
from gearlube_core.errors import GearLubeError, ParameterError

try:
    from distributed import Client, Worker, WorkerPlugin, get_worker
except ImportError:
    raise ParameterError(
        "Points on a cluster (--scheduler) need the packages distributed and dask, which are not "
        "installed. Install them: pip install 'gearlube[cluster]'."
    ) from None

__all__ = ["DaskPool", "NamedPlugin", "Worker", "get_worker"]

logger = logging.getLogger(__name__)

RETRIES = 3  # times a task is tried again after its worker has died
_CONNECT_TIMEOUT = 20.0  # s
_PATIENCE = 5.0  # s without a worker, after which it is said
_POLL = 0.5  # s


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
        """Wait for a worker, bring the plugin to all workers and give an executor.

        A warning is logged whenever there has been no worker for some seconds.

        Raises
        ------
        GearLubeError
            No scheduler answers at the address or it ends, or a worker has not this version of the
            package.
        """
        try:
            client = Client(self.scheduler, timeout=_CONNECT_TIMEOUT, set_as_default=False)
        except (OSError, ValueError) as error:
            raise GearLubeError(
                f"No Dask scheduler answered at {self.scheduler} within {_CONNECT_TIMEOUT:g} s: "
                f"{error}. Start one with `dask scheduler` and workers with "
                "`dask worker ADDRESS --nthreads 1`."
            ) from error
        ended = Event()
        watch = Thread(target=self._watch, args=(client, ended), daemon=True)
        watch.start()
        try:
            while not _workers(client):
                if client.status == "closed":
                    raise CancelledError
                time.sleep(_POLL)
            self._check_packages(client)
            client.register_plugin(self.plugin, name=self.plugin.name)
            executor = client.get_executor(retries=RETRIES, pure=False)
            try:
                yield executor
            finally:
                executor.shutdown(wait=False)
                if client.status == "running":
                    client.unregister_worker_plugin(self.plugin.name)
        except CancelledError:
            logging.getLogger("distributed.client").setLevel(
                logging.CRITICAL
            )  # it ends in a traceback
            raise GearLubeError(
                f"The Dask scheduler at {self.scheduler} has ended, or cannot be reached any more. "
                "What is finished is kept: start it and its workers again, then run the same "
                "command again."
            ) from None
        finally:
            ended.set()
            watch.join()
            client.close()

    def _watch(self, client: Client, ended: Event) -> None:
        """Say when the cluster has had no worker for a while, until `ended` is set."""
        last, said = time.monotonic(), False
        while not ended.wait(_POLL):
            if _workers(client):
                last, said = time.monotonic(), False
            elif not said and time.monotonic() - last > _PATIENCE:
                said = True
                logger.warning(
                    "The Dask scheduler at %s has no workers. Start one with "
                    "`dask worker %s --nthreads 1` where this gearlube is installed. Waiting for "
                    "it; Ctrl-C stops.",
                    self.scheduler,
                    self.scheduler,
                )

    def _check_packages(self, client: Client) -> None:
        """Refuse workers without the package, or with another version of it."""
        found = client.run(metadata.version, "gearlube", on_error="return")
        for worker, version in found.items():
            if version != __version__:
                got = f"{version}" if isinstance(version, str) else "none"
                raise GearLubeError(
                    f"Every Dask worker must have gearlube {__version__}, got {got} at {worker}. "
                    "Install it into the environment of the worker, with `pip install gearlube`, "
                    "and start the worker again."
                )


def _workers(client: Client) -> bool:
    return bool(client.scheduler_info().get("workers"))  # {} without a scheduler
