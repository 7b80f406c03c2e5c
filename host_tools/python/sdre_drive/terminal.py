# SPDX-License-Identifier: MIT
"""Parts that several commands of `sdre-drive` need: the terminal, an end by Ctrl-C, --for."""

from __future__ import annotations

import signal
import threading
from typing import Optional

import typer
from rich.console import Console
from typing_extensions import Annotated

out = Console()
err = Console(stderr=True, soft_wrap=True)

For = Annotated[
    Optional[float], typer.Option("--for", min=0.0, help="end after so many seconds", metavar="S")
]


def end_by_signal() -> threading.Event:
    """Set by Ctrl-C or a request to end, so that the drive can be stopped in peace."""
    end = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: end.set())
    return end
