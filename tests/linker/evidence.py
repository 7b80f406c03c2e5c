# SPDX-License-Identifier: MIT
"""One page of what TI's tools made of the images: sizes, places, frames, cycles, inlining, each
against what this project expects. Cycles are those of `./dev budget`, at its prices.

    evidence.py BUILD_DIRECTORY IMAGE..      IMAGE: flash, ram

It writes evidence.md there, and fails when something is not as expected.
"""

import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "target"))
import check_stack
import code_size
import command_file
import listing
import pricing

ROOT = Path(__file__).resolve().parents[2]
LEFT = 0.15  # as tests/linker/test_table_sizes.py
PERIOD_cycles = 30000


class Page:
    """Lines of the page, and what is not as expected."""

    def __init__(self):
        self.lines, self.wrong = [], []

    def table(self, title, head, rows):
        self.lines += [
            "",
            f"## {title}",
            "",
            "| " + " | ".join(head) + " |",
            "|" + "---|" * len(head),
        ]
        self.lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] or [
            "| nothing |" + " |" * (len(head) - 1)
        ]

    def judge(self, good, what):
        if not good:
            self.wrong.append(what)
        return "as expected" if good else "**not as expected**"


def sizes(page, image, areas):
    rows = []
    for area in areas:
        share = area.used / area.length
        verdict = page.judge(
            share <= 1 - LEFT or area.length <= 2,
            f"{image}: {area.name} is {100 * share:.0f} % full",
        )
        rows.append(
            (
                area.name,
                f"{area.origin:#08x}",
                area.length,
                area.used,
                f"{100 * share:.0f} %",
                verdict,
            )
        )
    page.table(
        f"{image}: memory",
        ("range", "origin", "words", "used", "share", f"at most {100 * (1 - LEFT):.0f} %"),
        rows,
    )


def places(page, image, groups):
    ranges, sections = command_file.parse(
        (ROOT / "linker" / f"f28335_{image}.cmd").read_text(), ("FAST_RTS",)
    )
    rows = []
    for group in groups:
        section = sections.get(group.name)
        if section is None:
            page.wrong.append(f"{image}: section {group.name} is in no command file")
            continue
        if section.type or group.size == 0:
            continue
        for kind, address, wanted in (
            ("load", group.load, section.load),
            ("run", group.run, section.run),
        ):
            if address is None:
                continue
            item = ranges[wanted]
            good = item.origin <= address and address + group.size <= item.end
            rows.append(
                (
                    group.name,
                    kind,
                    f"{address:#08x}",
                    group.size,
                    wanted,
                    page.judge(
                        good, f"{image}: {group.name} {kind}s at {address:#x}, outside {wanted}"
                    ),
                )
            )
    for name in ("codestart", ".TI.ramfunc", ".tables", ".stack") + (
        (".seldom", ".in_force") if image == "flash" else ()
    ):
        if not any(group.name == name and group.size for group in groups):
            page.wrong.append(f"{image}: section {name} is empty")
    page.table(f"{image}: sections", ("section", "", "address", "words", "range", ""), rows)


def functions_in_flash(page, linked):
    """Names of functions that run from the flash: those compiled for it, and the seldom ones. It
    judges where each runs."""
    seldom = set(code_size.seldom())
    ranges, sections = command_file.parse(
        (ROOT / "linker" / "f28335_flash.cmd").read_text(), ("FAST_RTS",)
    )
    slow = set()
    for name, found in linked.items():
        for part in found:
            flash = part.section == ".text" or name in seldom
            item = ranges[sections[".text" if flash else ".TI.ramfunc"].run]
            if part.address is not None and not item.origin <= part.address < item.end:
                page.wrong.append(f"{name}() runs at {part.address:#x}, outside {item.name}")
            slow |= {name} if flash else set()
    return slow


def estimate(page, groups, law):
    """Code in RAM against the estimate's band; the run-time library is in the found one only."""
    if not code_size.is_there():
        page.lines += [
            "",
            f"No {code_size.COMPILER}: sizes and frames are not compared with the estimate.",
        ]
        return
    seldom, from_ram = set(code_size.seldom()), code_size.runs_from_ram(law)
    functions = code_size.functions([law])[law]
    halfwords = sum(f.halfwords for f in functions if from_ram(f.source) and f.name not in seldom)
    found = sum(group.size for group in groups if group.name == ".TI.ramfunc")
    most = code_size.words_at_most(halfwords) + code_size.LIBRARY_words
    least = round(halfwords * code_size.WORDS_PER_HALFWORD * (1 - code_size.BAND))
    page.table(
        "Code in RAM",
        ("estimated words", "found", ""),
        [
            (
                f"{least} .. {most}",
                found,
                page.judge(
                    least <= found <= most,
                    f"code in RAM: {found} words, estimated {least} .. {most}",
                ),
            )
        ],
    )


def frames(page, functions):
    """A frame of TI's compiler that is larger than the stack's count takes it for."""
    if not code_size.is_there():
        return
    graph = check_stack.graph_of(
        code_size.COMPILER,
        [
            p
            for folder in check_stack.FOLDERS
            for p in sorted(folder.glob("*.c"))
            if p.name != "bench.c"
        ],
    )
    counted = {}
    for title, words in graph.frame.items():
        counted[title.rsplit(":", 1)[-1]] = max(words, counted.get(title.rsplit(":", 1)[-1], 0))
    larger = sorted(
        (
            (f.frame - counted[n], n, f.frame, counted[n])
            for n, f in functions.items()
            if f.frame is not None and n in counted and f.frame > counted[n]
        ),
        reverse=True,
    )
    page.table(
        "Frames larger than counted", ("function", "found", "counted"), [row[1:] for row in larger]
    )
    worst, room = sum(row[0] for row in larger), check_stack.stack_words()
    page.lines += [
        "",
        f"All of them in one chain would add {worst} words to the count: "
        + page.judge(
            worst <= LEFT * room,
            f"frames: {worst} words beyond the count, {LEFT * room:.0f} are left for them",
        ),
    ]


def cycles(page, functions, law, in_flash, entry="control_isr", core="drive_tick"):
    """The dearest way through the core against the budget's, at the same prices."""
    rows = []
    for name in sorted(functions, key=lambda n: -functions[n].words)[:20]:
        alone, _, _ = pricing.dearest({name: functions[name]}, name, law, in_flash)
        whole, _, _ = pricing.dearest(functions, name, law, in_flash)
        rows.append((name, functions[name].words, alone, whole))
    page.table("Dearest ways", ("function", "words", "cycles alone", "with its callees"), rows)
    for name in (entry, core):
        if name not in functions:
            page.wrong.append(f"no listing of {name}()")
            return
    whole, _, _ = pricing.dearest(functions, entry, law, in_flash)
    verdict = page.judge(
        whole <= PERIOD_cycles / 2, f"{entry}(): {whole} cycles are more than half a period"
    )
    page.lines += [
        "",
        f"{entry}(): {whole} cycles, {100 * whole / PERIOD_cycles:.1f} % of the period. {verdict}",
    ]
    found, unpriced, unbounded = pricing.dearest(functions, core, law, in_flash)
    budget = json.loads((ROOT / "docs" / "budget.json").read_text())["bound"].get(law)
    if budget is None:
        page.lines += ["", f"{core}(): {found} cycles. The budget does not price law {law}."]
        return
    verdict = page.judge(
        found <= budget[1], f"{core}(): {found} cycles, the budget says {budget[0]} .. {budget[1]}"
    )
    below = ", below the budget's band" if found < budget[0] else ""
    page.table(
        "Cycles of the core",
        ("law", "dearest way by the budget", "by the listing", ""),
        [(law, f"{budget[0]} .. {budget[1]}", found, verdict + below)],
    )
    if unpriced:
        page.lines += ["", f"Calls counted without their body: {', '.join(sorted(unpriced))}."]
    if unbounded:
        page.lines += [
            "",
            "Loops that the budget does not know, each with the law's largest number of passes: "
            f"{', '.join(sorted(unbounded))}.",
        ]


def parts():
    """Functions that are to be put where the tick calls them; checks and resets run seldom."""
    found = set()
    for header in (ROOT / "firmware" / "control").rglob("*.h"):
        found |= set(re.findall(r"^CTL_PART [\w ]+?\**(\w+)\(", header.read_text(), flags=re.M))
    return {name for name in found if not re.search(r"_(check|reset|init)$", name)}


def inlining(page, linked):
    apart = sorted(parts() & set(linked))
    page.table(
        "Inlining",
        ("part of the tick", "found"),
        [(name, "a function of its own") for name in apart],
    )
    page.lines += [
        "",
        f"{len(parts()) - len(apart)} of {len(parts())} parts are inlined or left out. "
        + page.judge(not apart, f"not inlined: {', '.join(apart)}"),
    ]


def law_of(build):
    """The law whose entry point is linked."""
    cache = (build / "CMakeCache.txt").read_text() if (build / "CMakeCache.txt").exists() else ""
    match = re.search(r"^SDRE_TABLES:\w+=(.+)$", cache, flags=re.M)
    tables = Path(match.group(1)) if match else ROOT / "firmware" / "config"
    return re.search(r"\.law\s+=\s+&law_(\w+),", (tables / "gain_tables.c").read_text()).group(1)


def make(build, images):
    page, functions, linked, law = Page(), {}, {}, law_of(build)
    for file in sorted((build / "listings").rglob("*.lst")):
        if not re.match(r"law_", file.name) or file.stem == f"law_{law}":
            functions.update(listing.read(file.read_text(errors="replace")))
    if not functions:
        page.wrong.append("no listings")
    for image in images:
        areas, groups, names = listing.read_link((build / f"sdre_f28335_{image}.xml").read_text())
        sizes(page, image, areas)
        places(page, image, groups)
        if image == "flash":
            linked = names
            estimate(page, groups, law)
    kept = {name: function for name, function in functions.items() if name in linked}
    in_flash = functions_in_flash(page, linked)
    frames(page, kept)
    cycles(page, kept, law, in_flash)
    inlining(page, linked)
    head = ["# Evidence of TI's tools", ""] + (
        [f"- {wrong}" for wrong in page.wrong] or ["Everything is as expected."]
    )
    return "\n".join(head + page.lines) + "\n", page.wrong


def main():
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    build = Path(sys.argv[1])
    try:
        text, wrong = make(build, sys.argv[2:])
    except ValueError as error:
        raise SystemExit(f"evidence.py: {error}") from None
    (build / "evidence.md").write_text(text)
    print(
        f"{build / 'evidence.md'}: "
        + (f"{len(wrong)} not as expected" if wrong else "everything is as expected")
    )
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
