# SPDX-License-Identifier: MIT
"""docs/troubleshooting.md from faults.toml: `python3 -m sdre_drive.troubleshooting > ../../docs/troubleshooting.md`."""

from __future__ import annotations

from typing import Iterator

from sdre_drive.faults import GROUPS, Entry, Recipe, table
from sdre_drive.registers import BY_NAME

HEAD = """# Troubleshooting

What the drive reports, in plain words. Generated from `host_tools/python/sdre_drive/faults.toml`, which `sdre-drive` and its page use
too (`python3 -m sdre_drive.troubleshooting` in `host_tools/python`); `docs.faults` compares both with the firmware.

Read the numbers with `sdre-drive faults`, or from the registers: docs/modbus.md. Before anything is touched: docs/hardware.md, "Safety
first".

"Virtual drive" says how to see an entry without hardware: `./dev serve`, `sdre-drive run .. --radps` at the speed that stands there, then
the lines to the control port (127.0.0.1:1503) or the same from the page (`sdre-drive ui`); `mend` makes it whole again, `sdre-drive reset` leaves the fault.
"""



def _at(name: str) -> int:
    return BY_NAME[name].address


TITLES = {
    "application": ("Faults", f"Register {_at('FAULT')}; {_at('FIRST_FAULT')} of the first fault."),
    "drive": ("Drive faults", f"Register {_at('DRIVE_FAULT')}, or {_at('FIRST_DRIVE_FAULT')}, when the fault is 10."),
    "board": ("Board faults", f"Bits of register {_at('BOARD_FAULTS')}, or {_at('FIRST_BOARD_FAULTS')}, when the fault is 2."),
    "condition": ("Conditions", f"Bits of register {_at('CONDITIONS')}. They keep a drive from starting or tell what limits it; none of them is latched but 2."),
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
    yield "- May be: " + "; ".join(entry.causes) + "."
    yield "- Look at: " + "; ".join(entry.check) + "."
    virtual = how(entry.reproduce) if isinstance(entry.reproduce, Recipe) else entry.reproduce
    yield f"- Virtual drive: {virtual}."
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
