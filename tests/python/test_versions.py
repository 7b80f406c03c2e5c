# SPDX-License-Identifier: MIT
"""Firmware and tool that do not fit together: the message says which side to update."""

from __future__ import annotations

from typing import List

import pytest

from sdre_drive import register_map
from sdre_drive.connection import MAP_OBJECT, VERSION_OBJECT, Drive, DriveError, Target, other_map


@pytest.mark.parametrize(
    ("firmware", "wanted"),
    [
        ("0.9.12", "update the firmware, or use sdre-drive 0.9.12"),
        ("", "update the firmware"),
        (register_map.VERSION, "take both from one build"),
        ("1.0.10", "update sdre-drive"),
        ("10.0.0", "update sdre-drive"),
    ],
)
def test_other_map_says_which_side(firmware: str, wanted: str) -> None:
    assert wanted in other_map(firmware)


def of_map(digest: str, monkeypatch: pytest.MonkeyPatch) -> Drive:
    """A drive that tells this digest of its register map, and nothing else."""
    drive = Drive(Target())

    def words(*_: int) -> List[int]:
        raise AssertionError("a register is read")

    monkeypatch.setattr(drive, "identify", lambda: {MAP_OBJECT: digest})
    monkeypatch.setattr(drive, "identify_basic", lambda: {VERSION_OBJECT: "9.0.0"})
    monkeypatch.setattr(drive, "words", words)
    return drive


def test_another_map_is_refused_before_a_register_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(DriveError, match="9.0.0 has other registers .*: update sdre-drive"):
        of_map("00000000", monkeypatch).constants()


def test_the_same_map_goes_on_to_the_registers(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssertionError):
        of_map(register_map.DIGEST, monkeypatch).constants()
