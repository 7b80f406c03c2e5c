# SPDX-License-Identifier: MIT
"""Does an image of every law fit where linker/*.cmd puts it, with room left? Sizes of data are
those of the C28x, from a 32-bit compiler: there as here float and pointer are two words of 16 bits.
A bool is made one word. Sizes of code: code_size.py."""

import functools
import pathlib
import re
import subprocess
import sys
import unittest
import unittest.mock

sys.dont_write_bytecode = True
import code_size
import command_file

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "firmware"
ROOMS = [FIRMWARE / d for d in ("control", "commission", "store", "app")]
INCLUDES = [f"-I{path}" for room in ROOMS for path in (room, *sorted(room.glob("*/")))]
INCLUDES += [f"-I{FIRMWARE / d}" for d in ("board", "board/program", "board/f28335")]
COMPILER = [
    "clang",
    "--target=arm-none-eabi",
    "-std=c99",
    "-ffreestanding",
    "-fcommon",  # .comm of every variable
    "-nostdlibinc",
    "-isystem",
    str(ROOT / "tests/target/include"),
    *INCLUDES,
    "-D_Bool=unsigned short",
    "-S",
    "-o",
    "-",
    "-xc",
    "-",
]
SPARE = 0x0100  # for the board's and the run-time library's; theirs are counted by nobody
LEFT = 0.15  # chosen: of every memory, at the upper end of the estimate
CONSTANTS_words = 0x2000  # chosen: gain tables of any law 5.3 K, registers 1.9 K, and some
SAMPLES = {"noc_h": 256}  # of the scope; the others have 512
WITHOUT_LEARNING = {"noc_h"}  # app_watch_inertia.h, app_trim.h
BELIEVE = {"noc"}  # app_believe.h
WITH_MAP = ["-DAPP_DISC_MAP=1"]  # SDRE_DISC_MAP=ON


def laws():
    return re.findall(r'#include "law_(\w+)\.h"', (FIRMWARE / "control/laws/laws.h").read_text())


def assembly(source, law, more=()):
    options = [
        *more,
        f"-DLAW_CONSTANTS=law_{law}_config_t",
        f"-DAPP_SCOPE_SAMPLES={SAMPLES.get(law, 512)}U",
        f"-DAPP_WATCH_INERTIA={0 if law in WITHOUT_LEARNING else 1}",
        f"-DAPP_TRIM={0 if law in WITHOUT_LEARNING else 1}",
        f"-DAPP_BELIEVE={1 if law in BELIEVE else 0}",
    ]
    return subprocess.run(
        [*COMPILER, *options], input=source, text=True, stdout=subprocess.PIPE, check=True
    ).stdout


def words(law, more=()):
    """{object: words} of what an image with this law keeps beside the variables."""
    types = {
        "law": f"law_{law}_config_t",
        "drive": "drive_config_t",
        "entry": "law_t",
        "in_force": "app_image_t",
    }
    source = '#include "app_image.h"\n'
    source += "".join(f"const {type} size_{name} = {{0}};\n" for name, type in types.items())
    return {
        name: int(octets) // 2
        for name, octets in re.findall(r"\.size\s+size_(\w+), (\d+)", assembly(source, law, more))
    }


def variables_of(source, law, more=()):
    """Words of each variable of a file."""
    found = re.findall(r"\.comm\s+\w+,(\d+)", assembly(f'#include "{source}"\n', law, more))
    return [int(octets) // 2 for octets in found]


@functools.lru_cache(maxsize=None)
def sources_with_variables():
    """The law decides how large a variable is; the options decide which there are."""
    return [
        source
        for source in sorted((FIRMWARE / "app").rglob("*.c"))
        if variables_of(source, "noc", WITH_MAP) or variables_of(source, "noc_h")
    ]


def variables(law, more=()):
    """Words of what the application keeps: it lies beside the constants in force."""
    return sum(sum(variables_of(source, law, more)) for source in sources_with_variables())


@functools.lru_cache(maxsize=None)
def code():
    return code_size.functions(laws())


def documented():
    """{law, "others" or "debugger": (percent of code, percent of data or None)} of hardware.md."""
    text = (ROOT / "docs" / "hardware.md").read_text()
    head = "| law | code in L0..L3 at most | data in L4..L7 at most |"
    table = text[text.index(head) :].split("\n\n")[0]
    rows = re.findall(r"^\| (\w+) \| (\d+) % \| (\d+) % \|$", table, flags=re.M)
    found = {law: (int(code), int(data)) for law, code, data in rows}
    ram = re.search(r"scope and store: at most (\d+) % of L0..L3", text)
    return {**found, "debugger": (int(ram[1]), None)}


def called(bodies, entry):
    """Functions of bodies that entry reaches, itself included."""
    found, todo = set(), [entry]
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += [n for n in re.findall(r"\b(\w+)\(", bodies[name]) if n in bodies]
    return found


def interrupt_of_the_board():
    """Functions of the board layer that the control interrupt reaches by name."""
    board, bodies = FIRMWARE / "board" / "f28335", {}
    for source in sorted(board.glob("*.c")):
        text = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.S)
        bodies |= dict(re.findall(r"^[\w ]+[ *](\w+)\([^;{]*\)\n\{\n(.*?)^\}", text, re.M | re.S))
    return called(bodies, "control_isr")


def length(section, image="flash"):
    ranges, sections = command_file.parse((ROOT / "linker" / f"f28335_{image}.cmd").read_text())
    return ranges[sections[section].run].length


class TableSizes(unittest.TestCase):
    def test_sizes_are_those_of_16_bit_words(self):
        sizes = words("noc")
        # motor: 13 floats; dead time: 2; nine scalars, three flags with a pad before the floats.
        # hardware: two long ones, two integers, a flag with a pad; two pointers.
        self.assertEqual(sizes["drive"], 2 * 13 + 2 * 2 + 2 * 9 + 4 + (2 * 2 + 2 + 2) + 2 * 2)
        # seven pointers and one long number; one integer with a pad
        self.assertEqual(sizes["entry"], 8 * 2 + 2)

    def test_data_of_every_law_leaves_room(self):
        self.assertGreaterEqual(len(laws()), 6)
        room = length(".in_force")
        for law in laws():
            with self.subTest(law=law):
                sizes, kept = words(law), variables(law)
                self.assertGreater(kept, 8 * SAMPLES.get(law, 512))  # the scope's samples are in it
                total = kept + sizes["in_force"] + sizes["entry"] + SPARE
                print(
                    f"{law}: data {total} of {room} words, {sizes['in_force']} of them in force: "
                    f"{100 * total / room:.0f} %"
                )
                self.assertLessEqual(total, (1 - LEFT) * room)
                self.assertLessEqual(total, self.said(law)[1] / 100 * room, "docs/hardware.md")

    def test_a_map_of_the_disc_leaves_room(self):
        room = length(".in_force")
        for law, samples in (("noc", 512), ("noc_h", 128)):
            with self.subTest(law=law), unittest.mock.patch.dict(SAMPLES, {law: samples}):
                sizes, kept = words(law, WITH_MAP), variables(law, WITH_MAP)
                plain = variables(law) + words(law)["in_force"]
                more = kept + sizes["in_force"] - plain
                print(f"{law}: a map of the disc takes {more} words of data")
                self.assertEqual(more, 30, "docs/disc_map.md")
                total = kept + sizes["in_force"] + sizes["entry"] + SPARE
                self.assertLessEqual(total, (1 - LEFT) * room)

    def said(self, law):
        pages = documented()
        return pages.get(law, pages["others"])

    def test_noc_h_with_the_whole_scope_would_not(self):
        SAMPLES_of_all = SAMPLES.pop("noc_h")
        try:
            total = variables("noc_h") + words("noc_h")["in_force"] + SPARE
        finally:
            SAMPLES["noc_h"] = SAMPLES_of_all
        self.assertGreater(total, (1 - LEFT) * length(".in_force"))

    @unittest.skipUnless(code_size.is_there(), f"no {code_size.COMPILER}: ./dev budget installs it")
    def test_code_of_every_law_leaves_room(self):
        seldom = set(code_size.seldom())
        room, flash = length(".TI.ramfunc"), length(".text")
        for law, functions in code().items():
            with self.subTest(law=law):
                from_ram = code_size.runs_from_ram(law)
                hot = sum(
                    f.halfwords for f in functions if from_ram(f.source) and f.name not in seldom
                )
                self.assertGreater(hot, 4000)
                most = code_size.words_at_most(hot) + code_size.LIBRARY_words
                everything = (
                    code_size.words_at_most(sum(f.halfwords for f in functions))
                    + code_size.LIBRARY_words
                )
                print(
                    f"{law}: code in RAM at most {most} of {room} words: {100 * most / room:.0f} "
                    f"%; in all {everything} of {flash}"
                )
                self.assertLessEqual(
                    most,
                    (1 - LEFT) * room,
                    "firmware/board/f28335/CMakeLists.txt and .seldom choose what runs from RAM",
                )
                self.assertLessEqual(everything + CONSTANTS_words, (1 - LEFT) * flash)
                self.assertLessEqual(most, self.said(law)[0] / 100 * room, "docs/hardware.md")

    @unittest.skipUnless(code_size.is_there(), f"no {code_size.COMPILER}: ./dev budget installs it")
    def test_image_for_a_debugger_leaves_room(self):
        functions = code_size.bench_functions()
        self.assertIn("control_isr", {f.name for f in functions})
        most, room = (
            code_size.words_at_most(sum(f.halfwords for f in functions)) + code_size.LIBRARY_words,
            length(".text", "ram"),
        )
        print(
            f"image for a debugger: code at most {most} of {room} words: {100 * most / room:.0f} %"
        )
        self.assertLessEqual(most, (1 - LEFT) * room)
        self.assertLessEqual(most, documented()["debugger"][0] / 100 * room, "docs/hardware.md")

    @unittest.skipUnless(code_size.is_there(), f"no {code_size.COMPILER}: ./dev budget installs it")
    def test_what_is_named_exists_and_is_compiled_for_the_ram(self):
        named, known = set(code_size.seldom()), set()
        for law, functions in code().items():
            from_ram = code_size.runs_from_ram(law)
            known |= {f.name for f in functions if from_ram(f.source)}
        self.assertEqual(named - known, set())

    def test_nothing_of_the_interrupt_is_named(self):
        hot = interrupt_of_the_board()
        self.assertLessEqual({"check_entry", "take_sample", "encoder_read", "trip_check"}, hot)
        self.assertEqual(hot & set(code_size.seldom()), set())


if __name__ == "__main__":
    unittest.main()
