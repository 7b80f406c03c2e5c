#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The cycles in docs/hardware.md and host_tools/drive/cycle_budget.hpp, from docs/budget.json.

    tables.py write    rewrites the tables between the markers, and the header
    tables.py check    exit code 1: a table or the header is not that of the JSON, or the default
                       drive costs more than its ceiling

./dev budget record makes the JSON and writes both.
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
HEADER = ROOT / "host_tools/drive/cycle_budget.hpp"
SHIPPED = "noc"
COLUMNS = {
    "noc_speed": "speed form",
    "noc": "encoder form",
    "noc, position": "encoder form, position",
    "noc, torque": "encoder form, torque",
    "noc_h": "`noc_h`",
    "noc_shaft": "`noc_shaft`",
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


PRICED = ("noc_speed", "noc", "noc_h", "noc_shaft", "conventional")


def more(f, what):
    """Cycles more on the way to a position, or with a torque."""
    return f["whole_period"][f"noc, {what}"][1] - f["whole_period"]["noc"][1]


def frequencies(f, background):
    """EQ-BOARD-6: with one update in a PWM period, in kHz."""
    rows = []
    for text, added in (("without both", 0), ("with `[position]`", more(f, "position"))):
        spent = [dearest(f, column)[1] + added for column in PRICED]
        rows.append(
            [text, *(f"{1e-3 * CLOCK_Hz * (1 - background) / cycles:.1f}" for cycles in spent)]
        )
    torque = dearest(f, "noc")[1] + more(f, "torque")
    alone = f"{1e-3 * CLOCK_Hz * (1 - background) / torque:.1f}"
    rows.insert(
        1,
        ["with `[torque]`", *(alone if column == "noc" else "" for column in PRICED)],
    )
    return table(["highest PWM frequency in kHz", *(COLUMNS[column] for column in PRICED)], rows)


def header(f, background):
    """The budget for pwm_frequency.cpp."""
    numbers = {law: f"{dearest(f, law)[1]}.0;" for law in PRICED}
    numbers["position"] = f"{more(f, 'position')}.0;"
    numbers["torque"] = f"{more(f, 'torque')}.0;"
    numbers["background_share"] = f"{background!r};"
    width = max(map(len, numbers))
    lines = [
        "// SPDX-License-Identifier: MIT",
        "// Generated from docs/budget.json. Do not edit: ./dev budget record.",
        "/// Upper ends of a whole period's cycles, the dearer of a run's first and the others.",
        "/// `position` is more on the way to a position. `torque` is more with one.",
        "#pragma once",
        "",
        "namespace sdre::cycle_budget {",
        "",
        *(f"constexpr double {name:{width}} = {number}" for name, number in numbers.items()),
        "",
        "} // namespace sdre::cycle_budget",
    ]
    return "\n".join(lines) + "\n"


def memory(f):
    words = {law: f["memory"][law] for law in ("noc_speed", "noc", "noc_h", "noc_shaft")}
    rows = [[name, *(str(w[name]) for w in words.values())] for name in words["noc"]]
    return table(["words", *(COLUMNS[law] for law in words)], rows)


def filled(page, f, costs):
    """The page with every table as the figures have it."""
    tables = {
        "limits": limits(f, costs.limits),
        "laws": laws(f),
        "features": features(f),
        "operations": operations(f),
        "memory": memory(f),
        "frequencies": frequencies(f, costs.background),
    }
    marked = re.compile(r"(<!-- budget (\w+) -->\n).*?(<!-- end -->)", re.S)
    if sorted(name for _, name, _ in marked.findall(page)) != sorted(tables):
        raise ValueError(
            f"docs/hardware.md needs one pair of markers for each of: {', '.join(tables)}"
        )
    return marked.sub(lambda m: f"{m[1]}\n{tables[m[2]]}\n\n{m[3]}", page)


def write():
    costs, recorded = Costs(), json.loads(RECORDED.read_text())
    PAGE.write_text(filled(PAGE.read_text(), recorded, costs))
    HEADER.write_text(header(recorded, costs.background))


def main(command):
    if command == "write":
        write()
        return 0
    page, costs, recorded = PAGE.read_text(), Costs(), json.loads(RECORDED.read_text())
    same = {
        "docs/hardware.md": page == filled(page, recorded, costs),
        "host_tools/drive/cycle_budget.hpp": HEADER.exists()
        and HEADER.read_text() == header(recorded, costs.background),
    }
    for name, good in same.items():
        print(
            f"ok   {name} has the cycles of docs/budget.json"
            if good
            else f"FAIL {name} has other cycles than docs/budget.json: "
            "tests/target/budget/tables.py write"
        )
    if wrong := exceeds(recorded, SHIPPED):
        print(
            f"FAIL docs/budget.json, whole period of the default drive: {wrong}; "
            "what costs more becomes an option"
        )
    return 0 if all(same.values()) and not wrong else 1


if __name__ == "__main__":
    if sys.argv[1:] not in (["write"], ["check"]):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
