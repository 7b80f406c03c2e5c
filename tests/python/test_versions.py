# SPDX-License-Identifier: MIT
"""Firmware and tool that do not fit together: the message says which side to update."""

from __future__ import annotations

from typing import Any, Dict

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


class Answer:
    """The answer of pymodbus to function 43/14."""

    def __init__(self, information: Dict[int, bytes]) -> None:
        self.information = information


def of_map(digest: str, monkeypatch: pytest.MonkeyPatch) -> Drive:
    """A drive that tells this digest of its register map, and nothing else."""
    drive = Drive(Target())

    def asked(call: str, *_: Any, **kwargs: Any) -> Answer:
        assert call == "read_device_information"
        return Answer(
            {VERSION_OBJECT: b"9.0.0"}
            if kwargs["read_code"] == 1
            else {MAP_OBJECT: digest.encode()}
        )

    monkeypatch.setattr(drive, "_asked", asked)
    return drive


def test_another_map_is_refused_before_a_register_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(DriveError, match="9.0.0 has other registers .*: update sdre-drive"):
        of_map("00000000", monkeypatch).constants()


def test_the_same_map_goes_on_to_the_registers(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(AssertionError):
        of_map(register_map.DIGEST, monkeypatch).constants()
