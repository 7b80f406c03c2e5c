# SPDX-License-Identifier: MIT
"""Compares the table "Modules and methods" of docs/assurance.md with the tree. Each room of the
firmware has a row. Proofs and tests that it names exist, and the mutants cover what it says."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "firmware"
NO_CODE = {"config", "one_unit"}  # tables, and files that include others
sys.path.insert(0, str(ROOT / "tests/quality"))

import mutate_host  # noqa: E402
import unit_build  # noqa: E402


def table() -> dict[str, list[str]]:
    """Cells by the first one."""
    page = (ROOT / "docs/assurance.md").read_text(encoding="utf-8")
    part = page.split("### Modules and methods")[1].split("###")[0]
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in part.split("\n")
        if line.startswith("| `")
    ]
    return {row[0].strip("`"): row[1:] for row in rows}


def rooms() -> set[str]:
    """Directories of sources: those of application and board one by one, others as a whole."""
    found = set()
    for file in FIRMWARE.rglob("*.c"):
        parts = file.parent.relative_to(FIRMWARE).parts
        found.add("/".join(parts[:2] if parts[0] in ("app", "board") else parts[:1]))
    return {f"firmware/{room}" for room in found - NO_CODE}


def proofs() -> set[str]:
    """Entries that `./dev prove` runs; those of commissioning as one."""
    text = (ROOT / "tests/prove/prove.sh").read_text(encoding="utf-8")
    listed = text[text.index("for law in ") :]
    return {re.sub(r"(commission)_.*", r"\1_*", name) for name in re.findall(r"prove_\w+", listed)}


def tests() -> set[str]:
    """Names of the tests, from the words that register them."""
    names = {"fuzz.*"}
    for file in ROOT.glob("tests/**/CMakeLists.txt"):
        text = file.read_text(encoding="utf-8")
        names |= set(re.findall(r"[a-z0-9]+\.\w+", text))
        for call, name in re.findall(r"sdre_(\w+)\((\w+(?: \w+)?)", text):
            kind = {"unit_test": "unit.", "app_test": "unit.", "fuzz": "fuzz."}.get(call, "")
            names.add(kind + name.split()[0] if kind else name.replace(" ", "."))
    return names


def room_of(path: Path) -> str:
    parts = path.relative_to(ROOT).parent.parts
    return "/".join(parts[:3] if parts[1] in ("app", "board") else parts[:2])


def problems(rows: dict[str, list[str]]) -> list[str]:
    found = [f"no row for {room}" for room in sorted(rooms() - rows.keys())]
    claimed = {n for row in rows.values() for n in re.findall(r"`(prove_\w+\*?)`", row[0])}
    found += [f"./dev prove runs no {name}" for name in sorted(claimed - proofs())]
    found += [f"no row names {name}" for name in sorted(proofs() - claimed)]
    known = tests()
    listed = tomllib.loads((ROOT / "tests/quality/aimed_mutants.toml").read_text(encoding="utf-8"))
    sources = unit_build.sources()
    aimed = {room_of(s) for s in sources for m in listed["mutant"] if m["file"] == s.name}
    mutated = {room_of(s) for s in sources}
    mutated |= {f"host_tools/{Path(m).parent.as_posix()}" for m in mutate_host.MODULES}
    for room, (_, generated, mutants, _, flipped) in rows.items():
        if not list((ROOT / room).rglob("*.c*")):
            found.append(f"{room} has no source")
        words = re.findall(r"[a-z0-9]+\.[\w*]+", generated + " " + flipped)
        found += [f"{room}: there is no test {name}" for name in words if name not in known]
        wanted = ("yes, aimed" if room in aimed else "yes") if room in mutated else "no"
        if mutants != wanted:
            found.append(f"{room}: mutated: {mutants} in the table, {wanted} in tests/quality")
    return found


def main() -> int:
    found = problems(table())
    print("\n".join(found) if found else "the table of methods is that of the tree")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
