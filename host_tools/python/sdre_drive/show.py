# SPDX-License-Identifier: MIT
"""A reading on a terminal."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, Dict, List, Optional

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from sdre_drive import bench as benches
from sdre_drive import faults
from sdre_drive.bench_faults import words_of
from sdre_drive.faults import Entry
from sdre_drive.registers import Mode, Reading, state_words
from sdre_drive.units import e_radps_of as e_radps_of
from sdre_drive.units import rpm_of as rpm_of
from sdre_drive.units import speed_words as speed_words


def line(reading: Reading, pole_pairs: Optional[int]) -> Text:
    """One line: what it does."""
    t = Text(
        f"{Mode(reading.mode).name if reading.mode in set(Mode) else reading.mode}  ", style="bold"
    )
    t.append(
        f"{speed_words(reading.speed_e_radps, pole_pairs)}  i_q {reading.iq_A:.2f} A  i_d "
        f"{reading.id_A:.2f} A  "
        f"{reading.dc_link_V:.0f} V",
        style="not bold",
    )
    limits = [e.name for e in faults.warnings(reading.conditions)]
    t.append(f"  {' '.join(limits)}" if limits else "", style="yellow")
    return t


def advice(entry: Entry) -> Text:
    """A fault or condition: meaning, causes, checks."""
    t = Text(faults.one_line(entry) + "\n", style="bold")
    for title, lines in (("causes", entry.causes), ("check", entry.check)):
        for k, text in enumerate(lines):
            t.append(f"  {title if k == 0 else '':8} {text}\n", style="not bold")
    t.rstrip()
    return t


def reasons(reading: Reading) -> List[Text]:
    """Advice for all that is wrong or limits the drive."""
    known = faults.explain(reading.why) + faults.warnings(reading.conditions)
    return [advice(e) for e in known]


def bench_words(state: Dict[str, Any]) -> str:
    """The bench of a virtual drive in a line."""
    parts = [f"load {benches.load_words(state)}", benches.pace_words(state)]
    parts += [words_of(b) for b in state["broken"]]
    parts += [state["note"]] if state["note"] else []
    return "; ".join(parts)


def status(
    reading: Reading, pole_pairs: Optional[int], bench: Optional[Dict[str, Any]] = None
) -> RenderableType:
    """Everything of one reading, and how the bench of a virtual drive is set."""
    table = Table(show_header=False, box=None, padding=(0, 2, 0, 0))
    rows = (
        ("mode", f"{reading.mode_words}"),
        (
            "state",
            state_words(reading.statusword)
            + (f", error code {reading.error_code:04X}h" if reading.error_code else ""),
        ),
        ("speed", speed_words(reading.speed_e_radps, pole_pairs)),
        ("i_q, i_d", f"{reading.iq_A:.3f} A, {reading.id_A:.3f} A"),
        ("wanted", f"{reading.iq_ref_A:.3f} A, {reading.id_ref_A:.3f} A"),
        ("v_q, v_d", f"{reading.vq_V:.1f} V, {reading.vd_V:.1f} V"),
        ("dc link", f"{reading.dc_link_V:.1f} V"),
        ("heat sink", f"{reading.temperature_degC:.1f} degC"),
        (
            "heat",
            f"motor {100 * reading.motor_heat:.0f} %, inverter "
            f"{100 * reading.inverter_heat:.0f} %, "
            f"derated by {100 * reading.derating:.0f} %",
        ),
        ("running since", f"{reading.time_s:.1f} s"),
        ("started by", reading.reset_words),
        *([("bench", bench_words(bench))] if bench else []),
    )
    for name, value in rows:
        table.add_row(name, value)
    return Group(table, *reasons(reading))


def as_dict(
    reading: Reading, pole_pairs: int, bench: Optional[Dict[str, Any]] = None
) -> Dict[str, Any]:
    """The same for --json: numbers as they are, and what is wrong by name."""
    return {
        **asdict(reading),
        "mode_words": reading.mode_words,
        "state": state_words(reading.statusword),
        "started_by": reading.reset_words,
        "speed_rpm": rpm_of(reading.speed_e_radps, pole_pairs),
        "faults": [e.name for e in faults.explain(reading.why)],
        "warnings": [e.name for e in faults.warnings(reading.conditions)],
        "bench": bench,
    }


def first_fault(reading: Reading, pole_pairs: Optional[int]) -> RenderableType:
    """The record of the last fault."""
    kept = reading.first_fault
    if kept.why.fault == 0:
        return Text("no fault since the start")
    mode = Mode(kept.mode).name if kept.mode in set(Mode) else str(kept.mode)
    head = Text(
        f"last fault at {kept.time_s:.4f} s in mode {mode}, at "
        f"{speed_words(kept.speed_e_radps, pole_pairs)}, "
        f"wanted {speed_words(kept.wanted_e_radps, pole_pairs)}"
    )
    return Group(head, *[advice(e) for e in faults.explain(kept.why)])
