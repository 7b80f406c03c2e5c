# SPDX-License-Identifier: MIT
"""Do the tables of every law fit where linker/*.cmd put them? Sizes are those of the C28x, from a 32-bit compiler: there
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
INCLUDES = [f"-I{FIRMWARE / d}" for d in ("control", "app", "board", "board/f28335")]
COMPILER = ["clang", "--target=arm-none-eabi", "-std=c99", "-ffreestanding", "-nostdlibinc", "-isystem",
            str(ROOT / "tests/target/include"), *INCLUDES, "-D_Bool=unsigned short", "-S", "-o", "-", "-xc", "-"]
BLOCK = 0x1000  # words of one of the device's blocks L0 .. L7


def laws():
    return re.findall(r'#include "law_(\w+)\.h"', (FIRMWARE / "control" / "laws.h").read_text())


def words():
    """{object: words} of the constants of every law and of what each image has besides."""
    types = {law: f"law_{law}_config_t" for law in laws()}
    types |= {"drive": "drive_config_t", "law": "law_t", "board": "app_config_t"}
    source = '#include "laws.h"\n#include "drive_config.h"\n#include "app_config.h"\n'
    source += "".join(f"const {type} size_{name} = {{0}};\n" for name, type in types.items())
    assembly = subprocess.run(COMPILER, input=source, text=True, stdout=subprocess.PIPE, check=True).stdout
    sizes = {name: int(octets) // 2 for name, octets in re.findall(r"\.size\s+size_(\w+), (\d+)", assembly)}
    points = re.search(r"ntc_degC\[(\d+)\]", (FIRMWARE / "config/board_config.c").read_text())
    return sizes | {"ntc": 2 * int(points.group(1))}


def tables(sizes, law):
    """Words of section .tables in an image of this law."""
    return sizes[law] + sum(sizes[name] for name in ("drive", "law", "board", "ntc"))


def room(image):
    ranges, sections = command_file.parse((ROOT / "linker" / f"f28335_{image}.cmd").read_text())
    return ranges[sections[".tables"].run].length


class TableSizes(unittest.TestCase):
    def setUp(self):
        self.sizes = words()

    def test_sizes_are_those_of_16_bit_words(self):
        # motor: 13 floats; dead time: 2; seven scalars, a flag with a pad before the floats; hardware: two long ones, two
        # integers, a flag with a pad; two pointers.
        self.assertEqual(self.sizes["drive"], 2 * 13 + 2 * 2 + 2 * 7 + 2 + (2 * 2 + 2 + 2) + 2 * 2)
        self.assertEqual(self.sizes["law"], 5 * 2)

    def test_every_law_fits(self):
        self.assertGreaterEqual(len(laws()), 6)
        for law in laws():
            need = tables(self.sizes, law)
            print(f"law_{law}: {self.sizes[law]} words of constants, {need} of tables")
            for image in ("flash", "ram"):
                with self.subTest(law=law, image=image):
                    self.assertLessEqual(need, room(image))

    def test_one_block_is_too_small_for_noc_h_alone(self):
        too_long = [law for law in laws() if tables(self.sizes, law) > BLOCK]
        self.assertEqual(too_long, ["noc_h"])


if __name__ == "__main__":
    unittest.main()
