#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The cost of one control period, from the compiled core.

Usage: budget.py RECORDER IMAGES CORE_LIBRARY TABLES_LIBRARY CONVENTIONAL_DRIVE SCENARIO...

IMAGES is a directory. host_stub.elf must run to its end on an emulated Cortex-M4F. RECORDER runs the scenarios of one
law on the host and records every tick; replay_LAW.elf replays them on that machine. The conventional law of paper A,
which no scenario names, runs those of the speed form with its own drive file. The answers must equal the host's,
instructions are counted, and the operations executed are priced with the C28x's cycles of costs.toml. Exit code 1: a
check failed.
"""
import re
import sys
import tempfile
import tomllib
from collections import Counter
from pathlib import Path

from execution import (
    COUNTS_PER_INSTRUCTION, TICKS, Steps, count_instructions, exit_code, path_counts, run, single_steps, walk_calls,
    walk_ticks,
)  # fmt: skip
from longest_path import LongestPath
from machine_code import law_functions, linked_sizes, read_code, section_sizes, stack_depth, symbols
from tick_file import GATE, read_results, read_runs

PREFIX = "arm-none-eabi-"

# Host and Cortex-M4F differ in the last bits of sine and cosine and what follows from them: measured 2.3e-5 at
# most, over all scenarios. Chosen: below one count of the compare register, 1.3e-4.
DUTY_TOLERANCE = 1e-4

PLAIN = "PI-FOC"  # runs beside every law; its ticks are counted once, with those of the shipped drive's law
SHIPPED, HARMONIC, SPEED, CONVENTIONAL = "noc", "noc_h", "noc_speed", "conventional"
LAWS = (SPEED, SHIPPED, HARMONIC, CONVENTIONAL)
# Chosen: what knowing the harmonics may cost, of the shipped law's cycles.
HARMONIC_RATIO = 2.5
ORDER = 2  # of the shipped drives; a run of a higher order stands only in the list of scenarios
SINGLE_STEPPED = 100  # chosen: more than one way through the code, in a second
OPERATIONS = (
    ("add, subtract", ("fp_add",)),
    ("multiply", ("fp_mul",)),
    ("divide", ("fp_div",)),
    ("square root", ("fp_sqrt",)),
    ("compare", ("fp_compare", "fp_flags")),
    ("limit", ("limit",)),
    ("move, negate, convert", ("fp_move", "fp_convert", "fp_mac")),
    ("constant", ("constant",)),
    ("load", ("load",)),
    ("store", ("store",)),
    ("integer", ("integer", "int_div")),
    ("branch", ("branch", "taken", "not_taken")),
    ("call and return", ("call", "return", "memset", "memcpy")),
    ("sine, cosine", ("sinf", "cosf")),
    ("minimum, maximum", ("fminf", "fmaxf")),
    ("words set or copied in calls", ("word_set", "word_copied")),
)


class Costs:
    def __init__(self, path):
        with open(path, "rb") as file:
            data = tomllib.load(file)
        self.cycles_per_tick = data["cycles_per_tick"]
        self.target_share = data["target_share"]
        self.board = set(data["board"])
        self.library = set(data["library"]) | self.board
        self.interrupt = sum(data["interrupt"].values())
        self.loops, self.loops_of = data["loops"], data["loops_of"]
        self.band = data["band"]
        self.of = {**data["cost"], **data["library"], **data["board"]}
        self.slow_division = data["without_fast_rts"]["fp_div"]

    def cycles(self, counts):
        return sum(n * self.of[name] for name, n in counts.items())

    def span(self, cycles):
        """Both ends of the band."""
        return (1 - self.band) * cycles, (1 + self.band) * cycles

    def slow(self, counts):
        """At most, with the plain library's division."""
        more = counts.get("fp_div", 0) * (self.slow_division - self.of["fp_div"])
        return (1 + self.band) * (self.cycles(counts) + more)


class Checks:
    def __init__(self):
        self.failed = False

    def __call__(self, good, text):
        print(f"{'ok  ' if good else 'FAIL'} {text}")
        self.failed |= not good


def check_no_double(check, table):
    """Neither double precision nor software floating point."""
    helper = r"__aeabi_|__(add|sub|mul|div|neg|fix|fixuns|float|floatun|extend|trunc|cmp)\w*[sd]f\w*$"
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
    check(worst <= DUTY_TOLERANCE, f"duties as on the host: worst {worst:.1e}, allowed {DUTY_TOLERANCE:.0e}")
    check(pi_worst <= DUTY_TOLERANCE, f"those of the PI-FOC: worst {pi_worst:.1e}, allowed {DUTY_TOLERANCE:.0e}")


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


def execute(law, image, directory, table, steps, runs, results):
    """{kind: Worst}, {run's name: Worst}; kinds are the columns of the table."""
    kinds = {name: Worst() for name in (law, f"{law}, start", *([PLAIN] if law == SHIPPED else []))}
    by_run = {recorded.name: Worst() for recorded in runs}
    walked = walk_ticks(image, directory, table, steps)
    for recorded, replayed in zip(runs, results):
        for k, result in enumerate(replayed):
            for function, timer in zip(TICKS, result):
                name, cycles, _, path = next(walked)
                assert name == function
                kind = PLAIN if function == "pi_foc_tick" else f"{law}, start" if k == 0 else law
                seen = [kinds[kind]] if kind in kinds and (kind == PLAIN or recorded.order <= ORDER) else []
                if function == "drive_tick" and k > 0:
                    seen.append(by_run[recorded.name])
                for worst in seen:
                    worst.see(cycles, round(timer / COUNTS_PER_INSTRUCTION), path, f"{recorded.name}, tick {k}")
    assert next(walked, None) is None
    return kinds, by_run


def check_counting(check, image, directory, table, steps, results):
    """Timer and decoded blocks against one log line per instruction, on the first ticks."""
    stepped = single_steps(image, directory, table, SINGLE_STEPPED)
    timer = [round(t / COUNTS_PER_INSTRUCTION) for result in results[0] for t in result[:2]]
    around = {timer[n] - everything for n, (everything, _) in enumerate(stepped)}
    walked = walk_ticks(image, directory, table, steps)
    blocks = [next(walked)[2] == core for _, core in stepped]
    walked.close()
    check(len(around) <= 2 and max(around) <= 20, f"timer and single steps agree but for {max(around)} instructions")
    check(len(stepped) == SINGLE_STEPPED and all(blocks), "decoded blocks and single steps agree")


def print_table(title, columns, rows):
    print(f"\n{title}")
    width = max(len(row[0]) for row in rows) + 2
    widths = [max(len(c), *(len(row[n + 1]) for row in rows)) + 3 for n, c in enumerate(columns)]
    for cells in (("", *columns), *rows):
        print(cells[0].ljust(width) + "".join(c.rjust(w) for c, w in zip(cells[1:], widths)))


def span(costs, cycles):
    low, high = costs.span(cycles)
    return f"{low:.0f} .. {high:.0f}"


def share(costs, cycles):
    low, high = (100 * end / costs.cycles_per_tick for end in costs.span(cycles))
    return f"{low:.1f} .. {high:.1f} %"


def print_operations(costs, replays, app):
    """The dearest executed tick of each kind, and the bound over all ways through the code."""
    columns = {kind: path_counts(worst.path, r.steps) for r in replays for kind, worst in r.kinds.items()}
    columns |= {f"bound, {r.law}": r.bound for r in replays}
    columns["application"] = app
    named = {name for _, names in OPERATIONS for name in names} | {"far", "spill"} | costs.board
    assert all(name in named for counts in columns.values() for name in counts)
    rows = [
        (text, *(str(sum(counts.get(name, 0) for name in names)) for counts in columns.values()))
        for text, names in OPERATIONS
    ]
    around = costs.cycles(app) + costs.interrupt
    cycles = [costs.cycles(counts) for counts in columns.values()]
    rows += [
        ("beyond seven words", *(str(counts.get("far", 0)) for counts in columns.values())),
        ("cycles", *(span(costs, c) for c in cycles)),
        ("  share of the period", *(share(costs, c) for c in cycles)),
        ("  with plain division", *(f"{costs.slow(counts):.0f}" for counts in columns.values())),
        ("whole period", *(span(costs, c + around) for c in cycles[:-1]), ""),
        ("  share of the period", *(share(costs, c + around) for c in cycles[:-1]), ""),
    ]
    title = f"Dearest tick, operations and estimated C28x cycles (+-{100 * costs.band:.0f} %)"
    print_table(title, list(columns), rows)
    for kind, worst in (pair for r in replays for pair in r.kinds.items()):
        print(f"  {kind}: {worst.where}")
    print("  application: dearest of app_tick() on host_stub while the law runs, without the core, with the calls of board.h")
    print(f"  whole period: with application and interrupt, {around:.0f} cycles")
    print("  bound: dearest way through the compiled code, whether or not anything can take it")


def print_verdict(costs, check, replays):
    limit = costs.target_share * costs.cycles_per_tick
    cycles = {}
    for r in replays:
        cycles[r.law] = costs.cycles(path_counts(r.kinds[r.law].path, r.steps))
        low, high = costs.span(cycles[r.law])
        verdict = "met" if high <= limit else "missed" if low > limit else "within the uncertainty of the estimate"
        print(f"  target of {limit:.0f} cycles ({100 * costs.target_share:.0f} %), {r.law} without the application: {verdict}")
    print(f"  {CONVENTIONAL} costs {cycles[CONVENTIONAL] / cycles[SPEED]:.2f} of {SPEED} in the same scenarios")
    ratio = cycles[HARMONIC] / cycles[SHIPPED]
    check(ratio <= HARMONIC_RATIO, f"{HARMONIC} costs {ratio:.2f} of {SHIPPED}, allowed {HARMONIC_RATIO}")


def print_instructions(kinds, by_run):
    plain = kinds[PLAIN]
    rows = [
        (kind, str(w.instructions), f"{w.total / w.ticks:.0f}", f"{w.total / w.ticks / (plain.total / plain.ticks):.2f}")
        for kind, w in kinds.items()
    ]
    print_table("Instructions per tick, Cortex-M4F, library included", ["worst", "mean", f"mean / {PLAIN}"], rows)
    rows = [(name, str(w.instructions), f"{w.cycles:.0f}") for name, w in by_run.items()]
    print_table("Worst after the start, per scenario (nd3: order 3)", ["instructions", "C28x cycles"], rows)


def print_memory(replays, core, tables):
    """The shipped tables stand in the shipped law's column."""
    constants = section_sizes(PREFIX, tables)
    table_words = (constants["text"] + constants["rodata"]) // 2
    linked = [linked_sizes(PREFIX, core, r.image) for r in replays]
    rows = [
        ("flash: core", *(str(sizes["flash"] // 2) for sizes in linked)),
        ("flash: gain table", *(str(table_words) if r.law == SHIPPED else "" for r in replays)),
        ("RAM: drive_t", *(str(r.table["drive"][1] // 2) for r in replays)),
        ("RAM: other data of the core", *(str(sizes["data"] // 2) for sizes in linked)),
        ("RAM: stack of drive_tick", *(str(stack_depth(r.code, "drive_tick") // 2) for r in replays)),
    ]
    print_table(
        "Words of memory, estimated from the Cortex-M4F's objects: two octets are one C28x word", [r.law for r in replays], rows
    )


def application(costs, image):
    """The dearest way of app_tick() with the law running, without the core: counts."""
    code = read_code(PREFIX, image, law_functions(PREFIX, image))
    table = symbols(PREFIX, image)
    steps = Steps(code, costs.library, (costs.cycles,))
    core = table["image_app_end"][0]
    dearest, ways = Counter(), 0
    with tempfile.TemporaryDirectory() as directory:
        for path in set(walk_calls(image, directory, table, "app_tick", steps)):
            if any(code[int(block, 16)].function == "step" for block in path):
                edges = (edge for edge in zip(path, path[1:] + (None,)) if int(edge[0], 16) < core)
                counts = sum((steps[edge][2] for edge in edges), Counter())
                dearest = max(dearest, counts, key=costs.cycles)
                ways += 1
    if not ways:
        raise RuntimeError("the application on host_stub never ran the law")
    return dearest


class Replay:
    """One image with the ticks of its law."""

    def __init__(self, law, drive, images, recorder, scenarios, costs, check):
        self.law = law
        self.image = str(Path(images, f"replay_{law}.elf").resolve())  # the emulator runs in another directory
        self.code = read_code(PREFIX, self.image, law_functions(PREFIX, self.image))
        self.table = symbols(PREFIX, self.image)
        self.steps = Steps(self.code, costs.library, (costs.cycles,))
        with tempfile.TemporaryDirectory() as directory:
            run([recorder, f"{law}={drive}" if drive else law, f"{directory}/ticks.bin", *scenarios])
            runs = read_runs(f"{directory}/ticks.bin")
            count_instructions(self.image, directory)
            results = read_results(f"{directory}/results.bin", runs)
            print(f"{law}: {sum(len(r.ticks) for r in runs)} ticks of {len(runs)} scenarios")
            check_no_double(check, self.table)
            compare(check, runs, results)
            check_counting(check, self.image, directory, self.table, self.steps, results)
            self.kinds, self.by_run = execute(law, self.image, directory, self.table, self.steps, runs, results)
        loops = {**costs.loops, "step": costs.loops_of[law]}
        self.bound = LongestPath(self.code, costs.library, loops, costs.cycles).function("drive_tick")
        dearest = max(worst.cycles for kind, worst in self.kinds.items() if kind != PLAIN)
        check(dearest <= costs.cycles(self.bound), "no tick costs more than the bound")


def main(recorder, images, core, tables, conventional, *scenarios):
    costs = Costs(Path(__file__).with_name("costs.toml"))
    check = Checks()
    code = exit_code(f"{images}/host_stub.elf")
    check(code == 0, f"the application on host_stub boots, aligns, holds a speed and stops: exit code {code}")
    drives = {CONVENTIONAL: conventional}
    replays = [Replay(law, drives.get(law), images, recorder, scenarios, costs, check) for law in LAWS]
    print_operations(costs, replays, application(costs, str(Path(images, "host_stub.elf").resolve())))
    print_verdict(costs, check, replays)
    kinds = {kind: worst for r in replays for kind, worst in r.kinds.items()}
    print_instructions(kinds, {name: worst for r in replays if r.law != CONVENTIONAL for name, worst in r.by_run.items()})
    print_memory(replays, core, tables)
    return 1 if check.failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
