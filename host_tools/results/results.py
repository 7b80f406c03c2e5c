#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measured figures of the docs, recorded in docs/results.json and printed between markers of the
pages.

    results.py record SDRE_SIL      runs every experiment of experiments.toml, writes JSON and pages
    results.py write                writes the pages from the JSON
    results.py check                exit code 1: a page or the JSON is stale
    results.py recompute SDRE_SIL   runs a few cheap experiments and compares them with the JSON

A recorded run has the digests of its drive and board file, its scenario and the trace in
tests/regression.
With another drive, scenario or core it is stale.
"""

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
RECORDED = ROOT / "docs/results.json"
PAGES = ("README.md", "docs/results.md")
SCENARIOS = ROOT / "host_tools/sil/scenarios"
DRIVES = ROOT / "firmware/config/drives"
BOARDS = ROOT / "firmware/config/boards"
TRACES = ROOT / "tests/regression/expected.json"
SEEDS = 20  # chosen: the worst of 20 moves by some per cent with another 20

# Recomputed by the gate: ideal signals, and one run on the board.
CHEAP = (
    "fig5 ipmsm_390w_speed",
    "fig6 ipmsm_390w_speed",
    "fig7 ipmsm_390w_speed",
    "fig5 ipmsm_390w_conventional",
    "load_step ipmsm_390w",
)
# Another compiler draws the noise of a board differently: measured 3 % of a worst of 20 seeds.
# Chosen: three times that.
TOLERANCE = 0.1
FLOOR = 1e-3  # of a quantity in SI units: below it a difference is rounding

# field of a cell: metric of sdre-sil, factor to the unit of the docs
FIELDS = {
    "settled_ms": ("settling_time_s", 1e3),
    "dip": ("dip_e_radps", 1),
    "overshoot": ("overshoot_e_radps", 1),
    "ripple": ("ripple_e_radps", 1),
    "error": ("steady_state_error_e_radps", 1),
    "low": ("steady_state_error_e_radps", 1),
    "peak_A": ("peak_current_A", 1),
    "vq_V": ("vq_noise_V", 1),
    "vd_V": ("vd_noise_V", 1),
    "rpm": ("fluctuation_rpm", 1),
    "decrease_rpm": ("decrease_rpm", 1),
    "within2_ms": ("within_2_percent_s", 1e3),
    "distortion": ("current_distortion_percent", 1),
    "offset_A": ("sensor_offset_hat_A", 1),
    "within5_ms": ("within_5_percent_s", 1e3),
    "within1_ms": ("within_1_percent_s", 1e3),
    "overshoot_pc": ("overshoot_percent", 1),
    "error_rpm": ("offset_rpm", 1),
    "audible": ("audible_torque_percent", 1),
    "reached_ms": ("position_settled_s", 1e3),
    "off_cnt": ("position_off_cnt", 1),
    "rest_cnt": ("position_steady_cnt", 1),
}
STATISTICS = ("worst", "median")


def digest(value):
    """Digest of a TOML file's content; comments and order of the keys do not count."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:16]


class Experiments:
    def __init__(self):
        data = tomllib.loads(Path(__file__).with_name("experiments.toml").read_text())
        self.scenarios, self.tables, self.elsewhere = (
            data["scenario"],
            data["table"],
            data["elsewhere"],
        )
        self.traces = json.loads(TRACES.read_text())

    @staticmethod
    def cell(row, column):
        """Text of a cell, or the name of a scenario, a drive and a format."""
        if "key" in column:
            return row[column["key"]]
        both = {**row, **column}
        return both["scenario"] + both.get("suffix", ""), both["drive"], both["show"]

    def runs(self):
        """Every pair of scenario and drive that a table shows, once."""
        cells = (
            self.cell(row, column)
            for t in self.tables.values()
            for row in t["rows"]
            for column in t["columns"]
        )
        return sorted({cell[:2] for cell in cells if not isinstance(cell, str)})

    def inputs(self, scenario, drive):
        """Digests of all that a run depends on."""
        what = self.scenarios[scenario]
        first = "servo_case_1_2" if drive.startswith("servo_") else "board_load_step"
        names = (f"trace {name} {drive}" for name in (what["file"], first))
        trace = next(self.traces[name] for name in names if name in self.traces)
        file = tomllib.loads((DRIVES / f"{drive}.toml").read_text())
        board = tomllib.loads((BOARDS / f"{file['board']['name']}.toml").read_text())
        return {
            "drive": digest([file, board]),
            "scenario": digest(
                [tomllib.loads((SCENARIOS / f"{what['file']}.toml").read_text()), what]
            ),
            "trace": trace["sha256"][:16],
        }


def with_keys(text, changes):
    """A scenario's text with other values of some keys of its tables."""
    for table, keys in changes.items():
        lines = "".join(f"{key} = {value}\n" for key, value in keys.items())
        head = re.search(rf"^\[{table}\]\n", text, re.M)
        if head:
            text = text[: head.end()] + lines + text[head.end() :]
        else:
            text += f"\n[{table}]\n{lines}"
    return text


def scenario_text(what):
    """The scenario with the keys of an experiment, for any directory."""
    text = (
        (SCENARIOS / f"{what['file']}.toml")
        .read_text()
        .replace("../../../firmware/config/drives", str(DRIVES))
    )
    return with_keys(text, what.get("set", {}))


def run(sil, what, drive):
    """{measure: {statistic: {metric: value}}} of one experiment; of random motors {"all": {"worst":
    ..}}."""
    with tempfile.TemporaryDirectory() as directory:
        scenario, out = Path(directory, f"{what['file']}.toml"), Path(directory, "out.json")
        scenario.write_text(scenario_text(what))
        motors = what.get("motors")
        count = ["--count", motors] if motors else ["--seeds", what.get("seeds", SEEDS)]
        command = [
            sil,
            "motors" if motors else "run",
            scenario,
            "--drive",
            DRIVES / f"{drive}.toml",
            *count,
            "--json",
            out,
        ]
        done = subprocess.run(
            [str(c) for c in command], capture_output=True, text=True, check=False
        )
        if not out.exists():
            sys.exit(f"results: {' '.join(map(str, command[1:3]))} {drive}: {done.stderr.strip()}")
        data = json.loads(out.read_text())
    if motors:
        good = 100 * (1 - data["failed"] / data["motors"])
        return {
            "all": {
                "worst": {
                    "motors": data["motors"],
                    "failed": data["failed"],
                    "good": round(good, 4),
                }
            }
        }
    metrics = {metric for metric, _ in FIELDS.values()}
    values = {"faults": data["faults"]}
    for name, measure in data["measures"].items():
        values[name] = {
            s: {
                m: v if v is None else float(f"{v:.6g}")
                for m, v in measure[s].items()
                if m in metrics
            }
            for s in STATISTICS
            if s in measure
        }
    return values


def run_all(sil, experiments, names):
    """One run for all scenarios that share file, changes and seeds."""
    keys = {}
    for scenario, drive in names:
        what = experiments.scenarios[scenario]
        same = json.dumps(
            [{k: v for k, v in what.items() if k != "measure"}, drive], sort_keys=True
        )
        keys.setdefault(same, []).append((scenario, drive))
    for n, pairs in enumerate(keys.values(), 1):
        values = run(sil, experiments.scenarios[pairs[0][0]], pairs[0][1])
        if sys.stderr.isatty():
            print(
                f"\r{n} of {len(keys)} runs",
                end="\n" if n == len(keys) else "",
                file=sys.stderr,
                flush=True,
            )
        for pair in pairs:
            yield pair, values


def record(sil, experiments):
    recorded = {}
    for (scenario, drive), values in run_all(sil, experiments, experiments.runs()):
        measure = experiments.scenarios[scenario].get("measure", "all")
        recorded[f"{scenario} {drive}"] = {
            "inputs": experiments.inputs(scenario, drive),
            "faults": values.get("faults", 0),
            **values[measure],
        }
    text = ",\n".join(
        f"{json.dumps(k)}: {json.dumps(v, sort_keys=True)}" for k, v in sorted(recorded.items())
    )
    RECORDED.write_text("{\n" + text + "\n}\n")


class Never(float):
    """A value that a run does not have, for example a settling time: it prints as a word."""

    def __format__(self, _):
        return "never"


def fields(values):
    """Named values of a cell."""
    found = {}
    for statistic, suffix in (("worst", ""), ("median", "_median")):
        of = values.get(statistic, {})
        for name, (metric, factor) in FIELDS.items():
            if metric in of:
                found[name + suffix] = Never() if of[metric] is None else abs(factor * of[metric])
        found |= {name + suffix: of[name] for name in ("motors", "failed", "good") if name in of}
    return found


def shown(form, values):
    """The text of a cell; what never happens has no unit."""
    return re.sub(r"never (ms|rad/s)", "never", form.format_map(fields(values)))


def table(experiments, recorded, name):
    """A Markdown table."""
    t = experiments.tables[name]
    lines = [
        [t["corner"], *(column["head"] for column in t["columns"])],
        ["---"] * (len(t["columns"]) + 1),
    ]
    for row in t["rows"]:
        cells = [row["label"]]
        for column in t["columns"]:
            cell = experiments.cell(row, column)
            if not isinstance(cell, str):
                values = recorded[f"{cell[0]} {cell[1]}"]
                cell = "trips" if values["faults"] else shown(cell[2], values)
            cells.append(cell)
        lines.append(cells)
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def elsewhere(experiments):
    """A Markdown table of the figures that other commands make."""
    lines = [["figures", "command", "page"], ["---"] * 3]
    for what, (command, link) in experiments.elsewhere.items():
        page = link.partition("#")[0]
        lines.append([what, f"`{command}`", f"[{page}]({link})"])
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def pages(experiments, recorded):
    """(path, text as it is, text as it has to be)."""
    marked = re.compile(r"(<!-- results (\w+) -->\n).*?(<!-- end -->)", re.S)

    def block(m):
        name = m[2]
        made = elsewhere(experiments) if name == "elsewhere" else table(experiments, recorded, name)
        return f"{m[1]}\n{made}\n{m[3]}"

    for name in PAGES:
        text = (ROOT / name).read_text()
        yield (
            ROOT / name,
            text,
            marked.sub(block, text),
        )


def write(experiments):
    recorded = json.loads(RECORDED.read_text())
    for path, old, new in pages(experiments, recorded):
        if old != new:
            path.write_text(new)
            print(f"{path.relative_to(ROOT)} written")


def check(experiments):
    recorded = json.loads(RECORDED.read_text())
    wanted = {f"{scenario} {drive}": (scenario, drive) for scenario, drive in experiments.runs()}
    stale = [f"{name}: not recorded" for name in wanted if name not in recorded]
    stale += [f"{name}: shown nowhere" for name in recorded if name not in wanted]
    for name in sorted(set(wanted) & set(recorded)):
        now = experiments.inputs(*wanted[name])
        stale += [
            f"{name}: another {what}"
            for what, value in recorded[name]["inputs"].items()
            if now[what] != value
        ]
    if not stale:
        stale = [
            f"{path.relative_to(ROOT)}: other text than the JSON gives"
            for path, old, new in pages(experiments, recorded)
            if old != new
        ]
    for line in stale:
        print(f"results: {line}")
    if stale:
        print("results: run ./dev results")
    return 1 if stale else 0


def recompute(sil, experiments):
    recorded, wrong = json.loads(RECORDED.read_text()), []
    pairs = [tuple(name.split()) for name in CHEAP]
    for (scenario, drive), values in run_all(sil, experiments, pairs):
        before = recorded[f"{scenario} {drive}"]["worst"]
        now = values[experiments.scenarios[scenario]["measure"]]["worst"]
        for metric, x in before.items():
            y = now[metric]
            same = (
                x is y if x is None or y is None else abs(x - y) <= max(TOLERANCE * abs(x), FLOOR)
            )
            if not same:
                wrong.append(f"{scenario} {drive}: {metric} is {y}, docs/results.json has {x}")
    for line in wrong:
        print(f"results: {line}")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description="measured figures of the docs")
    parser.add_argument("what", choices=("record", "write", "check", "recompute"))
    parser.add_argument("sil", nargs="?", default=str(ROOT / "build/host/bin/sdre-sil"))
    options = parser.parse_args()
    experiments = Experiments()
    if options.what == "check":
        return check(experiments)
    if options.what == "recompute":
        return recompute(options.sil, experiments)
    if options.what == "record":
        record(options.sil, experiments)
    write(experiments)
    if options.what == "record":
        print("not run here:")
        for what, (command, page) in experiments.elsewhere.items():
            print(f"  {what}: {command}, docs/{page}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
