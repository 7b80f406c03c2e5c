# SPDX-License-Identifier: MIT
"""The files of tests/target/tick_file.h: recorded runs, and what the replay answered."""

import struct
from dataclasses import dataclass

NAME_SIZE = 64
HEAD = struct.Struct(
    "<6I"
)  # layout, size of this head and all up to the ticks, tick size, law, order, ticks
PUBLIC = struct.Struct("<10f3f3fI")  # end of a tick, after the core's memory
RESULT = struct.Struct("<III3f3f")
GATE = 4


@dataclass
class Run:
    name: str
    order: int
    ticks: list  # tuples: sample and command, duties of the law and of the PI-FOC, flags


def read_runs(path):
    with open(path, "rb") as file:
        data = file.read()
    runs, at = [], 0
    while True:
        name = data[at : at + NAME_SIZE].rstrip(b"\0").decode()
        _, run_size, tick_size, _, order, count = HEAD.unpack_from(data, at + NAME_SIZE)
        if count == 0:
            return runs
        at += run_size
        tick = struct.Struct(f"<{tick_size - PUBLIC.size}x{PUBLIC.format[1:]}")
        ticks = list(tick.iter_unpack(data[at : at + count * tick_size]))
        runs.append(Run(name, order, ticks))
        at += count * tick_size


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
