# SPDX-License-Identifier: MIT
"""The image of the B-G431B-ESC1, as it is flashed. Two builds in two directories have the same
octets. Vectors, forbidden routines, flash, RAM and the need of stack are checked.

    check_image.py [-v] [--keep FILE]    # leaves the image there, for tests that run it

Without the compiler nothing is checked, and a line says so.
"""

import hashlib
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PRESET = "stm32g431-release"
TOOL = "arm-none-eabi-"
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "cmake", "firmware", "linker")

FLASH = range(0x08000000, 0x0801C000)
FLASH_octets = 112 * 1024  # linker/stm32g431.ld; behind it are the slots of the store
RAM_octets = 32 * 1024
RAM_most = 0.9  # chosen: of the RAM, with the whole stack
STACK_most = 0.85  # as of the F28335's stack (tests/target/check_stack.py)

# Places of the handlers in the table of vectors: 16 and the interrupt's number (registers.h).
VECTORS = {1: "startup_reset", 2: "fault_nmi", 3: "fault", 11: "fault", 15: "tick_is_missing"}
INTERRUPTS = {"IRQ_ADC1_2": "control_isr", "IRQ_FDCAN1_IT0": "can_isr", "IRQ_USART2": "serial_isr"}
# Double precision by software, the heap, and formatted output.
FORBIDDEN = r"__aeabi_(d\w+|f2d|i2d|ui2d|l2d)|_?malloc\w*|_?sbrk\w*|_?v?s?n?printf\w*"

# A level of interrupts: eight words, 18 of the floats, one to align.
ENTRY_octets = 4 * (8 + 18 + 1)
# Routines of the library have no graph. Chosen: a leaf's saved registers, and those of a division.
LIBRARY_octets = {"__aeabi_uldivmod": 128, "__aeabi_ldivmod": 128}
LEAF_octets = 64
LEAVES = {"memset", "memcpy", "memmove", "memcmp", "strlen", "fminf", "fmaxf", "fabsf", "sqrtf"}
LAW = r"firmware/(?:one_unit/)?(?:\.\./)?control/(?:laws|fields)/law_\w+\.c|one_unit/law_\w+\.c"


def run(*command, **more):
    done = subprocess.run(
        [str(c) for c in command], capture_output=True, text=True, check=False, **more
    )
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(str(c) for c in command)}:\n{done.stdout}{done.stderr}")
    return done.stdout


def build(source, directory):
    environment = {**os.environ, "CCACHE_DISABLE": "1"}
    run("cmake", "--preset", PRESET, "-B", directory, cwd=source, env=environment)
    run("cmake", "--build", directory, "--target", "sdre_stm32g431", env=environment)
    return directory / "bin/sdre_stm32g431.elf"


def octets_of(elf):
    """Those that a programming tool writes."""
    binary = elf.with_suffix(".bin")
    run(f"{TOOL}objcopy", "-O", "binary", elf, binary)
    return binary.read_bytes()


def symbols_of(elf):
    return {
        name: int(value, 16)
        for value, name in re.findall(r"^([0-9a-f]{8}) \w (\S+)$", run(f"{TOOL}nm", elf), re.M)
    }


def sections_of(elf):
    return {
        name: (int(size), int(place))
        for name, size, place in re.findall(
            r"^(\.\S+) +(\d+) +(\d+)$", run(f"{TOOL}size", "-A", elf), re.M
        )
    }


def same(first, second):
    """Two builds in two directories."""
    sums = [hashlib.sha256(octets).hexdigest() for octets in (first, second)]
    return [] if sums[0] == sums[1] else [f"two builds differ: {sums[0]}, {sums[1]}"]


def vectors(octets, symbols):
    header = (ROOT / "firmware/board/stm32g431/registers.h").read_text()
    numbers = dict(re.findall(r"(IRQ_\w+) = (\d+)", header))
    expected = {**VECTORS, **{16 + int(numbers[n]): to for n, to in INTERRUPTS.items()}}
    last = max(expected)
    table = struct.unpack(f"<{last + 1}I", octets[: 4 * (last + 1)])
    wrong = []
    if table[0] != symbols["image_stack_top"]:
        wrong.append(f"the first stack pointer is {table[0]:#x}")
    for n, address in enumerate(table[1:], 1):
        name = expected.get(n, "fault")
        if address != symbols[name] + 1:  # Thumb code
            wrong.append(f"vector {n} is {address:#x}, not {name}")
    return wrong


def links(symbols):
    return [f"links {name}" for name in symbols if re.fullmatch(FORBIDDEN, name)]


def memory(octets, sections, symbols):
    used = sum(
        size
        for name, (size, _) in sections.items()
        if name in (".ccm", ".stack", ".data", ".bss", ".noinit")
    )
    code, _ = sections[".ccm"]
    print(f"flash {len(octets)} of {FLASH_octets} octets, {100 * len(octets) / FLASH_octets:.1f} %")
    print(
        f"RAM {used} of {RAM_octets} octets, {100 * used / RAM_octets:.1f} %, "
        f"{code} of them code of the tick"
    )
    wrong = []
    law = symbols["step"] - symbols["image_ccm"]
    if law not in range(code):
        wrong.append("the law is not in the CCM SRAM")
    if used > RAM_most * RAM_octets:
        wrong.append("the RAM is too full")
    if symbols["image_guard"] % 32 != 0 or symbols["image_stack"] - symbols["image_guard"] != 32:
        wrong.append("the guard below the stack is no region of 32 octets")
    if symbols["image_store"] not in range(FLASH.stop, FLASH.stop + 1):
        wrong.append("the store does not begin behind the program")
    return wrong


class Graph:
    """Frames in octets and calls of every function, as the linker's step has written them."""

    def __init__(self, text, symbols):
        """Functions that are alike are one: the graph has a node for one of their names."""
        self.frame, self.calls, self.file, self.alike, self.known = {}, {}, {}, {}, {}
        for name, address in symbols.items():
            self.alike.setdefault(address, []).append(self.name(name))
        self.address = {self.name(name): address for name, address in symbols.items()}
        for title, label, tail in re.findall(
            r'node: \{ title: "([^"]+)" label: "([^"]*)"([^}]*)\}', text
        ):
            if "ellipse" not in tail:
                name = self.name(title)
                octets, kind = re.search(r"(\d+) bytes \(([^)]*)\)", label).groups()
                if "dynamic" in kind and "bounded" not in kind:
                    raise SystemExit(f"{name}: a frame without a bound")
                self.frame[name] = max(int(octets), self.frame.get(name, 0))
                self.file[name] = re.search(r"\\n(\S+?):\d+:\d+\\n", label).group(1)
        for caller, callee, label in re.findall(
            r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)" label: "([^"]*)"', text
        ):
            self.calls.setdefault(self.name(caller), set()).add((self.name(callee), label))

    @staticmethod
    def name(title):
        return re.sub(r"\.lto_priv\.\d+$", "", title.rsplit(":", 1)[-1])

    def callees(self, name):
        found = set()
        for callee, site in self.calls.get(name, ()):
            if callee != "__indirect_call":
                found.add(callee)
            elif "control_isr.c" in site:
                found.add("app_tick")
            else:  # the law that is linked
                found |= {n for n, file in self.file.items() if re.search(LAW, file)}
        return found

    def depth(self, name, path=()):
        """Octets that a call of this needs at most, and the chain that needs them."""
        if name not in self.known:
            self.known[name] = self.measured(name, path)
        return self.known[name]

    def measured(self, name, path):
        if name in path:
            raise SystemExit("recursion: " + " -> ".join((*path, name)))
        if name not in self.frame:
            twins = [n for n in self.alike.get(self.address.get(name), ()) if n in self.frame]
            if twins:
                return self.depth(twins[0], path)
            if name not in LEAVES and name not in LIBRARY_octets:
                raise SystemExit(f"{name}: no frame is known")
            return LIBRARY_octets.get(name, LEAF_octets), (name,)
        below = [self.depth(callee, (*path, name)) for callee in sorted(self.callees(name))]
        octets, chain = max(below, default=(0, ()))
        return octets + self.frame[name], (f"{name} {self.frame[name]}", *chain)


def stack(directory, symbols, verbose):
    (file,) = directory.glob("bin/*.ltrans.ci")
    graph = Graph(file.read_text(), symbols)
    size = symbols["image_stack_top"] - symbols["image_stack"]
    background = graph.depth("startup_reset")
    levels = [
        max(graph.depth(n) for n in ("serial_isr", "can_isr")),
        graph.depth("control_isr"),
        graph.depth("tick_is_missing"),
        graph.depth("fault_nmi"),
    ]
    octets = background[0] + sum(ENTRY_octets + level[0] for level in levels)
    print(
        f"stack {octets} of {size} octets, {100 * octets / size:.1f} %: background "
        f"{background[0]}, then {', '.join(str(level[0]) for level in levels)} and "
        f"{ENTRY_octets} for each level; {len(graph.frame)} functions, no recursion"
    )
    if verbose:
        for _, chain in (background, *levels):
            print("  " + " -> ".join(chain))
    return [] if octets <= STACK_most * size else ["the stack is too small"]


def main():
    if not shutil.which(f"{TOOL}gcc"):
        print(f"stm32g431.image: nothing checked, there is no {TOOL}gcc")
        return 0
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        first = build(ROOT, work / "first")
        copy = work / "another/place"
        copy.mkdir(parents=True)
        for name in SOURCES:
            source = ROOT / name
            (shutil.copytree if source.is_dir() else shutil.copy)(source, copy / name)
        second = build(copy, work / "second")

        octets, symbols = octets_of(first), symbols_of(first)
        wrong = same(octets, octets_of(second))
        wrong += vectors(octets, symbols)
        wrong += links(symbols)
        wrong += memory(octets, sections_of(first), symbols)
        wrong += stack(work / "first", symbols, "-v" in sys.argv)
        print(f"sha256 {hashlib.sha256(octets).hexdigest()}")
        if "--keep" in sys.argv:
            kept = Path(sys.argv[sys.argv.index("--keep") + 1])
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(first, kept)
    for line in wrong:
        print(f"stm32g431.image: {line}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
