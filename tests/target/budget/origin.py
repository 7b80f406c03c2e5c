# SPDX-License-Identifier: MIT
"""Source of each instruction, from the debug information of an image: its feature, its memory, its
intrinsics."""

import re
import subprocess
from fnmatch import fnmatch
from pathlib import Path

FIRMWARE = Path(__file__).resolve().parents[3] / "firmware"
FOLDERS = ("control", "app", "commission", "store", "board/program", "board/f28335")
FLASH = ", flash"  # ends the names of counts that come with the flash's wait states
OTHER = "other"


def read_frames(prefix, image, addresses):
    """{address: ((function, file), ..)}, inlined functions first, the one that the linker sees
    last."""
    command = [f"{prefix}addr2line", "-a", "-i", "-f", "-e", image]
    asked = "".join(f"{address:#x}\n" for address in addresses)
    answer = subprocess.run(
        command, input=asked, check=True, capture_output=True, text=True
    ).stdout.splitlines()
    frames, at = {}, None
    for n, line in enumerate(answer):
        if re.fullmatch(r"0x[0-9a-f]+", line):
            at, start = int(line, 16), n + 1
            frames[at] = ()
        elif (n - start) % 2 == 1:
            frames[at] += ((answer[n - 1], Path(line.rsplit(":", 1)[0]).name),)
    return frames


def cmake_list(text, name):
    """Names of files in a list of the board, without their folders."""
    match = re.search(rf"set\({name}\s+([^)]*)\)", text)
    if not match:
        raise ValueError(f"no list {name} in the CMakeLists.txt of the board")
    return {Path(item).name for item in re.sub(r"#.*", "", match[1]).split()}


def flash_files(text, law, controls, others):
    """Files whose functions the F28335 runs from the flash, by the text of the board's
    CMakeLists.txt; controls: of the core."""
    if not re.search(r"target_compile_options\(control_core PRIVATE --ramfunc=on\)", text):
        raise ValueError("the CMakeLists.txt of the board does not put the core into RAM")
    patterns = cmake_list(text, "core_flash_sources")
    in_ram = cmake_list(text, "app_ram_sources") | cmake_list(text, "board_ram_sources")
    if f"set(app_flash_sources_{law} " in text:
        in_ram -= cmake_list(text, f"app_flash_sources_{law}")
    return {name for name in controls if any(fnmatch(name, p) for p in patterns)} | (
        set(others) - in_ram
    )


def seldom_functions(text):
    """Functions that the linker puts into the flash although their file is compiled for the RAM."""
    found = re.search(r"^ *\.seldom +:\s*\{(.*?)\}", text, re.M | re.S)
    if not found:
        raise ValueError("no section .seldom in linker/f28335_flash.cmd")
    return set(re.findall(r"\.TI\.ramfunc:(\w+)\)", found[1]))


def intrinsics(text):
    """Functions that TI's compiler makes one instruction for each __fmin(), __fmax(), __einvf32()
    or __eisqrtf32() in them."""
    bodies = re.findall(r"static inline float (\w+)\([^)]*\)\s*\{(.*?)\n\}", text, re.S)
    return {name for name, body in bodies if re.search(r"__(fm(in|ax)|e(inv|isqrt)f32)\(", body)}


class Origin:
    """features: {feature: [names of files, or of functions for a part of a file]}."""

    def __init__(self, features, flash, one_instruction, seldom=frozenset()):
        self.flash, self.intrinsics, self.seldom = flash, one_instruction, seldom
        self.feature_of = {name: feature for feature, names in features.items() for name in names}
        if len(self.feature_of) != sum(map(len, features.values())):
            raise ValueError("a file or function stands in two features")

    @classmethod
    def of_firmware(cls, features, law):
        board = (FIRMWARE / "board/f28335/CMakeLists.txt").read_text()
        files = {name: {path.name for path in (FIRMWARE / name).rglob("*.c")} for name in FOLDERS}
        others = set().union(*(files[name] for name in FOLDERS[1:]))
        (base,), (fpu,) = FIRMWARE.rglob("base.h"), FIRMWARE.rglob("fpu.h")
        return cls(
            features,
            flash_files(board, law, files["control"], others),
            intrinsics(base.read_text() + fpu.read_text()),
            seldom_functions((FIRMWARE.parent / "linker/f28335_flash.cmd").read_text()),
        )

    def feature(self, frames):
        """The innermost function or file that a feature names: a helper in a header belongs to its
        caller."""
        for function, file in frames:
            for name in (function, file):
                if name in self.feature_of:
                    return self.feature_of[name]
        return OTHER

    def in_flash(self, frames):
        return bool(frames) and (
            frames[-1][1] in self.flash or frames[-1][0].partition(".")[0] in self.seldom
        )

    def is_intrinsic(self, frames):
        return bool(frames) and frames[0][0] in self.intrinsics
