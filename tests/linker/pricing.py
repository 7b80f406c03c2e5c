# SPDX-License-Identifier: MIT
"""Cycles of the dearest way through a listing. Flash factors, library prices, bounds of loops and
the search are those of `./dev budget`."""

import re
import sys
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "target" / "budget"))
import listing

from costs import Costs
from longest_path import LongestPath
from origin import FLASH

# Run-time library of TI's compiler -> name in costs.toml, call and return included.
LIBRARY = {
    "__c28xabi_divf": "fp_div",
    "FS$$DIV": "fp_div",
    "sqrtf": "fp_sqrt",
    "sinf": "sinf",
    "cosf": "cosf",
    "memset": "memset",
    "memcpy": "memcpy",
}
# Functions of law_t by the word at which their address stands there.
LAW = {0: "check", 2: "reset", 4: "step", 6: "counts_ok"}


def is_float(mnemonic, operands):
    """Instructions whose delay hides a part of the flash's waits, as `of_float` of costs.toml."""
    moves = re.fullmatch(r"R\d+H\s*,\s*R\d+H\b.*|\*SP\+\+.*|R\d+H\s*,\s*\*--SP.*", operands)
    return "F32" in mnemonic or mnemonic in ("MOVST0", "NOP") or mnemonic == "MOV32" and bool(moves)


def price_list(costs):
    """{name of a count: cycles}; names are made by instructions()."""
    own = {
        "cycles": 1,
        "float": 1,
        "call": listing.CALL,
        "return": listing.RETURN,
        "branch": listing.BRANCH,
        "not_taken": listing.BRANCH,
        "taken": listing.BRANCH,
        "taken, long": listing.LONG_BRANCH_TAKEN,
        "branch, long": listing.LONG_BRANCH_TAKEN,
        "not_taken, long": listing.BRANCH,
    }
    waits = {
        name + FLASH: cycles / costs.flash["float" if name == "float" else "other"]
        for name, cycles in own.items()
    }
    return {**own, **waits, **{name: costs.of[known] for name, known in LIBRARY.items()}}


def repeats(mnemonic, operands):
    """Passes of the next instruction beyond the first."""
    match = re.match(r"#(\d+)", operands) if mnemonic == "RPT" else None
    return int(match[1]) if match else 0


def law_call(lines, index):
    """Function of law_t that a call through XAR7 reaches, by the load in front of it."""
    for mnemonic, operands in reversed(lines[:index]):
        if mnemonic == "MOVL" and operands.startswith("XAR7"):
            match = re.search(r"\*\+XAR\d\[(\d)\]", operands)
            return LAW.get(int(match[1])) if match else None
    return None


def instructions(functions, in_flash):
    """{address: what LongestPath reads of an instruction}; `unknown`: calls that have no price."""
    code, unknown, start, first = {}, set(), {}, 0
    for function in functions.values():
        start[function.name] = first
        first += len(function.lines) + 1
    for function in functions.values():
        at, before = start[function.name], None
        memory = FLASH if function.name in in_flash else ""
        for n, (mnemonic, operands) in enumerate(function.lines):
            kind = "float" if is_float(mnemonic, operands) else "cycles"
            i = SimpleNamespace(
                address=at + n, function=function.name, counts=Counter(), flow="", target=None,
                target_name=function.name, memory=memory, free=False, next=None,
            )  # fmt: skip
            label = re.search(r"\|\|([^|]+)\|\|", operands)
            name = label[1] if label else None
            if mnemonic in listing.RETURNS:
                i.flow = "return"
            elif mnemonic in listing.CALLS or mnemonic == "LB" and name not in function.labels:
                i.flow = "call" if mnemonic in listing.CALLS else "branch"
                i.target_name = name or law_call(function.lines, n) or "step"
            elif mnemonic in listing.BRANCHES:
                always = mnemonic != "BANZ" and ("UNC" in operands or "," not in operands)
                i.flow = "branch" if always else "conditional"
                i.target = at + function.labels[name]
                i.memory = (", long" if mnemonic in listing.SLOW_BRANCHES else "") + memory
            else:
                i.counts[kind + memory] = 1 + repeats(mnemonic, operands)
            if before:
                before.next = i
            code[i.address] = before = i
    for i in code.values():
        if i.flow and i.target_name != i.function and i.target is None:
            i.target = start.get(i.target_name)
            if i.target is None and i.target_name not in LIBRARY:
                unknown.add(i.target_name)
    return code, unknown


class Dearest(LongestPath):
    """A loop that the budget does not bound at this place takes the law's largest bound."""

    def __init__(self, functions, law, in_flash):
        costs, self.assumed = Costs(), set()
        code, self.unknown = instructions(functions, in_flash)
        prices = {**price_list(costs), **{name: listing.CALL for name in self.unknown}}
        loops = {**costs.loops, **costs.loops_of.get(law, {})}
        self.most = max(n for bounds in loops.values() for n in bounds)
        super().__init__(
            code,
            set(LIBRARY) | self.unknown,
            loops,
            lambda counts: sum(n * prices[name] for name, n in counts.items()),
        )

    def _passes(self, name, head, graph, start):
        try:
            return super()._passes(name, head, graph, start)
        except ValueError:
            self.assumed.add(name)
            return self.most


def dearest(functions, name, law, in_flash=()):
    """(cycles, callees without a price, functions with a loop of unknown bound)."""
    way = Dearest(functions, law, in_flash)
    cycles = way.cost(way.function(name))
    return round(cycles), way.unknown, way.assumed
