# SPDX-License-Identifier: MIT
"""Tasks on a Dask cluster: this machine's cores, or one that is there already."""

from __future__ import annotations

import itertools
import logging
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager, suppress
from typing import Any, Callable, Iterator, Optional, Sequence

import dask
from distributed import Client, LocalCluster, as_completed
from distributed.client import FutureCancelledError
from distributed.scheduler import KilledWorker
from distributed.security import Security

import sdre
from sdre_campaign.batch import Done
from sdre_campaign.spec import Spec

# Tasks that wait at each thread beside the one that runs: a worker is never idle, and no more
# results than these are in memory.
_AHEAD = 2


class ClusterError(RuntimeError):
    """The cluster is gone, or loses the same work again and again."""


# A machine that has other things to do leaves a process of low priority without a turn for minutes:
# that is no death. One that dies is noticed by its connection.
_PATIENCE = {
    "distributed.scheduler.worker-ttl": None,
    "distributed.comm.timeouts.connect": "2m",
    "distributed.comm.timeouts.tcp": "2m",
    "distributed.admin.tick.limit": "1h",
}


@contextmanager
def connected(scheduler: Optional[str], workers: int) -> Iterator[Client]:
    """A client of a scheduler, or of a local cluster of processes with one thread each. A scheduler
    runs what it is given. The local one accepts TLS with a certificate of this run alone."""
    if scheduler is not None:
        with _client(scheduler) as client:
            yield client
        return
    with ExitStack() as closed, dask.config.set(_PATIENCE):
        cluster = LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            dashboard_address="127.0.0.1:0",
            memory_limit=0,
            security=Security.temporary(),
            silence_logs=logging.CRITICAL,
        )
        client = Client(cluster)
        closed.callback(_close, cluster)
        closed.callback(_close, client)
        yield client


def _client(scheduler: str) -> Client:
    try:
        return Client(scheduler, timeout=20)
    except (OSError, ValueError, TimeoutError) as error:
        raise ClusterError(f"{scheduler}: no scheduler answers") from error


def _close(what: Any) -> None:
    """Closes it. Written parts are safe, so a process that does not end in time is not a
    failure."""
    with suppress(Exception):
        what.close(timeout=60)


Work = Callable[[Spec, Any], Done]  # a task of a campaign, at a worker


def run_tasks(
    client: Client, work: Work, spec: Spec, tasks: Sequence[Any], keep: Callable[[Done], None]
) -> None:
    """Runs the tasks in order and hands each result on as it comes; a worker that dies costs its
    own task's time."""
    todo = iter(tasks)
    running: Any = as_completed()

    def keeping(result: Done) -> None:
        try:
            keep(result)
        except OSError as error:  # not the cluster's
            raise sdre.InputError(
                f"a result cannot be written: {error}; --resume goes on"
            ) from error

    def submit(count: int) -> None:
        for task in itertools.islice(todo, count):
            running.add(client.submit(work, spec, task, pure=False))

    threads = max(1, sum(client.nthreads().values()))
    submit(threads * (1 + _AHEAD))
    try:
        for future in running:
            keeping(future.result())
            now = max(1, sum(client.nthreads().values()))  # workers come and go
            submit(1 + max(0, now - threads) * (1 + _AHEAD))
            threads = max(threads, now)
    except KilledWorker as error:
        raise ClusterError(
            "workers die with the same task again and again: is there memory enough?"
        ) from error
    except (OSError, TimeoutError, CancelledError, FutureCancelledError) as error:
        raise ClusterError(f"the cluster is gone: {error}") from error
