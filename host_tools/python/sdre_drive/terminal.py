# SPDX-License-Identifier: MIT
"""Parts that several commands of `sdre-drive` need: the terminal, an end by Ctrl-C, --for."""

from __future__ import annotations

import logging
import signal
import threading
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator, Optional

import typer
from rich.console import Console
from rich.progress import Progress
from typing_extensions import Annotated

out = Console()
err = Console(stderr=True, soft_wrap=True)
notes = Console(stderr=True, soft_wrap=True)  # beside what was asked for; none with -q
live_line = Console()  # what a command shows while it runs; none with -q

Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="print only what was asked for")]
Verbose = Annotated[
    bool, typer.Option("-v", "--verbose", help="tell every drive that is met and every write")
]
Json = Annotated[
    Optional[Path],
    typer.Option("--json", help="write it as JSON instead; -: to the terminal", metavar="FILE"),
]

For = Annotated[
    Optional[float], typer.Option("--for", min=0.0, help="end after so many seconds", metavar="S")
]


class Bar:
    """How far something is, shown while it lasts."""

    def __init__(self, bar: Progress, what: str) -> None:
        self._bar = bar
        self._task = bar.add_task(what, total=1.0)

    def share(self, share: float) -> None:
        self._bar.update(self._task, completed=share)

    def stage(self, what: str, share: float) -> None:
        """The same, with what is done now."""
        self._bar.update(self._task, description=what, completed=share)


@contextmanager
def progress(what: str) -> Iterator[Bar]:
    """A bar that goes when its block ends; none with -q."""
    with Progress(console=notes, transient=True) as bar:
        yield Bar(bar, what)


def set_volume(quiet: bool, verbose: bool) -> None:
    """-q and -v."""
    notes.quiet = live_line.quiet = quiet
    log = logging.getLogger("sdre_drive")
    if verbose and not log.handlers:
        handler = logging.StreamHandler()
        handler.setFormatter(logging.Formatter("sdre-drive: %(message)s"))
        log.addHandler(handler)
        log.setLevel(logging.INFO)


class End(threading.Event):
    """Set by the first request to end. A second one sets `at_once`: the ramp takes too long."""

    def __init__(self) -> None:
        super().__init__()
        self.at_once = threading.Event()

    def ask(self) -> None:
        """Ctrl-C, once more."""
        (self.at_once if self.is_set() else self).set()


def end_by_signal() -> End:
    """Set by Ctrl-C or a request to end, so that the drive can be stopped in peace."""
    end = End()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: end.ask())
    return end
