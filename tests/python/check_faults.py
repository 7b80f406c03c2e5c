# SPDX-License-Identifier: MIT
"""The table of faults and docs/troubleshooting.md against the firmware. Standard library alone."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Dict, List

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "host_tools/python"))

from sdre_drive import faults, registers, troubleshooting  # noqa: E402


def enumerators(file: str, prefix: str, first: str) -> Dict[str, int]:
    """Names without their prefix, and values, of the enum of `file` that begins with `first`."""
    source = re.sub(
        r"/\*.*?\*/", "", (ROOT / "firmware" / file).read_text(encoding="utf-8"), flags=re.S
    )
    body = re.search(r"enum\s*\{([^}]*\b" + prefix + first + r"\b[^}]*)\}", source)
    assert body, f"{file}: no enum with {prefix}{first}"
    out: Dict[str, int] = {}
    for item in filter(None, map(str.strip, body.group(1).split(","))):
        name, _, value = (part.strip() for part in item.partition("="))
        previous = list(out.values())[-1] if out else -1
        assert name.startswith(prefix), f"{file}: {name}"
        base, _, more = value.rpartition("+")  # a number, or an earlier name and a number
        start = out[base.strip()[len(prefix) :]] if base else 0
        out[name[len(prefix) :]] = start + int(more) if value else previous + 1
    return out


def told(what: str, firmware: Dict[str, int], here: Dict[str, int]) -> List[str]:
    """Differences in words."""
    return [
        f"{what}: {name} is {firmware.get(name)} in the firmware and {here.get(name)} here"
        for name in sorted(firmware.keys() | here.keys())
        if firmware.get(name) != here.get(name)
    ]


def differences() -> List[str]:
    """All of them."""
    enums = {
        "application": enumerators("app/app_status.h", "APP_FAULT_", "NONE"),
        "drive": enumerators("control/drive_tick.h", "DRIVE_FAULT_", "NONE"),
        "board": enumerators("board/board.h", "BOARD_FAULT_", "NONE"),
        "condition": enumerators("app/registers/app_registers.h", "APP_REGISTERS_", "HOT"),
    }
    found: List[str] = []
    for group, firmware in enums.items():
        firmware.pop("NONE", None)
        found += told(group, firmware, {e.name: e.number for e in faults.table()[group].values()})
    found += told(
        "mode",
        enumerators("app/app_status.h", "APP_MODE_", "BOOT"),
        {m.name: m.value for m in registers.Mode},
    )
    for group in faults.GROUPS:
        for e in faults.table()[group].values():
            if not (e.meaning and e.causes and e.check and e.reproduce):
                found.append(f"{group} {e.number}: says too little")
    if (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8") != troubleshooting.text():
        found.append("docs/troubleshooting.md is not what sdre_drive.troubleshooting writes")
    return found


if __name__ == "__main__":
    all_found = differences()
    print("\n".join(all_found) or "the table of faults is that of the firmware")
    sys.exit(1 if all_found else 0)
