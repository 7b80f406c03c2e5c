# SPDX-License-Identifier: MIT
"""The recorded figures as the pages show them."""

import re

import plane
from experiments import FIELDS, ROOT
from plane_picture import svg

PAGES = ("README.md", "docs/assurance.md", "docs/papers.md", "docs/results.md")
PICTURES = {"docs/plots/plane.svg": "plane ipmsm_390w"}

# host_tools/sil/run/faults.hpp
APPLICATION, RESET = 100, 200


class Never(float):
    """A value that a run does not have, for example a settling time: it prints as a word."""

    def __format__(self, _):
        return "never"


def reason(code):
    """A fault by the numbers of docs/modbus.md."""
    if code == RESET:
        return "watchdog reset"
    if code > APPLICATION:
        return f"application {code - APPLICATION}"
    return f"drive {code}"


def fields(values):
    """Named values of a cell."""
    found = plane.fields(values["plane"]) if "plane" in values else {}
    trips = values.get("trips")
    if trips:
        after_s = trips["after_s"]
        found["reported"] = ", ".join(reason(code) for code in trips["codes"]) or "-"
        found["tripped"] = f"{values['faults']} of {trips['seeds']}"
        found["trip_ms"] = Never() if after_s is None else 1e3 * after_s
    for statistic, suffix in (("worst", ""), ("median", "_median"), ("best", "_best")):
        of = values.get(statistic, {})
        for name, (metric, factor) in FIELDS.items():
            if metric in of:
                found[name + suffix] = Never() if of[metric] is None else abs(factor * of[metric])
        found |= {
            name + suffix: of[name]
            for name in ("motors", "failed", "tripped", "good")
            if name in of
        }
    return found


def shown(form, values):
    """The text of a cell; what never happens has no unit."""
    return re.sub(r"never (ms|rad/s)", "never", form.format_map(fields(values)))


def table(experiments, recorded, name):
    """A Markdown table."""
    t = experiments.tables[name]
    lines = [
        [t["corner"], *(column["head"] for column in t["columns"])],
        ["---"] * (len(t["columns"]) + 1),
    ]
    for row in t["rows"]:
        cells = [row["label"]]
        for column in t["columns"]:
            cell = experiments.cell(row, column)
            if not isinstance(cell, str):
                values = recorded[f"{cell[0]} {cell[1]}"]
                known = "trips" in values or not values["faults"]
                cell = shown(cell[2], values) if known else "trips"
            cells.append(cell)
        lines.append(cells)
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def elsewhere(experiments):
    """A Markdown table of the figures that other commands make."""
    lines = [["figures", "command", "page"], ["---"] * 3]
    for what, (command, link) in experiments.elsewhere.items():
        page = link.partition("#")[0]
        lines.append([what, f"`{command}`", f"[{page}]({link})"])
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def pages(experiments, recorded):
    """(path, text as it is, text as it has to be)."""
    marked = re.compile(r"(<!-- results (\w+) -->\n).*?(<!-- end -->)", re.S)

    def block(m):
        name = m[2]
        made = elsewhere(experiments) if name == "elsewhere" else table(experiments, recorded, name)
        return f"{m[1]}\n{made}\n{m[3]}"

    for name in PAGES:
        text = (ROOT / name).read_text()
        yield (
            ROOT / name,
            text,
            marked.sub(block, text),
        )
    for name, run in PICTURES.items():
        path = ROOT / name
        yield path, path.read_text() if path.exists() else "", svg(recorded[run]["plane"])
