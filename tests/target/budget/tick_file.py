# SPDX-License-Identifier: MIT
"""The files of tests/target/tick_file.h: recorded runs, and what the replay answered."""
import struct
from dataclasses import dataclass

NAME_SIZE, PI_GAINS_SIZE = 64, 32
TABLE_SIZE = 4 + 4 + 3 * 4 + 8 * 8 + 17 * 24 * 6 * 4  # whether there is one, counts, constants, pairs, gains
HEAD = struct.Struct("<5I")  # layout, tick size, form, order, ticks
DRIVE_SIZE = (49 + 26) * 4
TICK = struct.Struct(f"<{DRIVE_SIZE}x6f3f3fI")
RESULT = struct.Struct("<III3f3f")
GATE = 4


@dataclass
class Run:
    name: str
    encoder: bool
    order: int
    ticks: list  # tuples of TICK


def read_runs(path):
    with open(path, "rb") as file:
        data = file.read()
    runs, at = [], 0
    while True:
        name = data[at : at + NAME_SIZE].rstrip(b"\0").decode()
        layout, tick_size, form, order, count = HEAD.unpack_from(data, at + NAME_SIZE)
        if count == 0:
            return runs
        config_size = layout & 0xFFFF
        if tick_size != TICK.size:
            raise ValueError(f"{path}: ticks of {tick_size} octets, {TICK.size} are known")
        at += NAME_SIZE + HEAD.size + config_size + PI_GAINS_SIZE + TABLE_SIZE
        ticks = list(TICK.iter_unpack(data[at : at + count * TICK.size]))
        runs.append(Run(name, form == 1, order, ticks))
        at += count * TICK.size


def read_results(path, runs):
    """One list of RESULT tuples per run."""
    with open(path, "rb") as file:
        data = file.read()
    if len(data) != RESULT.size * sum(len(run.ticks) for run in runs):
        raise ValueError(f"{path}: not as many results as ticks")
    everything, results, at = list(RESULT.iter_unpack(data)), [], 0
    for run in runs:
        results.append(everything[at : at + len(run.ticks)])
        at += len(run.ticks)
    return results
