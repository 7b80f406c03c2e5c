# SPDX-License-Identifier: MIT
"""One connection of a browser. Every request passes the guard first."""

from __future__ import annotations

import json
import re
import time
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from typing import Any, Dict, Optional
from urllib.parse import parse_qs, urlsplit

from sdre_drive.connection import DriveError
from sdre_drive.page import facts, guard
from sdre_drive.page.viewers import TooMany

STATIC = Path(__file__).parent / "static"
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}
FILES = {f"/{p.relative_to(STATIC).as_posix()}": p for p in STATIC.rglob("*") if p.suffix in TYPES}
STREAM_S = 0.1  # between two states
MOST_OCTETS = 400_000  # of a request: an image of constants has less than half of it
VIEWER = re.compile(r"[0-9a-f-]{8,40}")


class Handler(BaseHTTPRequestHandler):
    """GET of files and states, POST of actions."""

    protocol_version = "HTTP/1.1"
    server_version, sys_version = "sdre-drive", ""
    timeout = 20.0  # of a connection that is silent
    server: Any

    def do_GET(self) -> None:
        """Files and what a page reads."""
        if not self._allowed():
            return
        path = urlsplit(self.path).path
        if path == "/api/stream":
            self._stream()
        elif path.startswith("/api/"):
            self._read(path[len("/api/") :])
        else:
            self._file(path)

    def do_POST(self) -> None:
        """An action: JSON in, JSON out."""
        body = self._body()
        if not self._allowed():
            return
        if body is None:
            self.close_connection = True
            self._json(400, {"error": "the request is too long, or no JSON"})
            return
        viewer, name = self._viewer(), urlsplit(self.path).path.rpartition("/")[2]
        try:
            args = json.loads(body or b"{}")
            if not isinstance(args, dict):
                raise ValueError
        except ValueError:
            self._json(400, {"error": "the request is no JSON object"})
            return
        try:
            self._json(200, {"said": self.server.actor.do(viewer, name, args)})
        except DriveError as e:
            self._json(409, {"error": str(e)})

    def log_message(self, *_args: Any) -> None:
        """Says nothing: the address has the token."""

    def _allowed(self) -> bool:
        headers = guard.lower(dict(self.headers.items()))
        port = self.server.server_address[1]
        if guard.is_allowed(self.command, self.path, headers, self.server.token, port):
            return True
        self.close_connection = True
        self._answer(403, "text/plain; charset=utf-8", guard.REFUSED.encode())
        return False

    def _body(self) -> Optional[bytes]:
        """All of it, so that the connection can go on; None: it is not taken."""
        length = self.headers.get("Content-Length", "")
        kind = self.headers.get("Content-Type", "")
        if not length.isdigit() or int(length) > MOST_OCTETS:
            return None
        body = self.rfile.read(int(length))
        return body if kind == "application/json" else None

    def _viewer(self) -> str:
        given = parse_qs(urlsplit(self.path).query).get("viewer", [""])[-1]
        return given if VIEWER.fullmatch(given) else ""

    def _file(self, path: str) -> None:
        file = FILES.get("/index.html" if path == "/" else path)
        if file is None:
            self._answer(404, "text/plain; charset=utf-8", b"there is no such file")
        else:
            self._answer(200, TYPES[file.suffix], file.read_bytes())

    def _read(self, what: str) -> None:
        w = self.server.watcher
        if what == "facts":
            self._json(200, facts.facts(w))
        elif what == "parameters":
            self._json(200, facts.parameters(w))
        elif what == "scope":
            self._json(200, facts.capture(w.capture))
        elif what == "history":
            self._json(200, w.history.for_page())
        elif what == "result":
            job = w.jobs.last
            self._json(200, {"name": job.file_name, "text": job.file_text} if job else None)
        elif re.fullmatch(r"record/\d{1,9}", what):
            self._json(200, facts.capture(w.history.record_of(int(what.partition("/")[2]))))
        else:
            self._json(404, {"error": "there is nothing of that name"})

    def _stream(self) -> None:
        """States, a line of JSON each, until the viewer goes."""
        w, viewer = self.server.watcher, self._viewer()
        try:
            if not viewer:
                raise DriveError("a viewer has to have a name")
            w.viewers.come(viewer)
        except DriveError as e:
            self._json(503 if isinstance(e, TooMany) else 400, {"error": str(e)})
            return
        try:
            self._head(200, "application/x-ndjson; charset=utf-8", None)
            seen: Dict[str, int] = {}
            while not self.server.ends.is_set():
                state = {**w.for_page(viewer), "traces": w.traces.since(seen)}
                self.wfile.write(json.dumps(state).encode() + b"\n")
                time.sleep(STREAM_S)
        except OSError:
            pass  # it has gone
        finally:
            w.viewers.go(viewer)
            self.close_connection = True

    def _json(self, status: int, what: Any) -> None:
        self._answer(status, "application/json; charset=utf-8", json.dumps(what).encode())

    def _answer(self, status: int, kind: str, body: bytes) -> None:
        self._head(status, kind, len(body))
        if self.command != "HEAD":
            self.wfile.write(body)

    def _head(self, status: int, kind: str, length: Optional[int]) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        if length is None:
            self.send_header("Connection", "close")
        else:
            self.send_header("Content-Length", str(length))
        if status == 200:
            port = self.server.server_address[1]
            self.send_header("Set-Cookie", guard.cookie(self.server.token, port))
        for name, value in guard.HEADERS.items():
            self.send_header(name, value)
        self.end_headers()
