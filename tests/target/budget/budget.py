#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The cost of one control period, from the compiled core.

Usage: budget.py BIN_HOST BUILD_TARGET JSON [record | COLUMN...]

BIN_HOST has record_ticks, BUILD_TARGET is the tree of the preset cortex-m4f. host_stub.elf must run
to its end on an emulated Cortex-M4F. record_ticks runs the scenarios of a law on the host and
records every tick; replay_LAW.elf replays them on that machine. The answers must equal the host's,
instructions are counted, and the operations executed are priced with the C28x's cycles of
costs.toml. The figures go to JSON, unless columns are named: then those alone are made. Exit code
1: a check failed, or a whole period takes more than docs/budget.json has; record makes that file
and the tables of docs/hardware.md. It refuses a default drive above its ceiling.
"""

import json
import re
import sys
import tempfile
from collections import Counter
from pathlib import Path

import report
import tables
from costs import Costs
from execution import (
    COUNTS_PER_INSTRUCTION,
    TICKS,
    Steps,
    count_instructions,
    exit_code,
    path_counts,
    run,
    single_steps,
    walk_calls,
    walk_ticks,
)
from longest_path import LongestPath
from machine_code import law_functions, read_code, symbols
from origin import Origin
from tick_file import GATE, read_results, read_runs

PREFIX = "arm-none-eabi-"
ROOT = Path(__file__).resolve().parents[3]
SCENARIOS = ROOT / "host_tools/sil/scenarios"
DRIVES = ROOT / "firmware/config/drives"

# Host and Cortex-M4F differ in the last bits of sine and cosine and what follows from them:
# measured 2.3e-5 at most, over all scenarios. Chosen: below one count of the compare register,
# 1.3e-4.
DUTY_TOLERANCE = 1e-4

# runs beside every law; its ticks are counted once, with those of the shipped drive's law
PLAIN = "PI-FOC"
SHIPPED, HARMONIC = "noc", "noc_h"
# {column: (law, drive in place of the scenarios' own, periods in a second, scenarios)}
COLUMNS = {
    "noc_speed": ("noc_speed", None, 5000, ("*",)),
    SHIPPED: ("noc", None, 5000, ("*",)),
    HARMONIC: ("noc_h", None, 5000, ("*",)),
    "conventional": ("conventional", "ipmsm_390w_conventional.toml", 5000, ("*",)),
    "noc_shaft": (
        "noc_shaft",
        "ipmsm_390w_shaft.toml",
        5000,
        ("board_flux_weakening", "board_regeneration", "board_load_step"),
    ),
    # Chosen: the dearest ticks at 5 kHz are those of weakened flux, of braking and of a load step.
    "noc_10khz": (
        "noc",
        "ipmsm_390w_10khz.toml",
        10000,
        ("board_flux_weakening", "board_regeneration", "board_load_step"),
    ),
}
# Chosen: what knowing the harmonics may cost, of the shipped law's cycles.
HARMONIC_RATIO = 2.5
# Chosen: a function that the linker puts into the flash as seldom runs in one tick of so many.
SELDOM_ticks = 1000
ORDER = 2  # of the shipped drives; a run of a higher order stands only in the list of scenarios
SINGLE_STEPPED = 100  # chosen: more than one way through the code, in a second


class Checks:
    def __init__(self):
        self.failed = False

    def __call__(self, good, text):
        print(f"{'ok  ' if good else 'FAIL'} {text}")
        self.failed |= not good


def check_no_double(check, table):
    """Neither double precision nor software floating point."""
    helper = (
        r"__aeabi_|__(add|sub|mul|div|neg|fix|fixuns|float|floatun|extend|trunc|cmp)\w*[sd]f\w*$"
    )
    found = sorted(name for name in table if re.match(helper, name))
    check(not found, f"no floating-point helper is linked{': ' if found else ''}{' '.join(found)}")


def compare(check, runs, results):
    worst = pi_worst = 0.0
    gates = True
    for recorded, replayed in zip(runs, results):
        for tick, result in zip(recorded.ticks, replayed):
            worst = max(worst, *(abs(tick[10 + i] - result[3 + i]) for i in range(3)))
            pi_worst = max(pi_worst, *(abs(tick[13 + i] - result[6 + i]) for i in range(3)))
            gates &= tick[16] & GATE == result[2]
    check(gates, "gates as on the host")
    check(
        worst <= DUTY_TOLERANCE,
        f"duties as on the host: worst {worst:.1e}, allowed {DUTY_TOLERANCE:.0e}",
    )
    check(
        pi_worst <= DUTY_TOLERANCE,
        f"those of the PI-FOC: worst {pi_worst:.1e}, allowed {DUTY_TOLERANCE:.0e}",
    )


class Worst:
    """The dearest tick of one kind."""

    def __init__(self):
        self.cycles = self.instructions = self.total = self.ticks = 0
        self.path = self.where = None

    def see(self, costs, instructions, path, where):
        self.total += instructions
        self.ticks += 1
        self.instructions = max(self.instructions, instructions)
        if costs[0] > self.cycles:
            self.cycles, self.path, self.where = costs[0], path, where


def check_counting(check, image, directory, table, steps, results):
    """Timer and decoded blocks against one log line per instruction, on the first ticks."""
    stepped = single_steps(image, directory, table, SINGLE_STEPPED)
    timer = [round(t / COUNTS_PER_INSTRUCTION) for result in results[0] for t in result[:2]]
    around = {timer[n] - everything for n, (everything, _) in enumerate(stepped)}
    walked = walk_ticks(image, directory, table, steps)
    blocks = [next(walked)[2] == core for _, core in stepped]
    walked.close()
    check(
        len(around) <= 2 and max(around) <= 20,
        f"timer and single steps agree but for {max(around)} instructions",
    )
    check(len(stepped) == SINGLE_STEPPED and all(blocks), "decoded blocks and single steps agree")


class Application:
    """The dearest way of app_tick() with the law running, without the core, with the calls of
    board.h."""

    def __init__(self, costs, origin, image):
        code = read_code(PREFIX, image, law_functions(PREFIX, image), origin)
        table = symbols(PREFIX, image)
        steps = Steps(code, costs.library, (costs.cycles,))
        core = table["image_app_end"][0]
        self.counts, self.features, self.calls = Counter(), {}, Counter()
        with tempfile.TemporaryDirectory() as directory:
            walked = Counter(walk_calls(image, directory, table, "app_tick", steps))
            for path, ticks in walked.items():
                functions = frozenset(code[int(block, 16)].function for block in path)
                if "step" in functions:
                    edges = [
                        edge for edge in zip(path, path[1:] + (None,)) if int(edge[0], 16) < core
                    ]
                    counts = sum((steps[edge][2] for edge in edges), Counter())
                    self.calls[functions] += ticks
                    if costs.cycles(counts) > costs.cycles(self.counts):
                        self.counts, self.features = counts, steps.by_feature(edges)
        if not self.calls:
            raise RuntimeError("the application on host_stub never ran the law")


def applications(costs, origins, image):
    """{law: Application}: laws differ in what of the application runs from the flash."""
    made = {frozenset(origin.flash): None for origin in origins.values()}
    for origin in origins.values():
        made[frozenset(origin.flash)] = made[frozenset(origin.flash)] or Application(
            costs, origin, image
        )
    return {law: made[frozenset(origin.flash)] for law, origin in origins.items()}


def check_seldom(check, what, calls, seldom):
    """Functions that the linker puts into the flash run in one tick of SELDOM_ticks at most; calls:
    {functions that a tick runs: ticks}."""
    runs = Counter()
    for functions, ticks in calls.items():
        for name in {name.partition(".")[0] for name in functions} & seldom:
            runs[name] += ticks
    often = sorted(n for n, ticks in runs.items() if SELDOM_ticks * ticks > sum(calls.values()))
    check(
        not often,
        f"{what}: functions of .seldom run in one tick of {SELDOM_ticks} at most"
        + (f", but not {' '.join(often)}" if often else ""),
    )


class Replay:
    """One image with the ticks of its law."""

    def __init__(self, name, images, recorder, costs, origin, check):
        self.name = name
        self.law, drive, self.rate_Hz, chosen = COLUMNS[name]
        self.image = str(
            Path(images, f"replay_{self.law}.elf").resolve()
        )  # the emulator runs in another directory
        self.code = read_code(PREFIX, self.image, law_functions(PREFIX, self.image), origin)
        self.table = symbols(PREFIX, self.image)
        self.steps, self.known = Steps(self.code, costs.library, (costs.cycles,)), {}
        law = f"{self.law}={DRIVES / drive}" if drive else self.law
        scenarios = sorted(str(path) for name in chosen for path in SCENARIOS.glob(f"{name}.toml"))
        with tempfile.TemporaryDirectory() as directory:
            run([recorder, law, f"{directory}/ticks.bin", *scenarios])
            runs = read_runs(f"{directory}/ticks.bin")
            count_instructions(self.image, directory)
            results = read_results(f"{directory}/results.bin", runs)
            print(f"{name}: {sum(len(r.ticks) for r in runs)} ticks of {len(runs)} scenarios")
            check_no_double(check, self.table)
            compare(check, runs, results)
            check_counting(check, self.image, directory, self.table, self.steps, results)
            self.execute(directory, runs, results)
        check_seldom(check, name, self.calls, origin.seldom)
        loops = {**costs.loops, **costs.loops_of[self.law]}
        self.bound = LongestPath(self.code, costs.library, loops, costs.cycles).function(
            "drive_tick"
        )
        dearest = max(worst.cycles for kind, worst in self.kinds.items() if kind != PLAIN)
        check(dearest <= costs.cycles(self.bound), "no tick costs more than the bound")
        self.counts = {
            kind: path_counts(worst.path, self.steps) for kind, worst in self.kinds.items()
        }

    def kind_of(self, function, recorded, tick):
        """Column of the table; None for a tick that has none."""
        if function == "pi_foc_tick":
            return PLAIN if self.name == SHIPPED else None
        if recorded.order > ORDER:
            return None
        return (
            f"{self.name}, start"
            if tick == 0
            else f"{self.name}, position"
            if "position" in recorded.name
            else f"{self.name}, torque"
            if "torque" in recorded.name
            else self.name
        )

    def execute(self, directory, runs, results):
        """kinds: {column: Worst}; by_run: {run's name: Worst}."""
        self.kinds, self.by_run = (
            {self.name: Worst()},
            {recorded.name: Worst() for recorded in runs},
        )
        self.calls = Counter()  # functions that a tick runs -> ticks
        walked = walk_ticks(self.image, directory, self.table, self.steps)
        for recorded, replayed in zip(runs, results):
            for k, result in enumerate(replayed):
                for function, timer in zip(TICKS, result):
                    name, cycles, _, path = next(walked)
                    assert name == function
                    if function == "drive_tick":
                        self.calls[self.functions_of(path)] += 1
                    kind = self.kind_of(function, recorded, k)
                    seen = [self.kinds.setdefault(kind, Worst())] if kind else []
                    if function == "drive_tick" and k > 0:
                        seen.append(self.by_run[recorded.name])
                    for worst in seen:
                        worst.see(
                            cycles,
                            round(timer / COUNTS_PER_INSTRUCTION),
                            path,
                            f"{recorded.name}, tick {k}",
                        )
        assert next(walked, None) is None

    def functions_of(self, path):
        if path not in self.known:
            self.known[path] = frozenset(self.code[int(block, 16)].function for block in path)
        return self.known[path]

    def features(self, kind):
        path = self.kinds[kind].path
        return self.steps.by_feature(zip(path, path[1:] + (None,)))


def show_limits(costs, figures):
    for column, limits in costs.limits.items():
        if column not in figures["whole_period"]:
            continue
        most = report.dearest(figures, column)[1]
        verdicts = ", ".join(
            f"{name} {limit} {report.verdict(most, limit)}" for name, limit in limits.items()
        )
        print(f"  whole period of {column}, {most} cycles at the band's upper end: {verdicts}")


def check_growth(check, whole_period, recorded):
    """Nothing becomes dearer without a new record. A cheaper period is named."""
    for column, (_, most) in whole_period.items():
        before = recorded.get(column, [0, 0])[1]
        hint = "" if most == before else ": ./dev budget record"
        check(most <= before, f"whole period of {column}: {most} cycles, recorded {before}{hint}")


def read_record():
    return json.loads(tables.RECORDED.read_text()) if tables.RECORDED.exists() else {}


def record_figures(check, figures, before):
    """Writes the record and the tables. It refuses a dearer default drive."""
    spent = report.dearest(figures, SHIPPED)[1]
    figures = {**figures, "ceiling": min(spent, before.get("ceiling", spent))}
    wrong = report.exceeds(figures, SHIPPED)
    check(not wrong, f"whole period of the default drive: {wrong or f'{spent} cycles'}")
    if not check.failed:
        tables.RECORDED.write_text(report.text(figures))
        tables.write()


def main(host, target, path, *arguments):
    costs, check = Costs(), Checks()
    record, columns = arguments == ("record",), [c for c in arguments if c != "record"]
    if unknown := [column for column in columns if column not in COLUMNS]:
        sys.exit(f"budget.py: no column {unknown[0]}; there are {', '.join(COLUMNS)}")
    images = f"{target}/bin"
    code = exit_code(f"{images}/host_stub.elf")
    check(
        code == 0,
        f"the application on host_stub boots, aligns, holds a speed and stops: exit code {code}",
    )
    origins = {
        law: Origin.of_firmware(costs.features, law)
        for law in (SHIPPED, *(c[0] for c in COLUMNS.values()))
    }
    apps = applications(costs, origins, str(Path(images, "host_stub.elf").resolve()))
    check_seldom(check, "application", apps[SHIPPED].calls, origins[SHIPPED].seldom)
    recorder = f"{host}/record_ticks"
    replays = {
        name: Replay(name, images, recorder, costs, origins[COLUMNS[name][0]], check)
        for name in columns or COLUMNS
    }
    figures = report.figures(costs, replays, apps, SHIPPED)
    if not columns:
        figures["memory"] = report.memory(PREFIX, target, replays)
        ratio = replays[HARMONIC].kinds[HARMONIC].cycles / replays[SHIPPED].kinds[SHIPPED].cycles
        check(
            ratio <= HARMONIC_RATIO,
            f"{HARMONIC} costs {ratio:.2f} of {SHIPPED}, allowed {HARMONIC_RATIO}",
        )
        Path(path).write_text(report.text(figures))
    report.show(figures)
    show_limits(costs, figures)
    if record:
        record_figures(check, figures, read_record())
    check_growth(check, figures["whole_period"], read_record().get("whole_period", {}))
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
