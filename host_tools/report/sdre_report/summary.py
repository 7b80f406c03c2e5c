# SPDX-License-Identifier: MIT
"""The first table of the page: every item of both papers, its main number, and whether it
repeats."""

from __future__ import annotations

from typing import Dict, List

from .tables import Section, Table
from .tools import ReportError

HEAD = ("", "paper", "here, ideal", "here, board", "repeats?")
FIGURES_A = {
    5: "faster; the two controls settle alike here",
    6: "faster; the two controls settle alike here, 19 rad/s of error are 1.3 at most",
    7: "faster, the paper's order of the two barely; overshoot is none",
    8: "yes, the order of the two controls; with a dc link that is really limited",
}
ROWS_B = (
    (
        "Table I: CDOBC, fluctuation II [r/min]",
        "II: fluctuation [r/min]",
        "no: 3.5 instead of 1.3; the order of the laws but HDOBC",
    ),
    ("Table I: CDOBC, overshoot [%]", "I: overshoot [%]", "yes"),
    (
        "Table II: CDOBC, decrease [r/min]",
        "III: decrease [r/min]",
        "no: 23.7 is the least that the inertia allows",
    ),
    ("Table II: CDOBC, fluctuation IV [r/min]", "IV: fluctuation [r/min]", "yes"),
)


def row_of(section: Section, ident: str, name: str) -> List[str]:
    """One row of a table that is in the page."""
    for part in section.parts:
        if isinstance(part, Table) and part.ident == ident:
            for row in part.rows:
                if row[0] == name:
                    return row[1:]
    raise ReportError(f"the summary finds no {name!r} in {ident}")


def section(a: Section, b: Section) -> Section:
    """From the tables below it."""
    out = Table(
        "S-summary",
        "What repeats",
        HEAD,
        note='Settling times: proposed / conventional control. Reasons: the chapter "What does not '
        'reproduce, and why". Fig. 1 to 3 of paper A and 1 to 3 of paper B are block diagrams and '
        "test benches: docs/papers.md.",
    )
    order: Dict[str, List[str]] = {n: row_of(a, "A-fig4-numbers", n) for n in ("d_w",)}
    d_w = order["d_w"]
    out.add(
        "A, Fig. 4: d_w with N_d = 0 and 2 [ms]",
        f"{d_w[0]} / {d_w[6]}",
        f"{d_w[1]}; {d_w[7]}",
        f"{d_w[2]}; {d_w[8]}",
        "no: the order hardly acts, with any weights that converge",
    )
    for number, words in FIGURES_A.items():
        row = row_of(a, f"A-fig{number}-numbers", "speed within 1 % [ms]")
        out.add(
            f"A, Fig. {number}: speed [ms]", *(f"{row[k]} / {row[k + 1]}" for k in (0, 2, 4)), words
        )
    rows = [row_of(a, "A-table3", n) for n in ("load step, 200/150 %", "speed step")]
    out.add(
        "A, Table 3: d_w of rows 2 and 3",
        *(" / ".join(r[k] for r in rows) for k in (0, 1)),
        "-",
        "row 2 yes; row 3 is that of a motor that is known",
    )
    for words, name, verdict in ROWS_B:
        row = row_of(b, "B-tables", name)
        out.add(f"B, {words}", row[9], row[10], row[11], verdict)
    row = row_of(b, "B-fig8-numbers", "CDOBC")
    out.add(
        "B, Fig. 8: CDOBC's estimate, I and III [V]",
        f"{row[0]} / {row[2]}",
        f"{row[1]} / {row[3]}",
        "-",
        "no: 20 V are 1.04 N m, not 1.5",
    )
    row = row_of(b, "B-theorem1", "repaired, N = 2")
    out.add(
        "B, Theorem 1: bound, 25 Hz [r/min]",
        "exists",
        row[2],
        row[4],
        "the bound is small for the repaired poles, useless for the printed",
    )
    return Section("summary", "Summary", "", [out])
