# SPDX-License-Identifier: MIT
"""Does every test that docs/bring-up.md names exist, and does every step of levels 1 and 2 that a
debugger alone can see name one?"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "bring-up.md"


def problems(page, tests):
    found = [
        f"{name} is no test" for name in re.findall(r"\bF28335\w+\.\w+", page) if name not in tests
    ]
    levels = re.findall(r"^## Level (\d): .*?$(.*?)(?=^## |\Z)", page, flags=re.M | re.S)
    if [number for number, _ in levels] != list("012345"):
        found.append("the levels are not 0 to 5")
    for number, body in levels:
        rows = [
            [cell.strip() for cell in line.strip("|").split("|")]
            for line in body.splitlines()
            if line.startswith("|")
        ]
        for row in rows[2:]:
            if number in "12" and row[3] == "live view" and not row[4]:
                found.append(f"level {number}: nothing tries: {row[0]}")
            if number != "0" and not (row[1] and row[2] and row[3]):
                found.append(f"level {number}: measurement, limit or proof is missing: {row[0]}")
    return found


def main():
    page = PAGE.read_text(encoding="utf-8")
    sources = "".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "tests" / "f28335").glob("*.cpp")
    )
    tests = {
        f"{suite}.{name}" for suite, name in re.findall(r"TEST(?:_F)?\((\w+),\s*(\w+)\)", sources)
    }
    wrong = problems(page, tests)
    for seed, part in (
        (page.replace("F28335Bench.Level1", "F28335Bench.Level9"), "is no test"),
        (
            re.sub(r"\| live view \| F28335\S+ \|", "| live view | |", page, count=1),
            "nothing tries",
        ),
        (page.replace("## Level 3", "## Level 6"), "not 0 to 5"),
    ):
        if not any(part in problem for problem in problems(seed, tests)):
            wrong.append(f"a seeded defect is not found: {part}")
    print("\n".join(wrong) or f"{len(re.findall('F28335', page))} tests named, all there")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
