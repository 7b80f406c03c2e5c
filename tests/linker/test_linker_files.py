# SPDX-License-Identifier: MIT
"""Do linker/*.cmd fit the device and the program? With copies that do not, which have to be
refused."""

import fnmatch
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
import command_file
import device
from command_file import Refused

ROOT = pathlib.Path(__file__).resolve().parents[2]
BOARD = ROOT / "firmware" / "board" / "f28335"
TEXT = {image: (ROOT / "linker" / f"f28335_{image}.cmd").read_text() for image in ("flash", "ram")}
FAST_RTS = "-l rts2800_fpu32_fast_supplement_eabi.lib(.text)"
RTS = "-l rts2800_fpu32_eabi.lib(.text)"


def inside(item, blocks):
    return any(first <= item.origin and item.end <= last for first, last in blocks)


def check_memory(image, ranges):
    entry = device.BOOT_ENTRY[image]
    blocks = (
        device.RAM + device.FLASH + device.ROM_TABLES + device.RESET_VECTOR + [(entry, entry + 2)]
    )
    for item in ranges.values():
        if item.length == 0:
            raise Refused(f"range {item.name} is empty")
        if any(item.origin < last and first < item.end for first, last in device.SECURITY):
            raise Refused(f"range {item.name} holds words of the security module")
        if not inside(item, blocks):
            raise Refused(f"range {item.name} is not memory of the device")
    ordered = sorted(ranges.values(), key=lambda item: item.origin)
    for lower, upper in zip(ordered, ordered[1:]):
        if lower.end > upper.origin:
            raise Refused(f"ranges {lower.name} and {upper.name} overlap")


def check_sections(image, ranges, sections, defines):
    def require(condition, name, what):
        if not condition:
            raise Refused(f"section {name} {what}")

    expected = device.LOADED + device.NOT_LOADED + device.OWN
    if image == "ram":
        expected = [name for name in expected if name not in (".seldom", ".in_force")]
    for name in expected:
        require(name in sections, name, "has no place")
    for name in sections:
        require(name in expected, name, "is made by nothing")
    for section in sections.values():
        for where in (section.load, section.run):
            require(where in ranges, section.name, f"is in {where}, which is no range")

    stored = device.FLASH if image == "flash" else device.RAM
    for name in device.LOADED + [".tables"]:
        require(inside(ranges[sections[name].load], stored), name, "is not stored where it lasts")
    for name in device.NOT_LOADED:
        require(inside(ranges[sections[name].run], device.RAM), name, "is not in RAM")

    code, tables, stack = sections[".TI.ramfunc"], sections[".tables"], sections[".stack"]
    require(inside(ranges[code.run], [device.ZERO_WAIT_CODE]), code.name, "runs with wait states")
    require(inside(ranges[tables.run], [device.ZERO_WAIT_DATA]), tables.name, "has wait states")
    require(tables.run != code.run, tables.name, "shares a block with the code that reads it")
    if image == "flash":
        in_force = sections[".in_force"]
        require(
            inside(ranges[in_force.run], [device.ZERO_WAIT_DATA]), in_force.name, "has wait states"
        )
        require(
            in_force.run != code.run, in_force.name, "shares a block with the code that reads it"
        )
    require(ranges[stack.run].end <= device.STACK_LIMIT, ".stack", "is out of the pointer's reach")
    require(sum(s.run == stack.run for s in sections.values()) == 1, ".stack", "is not alone")

    if image == "flash":
        names = list(sections)
        require(
            names.index(".seldom") < names.index(code.name),
            ".seldom",
            "stands behind the section that would take its functions",
        )
        require(
            inside(ranges[sections[".seldom"].run], device.FLASH), ".seldom", "is not in the flash"
        )

    wanted = ["*(.TI.ramfunc)"] + ([FAST_RTS] if "FAST_RTS" in defines else []) + [RTS]
    require(code.inputs == wanted, code.name, f"takes {code.inputs}")

    entry = ranges[sections["codestart"].run]
    require(
        (entry.origin, entry.length) == (device.BOOT_ENTRY[image], 2),
        "codestart",
        "is not where the boot ROM jumps to",
    )
    require(
        sum(entry.name in (s.load, s.run) for s in sections.values()) == 1,
        "codestart",
        "is not alone",
    )

    rom = sections["FPUmathTables"]
    require(rom.type == "NOLOAD", rom.name, "would be loaded")
    require(
        ranges[rom.run].origin == device.ROM_TABLES[0][0], rom.name, "is not at the ROM's tables"
    )
    require(sections[".reset"].type == "DSECT", ".reset", "would be loaded")
    for section in sections.values():
        require(
            section.name in ("FPUmathTables", ".reset") or not section.type,
            section.name,
            "would not be loaded",
        )


def check_symbols(sections):
    expected = {
        ".TI.ramfunc": {
            "codestart_code_load": "LOAD_START",
            "codestart_code_words": "LOAD_SIZE",
            "codestart_code_run": "RUN_START",
        },
        ".tables": {
            "codestart_tables_load": "LOAD_START",
            "codestart_tables_words": "LOAD_SIZE",
            "codestart_tables_run": "RUN_START",
        },
        ".stack": {"codestart_stack": "RUN_START", "codestart_stack_words": "RUN_SIZE"},
    }
    for section in sections.values():
        if section.symbols != expected.get(section.name, {}):
            raise Refused(f"section {section.name} defines {section.symbols}")
    names = {name for symbols in expected.values() for name in symbols}
    source = (BOARD / "codestart.asm").read_text()
    fill = re.search(r"STACK_FILL .set 0x([0-9A-F]+)", source).group(1)
    if f"BOARD_STACK_FILL  0x{fill}U" not in (BOARD / "peripherals.h").read_text():
        raise Refused("codestart.asm fills the stack with something else than memory.c looks for")
    size = re.search(r"--stack_size=(\w+)", (BOARD / "CMakeLists.txt").read_text()).group(1)
    if f"BOARD_STACK_WORDS {size}U" not in (BOARD / "peripherals.h").read_text():
        raise Refused("memory.c does not know the stack's size")
    check_copies(source)
    used = set(re.findall(r"\bcodestart_\w+", re.sub(r";.*", "", source)))
    if used != names:
        raise Refused(f"codestart.asm and the linker differ in {used ^ names}")


def check_copies(source):
    """The background compares what the start copies, in the order of board_copy_t."""
    copied = re.findall(
        r"\s+".join(
            rf"MOVL +{register}, #(codestart_\w+)" for register in ("XAR4", "XAR5", "XAR6")
        ),
        source,
    )
    compared = re.findall(r"^ +\.long +(\w+), (\w+), (\w+)$", source, flags=re.M)
    if compared != copied:
        raise Refused(f"board_copies has {compared}, the start copies {copied}")
    header = (BOARD / "peripherals.h").read_text()
    if f"BOARD_COPIES      {len(copied)}U" not in header:
        raise Refused("BOARD_COPIES is not the number of copies")
    members = re.search(r"typedef struct \{(.*?)\} board_copy_t;", header, flags=re.S).group(1)
    if re.findall(r"(\w+);", members) != ["load", "run", "words"]:
        raise Refused("board_copy_t has another order than board_copies")


def table_sources():
    """Files whose constants are read in every period."""
    files = sorted((ROOT / "firmware/control/laws").glob("law_*.c"))
    return [source for source in files if not source.name.endswith("_fields.c")]


def check_tables(image, sections):
    """The patterns have to name what the sources define, or the tables would stay in flash."""
    if image == "ram":
        if sections[".tables"].inputs != ["*(.const:board_config)"]:
            raise Refused("section .tables leaves board_config out")
        return
    for source in table_sources():
        constants = re.findall(
            r"^(?:static )?const \w+ (\w+)(?:\[\w+\])? =", source.read_text(), flags=re.M
        )
        if not constants:
            raise Refused(f"{source.name} defines nothing")
        for constant in constants:
            if not any(
                fnmatch.fnmatchcase(f"*(.const:{constant})", pattern.replace("*(", "[*](", 1))
                for pattern in sections[".tables"].inputs
            ):
                raise Refused(f"section .tables leaves {constant} out")
    main = (BOARD.parent / "program/main.c").read_text()
    if not re.search(r"^static app_image_t in_force;", main, flags=re.M):
        raise Refused("main.c has no in_force")
    if sections[".in_force"].inputs != ["*(.bss:in_force)"]:
        raise Refused("section .in_force leaves in_force out")


def check_store(image, ranges):
    """The sectors that board_store_memory names hold nothing that is linked."""
    first = device.PERIPHERALS["board_store_memory"]
    if any(
        first < item.end and item.origin < first + device.STORE_WORDS
        for item in ranges.values()
        if item.name != "STORE"
    ):
        raise Refused("a range holds words of the store")


def check(image, text):
    for defines in ((), ("FAST_RTS",)):
        ranges, sections = command_file.parse(text, defines)
        check_memory(image, ranges)
        check_sections(image, ranges, sections, defines)
        check_symbols(sections)
        check_tables(image, sections)
        check_store(image, ranges)


def check_registers(text):
    symbols = command_file.parse_symbols(text)
    if symbols != device.PERIPHERALS:
        raise Refused(f"peripherals: {set(symbols.items()) ^ set(device.PERIPHERALS.items())}")
    used = set()
    for source in (*BOARD.glob("*.c"), *BOARD.glob("*.h")):
        used |= set(
            re.findall(
                r"\b(\w+Regs|ECanaMboxes|AdcMirror|PieVectTable|ADC_cal|board_store_memory)\b",
                source.read_text(),
            )
        )
    if used != set(symbols):
        raise Refused(f"used and placed differ in {used ^ set(symbols)}")


# image, text, what it becomes, part of the reason
MUTANTS = [
    ("flash", "length = 0x01F000", "length = 0x01FFF7", "security module"),
    ("flash", "length = 0x01F000", "length = 0x01FF81", "security module"),
    (
        "flash",
        "FLASH     : origin = 0x320000, length = 0x01F000",
        "FLASH     : origin = 0x318000, length = 0x020000",
        "overlap",
    ),
    (
        "flash",
        "STORE     : origin = 0x300000, length = 0x020000",
        "OTHER     : origin = 0x300000, length = 0x020000",
        "words of the store",
    ),
    (
        "flash",
        "origin = 0x33FFF6, length = 0x000002",
        "origin = 0x33FFF6, length = 0x000003",
        "security module",
    ),
    ("flash", "origin = 0x33FFF6", "origin = 0x33FFF4", "security module"),
    ("flash", "origin = 0x33FFF6", "origin = 0x33FF7E", "not where the boot ROM"),
    ("flash", "STORE     : origin = 0x300000", "STORE     : origin = 0x2FFFFE", "not memory"),
    (
        "flash",
        "origin = 0x000100, length = 0x000700",
        "origin = 0x000040, length = 0x0007C0",
        "not memory",
    ),
    (
        "flash",
        "origin = 0x008000, length = 0x004000",
        "origin = 0x008000, length = 0x004001",
        "overlap",
    ),
    ("flash", "RUN = RAML0123", "RUN = RAML4567", "wait states"),
    ("flash", "RUN = RAML0123", "RUN = FLASH", "wait states"),
    ("flash", "RUN = RAML4567", "RUN = RAML0123", "shares a block"),
    ("flash", "RUN = RAML4567", "RUN = RAML9", "no range"),
    ("flash", ".init_array  : > FLASH", "", ".init_array has no place"),
    ("flash", ".data        : > RAML4567", ".data        : > FLASH", ".data is not in RAM"),
    ("flash", ".cinit       : > FLASH", ".cinit       : > RAML4567", "not stored where it lasts"),
    ("flash", ".const       : > FLASH", ".econst      : > FLASH", "has no place"),
    ("flash", ".bss         : > RAML4567", ".bss         : > RAMM01", ".stack is not alone"),
    ("flash", "TYPE = NOLOAD", "TYPE = COPY", "would be loaded"),
    ("flash", ", TYPE = DSECT", "", "would be loaded"),
    ("flash", "> FPUTABLES", "> RAML4567", "not at the ROM's tables"),
    ("flash", "LOAD_SIZE(codestart_code_words)", "RUN_START(codestart_code_words)", "defines"),
    ("flash", "LOAD_START(codestart_tables_load)", "LOAD_START(codestart_table_load)", "defines"),
    ("flash", "*(.bss:in_force)", "*(.bss:in_use)", "leaves in_force out"),
    ("flash", "*(.const:law_*)", "*(.const:law)", "leaves law_conventional out"),
    ("flash", "                   > RAML4567", "                   > RAML0123", "shares a block"),
    ("ram", "*(.const:board_config)", "*(.const:law_*)", "leaves board_config out"),
    ("flash", ".seldom      :", ".seldom2     :", ".seldom has no place"),
    (
        "flash",
        "    }\n                   > FLASH\n",
        "    }\n                   > RAML0123\n",
        "not in the flash",
    ),
    ("flash", RTS, "", "takes"),
    ("flash", "#ifdef FAST_RTS", "#ifdef FASTRTS", "takes"),
    ("flash", "#endif", "", "without #endif"),
    ("flash", "SECTIONS", "SECTION", "no SECTIONS"),
    ("flash", "codestart    : > BEGIN", "codestart    : > FLASH", "not where the boot ROM"),
    ("ram", "> RAML0123,", "> RAML4567,", "wait states"),
    ("ram", ".cinit       : > RAML4567", ".cinit       : > RAMX", "no range"),
    ("ram", "origin = 0x000000", "origin = 0x000002", "not memory"),
    ("ram", "length = 0x000700", "length = 0x000701", "not memory"),
    ("ram", "length = 0x000700", "length = 0x000000", "empty"),
    (
        "ram",
        ".switch      : > RAML0123",
        ".switch      : > RAML0123, TYPE = NOLOAD",
        "would not be loaded",
    ),
]


class LinkerFiles(unittest.TestCase):
    def test_flash_image_fits(self):
        check("flash", TEXT["flash"])

    def test_ram_image_fits(self):
        check("ram", TEXT["ram"])

    def test_every_peripheral_used_is_placed_where_it_is(self):
        check_registers((ROOT / "linker" / "f28335_registers.cmd").read_text())

    def test_pins_are_safe_before_anything_is_copied(self):
        source = re.sub(r";.*", "", (BOARD / "codestart.asm").read_text())
        code = re.findall(r"^[ \t]+(MOVB|MOVL|EDIS)\b[ \t]*(.*?)[ \t]*$", source, flags=re.M)
        safe = [
            ("MOVB", "ACC, #0x7F"),
            ("MOVL", "XAR4, #0x6FC4"),
            ("MOVL", "*+XAR4[0], ACC"),
            ("MOVL", "XAR4, #0x6F8A"),
            ("MOVL", "*+XAR4[0], ACC"),
            ("EDIS", ""),
        ]
        at = next(n for n in range(len(code)) if code[n : n + len(safe)] == safe)
        self.assertLess(
            at, next(n for n, (_, operands) in enumerate(code) if "codestart_stack" in operands)
        )

    def test_wrong_copies_are_refused(self):
        for image, old, new, reason in MUTANTS:
            with self.subTest(image=image, old=old, new=new):
                self.assertIn(old, TEXT[image])
                with self.assertRaises(Refused) as refused:
                    check(image, TEXT[image].replace(old, new, 1))
                self.assertIn(reason, str(refused.exception))

    def test_wrong_addresses_are_refused(self):
        text = (ROOT / "linker" / "f28335_registers.cmd").read_text()
        for old, new in (
            ("0x006840", "0x006841"),
            ("EQep1Regs     = 0x006B00;", ""),
            ("0x380080", "0x380090"),
        ):
            with self.subTest(old=old), self.assertRaises(Refused):
                self.assertIn(old, text)
                check_registers(text.replace(old, new, 1))


if __name__ == "__main__":
    unittest.main()
