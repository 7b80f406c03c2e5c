# SPDX-License-Identifier: MIT
"""Something that takes a while: one at a time, with its progress and its result for all viewers."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from typing import Any, Callable, Dict, Optional

from sdre_drive.connection import DriveError

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Job:
    """State of the last one."""

    name: str
    stage: str = "begins"
    share: float = 0.0
    running: bool = True
    error: str = ""
    said: str = ""
    file_name: str = ""
    file_text: str = ""


@dataclass(frozen=True)
class Result:
    """The product of a job."""

    said: str
    file_name: str = ""
    file_text: str = ""


class Jobs:
    """A thread for each."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.last: Optional[Job] = None
        self.number = 0  # of jobs begun
        self.end = threading.Event()  # asked to end

    @property
    def running(self) -> str:
        """Name of the one that runs, or nothing."""
        job = self.last
        return job.name if job and job.running else ""

    def require_none(self) -> None:
        """DriveError while one runs."""
        if self.running:
            raise DriveError(f"{self.running} runs: wait, or STOP it")

    def begin(self, name: str, work: Callable[[Progress, threading.Event], Result]) -> None:
        """Runs it in a thread of its own."""
        with self._lock:
            self.require_none()
            self.end = threading.Event()
            self.number += 1
            self.last = Job(name)
        threading.Thread(target=self._run, args=(work, self.end), daemon=True).start()

    def _run(self, work: Callable[[Progress, threading.Event], Result], end: Any) -> None:
        try:
            found = work(lambda stage, share: self._note(stage=stage, share=share), end)
            self._note(running=False, share=1.0, **vars(found))
        except DriveError as e:
            self._note(running=False, error=str(e))
        except Exception as e:  # a page that waits forever would be worse
            self._note(running=False, error=f"an error of this tool: {e!r}")
            raise

    def _note(self, **what: Any) -> None:
        assert self.last
        self.last = replace(self.last, **what)

    def for_page(self) -> Optional[Dict[str, Any]]:
        """For the viewers; the file is fetched on its own."""
        job = self.last
        if job is None:
            return None
        told = {k: v for k, v in vars(job).items() if k != "file_text"}
        return {**told, "number": self.number}
