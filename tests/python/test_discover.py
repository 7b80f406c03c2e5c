# SPDX-License-Identifier: MIT
"""Drives that are found by themselves."""

from __future__ import annotations

from types import SimpleNamespace
from typing import List

import pytest
from conftest import Served

from sdre_drive import discover
from sdre_drive.connection import DriveError, Target

LINE = Target()


def place(monkeypatch: pytest.MonkeyPatch, tcp: List[int], serial: List[str]) -> None:
    """A machine with these places alone."""
    monkeypatch.setattr(discover, "TCP_PORTS", (1, *tcp))
    ports = [SimpleNamespace(device=device) for device in serial]
    monkeypatch.setattr(discover.list_ports, "comports", lambda: ports)


def test_the_only_drive_is_taken(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    place(monkeypatch, [served.tcp], [])
    assert discover.the_only_one(LINE).tcp_port == served.tcp
    (found,) = discover.find(LINE)
    assert found.same_map and "ipmsm_390w" in found.words and "firmware 1.0.0" in found.words
    place(monkeypatch, [], [served.pty])
    assert discover.the_only_one(LINE).serial_port == served.pty


def test_several_drives_are_listed(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    place(monkeypatch, [served.tcp], [served.pty])
    with pytest.raises(DriveError, match="several drives answer") as told:
        discover.the_only_one(LINE)
    assert served.pty in str(told.value) and str(served.tcp) in str(told.value)


def test_what_is_no_drive_is_none(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    """The bench has a port too, and speaks no Modbus."""
    place(monkeypatch, [served.control], ["/dev/null", "/dev/no-such-line"])
    assert discover.find(LINE) == []
    with pytest.raises(DriveError, match=r"no drive answers: serial ports \(/dev/no-such-line, "):
        discover.the_only_one(LINE)
