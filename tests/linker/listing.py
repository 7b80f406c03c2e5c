# SPDX-License-Identifier: MIT
"""Reads what TI's compiler and linker write: assembly listings, and the link information in XML."""

import re
import xml.etree.ElementTree as ElementTree
from collections import namedtuple

# Cycles of a listed line: docs/hardware.md, "How the cycles were calibrated". The second of a
# parallel pair has no line of its own.
CALL, RETURN = 4, 8
LONG_BRANCH_TAKEN, BRANCH = 7, 4
RETURNS = ("LRETR", "LRET", "LRETE", "IRET")
CALLS = ("LCR", "LC", "FFC")
BRANCHES = ("B", "BF", "SB", "SBF", "LB", "BAR", "BANZ")
SLOW_BRANCHES = ("B", "SB")

Area = namedtuple("Area", "name origin length used")
Linked = namedtuple("Linked", "section address")  # address where it runs
Group = namedtuple("Group", "name load run size")


class Function:
    """Instructions of one section; `frame` in words, without what calls push."""

    def __init__(self, name):
        self.name, self.frame, self.words = name, None, 0
        self.lines = []  # (mnemonic, operands)
        self.labels = {}  # label -> index of the next line


def read(text):
    """{name: Function} of a listing."""
    functions, now = {}, None
    for line in text.splitlines():
        if match := re.search(r'\.sect\s+"([^"]+)"', line):
            root, _, name = match.group(1).partition(":")
            now = (
                functions.setdefault(name, Function(name))
                if name and root in (".text", ".TI.ramfunc")
                else None
            )
        elif now is None:
            continue
        elif match := re.search(r"\* FNAME: (\S+)\s+FR SIZE:\s*(\d+)", line):
            now.frame = int(match.group(2))
        elif match := re.match(r"\s*\d+\s+\|\|(\S+)\|\|:", line) or re.match(
            r"\s*\d+\s+[0-9a-f]{8}\s+\|\|(\S+)\|\|:", line
        ):
            now.labels[match.group(1)] = len(now.lines)
        elif match := re.match(r"\s*\d*\s+[0-9a-f]{8}[!= ]\s?[0-9A-F]{4}", line):
            now.words += 1
            if code := re.match(
                r"[!= ]?\s*(?:\|\|)?\s*([A-Z][A-Z0-9]*)\s*([^;]*)", line[match.end() :]
            ):
                now.lines.append((code.group(1), code.group(2).strip()))
    return {name: function for name, function in functions.items() if function.words}


def _number(element, tag):
    text = element.findtext(tag)
    return int(text, 16) if text else None


def read_link(text):
    """(areas, groups, {function: [Linked of each of this name]}) of a link information file."""
    root = ElementTree.fromstring(text)
    areas = [
        Area(
            a.findtext("name"), _number(a, "origin"), _number(a, "length"), _number(a, "used_space")
        )
        for a in root.iter("memory_area")
    ]
    groups = [
        Group(
            g.findtext("name"),
            _number(g, "load_address"),
            _number(g, "run_address"),
            _number(g, "size") or 0,
        )
        for g in root.iter("logical_group")
    ]
    linked = {}
    for part in root.iter("object_component"):
        section, _, name = (part.findtext("name") or "").partition(":")
        if name and section in (".text", ".TI.ramfunc"):
            address = _number(part, "run_address")
            linked.setdefault(name, []).append(
                Linked(section, _number(part, "load_address") if address is None else address)
            )
    return areas, groups, linked
