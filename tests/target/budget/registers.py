# SPDX-License-Identifier: MIT
"""Float registers of compiled code, counted as a machine with eight of them would have to move
them.

The Cortex-M4F keeps 32 values, the C28x eight. Each function is walked once, block by block in the
order of its addresses. A value that is read and not held is loaded again. The value whose next use
is farthest gives way to another one. It is stored first, unless it has a copy in memory: a load, a
constant and a stored value have one. A call, a division and a square root keep four values: R4H to
R7H belong to the caller. Further passes of a loop are not walked.
"""

import re

FLOAT_REGISTERS = 8
KEPT_BY_CALLS = 4
ARGUMENTS = 4  # R0H to R3H; further ones arrive in memory
NEVER = 1 << 20  # no way leads to a use
READ_ONLY = ("vcmp", "vcmpe", "vstr", "vstmia", "vstmdb")
ACCUMULATE = ("vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms")
SAVED_BY_CALLED = 16  # s16 and above outlast a call on the Cortex-M4F


def numbers(text):
    """Single registers named in operands, d registers as two, ranges of a list in full."""
    result = []
    for kind, first, last in re.findall(r"\b([sd])(\d+)\b(?:-[sd](\d+))?", text):
        for n in range(int(first), int(last or first) + 1):
            result += [n] if kind == "s" else [2 * n, 2 * n + 1]
    return result


def access(i):
    """(registers read, registers written) of one instruction; what a call does not save may hold
    its results."""
    if i.flow == "call":
        return (), tuple(range(SAVED_BY_CALLED))
    if not i.name.startswith("v") or i.name in ("vpush", "vpop", "vmrs"):
        return (), ()
    if i.name in READ_ONLY:
        return tuple(numbers(i.operands)), ()
    if i.name.startswith("vldm"):
        return (), tuple(numbers(i.operands))
    parts = [numbers(part) for part in i.operands.split(",")]
    if i.name == "vmov" and len(parts) == 4:  # two registers at once
        return tuple(parts[2] + parts[3]), tuple(parts[0] + parts[1])
    written, read = parts[0], sum(parts[1:], [])
    if i.name in ACCUMULATE or i.conditional:
        read = read + written
    return tuple(read), tuple(written)


def is_call(i):
    return i.flow == "call" or i.name in ("vdiv", "vsqrt")


def successors(i, code):
    found = [i.next] if i.next and i.flow in ("", "conditional", "call") else []
    if (
        i.flow in ("branch", "conditional")
        and i.target in code
        and code[i.target].function == i.function
    ):
        found.append(code[i.target])
    return found


def next_uses(function, code, accesses):
    """{address: {register: instructions to its next use}} before each instruction."""
    uses, after = (
        {i.address: {} for i in function},
        {i.address: successors(i, code) for i in function},
    )
    changed = True
    while changed:
        changed = False
        for i in reversed(function):
            read, written = accesses[i.address]
            merged = {}
            for following in after[i.address]:
                for register, distance in uses[following.address].items():
                    merged[register] = min(distance + 1, merged.get(register, NEVER))
            for register in written:
                merged.pop(register, None)
            for register in read:
                merged[register] = 0
            if merged != uses[i.address]:
                uses[i.address], changed = merged, True
    return uses


class Held:
    """Values in the registers of the machine, and those of all values that have a copy in
    memory."""

    def __init__(self, held=(), stored=()):
        self.held, self.stored, self.moves = set(held), set(stored), 0

    @classmethod
    def first(cls, uses, room):
        """The values that are used first are held, the others are in memory."""
        nearest = sorted(uses, key=lambda r: (uses[r], r))
        return cls(nearest[:room], nearest[room:])

    def copy(self):
        return Held(self.held, self.stored)

    def make_room(self, room, uses, busy=()):
        """Values give way until no more than room are held. Those in use give way last."""
        self.held &= set(uses) | set(busy)
        while len(self.held) > room:
            free = self.held - set(busy) or self.held
            victim = max(free, key=lambda r: (uses.get(r, 0), r))
            self.held.remove(victim)
            if victim not in self.stored:
                self.stored.add(victim)
                self.moves += 1

    def step(self, i, access_of, before, after):
        """Moves that one instruction needs; before, after: next uses."""
        read, written = access_of
        self.moves = 0
        for register in read:
            if register not in self.held:
                self.moves += 1
                self.held.add(register)
                self.stored.add(register)
                self.make_room(FLOAT_REGISTERS, before, read)
        if is_call(i):
            self.make_room(KEPT_BY_CALLS, {r: d for r, d in after.items() if r not in written})
        for register in written:
            if not i.conditional:
                self.held.discard(register)
        in_memory = i.name.startswith("vld") or i.name == "vmov" and "#" in i.operands
        (self.stored.update if in_memory else self.stored.difference_update)(written)
        live = [register for register in written if register in after]
        self.held.update(live)
        self.make_room(FLOAT_REGISTERS, after, live)
        return self.moves


def count_spills(code):
    """Adds the moves of each instruction to its counts, as spill."""
    functions = {}
    for address in sorted(code):
        functions.setdefault(code[address].function, []).append(code[address])
    for function in functions.values():
        accesses = {i.address: access(i) for i in function}
        if not any(read or written for read, written in accesses.values()):
            continue
        uses = next_uses(function, code, accesses)
        arriving, state = {}, Held.first(uses[function[0].address], ARGUMENTS)
        for i in function:
            if state is None:
                state = arriving.get(i.address)
            if state is None:  # reached from behind only
                state = Held.first(uses[i.address], FLOAT_REGISTERS)
            following = successors(i, code)
            after = {}
            for goal in following:
                for register, distance in uses[goal.address].items():
                    after[register] = min(distance, after.get(register, NEVER))
            if moves := state.step(i, accesses[i.address], uses[i.address], after):
                i.counts["spill"] = moves
            for goal in following:
                if goal is not i.next:
                    arriving.setdefault(goal.address, state.copy())
            if i.flow in ("branch", "return"):
                state = None
