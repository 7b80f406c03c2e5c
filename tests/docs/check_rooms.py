# SPDX-License-Identifier: MIT
"""Compares the table of rooms in docs/architecture.md with the sdre_room() calls of host_tools.
No circle of calls or of includes between files of the firmware. A single law is named in its own
rooms only: the others ask its LawDesign."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HOST = ROOT / "host_tools"
ABOVE_BOARD = ("firmware/app", "firmware/store", "firmware/commission", "firmware/control")
LAWS = ("drive/", "design/laws/", "tune/start_weights.cpp")  # the last makes a drive of law noc
FIRMWARE = {"control_core", "drive_app", "drive_app_headers", "drive_image", "commission"}


def linked(name: str) -> str:
    """Name of a target in the table; empty for what is neither a room nor firmware."""
    if name in FIRMWARE:
        return "firmware"
    return "f28335" if name == "f28335_model" else name[5:] if name.startswith("sdre_") else ""


def rooms_of_cmake() -> dict:
    """Directory of each room and the names that it uses."""
    found = {}
    for file in HOST.rglob("CMakeLists.txt"):
        for name, uses in re.findall(
            r"^sdre_room\((\w+)\s[^)]*?(?:USES([^)]*))?\)", file.read_text(encoding="utf-8"), re.M
        ):
            place = file.parent if file.parent.name == name else file.parent / name
            found[place.relative_to(HOST).as_posix()] = {linked(one) for one in uses.split()} - {""}
    return found


def rooms_of_page() -> dict:
    """The same from the page."""
    text = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    table = text.split("## Rooms of the host tools")[1].split("\n## ")[0]
    rows = re.findall(r"^\| ([\w/]+) \|[^|]*\| ([^|]*) \|$", table, re.M)
    return {name: set(re.findall(r"\w+", uses)) for name, uses in rows if name != "room"}


def code_of(file: Path) -> str:
    """A C file without comments and strings."""
    text = re.sub(r"/\*.*?\*/", "", file.read_text(encoding="utf-8"), flags=re.S)
    return re.sub(r'"[^"\n]*"', "", text)


def calls() -> dict:
    """Each .c file of the firmware above board.h, and the files whose functions it names."""
    code = {p: code_of(p) for room in ABOVE_BOARD for p in (ROOT / room).rglob("*.c")}
    definition = re.compile(r"^(?!static|typedef)\w[\w \*]*?\b(\w+)\([^;{}]*\)\n\{", re.M)
    home = {name: p for p, text in code.items() for name in definition.findall(text)}
    return {
        p: {home[w] for w in set(re.findall(r"\w+", text)) if home.get(w, p) != p}
        for p, text in code.items()
    }


def includes() -> dict:
    """Each header of the firmware above board.h, and the headers that it includes."""
    headers = {p.name: p for room in ABOVE_BOARD for p in (ROOT / room).rglob("*.h")}
    named = re.compile(r'#include "(\w+\.h)"')
    return {
        p: {headers[n] for n in named.findall(p.read_text(encoding="utf-8")) if n in headers}
        for p in headers.values()
    }


def circles(uses: dict) -> list:
    """The files on a circle, or between two. Those at either end of a chain are taken away."""
    left = {p: set(q) for p, q in uses.items()}
    while True:
        used = set().union(*left.values()) if left else set()
        free = [p for p in left if not left[p] & left.keys() or p not in used]
        if not free:
            return sorted(left)
        for p in free:
            del left[p]


def laws_elsewhere() -> list:
    """The host's files that name a single law and have another way to ask for what it can do."""
    files = [p for p in HOST.rglob("*.[ch]pp") if "Law::" in p.read_text(encoding="utf-8")]
    return sorted(p for p in files if not p.relative_to(HOST).as_posix().startswith(LAWS))


def main() -> int:
    """Prints each room whose row is missing or wrong, and each file on a circle."""
    cmake, page = rooms_of_cmake(), rooms_of_page()
    wrong = [
        f"{name}: docs/architecture.md has no row of it, it uses {', '.join(sorted(uses)) or '-'}"
        for name, uses in sorted(cmake.items())
        if name not in page
    ]
    wrong += [
        f"{name}: docs/architecture.md says {sorted(page[name])}, CMakeLists.txt {sorted(uses)}"
        for name, uses in sorted(cmake.items())
        if page.get(name, uses) != uses
    ]
    wrong += [
        f"{name}: docs/architecture.md has a row of it, host_tools no such directory"
        for name in sorted(page)
        if not (HOST / name).is_dir()
    ]
    for kind, uses in (("calls", calls()), ("includes", includes())):
        wrong += [f"{p.relative_to(ROOT)} is on a circle of {kind}" for p in circles(uses)]
    wrong += [
        f"{p.relative_to(ROOT)} names a law: ask law_design() instead" for p in laws_elsewhere()
    ]
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong or not cmake else 0


if __name__ == "__main__":
    sys.exit(main())
