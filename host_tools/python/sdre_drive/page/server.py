# SPDX-License-Identifier: MIT
"""Serves the page on this machine."""

from __future__ import annotations

import os
import secrets
import signal
import socket
import threading
import webbrowser
from types import FrameType
from typing import Optional, Tuple

from nicegui import app, ui

from sdre_drive.connection import DriveError, Target
from sdre_drive.page.guard import Guard
from sdre_drive.page.layout import Page
from sdre_drive.page.state import Watcher

HOST = "127.0.0.1"
RECONNECT_S = 20.0  # chosen: a browser on a busy machine keeps its page
FAREWELL_S = 2  # chosen: pages may close their connections
LONGEST_END_S = 4.0  # chosen: longest time from a signal to the end of the process


def require_free(port: int) -> None:
    """DriveError when the port is in use."""
    with socket.socket() as s:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            s.bind((HOST, port))
        except OSError as e:
            raise DriveError(f"--page-port {port}: {e.strerror}") from e


def end_in_any_case(number: int) -> None:
    """After LONGEST_END_S from the signal the process ends, whatever still waits. The drive's
    time-out stops the motor then."""
    orderly = signal.getsignal(number)

    def asked(seen: int, frame: Optional[FrameType]) -> None:
        last = threading.Timer(LONGEST_END_S, os._exit, [128 + seen])
        last.daemon = True
        last.start()
        if callable(orderly):
            orderly(seen, frame)

    signal.signal(number, asked)


def serve(
    target: Target,
    bench: Optional[Tuple[str, int]],
    pole_pairs: Optional[int],
    port: int,
    browser: bool,
) -> None:
    """Until Ctrl-C; a motor that was started from a page is stopped then."""
    require_free(port)
    token = secrets.token_urlsafe(16)
    address = f"http://{HOST}:{port}/?token={token}"
    watcher = Watcher(target, bench, pole_pairs)

    @ui.page("/", title="sdre-drive")
    def _page() -> None:
        Page(watcher)

    def started() -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            end_in_any_case(number)
        watcher.start()
        print(f"{address}\nCtrl-C ends it", flush=True)
        if browser:
            webbrowser.open(address)

    app.add_middleware(Guard, token=token, port=port)
    app.on_startup(started)
    app.on_shutdown(watcher.close)
    ui.run(
        host=HOST,
        port=port,
        reload=False,
        show=False,
        show_welcome_message=False,
        title="sdre-drive",
        reconnect_timeout=RECONNECT_S,
        timeout_graceful_shutdown=FAREWELL_S,
    )
