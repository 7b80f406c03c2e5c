# SPDX-License-Identifier: MIT
"""The viewers of the page. One of them at a time may write to the drive."""

from __future__ import annotations

import threading
import time
from typing import Dict, Optional

from sdre_drive.connection import DriveError

# Chosen: a browser has six connections to a server, for all of its tabs. Each viewer takes one, and
# STOP has to find another.
MOST = 4
ABANDONED_S = 2.0  # chosen: a connection that breaks for less is no farewell


class TooMany(DriveError):
    """There is no room for another viewer."""


class Viewers:
    """From any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: Dict[str, int] = {}  # connections of each viewer
        self._armed: Optional[str] = None
        self._left_s: Optional[float] = None  # since when the armed one has no connection

    def come(self, viewer: str) -> None:
        """A viewer begins to look, or comes back."""
        with self._lock:
            if viewer not in self._open and len(self._open) >= MOST:
                raise TooMany(f"{MOST} windows are open already: close one of them")
            self._open[viewer] = self._open.get(viewer, 0) + 1
            if viewer == self._armed:
                self._left_s = None

    def go(self, viewer: str) -> None:
        """A connection has ended."""
        with self._lock:
            self._open[viewer] -= 1
            if self._open[viewer] == 0:
                del self._open[viewer]
                if viewer == self._armed:
                    self._left_s = time.monotonic()

    def arm(self, viewer: str, take_over: bool) -> None:
        """Only this one may write from now on. DriveError when another one may."""
        with self._lock:
            if viewer not in self._open:
                raise DriveError("this window has lost its connection: reload it")
            if self._armed not in (None, viewer) and not take_over:
                raise DriveError("another window is armed: take over, or disarm it there")
            self._armed, self._left_s = viewer, None

    def disarm(self, viewer: str) -> bool:
        """Whether it was armed."""
        with self._lock:
            was = viewer == self._armed
            self._armed = None if was else self._armed
            return was

    def require_armed(self, viewer: str) -> None:
        """DriveError for one that may not write."""
        with self._lock:
            if viewer != self._armed:
                raise DriveError("arm this window first")

    def state_of(self, viewer: str) -> str:
        """The armed one, as this viewer sees it: me, other, none."""
        with self._lock:
            return "none" if self._armed is None else "me" if viewer == self._armed else "other"

    @property
    def count(self) -> int:
        """How many look."""
        with self._lock:
            return len(self._open)

    def abandoned(self) -> bool:
        """True once, when the armed viewer has been away for too long. Nobody is armed then."""
        with self._lock:
            if self._left_s is None or time.monotonic() < self._left_s + ABANDONED_S:
                return False
            self._armed, self._left_s = None, None
            return True
