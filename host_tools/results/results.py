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
import json
import sys

from experiments import ROOT, Experiments, run_all
from page_tables import pages

RECORDED = ROOT / "docs/results.json"

# Recomputed by the gate: ideal signals, and one run on the board.
CHEAP = (
    "fig5 ipmsm_390w_speed",
    "fig6 ipmsm_390w_speed",
    "fig7 ipmsm_390w_speed",
    "fig5 ipmsm_390w_conventional",
    "load_step ipmsm_390w",
    "plane ipmsm_390w",
    "fault_phase_open ipmsm_390w",
    "fault_encoder_losing ipmsm_390w",
    "fault_tick_hung ipmsm_390w",
)
# Another compiler draws the noise of a board differently: measured 3 % of a worst of 20 seeds.
# Chosen: three times that.
TOLERANCE = 0.1
FLOOR = 1e-3  # of a quantity in SI units: below it a difference is rounding


def record(sil, experiments):
    recorded = {}
    for (scenario, drive), values in run_all(sil, experiments, experiments.runs()):
        measure = experiments.scenarios[scenario].get("measure", "all")
        recorded[f"{scenario} {drive}"] = {
            "inputs": experiments.inputs(scenario, drive),
            "faults": values.get("faults", 0),
            **({"trips": values["trips"]} if "trips" in values else {}),
            **values[measure],
        }
    text = ",\n".join(
        f"{json.dumps(k)}: {json.dumps(v, sort_keys=True)}" for k, v in sorted(recorded.items())
    )
    RECORDED.write_text("{\n" + text + "\n}\n")


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
    stale += [f"{file}: no experiment" for file in experiments.unused_faults()]
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
        codes = recorded[f"{scenario} {drive}"].get("trips", {}).get("codes")
        if codes != values.get("trips", {}).get("codes"):
            wrong.append(f"{scenario} {drive}: other faults than {codes} of docs/results.json")
        before = recorded[f"{scenario} {drive}"]["worst"]
        now = values[experiments.scenarios[scenario].get("measure", "all")]["worst"]
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
