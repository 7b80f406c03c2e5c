# SPDX-License-Identifier: MIT
"""Compares the table of rooms in docs/architecture.md with the sdre_room() calls of host_tools."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HOST = ROOT / "host_tools"
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


def main() -> int:
    """Prints each room whose row is missing or wrong."""
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
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong or not cmake else 0


if __name__ == "__main__":
    sys.exit(main())
