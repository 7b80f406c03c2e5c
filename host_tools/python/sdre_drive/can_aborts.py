# SPDX-License-Identifier: MIT
"""Abort codes of CiA 301 in the words of the exceptions of Modbus."""

from __future__ import annotations

from sdre_drive.link import EXCEPTION_WORDS, NO_REGISTER, NOT_NOW, OUT_OF_RANGE

ABORTS = {
    0x06020000: NO_REGISTER,
    0x06090011: NO_REGISTER,
    0x06090030: OUT_OF_RANGE,
    0x08000022: NOT_NOW,
}
READ_ONLY = 0x06010002
TORN = (0x05030000, 0x05040001)  # a segment that belongs to nothing: another client was in between


def refusal(code: int) -> str:
    """An abort code in the words of a person."""
    if code == READ_ONLY:
        return "the drive does not let this be written over CAN"
    words = EXCEPTION_WORDS.get(ABORTS.get(code, 0))
    return f"the drive {words or f'answers with abort code {code:08X}h'}"
