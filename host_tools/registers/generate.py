# SPDX-License-Identifier: MIT
"""Generates from firmware/app/registers/registers.toml: the firmware's map, its documentation as
tables and as CSV, the client's names, the tables of the page in a browser. CANopen objects too.

    python3 host_tools/registers/generate.py            writes what has changed
    python3 host_tools/registers/generate.py --check    says what would change; exit code 1 then
"""

from __future__ import annotations

import csv
import io
import json
import re
import sys
from pathlib import Path
from typing import Dict, List

sys.path.insert(0, str(Path(__file__).parent))

import canopen_map  # noqa: E402
from browser_tables import page_text  # noqa: E402
from c_map import header, source, types  # noqa: E402
from c_signals import signals_header, signals_source  # noqa: E402
from table import Fixed, Group, Register, Signal, TableError, fixed, read, signals  # noqa: E402
from versions import digest_of, require_different_ids, saved, version  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "firmware/app/registers/registers.toml"
MARK = "<!-- registers {name}: of firmware/app/registers/registers.toml -->"
END = "<!-- end -->"


def _range_words(r: Register) -> str:
    if r.signature:
        return f"{r.signature:08X}h"
    return f"{r.range[0]:g} .. {r.range[1]:g}" if r.range else ""


def words_of(r: Register) -> str:
    """Text and note of a register."""
    return f"{r.text}. {r.note}" if r.note else r.text


def table_text(group: Group) -> str:
    """A group for docs/modbus.md."""
    holding = group.space == "holding"
    head = (
        "| no. | name | type | unit | values | at start | |"
        if holding
        else "| no. | name | type | unit | |"
    )
    lines = [head, "|---" * (head.count("|") - 1) + "|"]
    for r in group.registers:
        middle = [_range_words(r), r.default] if holding else []
        text = "; ".join(
            filter(
                None,
                [
                    f"object {r.object}" if r.object else "",
                    r.text,
                    "only while stopped" if r.stopped else "",
                    "**parameter**" if r.saved else "",
                ],
            )
        )
        lines.append(
            "| "
            + " | ".join([r.numbers, f"`{r.name}`", r.type, r.unit_words, *middle, text])
            + " |"
        )
    notes = [f"- `{r.name}`: {r.note}" for r in group.registers if r.note]
    return "\n".join(lines + ([""] + notes if notes else []))


def signals_text(found: List[Signal]) -> str:
    """The signals for docs/modbus.md."""
    lines = ["| signal | | unit |", "|---|---|---|"]
    return "\n".join(lines + [f"| {s.number} | `{s.name}` | {s.unit} |" for s in found])


def documented(path: Path, tables: Dict[str, str]) -> str:
    """A page with new tables."""
    text = path.read_text(encoding="utf-8")
    for name, table in tables.items():
        mark = MARK.format(name=name)
        if mark not in text:
            raise TableError(f"{path.relative_to(ROOT)} has no place for {name}: {mark}")
        new = f"{mark}\n\n{table}\n\n{END}"
        text = re.sub(
            re.escape(mark) + r".*?" + re.escape(END), lambda _, n=new: n, text, count=1, flags=re.S
        )
    return text


def csv_text(groups: List[Group]) -> str:
    """Every value in a line."""
    out = io.StringIO()
    w = csv.writer(out, lineterminator="\n")
    w.writerow(
        [
            "space",
            "address",
            "registers",
            "name",
            "type",
            "step",
            "unit",
            "access",
            "least",
            "most",
            "default",
            "stopped",
            "saved",
            "object",
            "group",
        ]
    )
    for g in groups:
        for r in g.registers:
            low, high = (f"{x:g}" for x in r.range) if r.range else ("", "")
            w.writerow(
                [
                    g.space,
                    r.address,
                    r.words,
                    r.name,
                    r.type,
                    f"{r.step or 1:g}",
                    r.unit,
                    "rw" if g.space == "holding" else "r",
                    low,
                    high,
                    r.default,
                    int(r.stopped),
                    int(r.saved),
                    r.object,
                    g.name,
                ]
            )
    return out.getvalue()


def python_text(groups: List[Group], found: List[Signal]) -> str:
    """register_map.py of sdre_drive."""
    lines = [
        "# SPDX-License-Identifier: MIT",
        '"""Generated from firmware/app/registers/registers.toml. Do not edit: '
        'host_tools/registers/generate.py."""',
        "",
        "from __future__ import annotations",
        "",
        "from typing import NamedTuple, Optional, Tuple",
        "",
        "",
        "class Register(NamedTuple):",
        '    """One value: step is 0 for a whole number."""',
        "",
        "    name: str",
        "    address: int",
        "    type: str",
        "    step: float",
        "    unit: str",
        "",
        "",
        "class Parameter(NamedTuple):",
        '    """A parameter that is kept over power: range in its unit. No default means the '
        'largest."""',
        "",
        "    register: Register",
        "    low: float",
        "    high: float",
        "    default: Optional[float]",
        "    stopped: bool",
        "    object: str",
        "    text: str",
        "",
        "",
        f'DIGEST = "{digest_of(groups)}"',
        f'VERSION = "{version()}"',
        "",
    ]
    for g in groups:
        lines.append(f"{g.name.upper()}: Tuple[Register, ...] = (  # {g.space}")
        for r in g.registers:
            step = 0.0 if r.step is None else r.step
            lines.append(
                f'    Register("{r.name}", {r.address}, "{r.type}", {step!r}, "{r.unit}"),'
            )
        lines.append(")")
        lines.append("")
    for space in ("holding", "input"):
        lines.append(
            f"{space.upper()} = ("
            + ", ".join("*" + g.name.upper() for g in groups if g.space == space)
            + ")"
        )
    blocks = [g.name.upper() for g in groups if any(r.saved for r in g.registers)]
    lines += ["", "# Blocks that hold parameters.", f"PARAMETER_BLOCKS = ({', '.join(blocks)},)"]
    lines += [
        "",
        "BY_NAME = {r.name: r for r in (*HOLDING, *INPUT)}",
        "",
        "PARAMETERS: Tuple[Parameter, ...] = (",
    ]
    lines += [
        f'    Parameter(BY_NAME["{r.name}"], {r.range[0]!r}, {r.range[1]!r}, '
        f"{None if r.default == 'largest' else float(r.default)!r}, "
        f'{r.stopped}, "{r.object}", {json.dumps(words_of(r))}),'
        for r in saved(groups)
    ]
    lines += [")", "", "# Signals of the scope by number: name and unit.", "SIGNALS = ("]
    lines += [f'    ("{s.name}", "{s.unit}"),' for s in found]
    return "\n".join([*lines, ")"]) + "\n"


def files(groups: List[Group], found: List[Signal], constants: List[Fixed]) -> Dict[Path, str]:
    """Every file and what has to be in it."""
    modbus = ROOT / "docs/modbus.md"
    canopen = ROOT / "docs/canopen.md"
    tables = {g.name: table_text(g) for g in groups}
    tables["signals"] = signals_text(found)
    objects = {"objects": canopen_map.objects_text(groups, constants)}
    return {
        ROOT / "firmware/app/registers/app_registers_map.h": header(groups),
        ROOT / "firmware/app/registers/app_registers_map.c": source(groups),
        ROOT / "tests/unit/app/registers/register_types.h": types(groups),
        ROOT / "firmware/app/trace/app_scope_signals.h": signals_header(found),
        ROOT / "firmware/app/trace/app_scope_signals.c": signals_source(found),
        modbus: documented(modbus, tables),
        canopen: documented(canopen, objects),
        ROOT / "firmware/app/canopen/app_canopen_map.h": canopen_map.header(groups, constants),
        ROOT / "firmware/app/canopen/app_canopen_map.c": canopen_map.source(groups, constants),
        ROOT / "docs/sdre-drive.eds": canopen_map.eds(groups, constants),
        ROOT / "docs/registers.csv": csv_text(groups),
        ROOT / "host_tools/python/sdre_drive/register_map.py": python_text(groups, found),
        ROOT / "host_tools/python/sdre_drive/page/static/direct/tables.js": page_text(
            groups, found
        ),
    }


def main() -> int:
    """0: everything is as it should be, or was made so."""
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        print(f"generate.py: {' '.join(sys.argv[1:])} is not --check", file=sys.stderr)
        return 1
    try:
        groups = read(TABLE)
        require_different_ids(groups)
        wanted = files(groups, signals(TABLE), fixed(TABLE))
    except (TableError, KeyError) as e:
        print(f"registers.toml: {e}", file=sys.stderr)
        return 1
    other = [
        p for p, text in wanted.items() if not p.exists() or p.read_text(encoding="utf-8") != text
    ]
    for path in other:
        stale = "is not what registers.toml says: python3 host_tools/registers/generate.py"
        print(f"{path.relative_to(ROOT)} {stale if check else 'written'}")
        if not check:
            path.write_text(wanted[path], encoding="utf-8")
    return 1 if check and other else 0


if __name__ == "__main__":
    sys.exit(main())
