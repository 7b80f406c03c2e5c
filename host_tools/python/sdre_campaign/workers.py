# SPDX-License-Identifier: MIT
"""A campaign's tasks on a cluster, with what is seen of it on the way: how far, how fast."""

from __future__ import annotations

import logging
import time
from contextlib import ExitStack
from typing import Any, Callable, Optional, Sequence

from distributed import Client
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from sdre_campaign.batch import Done
from sdre_campaign.cluster import Work, connected, run_tasks
from sdre_campaign.spec import Spec

_log = logging.getLogger(__name__)


class Workers:
    """Starts its cluster with the first task: a campaign that is finished needs none."""

    def __init__(
        self, spec: Spec, scheduler: Optional[str], workers: int, quiet: bool = False
    ) -> None:
        self._quiet = quiet
        self._spec, self._scheduler, self._count = spec, scheduler, workers
        self._open = ExitStack()
        self._client: Optional[Client] = None
        console = Console(stderr=True)
        self._progress = Progress(
            TextColumn("{task.completed:.0f} of {task.total:.0f} cases"),
            BarColumn(),
            TimeRemainingColumn(),
            TextColumn("{task.fields[rate]}"),
            console=console,
            disable=quiet or not console.is_terminal,
        )
        self._task = self._progress.add_task("cases", total=0, rate="")
        self._cases = 0
        self._wall_s = self._native_s = self._cpu_s = 0.0
        self._threads = 1

    def expect(self, total: int, there: int) -> None:
        """How many cases there will be, and how many of them there are."""
        self._progress.update(self._task, total=total, completed=there)
        _log.info("%d of %d cases are there", there, total)

    def run(self, work: Work, tasks: Sequence[Any], keep: Callable[[Done], None]) -> None:
        """All tasks; `keep` gets each as it comes."""
        if not tasks:
            return
        if self._client is None:
            self._client = self._open.enter_context(connected(self._scheduler, self._count))
            self._open.enter_context(self._progress)
            self._client.wait_for_workers(1, timeout=60)
            where = self._scheduler or "this machine"
            _log.info("workers: %d, on %s", len(self._client.nthreads()), where)
        begin = time.monotonic()
        before = self._wall_s

        def kept(one: Done) -> None:
            keep(one)
            self._native_s += one.wall_s
            self._cpu_s += one.cpu_s
            self._cases += one.cases
            self._wall_s = before + time.monotonic() - begin
            self._progress.update(
                self._task, advance=one.table.num_rows, rate=f"{self._cases / self._wall_s:.0f}/s"
            )

        run_tasks(self._client, work, self._spec, tasks, kept)
        self._threads = sum(self._client.nthreads().values())

    def tell(self) -> None:
        """A line about how fast it was, if something was run; none with -q."""
        if self._cases == 0 or self._quiet:
            return
        seconds = self._cases * float(self._spec.scenario["duration_s"])
        print(
            f"{self._cases} cases in {self._wall_s:.1f} s on {self._threads} workers: "
            f"{self._cases / self._wall_s:.0f} cases/s; per core "
            f"and second of its time {seconds / max(self._cpu_s, 1e-9):.0f} simulated s; workers "
            f"busy "
            f"{100.0 * self._native_s / (self._wall_s * self._threads):.1f} %"
        )

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: Any) -> None:
        self._open.close()
