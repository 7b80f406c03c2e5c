# SPDX-License-Identifier: MIT
"""The experiments of experiments.toml: what they depend on, and their runs."""

import hashlib
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import tomllib
from plane import recorded

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "host_tools/sil/scenarios"
DRIVES = ROOT / "firmware/config/drives"
BOARDS = ROOT / "firmware/config/boards"
TRACES = ROOT / "tests/regression/expected.json"
SEEDS = 20  # chosen: the worst of 20 moves by some per cent with another 20

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
    "passed_cnt": ("position_overshoot_cnt", 1),
    "rise_ms": ("torque_rise_s", 1e3),
    "beyond": ("torque_overshoot_percent", 1),
    "torque_error": ("torque_error_percent", 1),
    "torque_ripple": ("torque_ripple_percent", 1),
}
STATISTICS = ("worst", "median")
OF_ANGLES = (*STATISTICS, "best")  # a range


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

    def unused_faults(self):
        """Files of faults that no experiment runs."""
        used = {what.get("file") for what in self.scenarios.values()}
        found = (f"faults/{path.stem}" for path in sorted((SCENARIOS / "faults").glob("*.toml")))
        return [name for name in found if name not in used]

    def inputs(self, scenario, drive):
        """Digests of all that a run depends on."""
        what = self.scenarios[scenario]
        first = "servo_case_1_2" if drive.startswith("servo_") else "board_load_step"
        names = (f"trace {name} {drive}" for name in (what.get("file"), first))
        trace = next(self.traces[name] for name in names if name in self.traces)
        file = tomllib.loads((DRIVES / f"{drive}.toml").read_text())
        board = tomllib.loads((BOARDS / f"{file['board']['name']}.toml").read_text())
        path = SCENARIOS / f"{what['file']}.toml" if "file" in what else None
        return {
            "drive": digest([file, board]),
            "scenario": digest([tomllib.loads(path.read_text()) if path else {}, what]),
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
    text = (SCENARIOS / f"{what['file']}.toml").read_text()
    text = re.sub(r"(\.\./)+firmware/config/drives", str(DRIVES), text)
    if "angles" in what:  # without the key every seed has an angle of its own
        text = re.sub(r"^initial_angle_e_rad.*\n", "", text, flags=re.M)
    return with_keys(text, what.get("set", {}))


def run_plane(sil, what, drive):
    """The map of `sdre-sil qualify`, which runs whatever is not good in it too."""
    with tempfile.TemporaryDirectory() as directory:
        out, file = Path(directory, "out.json"), DRIVES / f"{drive}.toml"
        options = f"--alone --motors 0 --seeds {what['seeds']} --json".split()
        command = [sil, "qualify", file, *options, out]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if not out.exists():
            sys.exit(f"results: qualify {drive}: {done.stderr.strip()}")
        found = json.loads(out.read_text())["map"]
    return {"faults": sum(p["faults"] for p in found["points"]), "all": recorded(found)}


def run(sil, what, drive):
    """{measure: {statistic: {metric: value}}} of one experiment; of random motors {"all": {"worst":
    ..}}."""
    if "plane" in what:
        return run_plane(sil, what, drive)
    with tempfile.TemporaryDirectory() as directory:
        name = Path(what["file"]).name
        scenario, out = Path(directory, f"{name}.toml"), Path(directory, "out.json")
        scenario.write_text(scenario_text(what))
        motors = what.get("motors")
        count = ["--count", motors] if motors else ["--seeds", what.get("seeds", SEEDS)]
        command = [
            sil,
            "motors" if motors else "run",
            scenario,
            *(["--board", what["board"]] if "board" in what else []),
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
                    "tripped": data["tripped"],
                    "good": round(good, 4),
                }
            }
        }
    metrics = {metric for metric, _ in FIELDS.values()}
    values = {"faults": data["faults"]}
    if "fault_s" in what:
        last = data["last_trip_s"]
        values["trips"] = {
            "codes": data["fault_codes"],
            "seeds": data["seeds"],
            "after_s": None if last is None else float(f"{last - what['fault_s']:.6g}"),
        }
    for name, measure in data["measures"].items():
        values[name] = {
            s: {
                m: v if v is None else float(f"{v:.6g}")
                for m, v in measure[s].items()
                if m in metrics
            }
            for s in (OF_ANGLES if "angles" in what else STATISTICS)
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
