# SPDX-License-Identifier: MIT
"""The drive's oscilloscope and the record of its last fault."""

from __future__ import annotations

import struct
import time
from dataclasses import dataclass
from typing import List, Sequence, Tuple

from sdre_drive import register_map
from sdre_drive.connection import Drive, DriveError, Refused
from sdre_drive.scope_facts import (
    ARM,
    BLOCK,
    CHANNELS,
    DONE,
    RECORD_FIRST,
    RECORD_SIGNALS,
    SAMPLES,
    SCOPE_FIRST,
    STOP,
    TRIGGERS,
    WAITS,
)

NAMES = tuple(name for name, _ in register_map.SIGNALS)
UNITS = dict(register_map.SIGNALS)
PERIOD_S = 0.05
LONGEST_WAY_S = 30.0  # chosen: for a picture that waits for nothing


@dataclass(frozen=True)
class Setup:
    """Settings of the scope."""

    signals: Sequence[str]
    decimation: int = 1
    trigger: str = "now"
    channel: int = 1
    level: float = 0.0
    before: int = 0


@dataclass(frozen=True)
class Capture:
    """Samples in the order of time; time 0 is the trigger."""

    signals: Tuple[str, ...]
    time_s: List[float]
    values: List[List[float]]  # of each signal


def number_of(name: str) -> int:
    """DriveError for a signal that does not exist."""
    if name.upper() not in NAMES[1:]:
        raise DriveError(f'there is no signal "{name}": one of {", ".join(NAMES[1:])}')
    return NAMES.index(name.upper())


def require_possible(setup: Setup) -> None:
    """DriveError names the error in a setting."""
    if not 1 <= len(setup.signals) <= CHANNELS:
        raise DriveError(f"{len(setup.signals)} signals: one to {CHANNELS}")
    if setup.trigger not in TRIGGERS:
        raise DriveError(f'trigger "{setup.trigger}" is not one of {", ".join(TRIGGERS)}')
    if setup.channel > len(setup.signals):
        raise DriveError(
            f"the signal that triggers is number {setup.channel} of {len(setup.signals)}"
        )
    for name in setup.signals:
        number_of(name)


def arm(drive: Drive, setup: Setup) -> None:
    """Begins; what was taken before is gone."""
    require_possible(setup)
    numbers = [number_of(name) for name in setup.signals] + [0] * (CHANNELS - len(setup.signals))
    for k, number in enumerate(numbers):
        drive.write(f"SCOPE_SIGNAL_{k + 1}", number)
    drive.write("SCOPE_DECIMATION", setup.decimation)
    drive.write("SCOPE_TRIGGER", TRIGGERS.index(setup.trigger))
    drive.write("SCOPE_CHANNEL", setup.channel)
    drive.write("SCOPE_LEVEL", setup.level)
    drive.write("SCOPE_BEFORE", setup.before)
    drive.write("SCOPE_COMMAND", ARM)


def stop(drive: Drive) -> None:
    """Gives up waiting."""
    drive.write("SCOPE_COMMAND", STOP)


def is_done(drive: Drive) -> bool:
    """The last sample was taken."""
    return drive.traces()["SCOPE_STATE"] == DONE


def is_filled(drive: Drive) -> bool:
    """It has the samples before the trigger, for which it waits from now on."""
    return drive.traces()["SCOPE_STATE"] >= WAITS


def read(drive: Drive, setup: Setup) -> Capture:
    """Samples taken with this setting."""
    samples = _samples(drive)
    values = _floats(drive, SCOPE_FIRST, CHANNELS * samples)
    period_s = drive.constants().period_s * setup.decimation
    return Capture(
        tuple(name.upper() for name in setup.signals),
        [(k - setup.before) * period_s for k in range(samples)],
        [values[k::CHANNELS] for k in range(len(setup.signals))],
    )


def take(drive: Drive, setup: Setup, longest_s: float) -> Capture:
    """Arms, waits, reads. A running drive keeps running meanwhile."""
    arm(drive, setup)
    end_s = time.monotonic() + longest_s
    while not is_done(drive):
        if time.monotonic() > end_s:
            stop(drive)
            raise DriveError(f"the trigger did not come within {longest_s:g} s")
        time.sleep(PERIOD_S)
    return read(drive, setup)


def samples_of(drive: Drive) -> int:
    """How many a picture has of each signal. That depends on the firmware's build."""
    return len(take(drive, Setup(("SPEED",)), LONGEST_WAY_S).time_s)


def record(drive: Drive) -> Capture:
    """The last periods before the last fault; time 0 is the fault."""
    for _ in range(2):
        before = drive.traces()
        count = int(before["RECORD_COUNT"])
        values = _floats(drive, RECORD_FIRST, count * len(RECORD_SIGNALS))
        if drive.traces()["RECORD_NUMBER"] == before["RECORD_NUMBER"]:
            break
    else:
        raise DriveError("the drive trips again and again")
    period_s = drive.constants().period_s
    return Capture(
        RECORD_SIGNALS,
        [(k + 1 - count) * period_s for k in range(count)],
        [values[k :: len(RECORD_SIGNALS)] for k in range(len(RECORD_SIGNALS))],
    )


def _samples(drive: Drive) -> int:
    """The most that the firmware has: beyond its last register it refuses."""
    for samples in SAMPLES:
        try:
            drive.words(SCOPE_FIRST + 2 * CHANNELS * samples - 1, 1)
            return samples
        except Refused:
            continue
    raise DriveError("this firmware has no scope that this tool knows")


def _floats(drive: Drive, first: int, count: int) -> List[float]:
    words: List[int] = []
    while len(words) < 2 * count:
        words += drive.words(first + len(words), min(BLOCK, 2 * count - len(words)))
    return [
        struct.unpack(">f", struct.pack(">HH", *words[k : k + 2]))[0]
        for k in range(0, 2 * count, 2)
    ]
