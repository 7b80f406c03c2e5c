# SPDX-License-Identifier: MIT
"""Makes the report: runs the tools, draws, writes one page and its PDF."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import List

from markupsafe import Markup

from . import effort, fig4, near_optimal, pages, paper_a, paper_b, printed, summary, theorem
from .campaign import section as campaign
from .campaign import stored as campaigns
from .guarantees import section as guarantees
from .guarantees import stored
from .tables import Section
from .tools import DRIVES, ROOT, ReportError, Tools, read_toml


def collect(tools: Tools) -> List[Section]:
    """Every section of the page, in its order."""
    published = printed.read()
    design = tools.design("ipmsm_390w_speed")
    drive = read_toml(DRIVES / "ipmsm_390w_speed.toml")
    servo = read_toml(DRIVES / "servo_200w_cdobc.toml")
    a = paper_a.section(tools, published["A"], design, drive)
    a.parts[1:1] = fig4.parts(tools, published["A"]["fig4"], design)
    tools.tell("the optimum")
    a.parts.append(near_optimal.table(design, drive))
    a.parts.append(near_optimal.implemented(design, drive))
    a.parts.append(
        effort.table(
            [(name, tools.design(f"ipmsm_390w_{name}")) for name in ("speed", "conventional")]
        )
    )
    b = paper_b.section(tools, published["B"], servo["motor"][paper_b.INDUCTANCE])
    tools.tell("Theorem 1")
    b.parts += [theorem.constants(), theorem.bounds(servo_designs(tools), servo["motor"])]
    if published.unread():
        raise ReportError(
            f"numbers of the papers that the page does not show: {', '.join(published.unread())}"
        )
    return [
        summary.section(a, b),
        a,
        b,
        not_reproduced(),
        guarantees.section(stored.read(tools)),
        campaign.section(campaigns.read(tools)),
    ]


def servo_designs(tools: Tools) -> list:
    """CDOBC repaired and as printed, each with what it does in Case IV."""
    found = []
    for name, drive in (
        ("repaired, N = 2", "servo_200w_cdobc"),
        ("printed, N = 1", "servo_200w_cdobc_printed"),
    ):
        run = tools.run("servo_case_3_4", drive, name=f"theorem-{drive}")
        simulated = (
            "trips" if run.result["fault"] != "none" else run.measure("case_4")["fluctuation_rpm"]
        )
        found.append((name, tools.design(drive), simulated))
    return found


def not_reproduced() -> Section:
    """The chapters of docs/errata.md."""
    chapters = (
        "Not reproduced",
        "Printed wrong",
        "The conventional near optimal control",
        "Printed wrong, or left open",
    )
    text = Markup("").join(
        Markup("<h3>{}</h3>").format(title) + pages.from_docs("errata.md", title)
        for title in chapters
    )
    return Section("not-reproduced", "What does not reproduce, and why", text)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(prog="./dev report", description=__doc__)
    parser.add_argument(
        "what",
        nargs="?",
        choices=("guarantees", "campaign"),
        help="guarantees: compute them anew, minutes; campaign: keep what finished ones have found",
    )
    parser.add_argument("directories", nargs="*", type=Path, help="of campaigns")
    parser.add_argument("--out", type=Path, default=ROOT / "build/report")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/host/bin")
    options = parser.parse_args()
    if (options.what == "campaign") != bool(options.directories):
        parser.error("campaign, and it alone, takes directories")
    count = 0

    def tell(what: str) -> None:
        nonlocal count
        count += 1
        print(
            f"\r\033[K[{count}] {what}" if sys.stdout.isatty() else f"[{count}] {what}",
            end="" if sys.stdout.isatty() else "\n",
            flush=True,
        )

    try:
        tools = Tools(options.bin, options.out / "data", tell)
        if options.what == "guarantees":
            from .guarantees import compute  # its solvers take seconds to load

            compute.write(tools)
            return 0
        if options.what == "campaign":
            campaigns.write(tools, options.directories)
            return 0
        sections = collect(tools)
        page = options.out / "report.html"
        text = pages.render(sections)
        page.write_text(text, encoding="utf-8")
        tell("PDF")
        has_pdf = pages.print_pdf(page, options.out / "report.pdf")
    except ReportError as error:
        print(f"\nreport: {error}", file=sys.stderr)
        return 1
    print(f"\n{page}" + (f"\n{page.with_suffix('.pdf')}" if has_pdf else "\nno Chromium: no PDF"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
