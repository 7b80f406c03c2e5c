# SPDX-License-Identifier: MIT
"""Other clients of the same SDO server. CiA 301 gives a server to one client. Two frames with the
same identifier at the same time are an error on the bus, and answers do not tell whose they are."""

from __future__ import annotations

import random
import time

LISTEN_S = 0.15  # chosen: a client that runs or watches a drive asks every 0.1 s
QUIET_S = 0.01  # chosen: segments of one transfer follow each other within 2 ms or so
LONGEST_WAIT_S = 0.2  # chosen: well below the silence that stops the motor
APART_S = 0.02  # chosen: two clients that collided start again at different times


class Others:
    """Their requests on the bus. The server's answer to one of them comes after it, so a transfer
    without such a request got its own answers."""

    def __init__(self) -> None:
        self.requests = 0
        self._last_s = 0.0

    def hear(self, *_: object) -> None:
        """A request of another client; python-can does not give back its own frames."""
        self.requests += 1
        self._last_s = time.monotonic()

    def are_there(self) -> bool:
        """Listens for 0.15 s, before the first request."""
        before, end_s = self.requests, time.monotonic() + LISTEN_S
        while self.requests == before and time.monotonic() < end_s:
            time.sleep(QUIET_S)
        return self.requests > before

    def let_end(self) -> None:
        """Waits for the end of another client's transfer, for 0.2 s at most."""
        end_s = time.monotonic() + LONGEST_WAIT_S
        while self._last_s + QUIET_S > time.monotonic() and time.monotonic() < end_s:
            time.sleep(QUIET_S / 4)

    @staticmethod
    def step_aside() -> None:
        """After a collision."""
        time.sleep(random.uniform(0.0, APART_S))
