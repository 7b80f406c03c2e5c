# SPDX-License-Identifier: MIT
"""Serves the page on this machine: files, a stream of states, actions. Standard library only."""

from __future__ import annotations

import os
import secrets
import signal
import socket
import threading
import webbrowser
from http.server import ThreadingHTTPServer
from types import FrameType
from typing import Optional, Tuple

from sdre_drive.connection import DriveError, Target
from sdre_drive.page.actions import Actor
from sdre_drive.page.handler import Handler
from sdre_drive.page.state import Watcher

HOST = "127.0.0.1"
LONGEST_END_S = 4.0  # chosen: longest time from a signal to the end of the process


class PageServer(ThreadingHTTPServer):
    """A thread for each connection; none of them holds up the end."""

    daemon_threads = True
    block_on_close = False
    request_queue_size = 32

    def __init__(self, port: int, token: str, watcher: Watcher) -> None:
        self.token, self.watcher, self.actor = token, watcher, Actor(watcher)
        self.ends = threading.Event()
        super().__init__((HOST, port), Handler)

    def handle_error(self, request: object, client_address: object) -> None:
        """A client that breaks off is no error of this server."""


def require_free(port: int) -> None:
    """DriveError when the port is in use."""
    with socket.socket() as s:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            s.bind((HOST, port))
        except OSError as e:
            raise DriveError(f"--page-port {port}: {e.strerror}") from e


def _end_by_signal(server: PageServer) -> None:
    """After LONGEST_END_S from the signal the process ends, whatever still waits. The drive's
    time-out stops the motor then."""

    def asked(seen: int, _frame: Optional[FrameType]) -> None:
        last = threading.Timer(LONGEST_END_S, os._exit, [128 + seen])
        last.daemon = True
        last.start()
        server.ends.set()
        threading.Thread(target=server.shutdown, daemon=True).start()

    for number in (signal.SIGINT, signal.SIGTERM):
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
    server = PageServer(port, token, watcher)
    _end_by_signal(server)
    watcher.start()
    print(f"{address}\nCtrl-C ends it", flush=True)
    if browser:
        webbrowser.open(address)
    try:
        server.serve_forever(poll_interval=0.1)
    finally:
        watcher.close()
        server.server_close()
