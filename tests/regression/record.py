#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every shipped scenario and drive against what they did before: traces, reports, tables.

    record.py SDRE_SIL SDRE_GAINS           compares with expected.json; exit code 1 on a difference
    record.py SDRE_SIL SDRE_GAINS --exact   the digests too: same compiler, same bits
    record.py SDRE_SIL SDRE_GAINS --write   records anew

A trace is kept as the SHA-256 of its CSV. For other compilers and machines it is kept as mean, root
mean square and end of every column. A report is kept as the numbers of its JSON, tables as their
sorted numbers.
"""

import argparse
import concurrent.futures
import csv
import hashlib
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXPECTED = pathlib.Path(__file__).with_name("expected.json")
SCENARIOS = ROOT / "host_tools/sil/scenarios"
DRIVES = ROOT / "firmware/config/drives"

# Drives beside the scenario's own. Paper B's laws take the servo's scenarios only. The 24 V drive
# takes its own.
IPMSM_SCENARIOS = (
    "board_load_step",
    "board_reversal",
    "board_flux_weakening",
    "fig7_speed_step",
    "harmonics_load_step",
)
SERVO_SCENARIOS = ("servo_case_1_2", "servo_case_3_4")
BOARDS = ("api", "f28335")
# The others are the same on both boards, or differ by a tick of the capture timer:
# f28335.board_runs.
ON_BOTH_BOARDS = ("board_load_step", "board_hold", "board_regeneration")

STATISTICS = ("mean", "rms", "mean of the end")
# Share of a column's range. A difference in a last digit sometimes moves an edge or a converter
# code. From there on the noise is another draw. Measured: at most 0.065 where the voltage limit
# cuts the noise, with another sine in the core.
TOLERANCE = 0.1
# A design that is not certified is unstable: from the first other digit on it goes its own way.
UNSTABLE = ("servo_200w_cdobc_printed",)
# Reports and tables: the table check's own bound on another compiler's digits (emit_tables.cpp).
NUMBER_TOLERANCE = 1e-5


def cases():
    """(name, arguments of sdre-sil) of every run."""
    for scenario in sorted(SCENARIOS.glob("*.toml")):
        yield scenario.stem, ["run", scenario]
        if scenario.stem.startswith(("board_", "m2310p_")):
            for board in BOARDS if scenario.stem in ON_BOTH_BOARDS else BOARDS[:1]:
                yield f"{scenario.stem} {board}", ["run", scenario, "--board", board]
    for drive in sorted(DRIVES.glob("*.toml")):
        names = SERVO_SCENARIOS if drive.stem.startswith("servo_") else IPMSM_SCENARIOS
        if drive.stem.startswith("m2310p_"):
            names = ()
        if any(rival in drive.stem for rival in ("pi_foc", "ladrc", "counts")):
            names = ("board_torque",) if "torque" in drive.stem else names[:1]
        for name in names:
            yield f"{name} {drive.stem}", ["run", SCENARIOS / f"{name}.toml", "--drive", drive]
    for drive in ("ipmsm_390w_noc_h", "ipmsm_390w_speed"):
        for board in BOARDS:
            yield (
                f"board_load_step {drive} {board}",
                [
                    "run",
                    SCENARIOS / "board_load_step.toml",
                    "--drive",
                    DRIVES / f"{drive}.toml",
                    "--board",
                    board,
                ],
            )


def call(arguments):
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)


def statistics(values):
    """Mean, root mean square, mean of the last tenth, range between the 2nd and the 98th
    percentile."""
    n = len(values)
    ranked = sorted(values)
    tail = values[-max(n // 10, 1) :]
    return [
        math.fsum(values) / n,
        math.sqrt(math.fsum(v * v for v in values) / n),
        math.fsum(tail) / len(tail),
        ranked[-1 - n // 50] - ranked[n // 50],
    ]


def trace(sil, arguments, was):
    """Digest and statistics of a run; of a refused one, the exit code and its words. With the
    digest that was recorded it has the statistics that were."""
    with tempfile.TemporaryDirectory() as directory:
        path = pathlib.Path(directory) / "trace.csv"
        done = call([sil, *arguments, "--csv", path])
        if not path.exists():
            return {
                "exit": done.returncode,
                "says": done.stderr.strip().replace(str(ROOT) + "/", ""),
            }
        data = path.read_bytes()
    digest = hashlib.sha256(data).hexdigest()
    if was.get("sha256") == digest and was["exit"] == done.returncode:
        return was
    rows = list(csv.reader(data.decode().splitlines()))
    columns = {
        name: statistics([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])
    }
    return {
        "exit": done.returncode,
        "sha256": digest,
        "rows": len(rows) - 1,
        "columns": {name: [float(f"{v:.6g}") for v in values] for name, values in columns.items()},
    }


def numbers_in(value):
    """All numbers of a JSON value, in their order."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return []
    if isinstance(value, dict):
        return [x for part in value.values() for x in numbers_in(part)]
    if isinstance(value, list):
        return [x for part in value for x in numbers_in(part)]
    return [float(value)]


def summary(numbers):
    """Digest, count and three sums; residuals and other rounding noise count as nothing."""
    clean = [0.0 if abs(x) < 1e-9 else x for x in numbers]
    text = " ".join(f"{x:.9g}" for x in clean)
    logs = [math.log(abs(x)) for x in clean if x]
    return {
        "sha256": hashlib.sha256(text.encode()).hexdigest(),
        "count": len(clean),
        "sums": [
            math.fsum(logs),
            math.fsum(x * x for x in logs),
            math.fsum(logs[i] * (i + 1) for i in range(len(logs))),
        ],
    }


def report(gains, drive):
    done = call([gains, "report", drive, "--json"])
    return (
        summary(numbers_in(json.loads(done.stdout)))
        if done.returncode in (0, 2) and done.stdout
        else {"exit": done.returncode}
    )


def tables(gains, drive):
    with tempfile.TemporaryDirectory() as directory:
        done = call([gains, "generate", drive, "--out", directory, "--uncertified"])
        source = pathlib.Path(directory) / "gain_tables.c"
        if not source.exists():
            return {"exit": done.returncode}
        code = re.sub(r"/\*.*?\*/", " ", source.read_text(), flags=re.S)
    found = [float(x) for x in re.findall(r"[-+]?\d+\.\d+e[-+]\d+(?=f)", code)]
    return summary(sorted(found))


def record(sil, gains, expected, core):
    """All cases, of the core alone if wanted; a process each, so that threads suffice."""
    jobs = {
        f"trace {name}": (trace, sil, arguments, expected.get(f"trace {name}", {}))
        for name, arguments in cases()
        if not (core and name.endswith(BOARDS))
    }
    for drive in [] if core else sorted(DRIVES.glob("*.toml")):
        jobs[f"report {drive.stem}"] = (report, gains, drive)
        jobs[f"tables {drive.stem}"] = (tables, gains, drive)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        running = {name: pool.submit(*job) for name, job in jobs.items()}
        return {name: future.result() for name, future in running.items()}


def differences_in_trace(was, now):
    if was["rows"] != now["rows"] or list(was["columns"]) != list(now["columns"]):
        yield "rows or columns differ"
        return
    for name, before in was["columns"].items():
        *before, span = before
        span = max(span, 1e-3 * before[1], 1e-9)
        for what, x, y in zip(STATISTICS, before, now["columns"][name]):
            if not abs(x - y) <= TOLERANCE * span:
                yield (
                    f"{name}: {what} {y:g} where {x:g} was recorded ({abs(x - y) / span:.3f} of "
                    f"its range)"
                )


def differences_in_numbers(was, now):
    if was["count"] != now["count"]:
        yield f"{now['count']} numbers where {was['count']} were recorded"
        return
    for x, y in zip(was["sums"], now["sums"]):
        if not abs(x - y) <= NUMBER_TOLERANCE * max(abs(x), 1.0):
            yield f"sum over the logarithms {y:.9g} where {x:.9g} was recorded"


def compare(name, was, now, exact):
    """(what differs, digits differ) of one case."""
    if was == now:
        return [], False
    if not exact and name.endswith(UNSTABLE):
        return [], True
    keys = ("exit", "says")
    if any(was.get(k) != now.get(k) for k in keys) or ("sha256" in was) != ("sha256" in now):
        return [
            f"{ {k: now.get(k) for k in keys} } where { {k: was.get(k) for k in keys} } was "
            f"recorded"
        ], True
    if exact:
        return ["digest differs"], True
    found = differences_in_trace(was, now) if "rows" in was else differences_in_numbers(was, now)
    return list(found), True


def write(recorded):
    lines = [f"{json.dumps(name)}: {json.dumps(value)}" for name, value in sorted(recorded.items())]
    EXPECTED.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def main():
    parser = argparse.ArgumentParser(
        description="shipped scenarios and drives against what they did before"
    )
    parser.add_argument("sil")
    parser.add_argument("gains")
    parser.add_argument("--exact", action="store_true", help="digests have to agree")
    parser.add_argument("--write", action="store_true", help="record anew")
    parser.add_argument(
        "--core",
        action="store_true",
        help="traces of the core alone: no boards, reports and tables",
    )
    options = parser.parse_args()
    expected = {} if options.write else json.loads(EXPECTED.read_text())
    if options.core:
        expected = {
            name: what
            for name, what in expected.items()
            if name.startswith("trace ") and not name.endswith(BOARDS)
        }
    recorded = record(options.sil, options.gains, expected, options.core)
    if options.write:
        write(recorded)
        return 0
    failed = digits = 0
    for name in sorted(set(expected) | set(recorded)):
        if name not in expected or name not in recorded:
            print(f"{name}: {'not recorded' if name not in expected else 'not there any more'}")
            failed += 1
            continue
        found, other_digits = compare(name, expected[name], recorded[name], options.exact)
        digits += other_digits
        failed += bool(found)
        for line in found:
            print(f"{name}: {line}")
    print(f"{len(recorded)} cases, {failed} differ, {digits} in their last digits at least")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
