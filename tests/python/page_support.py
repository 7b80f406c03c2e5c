# SPDX-License-Identifier: MIT
"""A page for a virtual drive, and a viewer without a browser."""

from __future__ import annotations

import contextlib
import http.client
import json
import socket
import subprocess
import sys
import threading
import time
import urllib.parse
import uuid
from typing import Any, Callable, Dict, Iterator, TextIO, Tuple

from conftest import Served

LONGEST_S = 30.0  # chosen: many times what a busy machine takes


@contextlib.contextmanager
def page_of(served: Served) -> Iterator[Tuple[str, subprocess.Popen]]:
    """A page for the virtual drive: its address with its token, and its process."""
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        port = s.getsockname()[1]
    command = [sys.executable, "-m", "sdre_drive", "ui", "--no-browser", "--page-port", str(port)]
    page = subprocess.Popen(
        [*command, *served.options(), "--control", f"127.0.0.1:{served.control}"],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert page.stdout
    try:
        yield page.stdout.readline().strip(), page
    finally:
        page.terminate()
        page.wait(20)


class Viewer:
    """A window that looks, and asks."""

    def __init__(self, address: str) -> None:
        at = urllib.parse.urlsplit(address)
        self.host, self.token = at.netloc, urllib.parse.parse_qs(at.query)["token"][0]
        self.name = str(uuid.uuid4())
        self.state: Dict[str, Any] = {}
        self.refused = ""
        self.rows: Dict[str, list] = {"drive": [], "truth": []}

    def __enter__(self) -> Viewer:
        host, _, port = self.host.partition(":")
        self._line = socket.create_connection((host, int(port)), timeout=60)
        path = f"/api/stream?viewer={self.name}&token={self.token}"
        self._line.sendall(f"GET {path} HTTP/1.1\r\nHost: {self.host}\r\n\r\n".encode())
        lines = self._line.makefile("r", encoding="utf-8", newline="\n")
        status = int(lines.readline().split()[1])
        while lines.readline().strip():
            pass
        if status != 200:
            self.refused = lines.readline()
            return self
        threading.Thread(target=self._look, args=(lines,), daemon=True).start()
        self.until(lambda s: s["reading"] is not None)
        return self

    def __exit__(self, *_: object) -> None:
        with contextlib.suppress(OSError):
            self._line.shutdown(socket.SHUT_RDWR)
        self._line.close()

    def _look(self, lines: TextIO) -> None:
        with contextlib.suppress(OSError, ValueError):
            for line in lines:
                self.state = json.loads(line)
                for name, rows in self.rows.items():
                    rows += self.state["traces"][name]

    def until(self, wanted: Callable[[Dict[str, Any]], Any], longest_s: float = LONGEST_S) -> Any:
        """The first state that is wanted."""
        end_s = time.monotonic() + longest_s
        while time.monotonic() < end_s:
            if self.state and wanted(self.state):
                return self.state
            time.sleep(0.02)
        raise AssertionError(f"it did not come; now {self.state}")

    def until_mode(self, mode: str, longest_s: float = LONGEST_S) -> Any:
        """The drive has this mode."""
        return self.until(lambda s: s["reading"] and s["reading"]["mode"] == mode, longest_s)

    def ask(self, action: str, /, **args: Any) -> Tuple[int, Dict[str, Any]]:
        """An action: status and answer."""
        headers = {
            "Content-Type": "application/json",
            "Origin": f"http://{self.host}",
            "Cookie": f"sdre_drive_{self.host.rpartition(':')[2]}={self.token}",
        }
        line = http.client.HTTPConnection(self.host, timeout=30)
        line.request("POST", f"/api/{action}?viewer={self.name}", json.dumps(args), headers)
        answer = line.getresponse()
        told = json.loads(answer.read())
        line.close()
        return answer.status, told

    def do(self, action: str, /, **args: Any) -> str:
        """An action that has to be done."""
        status, told = self.ask(action, **args)
        assert status == 200, told
        return str(told["said"])

    def refuse(self, action: str, /, **args: Any) -> str:
        """An action that must not be done: why."""
        status, told = self.ask(action, **args)
        assert status != 200, told
        return str(told["error"])

    def get(self, what: str) -> Any:
        """Data that a page reads once."""
        line = http.client.HTTPConnection(self.host, timeout=30)
        line.request("GET", f"/api/{what}?token={self.token}")
        answer = line.getresponse()
        assert answer.status == 200, what
        return json.loads(answer.read())
