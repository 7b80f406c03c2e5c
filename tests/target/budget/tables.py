#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The cycles in docs/hardware.md, from docs/budget.json.

    tables.py write    rewrites the tables between the markers
    tables.py check    exit code 1: a table is not that of the JSON, or the default drive costs
                       more than its ceiling

./dev budget record makes the JSON and writes the tables.
"""

import json
import re
import sys
from pathlib import Path

from costs import Costs
from report import OPERATIONS, dearest, exceeds, share, span, verdict

ROOT = Path(__file__).resolve().parents[3]
RECORDED = ROOT / "docs/budget.json"
PAGE = ROOT / "docs/hardware.md"
CLOCK_Hz = 150e6
# share of a period that stays for the background, as in host_tools/drive/pwm_frequency.cpp
BACKGROUND = 0.15
SHIPPED = "noc"
COLUMNS = {
    "noc_speed": "speed form",
    "noc": "encoder form",
    "noc, position": "encoder form, position",
    "noc_h": "`noc_h`",
    "noc_10khz": "encoder form, 10 kHz",
    "PI-FOC": "PI-FOC",
    "conventional": "`conventional_noc`",
}


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def limits(f, goals):
    rows = []
    for column, limit in goals.items():
        spent = dearest(f, column)
        cells = [
            f"{limit[k]}, {verdict(spent[1], limit[k])}" if k in limit else ""
            for k in ("goal", "step")
        ]
        rows.append(
            [COLUMNS[column], span(spent), share(spent, f["period_cycles"][column]), *cells]
        )
    return table(["whole period", "cycles", "share", "goal", "step"], rows)


def laws(f):
    found, first = {kind: f["law"][kind] for kind in COLUMNS}, f["whole_period"]
    rows = [
        ["law", *(span(law["cycles"]) for law in found.values())],
        [
            "share of the period",
            *(share(law["cycles"], f["period_cycles"][kind]) for kind, law in found.items()),
        ],
        ["whole period", *(span(f["whole_period"][kind]) for kind in found)],
        [
            "whole period that starts a run",
            *(span(first[k]) if (k := f"{kind}, start") in first else "" for kind in found),
        ],
        [
            "law with the plain library's division, at most",
            *(str(law["plain_division"]) for law in found.values()),
        ],
        [
            "dearest way through the law",
            *(span(f["bound"][kind]) if kind in f["bound"] else "" for kind in found),
        ],
        [
            "instructions on the Cortex-M4F, worst",
            *(str(law["instructions"][0]) for law in found.values()),
        ],
        ["the same, mean", *(str(law["instructions"][1]) for law in found.values())],
    ]
    return table(["cycles", *COLUMNS.values()], rows)


def features(f):
    kinds = [kind for kind in COLUMNS if kind != "PI-FOC"]
    names = list(
        dict.fromkeys(name for kind in ("noc", "noc_h", *kinds) for name in f["features"][kind])
    )
    rows = [[name, *(str(f["features"][kind].get(name, "")) for kind in kinds)] for name in names]
    rows.append(["sum", *(str(sum(f["features"][kind].values())) for kind in kinds)])
    return table(["feature", *(COLUMNS[kind] for kind in kinds)], rows)


def operations(f):
    kinds = list(COLUMNS)
    rows = [
        [
            name,
            *(str(f["law"][kind]["operations"][name]) for kind in kinds),
            str(f["application"]["operations"][name]),
        ]
        for name in OPERATIONS
    ]
    rows = [row for row in rows if set(row[1:]) != {"0"}]
    return table(["operations", *COLUMNS.values(), "application"], rows)


def frequencies(f):
    """EQ-BOARD-6: with one update in a PWM period, in kHz."""
    laws = ("noc_speed", "noc", "noc_h", "conventional")
    more = f["whole_period"]["noc, position"][1] - f["whole_period"]["noc"][1]
    rows = []
    for text, added in (("without positions", 0), ("with `[position]`", more)):
        spent = [dearest(f, column)[1] + added for column in laws]
        rows.append(
            [text, *(f"{1e-3 * CLOCK_Hz * (1 - BACKGROUND) / cycles:.1f}" for cycles in spent)]
        )
    return table(["highest PWM frequency in kHz", *(COLUMNS[column] for column in laws)], rows)


def memory(f):
    words = {law: f["memory"][law] for law in ("noc_speed", "noc", "noc_h")}
    rows = [[name, *(str(w[name]) for w in words.values())] for name in words["noc"]]
    return table(["words", *(COLUMNS[law] for law in words)], rows)


def filled(page, f, goals):
    """The page with every table as the figures have it."""
    tables = {
        "limits": limits(f, goals),
        "laws": laws(f),
        "features": features(f),
        "operations": operations(f),
        "memory": memory(f),
        "frequencies": frequencies(f),
    }
    marked = re.compile(r"(<!-- budget (\w+) -->\n).*?(<!-- end -->)", re.S)
    if sorted(name for _, name, _ in marked.findall(page)) != sorted(tables):
        raise ValueError(
            f"docs/hardware.md needs one pair of markers for each of: {', '.join(tables)}"
        )
    return marked.sub(lambda m: f"{m[1]}\n{tables[m[2]]}\n\n{m[3]}", page)


def write():
    PAGE.write_text(filled(PAGE.read_text(), json.loads(RECORDED.read_text()), Costs().limits))


def main(command):
    if command == "write":
        write()
        return 0
    page, figures = PAGE.read_text(), json.loads(RECORDED.read_text())
    good = page == filled(page, figures, Costs().limits)
    print(
        "ok   docs/hardware.md has the tables of docs/budget.json"
        if good
        else "FAIL docs/hardware.md has other tables than docs/budget.json: "
        "tests/target/budget/tables.py write"
    )
    if wrong := exceeds(figures, SHIPPED):
        print(
            f"FAIL docs/budget.json, whole period of the default drive: {wrong}; "
            "what costs more becomes an option"
        )
    return 0 if good and not wrong else 1


if __name__ == "__main__":
    if sys.argv[1:] not in (["write"], ["check"]):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
