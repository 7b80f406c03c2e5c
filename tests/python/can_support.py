# SPDX-License-Identifier: MIT
"""A virtual drive on Modbus and on CAN, and sdre-drive in this process."""

from __future__ import annotations

import signal
import socket
import sys
from contextlib import contextmanager
from typing import Callable, Iterator, NamedTuple

import pytest
from conftest import Served, serving

from sdre_drive import cli
from sdre_drive.connection import Drive, Target

WATCHED = 0x1016


class Bus(NamedTuple):
    """A virtual drive on Modbus and on CAN."""

    served: Served
    channel: str

    def target(self) -> Target:
        """Address on CAN."""
        return Target(can=self.channel)

    def options(self) -> list[str]:
        """Before a command."""
        return ["--can", self.channel]


@contextmanager
def on_both(factory: pytest.TempPathFactory) -> Iterator[Bus]:
    """One for all tests of a file; each leaves it at rest, and without a fault."""
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        port = s.getsockname()[1]
    with serving(factory.mktemp("bus"), "--slcan-tcp", str(port)) as served:
        yield Bus(served, f"socket://127.0.0.1:{port}")


class Done(NamedTuple):
    """How a command has ended."""

    code: int
    out: str
    err: str


Command = Callable[..., Done]


@contextmanager
def in_process(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Command]:
    """sdre-drive to its end: a process for each takes a second."""

    def run(*words: str) -> Done:
        monkeypatch.setattr("sdre_drive.options._line", {})
        monkeypatch.setattr(sys, "argv", ["sdre-drive", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        assert isinstance(end.value.code, int)
        return Done(end.value.code, *capsys.readouterr())

    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield run
    for number, handler in before.items():
        signal.signal(number, handler)


def watched(drive: Drive) -> int:
    """Object 1016h:1 of the drive."""
    octets = drive._link._node.sdo.upload(WATCHED, 1)  # type: ignore[attr-defined]
    return int.from_bytes(octets, "little")


def watch_nothing(drive: Drive) -> None:
    """As after its start."""
    drive._link._node.sdo.download(WATCHED, 1, bytes(4))  # type: ignore[attr-defined]
