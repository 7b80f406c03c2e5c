# SPDX-License-Identifier: MIT
"""docs/troubleshooting.md from faults.toml, printed by `python3 -m sdre_drive.troubleshooting`."""

from __future__ import annotations

from typing import Iterator

from sdre_drive.faults import GROUPS, Entry, Recipe, table
from sdre_drive.registers import BY_NAME

HEAD = """# Troubleshooting

This page explains every fault and condition of the drive. \
Read [Safety first](hardware.md#safety-first) before you touch anything.
`sdre-drive faults` reads the numbers, and so do the registers ([modbus.md](modbus.md)).

"Virtual drive" shows an entry without hardware:

1. Start `./dev serve`.
2. Run `sdre-drive run .. --radps` at the speed of the entry.
3. Give the lines to `sdre-drive bench`, or use the page (`sdre-drive ui`).
4. `mend` repairs the drive, and `sdre-drive reset` leaves the fault.

`python3 -m sdre_drive.troubleshooting` in `host_tools/python` writes this page \
from `sdre_drive/faults.toml`. \
`sdre-drive` and its
page use the same table. Test `docs.faults` compares both with the firmware.
"""


def _at(name: str) -> int:
    return BY_NAME[name].address


TITLES = {
    "application": ("Faults", f"Register {_at('FAULT')}; {_at('FIRST_FAULT')} of the first fault."),
    "drive": (
        "Drive faults",
        f"Register {_at('DRIVE_FAULT')}, or {_at('FIRST_DRIVE_FAULT')}, when the fault is 10.",
    ),
    "board": (
        "Board faults",
        f"Bits of register {_at('BOARD_FAULTS')}, or {_at('FIRST_BOARD_FAULTS')}, when the fault "
        f"is 2.",
    ),
    "condition": (
        "Conditions",
        f"Bits of register {_at('CONDITIONS')}. A condition prevents a start or shows a limit. "
        f"Only 2 is latched.",
    ),
}


def how(recipe: Recipe) -> str:
    """A recipe in a line."""
    parts = [f"at {recipe.at_e_radps:g} rad/s"] if recipe.at_e_radps else []
    parts += [f"`{line}`" for line in recipe.bench]
    if recipe.then:
        parts.append(recipe.then)
    parts += [f"afterwards `{line}`" for line in recipe.restore]
    return ", ".join(parts)


def lines_of(entry: Entry) -> Iterator[str]:
    """One entry."""
    yield f"### {entry.number} {entry.name}"
    yield ""
    yield entry.meaning
    yield ""
    yield "Causes:"
    yield ""
    yield from (f"- {cause}" for cause in entry.causes)
    yield ""
    yield "Check:"
    yield ""
    yield from (f"- {one}" for one in entry.check)
    yield ""
    virtual = how(entry.reproduce) if isinstance(entry.reproduce, Recipe) else entry.reproduce
    yield f"Virtual drive: {virtual}."
    yield ""


def text() -> str:
    """The whole page."""
    out = [HEAD]
    for group in GROUPS:
        title, where = TITLES[group]
        out += [f"## {title}", "", where, ""]
        for entry in table()[group].values():
            out += lines_of(entry)
    return "\n".join(out).rstrip() + "\n"


if __name__ == "__main__":
    print(text(), end="")
