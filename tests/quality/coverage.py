# SPDX-License-Identifier: MIT
"""Lines and branches of the firmware above the board that the unit tests reach, by gcov.

    coverage.py [-v]     -v: every line and branch that is missed

The counts are gcov's own. gcovr would be one more package, and it knows neither the rooms nor their
limits.

Exit code 1 below 100 % of the lines or 95 % of the branches of any room.
"""

import json
import sys
from concurrent.futures import ThreadPoolExecutor

import unit_build as ub

LINES = 100.0
BRANCHES = 95.0


def measured(build):
    """Per source: lines, branches, what is missed."""
    for source in ub.sources():
        out = ub.run(
            [
                "gcov",
                "--json-format",
                "--stdout",
                "--branch-probabilities",
                build.object(source.stem),
            ]
        )
        for file in json.loads(out.stdout)["files"]:
            if file["file"] == str(source):
                yield source, file["lines"]


def main():
    build = ub.Build(ub.ROOT / "build/coverage", ["-O0", "--coverage"])
    for old in build.directory.glob("*.gcda"):
        old.unlink()
    names = ub.tests()

    def one(name):
        program = build.directory / name
        linked = build.link(name, program)
        if linked.returncode != 0:
            return name + ": " + linked.stderr
        return "" if ub.passes(program, 300) else name + " fails"

    with ThreadPoolExecutor(ub.JOBS) as pool:
        for problem in filter(None, pool.map(one, names)):
            print(problem)
    good = True
    for directory in ub.ROOMS:
        lines = missed_lines = branches = missed_branches = 0
        for source, rows in measured(build):
            if ub.room_of(source) != directory:
                continue
            for row in rows:
                lines += 1
                missed_lines += row["count"] == 0
                taken = [b["count"] for b in row["branches"]]
                branches += len(taken)
                missed_branches += sum(count == 0 for count in taken)
                if "-v" in sys.argv and (row["count"] == 0 or 0 in taken):
                    print(
                        f"{source.name}:{row['line_number']}: {row['count']} times, branches "
                        f"{taken}"
                    )
        line_share = 100.0 * (1 - missed_lines / lines)
        branch_share = 100.0 * (1 - missed_branches / branches)
        print(
            f"firmware/{directory}: {line_share:.2f} % of {lines} lines, {branch_share:.2f} % of "
            f"{branches} branches"
        )
        good = good and line_share >= LINES and branch_share >= BRANCHES
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
