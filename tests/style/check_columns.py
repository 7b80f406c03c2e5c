# SPDX-License-Identifier: MIT
"""Lines of the firmware have at most 100 columns.

Generated files are left out. The counts below only fall.
"""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 100  # of .clang-format, which leaves comments as they are
GENERATED = {
    "firmware/app/canopen/app_canopen_map.c",
    "firmware/app/canopen/app_canopen_map.h",
    "firmware/app/registers/app_registers_map.c",
    "firmware/app/trace/app_scope_signals.c",
    "firmware/config/board_config.c",
    "firmware/config/stm32g431/board_config.c",
}
ALLOWED = {"commission": 14}  # lines of a room that are longer; other rooms: none


def long_lines():
    listed = subprocess.run(
        ["git", "ls-files", "firmware/*.c", "firmware/*.h"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    for name in listed:
        if name not in GENERATED and (ROOT / name).exists():
            lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
            yield from ((name, n) for n, line in enumerate(lines, 1) if len(line) > COLUMNS)


def main():
    rooms = {}
    for name, number in long_lines():
        rooms.setdefault(name.split("/")[1], []).append(f"{name}:{number}")
    status = 0
    for room in sorted(rooms):
        found, allowed = rooms[room], ALLOWED.get(room, 0)
        if len(found) > allowed:
            print(f"firmware/{room}: {len(found)} lines above {COLUMNS} columns, allowed {allowed}")
            print(*found, sep="\n")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
