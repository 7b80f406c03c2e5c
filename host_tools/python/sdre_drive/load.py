# SPDX-License-Identifier: MIT
"""Images of constants into the drive's flash: docs/loading.md. Register numbers and codes are those
of app_loader.h."""

from __future__ import annotations

import struct
import time
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, List, Optional

from sdre_drive.connection import Drive, DriveError
from sdre_drive.link import BOARD_OBJECT, DIGEST_OBJECT, NAME_OBJECT

FIRST = 8000
# Holding registers
COMMAND, OFFSET = FIRST, FIRST + 5
ENTER, BEGIN, COMMIT, FORGET, LEAVE = 1, 2, 3, 4, 5
# Texts of the identification
NAME, DIGEST, BOARD = NAME_OBJECT, DIGEST_OBJECT, BOARD_OBJECT
# Input registers
STATE, PUT, ROOM, LAW, NUMBER, FIELD, COUNT = 0, 2, 4, 6, 7, 9, 28
IMAGE_VALUE, BOARD_VALUE, FIELD_NAME, SUM_OF_BOARD = 10, 12, 14, 26
AWAY, IDLE, BUSY, WRITING, STORED, SUM, IMAGE, FLASH = range(8)
REASONS = {
    1: "it was made by another sdre-gains: make it again with the one that belongs to this "
    "firmware",
    2: "it is for another law than the firmware's",
    3: "it is damaged",
    4: "a constant is out of range, or it does not fit the board",
    6: "its map of the disc is for another encoder, or the firmware was built without "
    "SDRE_DISC_MAP",
}
OTHER_BOARD = 5
LAWS = {
    1: "noc",
    2: "noc_speed",
    3: "noc_h",
    4: "conventional",
    5: "dobc",
    6: "pid",
    7: "pi_foc",
    8: "ladrc",
    9: "noc_shaft",
    10: "noc_iron",
}

PER_REQUEST = 62  # words; a transfer on CAN has room for 64, and their place takes two
RESTART_S = 10.0  # chosen: many times what a start needs, and two requests without an answer
ERASE_S = 60.0  # data sheet: 2 s typical, 15 s at most, of a sector; two of them
BOARD_NAME = slice(30, 42)  # words of an image: the board it was made for
HEAD_WORDS = 80

NOT_TAKEN = (
    "the flash did not take it; an F28335's is written with a programming tool (docs/loading.md)"
)


@dataclass(frozen=True)
class Loader:
    """Registers of the loader."""

    state: int
    reason: int
    put_words: int
    room_words: int
    law: int
    number: int
    field: str  # of the board file: the first in which image and board differ
    image_value: float
    board_value: float


@dataclass(frozen=True)
class InForce:
    """Constants in force in the application."""

    number: int
    name: str
    digest: str
    board: str
    refused: str  # the stored image, at the start; "" when there is none

    @property
    def words(self) -> str:
        """For messages."""
        where = f"image {self.number}" if self.number else "what is compiled in"
        stored = f"; the stored image is not used: {self.refused}" if self.refused else ""
        return f"{where}: {self.name}, {self.digest}, for {self.board}{stored}"


def _pair(values: List[int], at: int) -> int:
    return (values[at] << 16) | values[at + 1]


def _float(values: List[int], at: int) -> float:
    return float(struct.unpack(">f", struct.pack(">I", _pair(values, at)))[0])


def _text(words: List[int]) -> str:
    octets = b"".join(word.to_bytes(2, "big") for word in words)
    return octets.split(b"\0")[0].decode("ascii", "replace")


def look(drive: Drive) -> Loader:
    """DriveError when the firmware has no loader."""
    v = drive.words(FIRST, COUNT)
    return Loader(
        v[STATE],
        v[1],
        _pair(v, PUT),
        _pair(v, ROOM),
        v[LAW],
        _pair(v, NUMBER),
        _text(v[FIELD_NAME:SUM_OF_BOARD]),
        _float(v, IMAGE_VALUE),
        _float(v, BOARD_VALUE),
    )


def in_force(drive: Drive) -> InForce:
    """The same, with the names of function 43/14."""
    found, of = look(drive), drive.identify()
    board = of.get(BOARD, "")
    refused = _reason(found, board, "") if found.state == AWAY and found.reason else ""
    return InForce(found.number, of.get(NAME, ""), of.get(DIGEST, ""), board, refused)


def read_image(path: Path) -> List[int]:
    """The words of a file of `sdre-gains image`."""
    try:
        octets = path.read_bytes()
    except OSError as e:
        raise DriveError(f"{path}: {e.strerror}") from e
    if len(octets) < 2 * HEAD_WORDS or len(octets) % 2:
        raise DriveError(f"{path}: {len(octets)} octets are no image of sdre-gains")
    return [(octets[n] << 8) | octets[n + 1] for n in range(0, len(octets), 2)]


def _wait(drive: Drive, states: List[int], longest_s: float) -> Loader:
    end, seen = time.monotonic() + longest_s, None
    while time.monotonic() < end:
        try:
            seen = look(drive)
        except DriveError:  # it restarts, or its flash keeps it
            seen = None
        if seen and seen.state in states:
            return seen
        time.sleep(0.1)
    raise DriveError(
        "the drive does not come back: it restarts with what it had when it is switched off and on"
    )


def _enter(drive: Drive) -> Loader:
    found = look(drive)
    if found.room_words == 0:
        raise DriveError("this board has no store: its constants are compiled in")
    if found.state == AWAY:
        try:
            drive.write_words(COMMAND, [ENTER])
        except DriveError as e:
            raise DriveError(
                f"{e}; the loader is entered with the bridge off: stop the motor first"
            ) from e
        found = _wait(drive, [IDLE], RESTART_S)
    return found


def _leave(drive: Drive) -> InForce:
    drive.write_words(COMMAND, [LEAVE])
    _wait(drive, [AWAY], RESTART_S)
    return in_force(drive)


def _check(found: Loader, words: List[int], path: Path) -> None:
    if words[1] != found.law:
        raise DriveError(
            f"{path}: is for law {LAWS.get(words[1], words[1])}, the firmware has "
            f"{LAWS.get(found.law, found.law)}"
        )
    if len(words) > found.room_words:
        raise DriveError(f"{path}: {len(words)} words; the drive has room for {found.room_words}")


def _write(drive: Drive, words: List[int], progress: Callable[[float], None]) -> None:
    at = 0
    while at < len(words):
        part = words[at : at + PER_REQUEST]
        try:
            drive.write_words(OFFSET, [at >> 16, at & 0xFFFF, *part])
            at += len(part)
        except DriveError:  # an answer was lost: the words may be there
            found = look(drive)
            if found.state != WRITING or found.put_words not in (at, at + len(part)):
                raise
            at = found.put_words
        progress(at / len(words))


def load(drive: Drive, path: Path, progress: Callable[[float], None]) -> InForce:
    """Writes the image, restarts the drive with it and returns what is in force then."""
    words = read_image(path)
    _check(look(drive), words, path)
    _enter(drive)
    drive.write_words(COMMAND, [BEGIN, len(words) >> 16, len(words) & 0xFFFF])
    found = _wait(drive, [WRITING, FLASH], ERASE_S)
    if found.state == WRITING:
        _write(drive, words, progress)
        crc = zlib.crc32(b"".join(word.to_bytes(2, "big") for word in words))
        drive.write_words(
            COMMAND, [COMMIT, len(words) >> 16, len(words) & 0xFFFF, crc >> 16, crc & 0xFFFF]
        )
        found = _wait(drive, [STORED, SUM, IMAGE, FLASH], ERASE_S)
    of = drive.identify().get(BOARD, "") if found.state == IMAGE else ""
    why = _refusal(found, of, _text(words[BOARD_NAME]))
    now = _leave(drive)
    if why:
        raise DriveError(f"{path}: {why}; in force: {now.words}")
    return now


def forget(drive: Drive) -> InForce:
    """Back to the compiled-in constants; the drive restarts."""
    _enter(drive)
    drive.write_words(COMMAND, [FORGET])
    found = _wait(drive, [STORED, FLASH], ERASE_S)
    now = _leave(drive)
    if why := _refusal(found, "", ""):
        raise DriveError(f"{why}; in force: {now.words}")
    return now


def _reason(found: Loader, board: str, made_for: str) -> str:
    """Why an image is refused; board: that of the firmware, made_for: that of the image or ""."""
    if found.reason != OTHER_BOARD:
        return REASONS.get(found.reason, f"reason {found.reason}")
    if found.field == "sum":
        return "the firmware's own board identity is damaged: program the firmware again"
    image = f"an image for {made_for}" if made_for else "the image"
    if found.field == "name":
        return f"it is {image}, the drive is a {board}; make it with the drive's own board file"
    return (
        f"{found.field} is {found.image_value:g} in {image} and {found.board_value:g} of the "
        f"drive's {board}; make it with [board] name = \"{board}\" and this board's file"
    )


def _refusal(found: Loader, board: str, made_for: str) -> Optional[str]:
    if found.state == FLASH:
        return NOT_TAKEN
    if found.state == SUM:
        return "it arrived damaged"
    if found.state == IMAGE:
        return f"the drive refuses it: {_reason(found, board, made_for)}"
    return None
