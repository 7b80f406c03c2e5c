# SPDX-License-Identifier: MIT
"""Disassembled Cortex-M4F code: what kind of operation each instruction is, and where control
goes."""

import re
import struct
import subprocess
from collections import Counter
from dataclasses import dataclass, field

from origin import FLASH, OTHER, read_frames
from registers import count_spills

CONDITIONS = "eq ne cs hs cc lo mi pl vs vc hi ls ge lt gt le".split()
KINDS = {
    "fp_add": ("vadd", "vsub"),
    "fp_mul": ("vmul", "vnmul"),
    "fp_mac": ("vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms"),
    "fp_convert": ("vcvt", "vcvtr"),
    "fp_div": ("vdiv",),
    "fp_sqrt": ("vsqrt",),
    "fp_compare": ("vcmp", "vcmpe"),
    "fp_flags": ("vmrs",),
    "fp_move": ("vmov", "vneg", "vabs"),
    "load": ("vldr", "ldr", "ldrh", "ldrsh", "ldrb", "ldrsb", "ldrd"),
    "store": ("vstr", "str", "strh", "strb", "strd"),
    "integer": (
        "adc adcs add adds addw and ands asr asrs bfc bfi bic bics clz cmn cmp eor eors lsl lsls "
        "lsr lsrs mla mls mov movs "
        "movt movw mul muls mvn mvns neg negs orn orns orr orrs ror rsb rsbs "
        "sbc sbcs sbfx smlabb smlal smulbb "
        "smull sub subs subw sxtab sxtah sxtb sxth teq tst "
        "ubfx umlal umull uxtab uxtah uxtb uxth"
    ).split(),
    "int_div": ("udiv", "sdiv"),
}
KIND_OF = {name: kind for kind, names in KINDS.items() for name in names}
MULTIPLE_LOAD = ("ldmia", "ldmdb", "ldm", "pop", "vpop", "vldmia", "vldmdb")
MULTIPLE_STORE = ("stmia", "stmdb", "stm", "push", "vpush", "vstmia", "vstmdb")
# of a structure: eight words, what an instruction of the C28x reaches without an index register
NEAR_OCTETS = 16
# R4H to R7H: the float registers that a function of the C28x keeps for its caller.
SAVED_FLOATS = 4
LAW = (
    "check",
    "reset",
    "step",
    "believe",
    "adopt",
    "counts_ok",
)  # functions of law_t that a drive calls, in their order
LAW_WORDS = (
    len(LAW) + 3
)  # then what visits the constants, the law's number, the size of its constants
OCTETS_BY = {"memset": "word_set", "memcpy": "word_copied"}  # calls that cost by the octets in r2


@dataclass
class Instruction:
    address: int
    function: str
    name: str  # without condition and width
    conditional: bool
    operands: str
    counts: Counter = field(default_factory=Counter)
    flow: str = ""  # "", branch, conditional, call, return
    target: int = 0
    target_name: str = ""
    register: str = ""  # that holds the target of an indirect call
    feature: str = OTHER
    memory: str = ""  # FLASH, or nothing for RAM without waits
    free: bool = False  # a branch of a function that is one instruction there
    next: "Instruction | None" = None


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def base_name(mnemonic):
    """(name, conditional) of e.g. vmovgt.f32, beq.n."""
    name = mnemonic.split(".")[0]
    known = (
        name in KIND_OF
        or name in MULTIPLE_LOAD + MULTIPLE_STORE
        or name in ("b", "bl", "bx", "blx")
    )
    if not known and name[-2:] in CONDITIONS and name[:-2]:
        return name[:-2], True
    return name, False


def list_length(operands):
    """Registers in {r4, r5-r7, d8}; a d register is two 32-bit cells."""
    length = 0
    for item in operands[operands.index("{") + 1 : operands.index("}")].split(","):
        ends = item.strip().split("-")
        count = 1 if len(ends) == 1 else int(ends[1][1:]) - int(ends[0][1:]) + 1
        length += count * (2 if ends[0].startswith("d") else 1)
    return length


def classify(i):
    """Fills counts and flow; an instruction that is not known stops the budget."""
    if i.name in ("b", "bl", "blx", "bx", "cbz", "cbnz"):
        if i.name == "bl":
            i.flow = "call"
        elif i.name in ("blx", "bx") and i.operands.strip() != "lr":
            i.flow, i.register = "call" if i.name == "blx" else "branch", i.operands.strip()
        elif i.name == "bx":
            i.flow = "return"
        else:
            i.flow = "conditional" if i.conditional or i.name != "b" else "branch"
            if i.name != "b":
                i.counts["integer"] += 1
        if i.conditional and i.flow != "conditional":
            raise ValueError(f"conditional call or return at {i.address:x}")
        return
    if i.name in MULTIPLE_LOAD + MULTIPLE_STORE:
        kind = "load" if i.name in MULTIPLE_LOAD else "store"
        saved = list_length(i.operands)
        i.counts[kind] += min(saved, SAVED_FLOATS) if i.name in ("vpush", "vpop") else saved
        if "pc" in i.operands:
            if i.conditional:
                raise ValueError(f"conditional return at {i.address:x}")
            i.counts[kind] -= 1
            i.flow = "return"
        return
    if re.fullmatch(r"i[te]{1,4}", i.name):
        i.counts["integer"] += 1
        return
    if i.name == "nop":
        return
    kind = KIND_OF.get(i.name)
    if i.name == "ldr" and i.operands.startswith("pc, [sp]"):
        i.flow = "return"
        return
    if re.match(r"pc\b", i.operands):
        kind = None  # a jump table
    if kind is None:
        raise ValueError(f"unknown instruction {i.name} {i.operands} at {i.address:x}")
    if kind == "load" and "[pc" in i.operands or i.name == "vmov" and "#" in i.operands:
        kind = "constant"
    i.counts[kind] += 2 if i.name in ("ldrd", "strd") else 1
    if kind in ("load", "store") and (match := re.search(r"\[(\w+), #(-?\d+)\]", i.operands)):
        if match[1] != "sp" and not 0 <= int(match[2]) < NEAR_OCTETS:
            i.counts["far"] += 1


def law_functions(prefix, image):
    """{offset in law_t: (address, name)} of the functions of the one law in an image."""
    table = symbols(prefix, image)
    laws = [
        name
        for name, (_, size) in table.items()
        if re.fullmatch(r"law_\w+", name) and size == 4 * LAW_WORDS
    ]
    if len(laws) != 1:
        raise ValueError(f"one law is expected in the image, found {laws}")
    start, size = table[laws[0]]
    dump = run(
        f"{prefix}objdump",
        "-s",
        f"--start-address={start}",
        f"--stop-address={start + size}",
        image,
    )
    octets = bytes.fromhex(
        "".join(re.findall(r"^ [0-9a-f]+ ((?:[0-9a-f]{2,8} )+)", dump, re.M)).replace(" ", "")
    )
    addresses = [
        pointer & ~1 for (pointer,) in struct.iter_unpack("<I", octets)
    ]  # the lowest bit says Thumb
    return {4 * n: (address, name) for n, (address, name) in enumerate(zip(addresses, LAW))}


def loaded_from(before, register, pattern):
    """Match of the last instruction that gave the register its value, if it is of this pattern;
    moves are followed back. Code after a return does not see the registers that it restores."""
    for earlier in reversed(before):
        if earlier.flow == "return":
            continue
        if not earlier.conditional:
            if match := re.match(pattern.format(register), f"{earlier.name} {earlier.operands}"):
                return match
            if earlier.name == "mov" and (
                match := re.match(rf"{register}, (\w+)$", earlier.operands)
            ):
                register = match[1]
                continue
        if re.match(rf"{register}\b|.*\{{.*\b{register}\b", earlier.operands) and not is_read(
            earlier
        ):
            break
    return None


def resolve(before, i, functions):
    """Gives the indirect call i its target: a member of law_t, loaded into its register by what
    stands before."""
    match = loaded_from(before, i.register, r"ldr {}, \[\w+(?:, #(\d+))?\]$")
    offset = int(match[1] or 0) if match else None
    if offset not in functions:
        raise ValueError(f"computed jump at {i.address:x}")
    i.target, i.target_name = functions[offset]


def count_words(before, i):
    """Gives a call of memset() or memcpy() its words; one of a size that is not a number there has
    no price."""
    match = loaded_from(before, "r2", r"movs? {}, #(\d+)$")
    if match:
        i.counts[OCTETS_BY[i.target_name]] += (int(match[1]) + 1) // 2
    else:
        i.target_name += " of unknown size"


def is_read(i):
    return i.name in ("cmp", "tst", "cbz", "cbnz", "push") or KIND_OF.get(i.name) == "store"


def read_code(prefix, image, functions=(), origin=None):
    """{address: Instruction} of the section .core, linked within each function; functions: see
    law_functions()."""
    text = run(f"{prefix}objdump", "-d", "--no-show-raw-insn", "-j", ".core", image)
    code, function, before, names, block = {}, "", None, set(), []
    for line in text.splitlines():
        head = re.match(r"[0-9a-f]+ <(\S+)>:", line)
        if head:
            function, before, block = head[1], None, []
            if function in names:
                raise ValueError(f"two functions are called {function}")
            names.add(function)
            continue
        match = re.match(r"\s*([0-9a-f]+):\t(\S+)\s*([^@;]*)", line)
        if not match or match[2] in (".word", ".short"):
            continue
        if match[2].startswith("."):
            raise ValueError(f"not decoded: {line}")
        if ".f64" in match[2]:
            raise ValueError(f"double precision: {line}")
        name, conditional = base_name(match[2])
        i = Instruction(int(match[1], 16), function, name, conditional, match[3].strip())
        classify(i)
        goal = re.search(r"([0-9a-f]+) <([\w.]+?)(\+0x[0-9a-f]+)?>", i.operands)
        if i.register:
            resolve(block, i, functions)
        elif i.flow in ("branch", "conditional", "call"):
            i.target, i.target_name = int(goal[1], 16), goal[2]
            if goal[2] in OCTETS_BY:
                count_words(block, i)
        if before:
            before.next = i
        code[i.address] = before = i
        block.append(i)
    count_spills(code)
    frames = read_frames(prefix, image, code) if origin else {}
    count_choices(code, {a for a, f in frames.items() if origin.is_intrinsic(f)})
    for address, found in frames.items():
        code[address].feature = origin.feature(found)
        if origin.in_flash(found):
            code[address].memory = FLASH
            code[address].counts = Counter(
                {name + FLASH: n for name, n in code[address].counts.items()}
            )
    return code


def count_choices(code, intrinsic):
    """A float that a comparison chooses takes a branch there, but in an intrinsic each comparison
    is one instruction. So is the quotient that stands for an estimate, with its root and its
    one."""
    ordered = list(code.values())
    for flags, condition, chosen in zip(ordered, ordered[1:], ordered[2:]):
        chain = flags.next is condition and condition.next is chosen
        if (
            chain
            and flags.name == "vmrs"
            and condition.counts["integer"]
            and chosen.conditional
            and chosen.name[0] == "v"
        ):
            condition.counts["select"] = condition.counts.pop("integer")
    for i in ordered:
        if i.address in intrinsic:
            if i.name in ("vcmp", "vcmpe"):
                i.counts["limit"] = i.counts.pop("fp_compare")
            elif i.name == "vdiv":
                i.counts["estimate"] = i.counts.pop("fp_div")
            elif (
                i.name in ("vmrs", "vsqrt")
                or i.counts["constant"]
                or i.conditional
                or i.counts["select"]
            ):
                i.counts.clear()
                i.free = i.flow == "conditional"


def symbols(prefix, image):
    """{name: (address, size)}"""
    table = {}
    for line in run(f"{prefix}nm", "-S", image).splitlines():
        fields = line.split()
        size = int(fields[1], 16) if len(fields) == 4 else 0
        table[fields[-1]] = (int(fields[0], 16), size)
    return table


def section_sizes(prefix, archive):
    """Octets of code, constants, data summed over an archive."""
    sizes = Counter()
    for line in run(f"{prefix}objdump", "-h", archive).splitlines():
        match = re.match(r"\s*\d+ \.(text|rodata|data|bss)\S*\s+([0-9a-f]{8})", line)
        if match:
            sizes[match[1]] += int(match[2], 16)
    return sizes


def linked_sizes(prefix, archive, image):
    """The same of what an image took from an archive, known by name."""
    wanted = {
        line.split()[-1]
        for line in run(f"{prefix}nm", "--defined-only", archive).splitlines()
        if " " in line
    }
    sizes = Counter()
    for line in run(f"{prefix}nm", "-S", image).splitlines():
        fields = line.split()
        if len(fields) == 4 and fields[-1] in wanted:
            sizes["data" if fields[2] in "bBdD" else "flash"] += int(fields[1], 16)
    return sizes


def stack_depth(code, function):
    """Octets of stack of a call, library functions left out."""
    own, callees = 0, set()
    for i in code.values():
        if i.function != function:
            continue
        if i.name in ("push", "vpush", "stmdb"):
            own += 4 * list_length(i.operands)
        elif i.name in ("sub", "subw") and i.operands.startswith("sp, "):
            own += int(re.search(r"#(\d+)", i.operands)[1])
        elif i.name == "str" and "[sp, #-" in i.operands:
            own += int(re.search(r"#-(\d+)", i.operands)[1])
        if i.flow in ("call", "branch") and i.target_name != function and i.target in code:
            callees.add(i.target_name)
    return own + max((stack_depth(code, callee) for callee in callees), default=0)
