# SPDX-License-Identifier: MIT
"""A drive with a STOP that is final: an action that began before it enables nothing."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import Iterator

from sdre_drive.connection import Drive, DriveError, Target
from sdre_drive.registers import ControlWord

ENABLES = 1 << 3  # of the control word: enable operation


class Stopped(DriveError):
    """STOP was pressed meanwhile."""


class PageDrive(Drive):
    """Several threads write to it, and any viewer may stop it."""

    def __init__(self, target: Target) -> None:
        super().__init__(target)
        # Held while the drive is enabled, so that a stop is sent after that and not in between.
        self._order = threading.Lock()
        self._stops = 0
        self._mine = threading.local()

    @contextmanager
    def action(self) -> Iterator[None]:
        """A stop ends what this thread does within it."""
        self._mine.stops = self._stops
        try:
            yield
        finally:
            del self._mine.stops

    def write(self, name: str, value: float) -> None:
        """A holding register, in its unit."""
        if name == "CONTROLWORD" and int(value) & ENABLES:
            with self._order:
                if getattr(self._mine, "stops", self._stops) != self._stops:
                    raise Stopped("STOP was pressed")
                super().write(name, value)
        else:
            super().write(name, value)

    def stop_now(self, brake: bool) -> None:
        """Brakes and then opens the bridge, or opens it at once. Whatever was about to start the
        drive does not."""
        with self._order:
            self._stops += 1
        word = ControlWord.QUICK_STOP if brake else ControlWord.DISABLE_VOLTAGE
        self.write("CONTROLWORD", word)
