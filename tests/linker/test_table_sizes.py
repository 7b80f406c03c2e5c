# SPDX-License-Identifier: MIT
"""Do the constants of every law fit where linker/*.cmd puts them? Sizes are those of the C28x, from a 32-bit compiler: there
as here float and pointer are two words of 16 bits; bool is made one."""
import pathlib
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import command_file

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "firmware"
INCLUDES = [f"-I{FIRMWARE / d}" for d in ("control", "commission", "store", "app", "board", "board/f28335")]
COMPILER = ["clang", "--target=arm-none-eabi", "-std=c99", "-ffreestanding", "-nostdlibinc", "-isystem",
            str(ROOT / "tests/target/include"), *INCLUDES, "-D_Bool=unsigned short", "-S", "-o", "-", "-xc", "-"]
BLOCK = 0x1000  # words of one of the device's blocks L0 .. L7
SPARE = 0x0100  # for the board's and the run-time library's; theirs are counted by nobody


def laws():
    return re.findall(r'#include "law_(\w+)\.h"', (FIRMWARE / "control" / "laws.h").read_text())


def words():
    """{object: words} of the constants of every law and of what each image has besides."""
    types = {law: f"law_{law}_config_t" for law in laws()}
    types |= {"drive": "drive_config_t", "law": "law_t", "constants": "law_constants_t", "in_force": "app_image_t"}
    source = '#include "app_image.h"\n'
    source += "".join(f"const {type} size_{name} = {{0}};\n" for name, type in types.items())
    assembly = subprocess.run(COMPILER, input=source, text=True, stdout=subprocess.PIPE, check=True).stdout
    return {name: int(octets) // 2 for name, octets in re.findall(r"\.size\s+size_(\w+), (\d+)", assembly)}


def variables():
    """Words of what the application keeps: it lies beside the constants in force."""
    total = 0
    for source in sorted((FIRMWARE / "app").glob("*.c")):
        code = f'#include "{source}"\n'
        assembly = subprocess.run(COMPILER, input=code, text=True, stdout=subprocess.PIPE, check=True).stdout
        total += sum(int(octets) // 2 for octets in re.findall(r"\.comm\s+\w+,(\d+)", assembly))
    return total


def room(image):
    ranges, sections = command_file.parse((ROOT / "linker" / f"f28335_{image}.cmd").read_text())
    return ranges[sections[".in_force"].run].length


class TableSizes(unittest.TestCase):
    def setUp(self):
        self.sizes = words()

    def test_sizes_are_those_of_16_bit_words(self):
        # motor: 13 floats; dead time: 2; seven scalars, a flag with a pad before the floats; hardware: two long ones, two
        # integers, a flag with a pad; two pointers.
        self.assertEqual(self.sizes["drive"], 2 * 13 + 2 * 2 + 2 * 7 + 2 + (2 * 2 + 2 + 2) + 2 * 2)
        # five pointers and one long number; one integer with a pad
        self.assertEqual(self.sizes["law"], 6 * 2 + 2)

    def test_constants_of_any_law_fit(self):
        self.assertGreaterEqual(len(laws()), 6)
        self.assertEqual(max(self.sizes[law] for law in laws()), self.sizes["constants"])
        print(f"{self.sizes['in_force']} words in force, {self.sizes['constants']} of them of a law")
        for image in ("flash", "ram"):
            with self.subTest(image=image):
                self.assertLessEqual(self.sizes["in_force"] + self.sizes["law"], room(image))

    def test_constants_and_variables_fit_together(self):
        kept = variables()
        self.assertGreater(kept, 512 * 4 * 2)  # the scope's samples
        total = kept + self.sizes["in_force"] + self.sizes["law"]
        print(f"{kept} words of variables, {total} with the constants in force, of {room('flash')}")
        self.assertLessEqual(total, room("flash") - SPARE)

    def test_one_block_is_too_small(self):
        self.assertGreater(self.sizes["in_force"], BLOCK)


if __name__ == "__main__":
    unittest.main()
