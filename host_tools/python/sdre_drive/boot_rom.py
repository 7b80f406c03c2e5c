# SPDX-License-Identifier: MIT
"""Programs into an F28335's RAM by the SCI loader of its boot ROM: docs/loading.md. The ROM answers
every octet with the same octet."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, List, Tuple

from sdre_drive.connection import DriveError

KEY = 0x08AA  # the stream has octets
RESERVED_WORDS = 8
AUTOBAUD = 0x41  # "A"
LOCK_S = 5.0  # chosen: time to release the reset
ECHO_S = 0.5  # chosen: many times what an octet takes at the slowest usual rate
# [first, last + 1): what the ROM's own stack and the linker leave of the RAM
RAM = ((0x000000, 0x000002), (0x000050, 0x000800), (0x008000, 0x010000))


@dataclass(frozen=True)
class Program:
    """A stream of `hex2000 --boot --sci8 -a`, checked."""

    octets: bytes
    entry: int
    blocks: Tuple[Tuple[int, int], ...]  # address, words

    @property
    def words(self) -> int:
        """The length of all blocks together."""
        return sum(count for _, count in self.blocks)


def is_ram(first: int, count: int) -> bool:
    """A block that the loader may write."""
    return any(low <= first and first + count <= high for low, high in RAM)


def read_program(path: Path) -> Program:
    """DriveError when the file is no such stream, or leads out of the RAM."""
    try:
        text = path.read_text(encoding="ascii", errors="replace")
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
    body = re.search(r"\x02(.*)\x03", text, flags=re.S)
    digits = re.sub(r"\$A[0-9A-Fa-f]+,", " ", body.group(1)).split() if body else []
    if not digits or any(not re.fullmatch("[0-9A-Fa-f]{2}", d) for d in digits):
        raise DriveError(f"{path}: no ASCII-hex stream; write it with hex2000 --boot --sci8 -a")
    return _checked(path, bytes(int(d, 16) for d in digits))


def _checked(path: Path, octets: bytes) -> Program:
    words = [octets[k] | (octets[k + 1] << 8) for k in range(0, len(octets) - 1, 2)]

    def take(at: int, count: int) -> List[int]:
        if at + count > len(words):
            raise DriveError(f"{path}: the stream ends within a block")
        return words[at : at + count]

    if take(0, 1)[0] != KEY:
        raise DriveError(
            f"{path}: begins with {words[0]:04X}h, a stream for the SCI loader begins with "
            f"{KEY:04X}h"
        )
    high, low = take(1 + RESERVED_WORDS, 2)
    entry, at, blocks = (high << 16) | low, 3 + RESERVED_WORDS, []
    while (count := take(at, 1)[0]) != 0:
        high, low = take(at + 1, 2)
        first = (high << 16) | low
        if not is_ram(first, count):
            raise DriveError(
                f"{path}: {count} words at {first:06X}h are not in RAM; the boot ROM cannot write "
                f"flash: use a programming tool"
            )
        take(at + 3, count)
        blocks.append((first, count))
        at += 3 + count
    if not any(first <= entry < first + count for first, count in blocks):
        raise DriveError(f"{path}: the entry {entry:06X}h is in no block")
    return Program(octets[: 2 * (at + 1)], entry, tuple(blocks))


def _lock(line, longest_s: float) -> None:
    end_s = time.monotonic() + longest_s
    while time.monotonic() < end_s:
        line.write(bytes([AUTOBAUD]))
        if line.read(1) == bytes([AUTOBAUD]):
            return
    raise DriveError(
        "the boot ROM does not answer: boot mode SCI-A (GPIO87..84 = 1110), then release the reset"
    )


def send(
    line, program: Program, progress: Callable[[float], None], longest_s: float = LOCK_S
) -> None:
    """`line`: an open serial port, 8N1, whose read() returns after ECHO_S at the latest."""
    line.reset_input_buffer()
    _lock(line, longest_s)
    for k, octet in enumerate(program.octets):
        line.write(bytes([octet]))
        answer = line.read(1)
        if not answer:
            raise DriveError(
                f"the boot ROM went silent at octet {k} of {len(program.octets)}: release the "
                f"reset and begin again"
            )
        if answer[0] != octet:
            raise DriveError(
                f"octet {k} arrived as {answer[0]:02X}h instead of {octet:02X}h: take a lower "
                f"--rate and begin again"
            )
        progress((k + 1) / len(program.octets))
