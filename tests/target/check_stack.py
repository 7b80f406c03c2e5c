# SPDX-License-Identifier: MIT
"""The most that the stack can need: the longest chain of calls in the background, with the longest
of the interrupts on top, by gcc's own call graph and frames, against the stack of the image. No
function may call itself, by whatever way.

    check_stack.py [-v] [COMPILER..]   default: arm-none-eabi-gcc where there is one, else gcc

gcc (32-bit x86) shows recursion only: with six registers for whole numbers it needs more stack than
any drive's processor.

A pointer in the core leads to every function of every law, the one in the control interrupt to
app_tick(); any other is an error, as is a function whose frame is not known. Two octets are one
word of the C28x.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BOARD = ROOT / "firmware/board/f28335"
HEADERS = ROOT / "host_tools/sil/f28335/include"
ROOMS = [
    ROOT / f"firmware/{name}"
    for name in ("control", "commission", "store", "app", "board/program", "board/f28335")
]
FOLDERS = [path for room in ROOMS for path in (room, *sorted(room.glob("*/")))]
FLAGS = [
    "-std=c99",
    "-O2",
    "-w",
    "-ffreestanding",
    "-fno-math-errno",
    "-fcallgraph-info=su",
    "-S",
    *[f"-I{p}" for p in (*FOLDERS, BOARD.parent, ROOT / "firmware/config")],
    "-isystem",
    str(ROOT / "tests/target/include"),
    "-isystem",
    str(HEADERS),
    "-include",
    str(HEADERS / "c28_cpu.h"),
]
MACHINE = {
    "arm-none-eabi-gcc": [
        "-mcpu=cortex-m4",
        "-mthumb",
        "-mfpu=fpv4-sp-d16",
        "-mfloat-abi=hard",
        "-fno-short-enums",
        "-ffinite-math-only",
        "-fno-signed-zeros",
    ],
    "gcc": ["-m32", "-msse2", "-mfpmath=sse", "-mregparm=3", "-mpreferred-stack-boundary=2"],
}  # pointers of two words, as there
# What the C28x has as instructions or inlined loops, and what is one register's access there.
LIBRARY = {
    "fabsf",
    "fminf",
    "fmaxf",
    "memcpy",
    "memset",
    "f28335_asm",
    "f28335_ecan_access",
    "f28335_delay_us",
    "f28335_scirxbuf_access",
    "f28335_scitxbuf_access",
    "f28335_wdkey_access",
    "ADC_cal",
}
LEFT = 0.15  # chosen: of the stack
LIBRARY_words = 16  # chosen: a leaf's return address and the registers that a callee saves
# The library's square root calls its division. Divisions of 64 bits: chosen, two operands of four
# words, a quotient, a rest, and what a callee saves beside them.
ROUTINE_words = {"sqrtf": 32, "__aeabi_ldivmod": 32, "__aeabi_uldivmod": 32}
# The C28x has eight float registers, this machine 32. A value in s8 .. s15 lies on the stack there
# and takes two words.
# Every function saves those of the others that it uses, in its frame.
SPILLED = range(8, 16)
# By the processor 14 and one to align; by the compiler RPC, eight XAR, XT, RB, STF and eight R, two
# words each.
INTERRUPT_words = 15 + 2 * (1 + 8 + 1 + 1 + 1 + 8)
# Which functions of a law are called by pointers of a file.
POINTERS = {"drive_config.c": {"check"}, "drive_tick.c": {"reset", "step", "counts_ok"}}
# The same of functions that are not static.
NAMED = {
    "drive_image.c": r"law_\w+_fields",
    "drive_adopt.c": r"law_\w+_adopt",
    "app_believe.c": r"law_\w+_believe",
}


class StackError(Exception):
    pass


class Graph:
    """Frames in words and callees of every function."""

    def __init__(self, texts, spilled=()):
        self.frame, self.calls, self.file = {}, {}, {}
        spilled = dict(spilled)
        for text in texts:
            for title, label, tail in re.findall(
                r'node: \{ title: "([^"]+)" label: "([^"]*)"([^}]*)\}', text
            ):
                if "ellipse" in tail:
                    continue
                octets, kind = re.search(r"(\d+) bytes \(([^)]*)\)", label).groups()
                if "dynamic" in kind and "bounded" not in kind:
                    raise StackError(f"{title}: a frame without a bound")
                self.frame[title] = (int(octets) + 1) // 2 + spilled.get(
                    title.rsplit(":", 1)[-1], 0
                )
                self.file[title] = (
                    re.search(r"([^/]*?):\d+:\d+\\n", label).group(1).split("\\n")[-1]
                )
            for caller, callee in re.findall(
                r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', text
            ):
                self.calls.setdefault(caller, set()).add(callee)
        self.laws = {n for n in self.frame if re.search(r"/law_\w+\.c:", n)}

    def callees(self, name):
        found = set(self.calls.get(name, ()))
        if "__indirect_call" in found:
            found.discard("__indirect_call")
            if name == "control_isr":
                found.add("app_tick")
            elif self.file[name] in NAMED:
                found |= {n for n in self.frame if re.fullmatch(NAMED[self.file[name]], n)}
            elif self.file[name] in POINTERS:
                found |= {n for n in self.laws if n.rsplit(":", 1)[1] in POINTERS[self.file[name]]}
            else:
                raise StackError(f"{name} calls by a pointer that nobody knows")
        return found

    def depth(self, name, path=()):
        """Words that a call of this needs at most, and the chain that needs them."""
        if name in path:
            raise StackError("recursion: " + " -> ".join((*path, name)))
        if name not in self.frame:
            if name in ROUTINE_words or name in LIBRARY:
                return ROUTINE_words.get(name, LIBRARY_words), (name,)
            raise StackError(f"{name}: no frame is known")
        if name not in self.known:
            below = [self.depth(callee, (*path, name)) for callee in sorted(self.callees(name))]
            words, chain = max(below, default=(0, ()))
            self.known[name] = (words + self.frame[name], (name, *chain))
        return self.known[name]

    known = None

    def whole(self):
        """All depths anew, from every function: recursion shows wherever it is."""
        self.known = {}
        for name in self.frame:
            self.depth(name)
        return self.known


def spilled_words(assembly):
    """{function: words} of the float registers beyond eight that no frame has in it; of two
    functions of one name the larger."""
    found = {}
    for name, body in re.findall(
        r"^([A-Za-z_][\w.]*):\n(.*?)^\t\.size\t\1,", assembly, flags=re.M | re.S
    ):
        used = {int(n) for n in re.findall(r"\bs(\d+)\b", body)}
        used |= {m for n in re.findall(r"\bd(\d+)\b", body) for m in (2 * int(n), 2 * int(n) + 1)}
        found[name] = max(found.get(name, 0), 2 * sum(n in used for n in SPILLED))
    return found


def graph_of(compiler, files):
    with tempfile.TemporaryDirectory() as work:

        def compile_one(file):
            command = [
                compiler,
                *MACHINE.get(Path(compiler).name, []),
                *FLAGS,
                str(file),
                "-o",
                f"{work}/{file.stem}.s",
            ]
            result = subprocess.run(command, capture_output=True, text=True, cwd=work)
            if result.returncode != 0:
                raise SystemExit(f"{' '.join(command)}:\n{result.stderr}")

        with ThreadPoolExecutor() as pool:
            list(pool.map(compile_one, files))
        spilled = {}
        if "arm" in Path(compiler).name:
            for assembly in sorted(Path(work).glob("*.s")):
                for name, words in spilled_words(assembly.read_text()).items():
                    spilled[name] = max(words, spilled.get(name, 0))
        return Graph([p.read_text() for p in sorted(Path(work).glob("*.ci"))], spilled)


def self_test(compiler):
    """Each of these has to be found."""
    apart = "__attribute__((noipa)) int"
    seeds = {
        "recursion": f"int g(int); {apart} f(int x) {{ return x > 0 ? g(x) + 1 : 0; }} {apart} "
        f"g(int x) {{ return f(x - 1) * 2; }}",
        "pointer": "int f(int (*p)(int)) { return p(1) + 1; }",
        "without a bound": "void g(char *); void f(int n) { char a[n]; g(a); }",
        "no frame": "int g(int); int f(int x) { return g(x) + 1; }",
    }
    for wanted, text in seeds.items():
        with tempfile.TemporaryDirectory() as work:
            source = Path(work) / "seed.c"
            source.write_text(text)
            try:
                graph_of(compiler, [source]).whole()
            except StackError as error:
                if wanted in str(error):
                    continue
            raise SystemExit(f"{compiler}: the seeded defect is not found: {wanted}")


def stack_words():
    return int(
        re.search(r"--stack_size=(0x[0-9a-fA-F]+)", (BOARD / "CMakeLists.txt").read_text()).group(
            1
        ),
        16,
    )


def report(compiler, verbose):
    graph = graph_of(
        compiler,
        [p for folder in FOLDERS for p in sorted(folder.glob("*.c")) if p.name != "bench.c"],
    )
    known = graph.whole()
    start, loop, tick = known["main"], known["firmware_pass"], known["control_isr"]
    nested = max(known[n] for n in known if n.endswith(("tick_is_missing", "pie.c:unexpected")))
    background = graph.frame["main"] + loop[0]
    words = max(start[0], background + tick[0] + nested[0] + 2 * INTERRUPT_words)
    print(
        f"{Path(compiler).name}: start {start[0]}; background {background}, control interrupt "
        f"{tick[0]} + {INTERRUPT_words}, the "
        f"one that may interrupt it {nested[0]} + {INTERRUPT_words}: {words} of {stack_words()} "
        f"words; {len(known)} functions, "
        "no recursion"
    )
    if verbose:
        for _, chain in (start, loop, tick, nested):
            print(
                "  "
                + " -> ".join(
                    f"{n.rsplit('/', 1)[-1]} {graph.frame.get(n, '')}".strip() for n in chain
                )
            )
    return words <= (1 - LEFT) * stack_words() or Path(compiler).name == "gcc"


def main():
    arguments = [a for a in sys.argv[1:] if a != "-v"]
    compilers = arguments or ["arm-none-eabi-gcc" if shutil.which("arm-none-eabi-gcc") else "gcc"]
    good = True
    for compiler in compilers:
        try:
            self_test(compiler)
            good = report(compiler, "-v" in sys.argv) and good
        except StackError as error:
            print(f"{compiler}: {error}")
            good = False
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
