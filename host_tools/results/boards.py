#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The table of boards around the F28335 in docs/hardware.md, from firmware/config/boards.

    boards.py write    rewrites the table between its markers
    boards.py check    exit code 1: the table is not that of the board files

Values that follow from a board stand below its own.
"""

import math
import re
import sys
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/hardware.md"
MARKS = re.compile(r"(<!-- boards -->\n).*?(<!-- end -->)", re.S)
CODES = 4096  # of the converter
FULL_V = 3.0  # its full scale
NTC_CODES = (512, 3968)  # ends of the table, host_tools/design/board/board_constants.cpp


def read():
    files = sorted((ROOT / "firmware/config/boards").glob("*.toml"))
    boards = [tomllib.loads(file.read_text()) for file in files]
    return [board for board in boards if board.get("processor", "f28335") == "f28335"]


def temperature_degC(board, code):
    """EQ-BOARD-4."""
    r_Ohm = board["ntc_divider_Ohm"] * code / (CODES - code)
    per_K = 1 / 298.15 + math.log(r_Ohm / board["ntc_resistance_Ohm"]) / board["ntc_beta_K"]
    return 1 / per_K - 273.15


DERIVED = {
    "current of a code": lambda b: f"{2e3 * b['current_range_A'] / CODES:.2f} mA",
    "voltage of a code": lambda b: f"{b['dc_link_range_V'] / CODES:.2f} V",
    "divider of the dc link": lambda b: f"1/{b['dc_link_range_V'] / FULL_V:g}",
    "temperatures": lambda b: (
        f"{temperature_degC(b, NTC_CODES[1]):.0f} .. {temperature_degC(b, NTC_CODES[0]):.0f} degC"
    ),
}


def table(boards):
    keys = [key for key in boards[0] if key not in ("schema", "name")]
    lines = [
        ["", *(board["name"] for board in boards)],
        ["---", *("---:" for _ in boards)],
        *([f"`{key}`", *(f"{board[key]:g}" for board in boards)] for key in keys),
        *([name, *(of(board) for board in boards)] for name, of in DERIVED.items()),
    ]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def main():
    if sys.argv[1:] not in (["write"], ["check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    text = PAGE.read_text()
    if len(MARKS.findall(text)) != 1:
        print(f"{PAGE.name}: not one table between <!-- boards --> and <!-- end -->")
        return 1
    new = MARKS.sub(lambda m: m[1] + "\n" + table(read()) + "\n" + m[2], text)
    if sys.argv[1] == "write":
        PAGE.write_text(new)
    elif new != text:
        print(f"{PAGE.name}: the table of boards is stale: host_tools/results/boards.py write")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
