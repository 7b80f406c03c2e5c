# SPDX-License-Identifier: MIT
"""What the replay image executed, tick by tick, from the emulator's log."""

import subprocess
from collections import Counter

from origin import FLASH


def run(command, directory=None):
    status = subprocess.run(command, cwd=directory).returncode
    if status != 0:
        raise RuntimeError(f"{command[0]} ended with {status}")


EMULATOR = [
    "qemu-system-arm",
    "-M",
    "mps2-an386",
    "-display",
    "none",
    "-monitor",
    "none",
    "-serial",
    "none",
    "-semihosting-config",
    "enable=on,target=native",
]
TICKS = ("drive_tick", "pi_foc_tick")
ICOUNT_SHIFT = (
    8  # chosen: 256 ns per instruction are 6.4 timer counts, enough to tell instructions apart
)
PAGE_BITS = 10  # of the emulated Cortex-M: no block goes on beyond 1 KB
COUNTS_PER_INSTRUCTION = 256e-9 * 25e6


def count_instructions(image, directory):
    """Replays with every instruction taking the same virtual time; leaves results.bin."""
    run(EMULATOR + ["-icount", f"shift={ICOUNT_SHIFT}", "-kernel", image], directory)


def exit_code(image):
    """Of an image that ends by itself."""
    return subprocess.run(EMULATOR + ["-kernel", image], timeout=60).returncode


class Steps:
    """Operations from the start of one logged block to the start of the next."""

    def __init__(self, code, library, tables):
        self.code, self.library, self.tables = code, library, tables
        self.known = {}  # (block, next block) -> [cost per table, instructions], counts

    def __getitem__(self, key):
        step = self.known.get(key)
        if step is None:
            counts, instructions = self._count(*key)
            step = self.known[key] = (
                tuple(cost(counts) for cost in self.tables),
                instructions,
                counts,
            )
        return step

    def _run(self, block, after):
        """Instructions from block on, and whether the last one leaves it. The emulator ends a block
        at the end of a page. The last instruction may lead to the same place."""
        i, end, passed, short = self.code[int(block, 16)], int(after, 16) if after else None, [], 0
        while True:
            passed.append(i)
            if i.flow:
                break
            i = i.next
            if i.address == end:
                short = len(passed)
        if short and (end not in self._goals(i) or (passed[short - 1].address ^ end) >> PAGE_BITS):
            return passed[:short], False
        return passed, True

    def _parts(self, block, after):
        """[(feature, counts)] of the instructions from block on, and of where the last one goes."""
        passed, leaves = self._run(block, after)
        end = int(after, 16) if after else None
        return [(i.feature, i.counts) for i in passed] + (
            [(passed[-1].feature, self._leave(passed[-1], end))] if leaves else []
        )

    def _count(self, block, after):
        return sum((counts for _, counts in self._parts(block, after)), Counter()), len(
            self._run(block, after)[0]
        )

    def by_feature(self, edges):
        """{feature: counts} of [(block, next block)]."""
        result = {}
        for edge in edges:
            for feature, counts in self._parts(*edge):
                result.setdefault(feature, Counter()).update(counts)
        return result

    def _goals(self, i):
        """Where control can be after i, as far as i says."""
        if i.flow == "conditional":
            return (i.target, i.next.address)
        if i.target_name in self.library:
            return (i.next.address,) if i.flow == "call" else ()
        return (i.target,) if i.flow in ("call", "branch") else ()

    def _leave(self, i, end):
        counts = Counter()
        if i.flow == "conditional":
            if end not in self._goals(i):
                raise ValueError(f"no way from {i.address:x} to {end:x}")
            if not i.free:
                counts[("taken" if end == i.target else "not_taken") + i.memory] += 1
        elif i.target_name in self.library:
            counts[i.target_name] += 1  # its price has call and return in it
        elif i.flow == "return" or i.target in self.code:
            counts[i.flow + i.memory] += 1
        else:
            raise ValueError(f"{i.target_name}() has no cost")
        if i.register and end != i.target:
            raise ValueError(f"the call at {i.address:x} went to {end:x}, not to {i.target_name}")
        return counts


def log_of(image, directory, *options):
    """The emulator writing one line per executed block; the block's address is the line's second
    field."""
    command = EMULATOR + ["-d", "exec,nochain", *options, "-D", "/dev/stdout", "-kernel", image]
    return subprocess.Popen(command, cwd=directory, stdout=subprocess.PIPE, bufsize=1 << 20)


def walk_ticks(image, directory, symbols, steps):
    """Yields (function, costs, instructions, path) of each call of drive_tick and pi_foc_tick, in
    order."""
    begin, end = symbols["image_core_begin"][0], symbols["image_core_end"][0]
    starts = {b"%08x" % symbols[name][0]: name for name in TICKS}
    others = {b"%08x" % symbols[name][0] for name in ("drive_init", "pi_foc_init")}
    current, path, known = None, [], {}

    def finished():
        """Many ticks take the same way; each way is added up once."""
        key = tuple(path)
        if key not in known:
            edges = [steps[edge] for edge in zip(path, path[1:] + [None])]
            costs = tuple(sum(column) for column in zip(*(edge[0] for edge in edges)))
            known[key] = (costs, sum(edge[1] for edge in edges))
        return (current, *known[key], key)

    with log_of(image, directory, "-dfilter", f"{begin:#x}..{end - 1:#x}") as emulator:
        for line in emulator.stdout:
            block = line.split(b"/", 2)[1]
            if block in starts or block in others:
                if current:
                    yield finished()
                current, path = starts.get(block), []
            path.append(block)
        if current:
            yield finished()
    if emulator.returncode != 0:
        raise RuntimeError(f"the logged replay ended with {emulator.returncode}")


class Away:
    """Where control comes back to after a block that ends in a call of a library function; None for
    any other block."""

    def __init__(self, code, library):
        self.code, self.library, self.known = code, library, {}

    def __getitem__(self, block):
        if block not in self.known:
            i = self.code[int(block, 16)]
            while not i.flow:
                i = i.next
            away = i.flow == "call" and i.target_name in self.library
            self.known[block] = b"%08x" % i.next.address if away else None
        return self.known[block]


def calls_in(log, start, steps, away):
    """Yields the path of each call of the function at start. The log may hold anything before and
    after a call, and in it what a library function calls in turn: both are left out."""
    path, depth, back = [], 0, None
    for block in log:
        if path:
            if back and block != back:
                continue
            counts = steps[path[-1], block][2]
            depth += sum(counts["call" + m] - counts["return" + m] for m in ("", FLASH))
            if depth < 0:
                yield tuple(path)
                path = []
        if path or block == start:
            if not path:
                depth = 0
            path.append(block)
            back = away[block]


def walk_calls(image, directory, symbols, name, steps):
    """Yields the path of each call of a function of the image; away from it is all that is not in
    its code."""
    begin, end = symbols["image_core_begin"][0], symbols["image_core_end"][0]
    with log_of(image, directory, "-dfilter", f"{begin:#x}..{end - 1:#x}") as emulator:
        log = (line.split(b"/", 2)[1] for line in emulator.stdout)
        yield from calls_in(log, b"%08x" % symbols[name][0], steps, Away(steps.code, steps.library))
    if emulator.returncode != 0:
        raise RuntimeError(f"{image} ended with {emulator.returncode}")


def single_steps(image, directory, symbols, calls):
    """[(all instructions, those of the core)] of the first calls of a tick, one log line per
    instruction."""
    begin, end = symbols["image_core_begin"][0], symbols["image_core_end"][0]
    starts = {symbols[name][0] for name in TICKS}
    # What calls the ticks, as far as the compiler did not inline it into main.
    callers = [
        range(symbols[f][0], sum(symbols[f][:2]))
        for f in ("main", "replay_run", "replay")
        if f in symbols
    ]
    result, inside = [], False
    with log_of(image, directory, "-singlestep") as emulator:
        for line in emulator.stdout:
            address = int(line.split(b"/", 2)[1], 16)
            if address in starts:
                result.append([0, 0])
                inside = True
            elif any(address in caller for caller in callers):
                inside = False
                if len(result) == calls:
                    break
            if inside:
                result[-1][0] += 1
                result[-1][1] += begin <= address < end
        emulator.kill()
    return result


def path_counts(path, steps):
    total = Counter()
    for edge in zip(path, path[1:] + (None,)):
        total.update(steps[edge][2])
    return total
