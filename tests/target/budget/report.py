# SPDX-License-Identifier: MIT
"""The figures of a budget as plain numbers, and as tables."""

import json
from collections import Counter

from machine_code import linked_sizes, section_sizes, stack_depth
from origin import FLASH

OPERATIONS = {
    "add, subtract": ("fp_add",),
    "multiply": ("fp_mul",),
    "divide": ("fp_div", "estimate"),
    "square root": ("fp_sqrt",),
    "compare": ("fp_compare", "fp_flags"),
    "choose after a comparison": ("select",),
    "limit in one instruction": ("limit",),
    "move, negate, convert": ("fp_move", "fp_convert", "fp_mac"),
    "constant": ("constant",),
    "load": ("load",),
    "store": ("store",),
    "float register to and from memory": ("spill",),
    "integer": ("integer", "int_div"),
    "branch": ("branch", "taken", "not_taken"),
    "call and return": ("call", "return", "memset", "memcpy"),
    "sine, cosine": ("sinf", "cosf"),
    "minimum, maximum called": ("fminf", "fmaxf"),
    "words set or copied in calls": ("word_set", "word_copied"),
    "beyond seven words": ("far",),
}
BOARD = "interrupt and board"


def operations(costs, counts):
    plain = Counter()
    for name, n in counts.items():
        plain[name.removesuffix(FLASH)] += n
    named = {name for names in OPERATIONS.values() for name in names} | costs.board
    assert set(plain) <= named, set(plain) - named
    return {text: sum(plain[name] for name in names) for text, names in OPERATIONS.items()}


def by_feature(costs, *parts):
    """{feature: cycles}, dearest first; calls of board.h stand with the interrupt."""
    result = Counter({BOARD: costs.interrupt})
    for part in parts:
        for feature, counts in part.items():
            board = {name: n for name, n in counts.items() if name in costs.board}
            result[BOARD] += costs.cycles(board)
            result[feature] += costs.cycles(counts) - costs.cycles(board)
    return {
        name: round(cycles)
        for name, cycles in sorted(result.items(), key=lambda item: (-item[1], item[0]))
        if round(cycles)
    }


def figures(costs, replays, apps, shipped):
    """All of it, for json: spans are both ends of the band in cycles, features the middle."""
    app = apps[shipped]
    result = {
        "band_percent": round(100 * costs.band),
        "target_percent": round(100 * costs.target_share),
        "whole_period": {},
        "law": {},
        "bound": {},
        "features": {},
        "period_cycles": {},
        "scenarios": {},
        "application": {
            "cycles": costs.span(costs.cycles(app.counts)),
            "operations": operations(costs, app.counts),
            "flash": round(costs.in_flash(app.counts)),
            "interrupt": costs.interrupt,
        },
    }
    for r in replays.values():
        around = costs.cycles(apps[r.law].counts) + costs.interrupt
        result["bound"][r.name] = costs.span(costs.cycles(r.bound))
        result["scenarios"] |= {
            f"{r.name}: {run}": [w.instructions, round(w.cycles)] for run, w in r.by_run.items()
        }
        for kind, worst in r.kinds.items():
            counts = r.counts[kind]
            result["period_cycles"][kind] = costs.clock_Hz // r.rate_Hz
            result["whole_period"][kind] = costs.span(costs.cycles(counts) + around)
            result["features"][kind] = by_feature(costs, r.features(kind), apps[r.law].features)
            result["law"][kind] = {
                "cycles": costs.span(costs.cycles(counts)),
                "plain_division": costs.slow(counts),
                "where": worst.where,
                "operations": operations(costs, counts),
                "instructions": [worst.instructions, round(worst.total / worst.ticks)],
            }
    return result


def memory(prefix, target, replays):
    """Words, estimated from the Cortex-M4F's objects: two octets are one C28x word."""
    constants = section_sizes(prefix, f"{target}/firmware/libgain_tables.a")
    result = {"gain table of the shipped drive": (constants["text"] + constants["rodata"]) // 2}
    for r in replays.values():
        sizes = linked_sizes(prefix, f"{target}/firmware/libcontrol_core.a", r.image)
        result[r.name] = {
            "flash: core": sizes["flash"] // 2,
            "RAM: drive_t": r.table["drive"][1] // 2,
            "RAM: other data of the core": sizes["data"] // 2,
            "RAM: stack of drive_tick": stack_depth(r.code, "drive_tick") // 2,
        }
    return result


def dearest(f, column):
    """Whole period of a column, that which starts a run included."""
    return max(
        (f["whole_period"][k] for k in (column, f"{column}, start") if k in f["whole_period"]),
        key=lambda ends: ends[1],
    )


def text(f):
    """The figures as JSON, a line for each entry of a part."""
    parts = []
    for name, part in f.items():
        if isinstance(part, dict) and part:
            inner = ",\n".join(
                f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in part.items()
            )
            parts.append(f" {json.dumps(name)}: {{\n{inner}\n }}")
        else:
            parts.append(f" {json.dumps(name)}: {json.dumps(part)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def exceeds(f, shipped):
    """Error of a record, or an empty text: the default drive never costs more than its ceiling."""
    spent, ceiling = dearest(f, shipped)[1], f.get("ceiling")
    if ceiling is None:
        return "no ceiling of the default drive"
    return f"{spent} cycles, its ceiling is {ceiling}" if spent > ceiling else ""


def verdict(cycles, most):
    return "met" if cycles <= most else f"missed by {100 * (cycles / most - 1):.0f} %"


def print_table(title, columns, rows):
    print(f"\n{title}")
    width = max(len(row[0]) for row in rows) + 2
    widths = [max(len(c), *(len(row[n + 1]) for row in rows)) + 3 for n, c in enumerate(columns)]
    for cells in (("", *columns), *rows):
        print(cells[0].ljust(width) + "".join(c.rjust(w) for c, w in zip(cells[1:], widths)))


def span(ends):
    return f"{ends[0]} .. {ends[1]}"


def share(ends, period):
    return f"{100 * ends[0] / period:.1f} .. {100 * ends[1] / period:.1f} %"


def show(f):
    laws, app, period = f["law"], f["application"], f["period_cycles"]
    rows = [
        (
            text,
            *(str(law["operations"][text]) for law in laws.values()),
            str(app["operations"][text]),
        )
        for text in OPERATIONS
    ]
    rows += [
        ("cycles", *(span(law["cycles"]) for law in laws.values()), span(app["cycles"])),
        (
            "  share of the period",
            *(share(law["cycles"], period[kind]) for kind, law in laws.items()),
            "",
        ),
        ("  with plain division", *(str(law["plain_division"]) for law in laws.values()), ""),
        ("whole period", *(span(f["whole_period"][kind]) for kind in laws), ""),
        (
            "  share of the period",
            *(share(f["whole_period"][kind], period[kind]) for kind in laws),
            "",
        ),
        ("Cortex-M4F, instructions", *(str(law["instructions"][0]) for law in laws.values()), ""),
        ("  mean", *(str(law["instructions"][1]) for law in laws.values()), ""),
    ]
    print_table(
        f"Dearest tick, operations and estimated C28x cycles (+-{f['band_percent']} %)",
        [*laws, "application"],
        rows,
    )
    for kind, law in laws.items():
        print(f"  {kind}: {law['where']}")
    print(
        "  application: dearest of app_tick() on host_stub while the law runs, without the core, "
        "with the calls of board.h;"
    )
    print(
        f"  {app['flash']} of its cycles are instructions from the flash; interrupt around it: "
        f"{app['interrupt']} cycles"
    )

    kinds = list(f["features"])
    names = list(dict.fromkeys(name for kind in kinds for name in f["features"][kind]))
    rows = [(name, *(str(f["features"][kind].get(name, "")) for kind in kinds)) for name in names]
    rows.append(("sum", *(str(sum(f["features"][kind].values())) for kind in kinds)))
    print_table("Cycles of the whole period by feature, middle of the band", kinds, rows)

    rows = [(name, span(ends), share(ends, period[name])) for name, ends in f["bound"].items()]
    print_table(
        "Dearest way through the compiled law, whether or not anything can take it",
        ["cycles", "share"],
        rows,
    )
    rows = [(name, *(str(n) for n in pair)) for name, pair in f["scenarios"].items()]
    print_table(
        "Worst after the start, per scenario (nd3: order 3)", ["instructions", "C28x cycles"], rows
    )
    if words := f.get("memory"):
        print(f"\nWords of memory: {words}")
    for kind, law in laws.items():
        most = f["target_percent"] * period[kind] // 100
        print(
            f"  target of {most} cycles ({f['target_percent']} %), {kind} without the application: "
            f"{verdict(law['cycles'][1], most)}"
        )
