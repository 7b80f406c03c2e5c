# SPDX-License-Identifier: MIT
"""Does evidence.py see what is wrong with an image? Link information and listings are made here, in
the form of TI's tools."""

import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
import command_file
import evidence
import listing
import pricing

LISTING = """
       1 00000000               .sect   ".TI.ramfunc:control_isr"
       2              ;* FNAME: control_isr                   FR SIZE:  {frame}           *
       3              ||control_isr||:
       4 00000000 B2BD          MOVL      *SP++,XAR1            ; [CPU_ALU]
       5 00000001 E203          MOV32     *SP++,R4H             ; [CPU_FPU]
         00000002 00BD
       6 00000003 E694          CMPF32    R0H,R1H               ; [CPU_FPU]
       7 00000004 AD14          MOVST0    ZF, NF                ; [CPU_FPU]
       8 00000005 6471          B         ||$C$L1||,LT          ; [CPU_ALU]
       9 00000006 7640!         LCR       #||drive_tick||       ; [CPU_ALU]
         00000007 0000
      10              ||$C$L1||:
      11 00000008 E022  ||      SUBF32    R4H,R0H,R1H           ; [CPU_FPU]
         00000009 4321
      12                        MOV32     R2H,R1H               ; [CPU_FPU]
      13 0000000a 0006          LRETR     ; [CPU_ALU]
      20 00000000               .sect   ".TI.ramfunc:drive_tick"
      21              ;* FNAME: drive_tick                    FR SIZE:   4           *
      22              ||drive_tick||:
      23 00000000 D008          MOVB      XAR0,#8               ; [CPU_ALU]
      24              ||$C$L2||:
      25 00000001 E700          MPYF32    R1H,R1H,R2H           ; [CPU_FPU]
         00000002 0088
      26 00000003 000E          BANZ      ||$C$L2||,AR0--       ; [CPU_ALU]
         00000004 FFFE
      27 00000005 0006          LRETR     ; [CPU_ALU]
"""


TICK_cycles = 1 + 3 * 1 + 3 * 4 + 8  # its loop three times: the most of a loop of law noc


def longer(cycles):
    """The listing with a core that takes as many cycles."""
    line = "      23 00000000 D008          MOVB      XAR0,#8               ; [CPU_ALU]\n"
    assert LISTING.count(line) == 1
    return LISTING.replace(line, line * (cycles - TICK_cycles + 1))


def link_information(image, change=None, functions=("control_isr", "drive_tick"), slow=(), at=None):
    """Every section at the beginning of its range, behind what is there already."""
    ranges, sections = command_file.parse(
        (evidence.ROOT / "linker" / f"f28335_{image}.cmd").read_text(), ("FAST_RTS",)
    )
    free = {name: item.origin for name, item in ranges.items()}
    size = {
        "codestart": 2,
        ".TI.ramfunc": 9000,
        ".stack": 0x700,
        ".bss": 4000,
        ".text": 12000 if image == "flash" else 2000,
    }
    groups = []
    for section in sections.values():
        words = 0 if section.type else size.get(section.name, 10)
        load, run = free[section.load], free[section.run]
        free[section.load] += words
        if section.run != section.load:
            free[section.run] += words
        row = {"name": section.name, "load": load, "run": run, "size": words}
        groups.append(change(row) if change else row)
    xml = "".join(
        "<logical_group><name>{name}</name><load_address>{load:#x}</load_address>"
        "<run_address>{run:#x}</run_address>"
        "<size>{size:#x}</size></logical_group>".format(**row)
        for row in groups
    )
    xml += "".join(
        f"<memory_area><name>{r.name}</name><origin>{r.origin:#x}</origin>"
        f"<length>{r.length:#x}</length>"
        f"<used_space>{free[r.name] - r.origin if r.name != 'RAMM01' else 0:#x}"
        f"</used_space></memory_area>"
        for r in ranges.values()
    )
    xml += "".join(
        f"<object_component><name>{'.text' if name in slow else '.TI.ramfunc'}:{name}</name>"
        f"<load_address>0x320000</load_address><run_address>"
        f"{(at or {}).get(name, 0x320000 if name in slow else 0x8000):#x}</run_address>"
        "</object_component>"
        for name in functions
    )
    return f"<link_info>{xml}</link_info>"


class Evidence(unittest.TestCase):
    def make(
        self,
        change=None,
        frame=8,
        functions=("control_isr", "drive_tick"),
        listings=LISTING,
        there=False,
        slow=(),
        at=None,
    ):
        with tempfile.TemporaryDirectory() as directory:
            build = pathlib.Path(directory)
            (build / "listings").mkdir()
            if listings:
                (build / "listings" / "control_isr.lst").write_text(
                    listings.replace("{frame}", str(frame))
                )
            for image in ("flash", "ram"):
                (build / f"sdre_f28335_{image}.xml").write_text(
                    link_information(
                        image, change if image == "flash" else None, functions, slow, at
                    )
                )
            with mock.patch.object(evidence.code_size, "is_there", lambda: there):
                return evidence.make(build, ["flash", "ram"])

    def refused(self, part, **arguments):
        text, wrong = self.make(**arguments)
        self.assertTrue(any(part in line for line in wrong), wrong)
        self.assertIn(part, text)

    def test_good_images_are_as_expected(self):
        text, wrong = self.make()
        self.assertEqual(wrong, [])
        for part in (
            "Everything is as expected.",
            "## flash: memory",
            "## ram: sections",
            "| drive_tick | 6 |",
        ):
            self.assertIn(part, text)

    def test_listing_is_read(self):
        functions = listing.read(LISTING.replace("{frame}", "8"))
        isr, tick = functions["control_isr"], functions["drive_tick"]
        self.assertEqual((isr.words, isr.frame, len(isr.lines)), (11, 8, 8))
        self.assertEqual((tick.words, tick.frame), (6, 4))

    def test_wrong_images_are_seen(self):
        def at(name, key, value):
            return lambda row: {**row, key: value} if row["name"] == name else row

        for change, part in (
            (at(".TI.ramfunc", "run", 0x320000), ".TI.ramfunc runs at 0x320000, outside RAML0123"),
            (at(".seldom", "load", 0x300000), ".seldom loads at 0x300000, outside FLASH"),
            (at(".text", "load", 0x33FF00), ".text loads at 0x33ff00, outside FLASH"),
            (at(".tables", "size", 0), "section .tables is empty"),
            (at(".stack", "run", 0x400), ".stack runs at 0x400, outside RAMM01"),
            (at(".args", "name", ".ebss"), "section .ebss is in no command file"),
        ):
            with self.subTest(part=part):
                self.refused(part, change=change)

    def test_full_memory_is_seen(self):
        with mock.patch.object(evidence, "LEFT", 0.6):
            self.refused("flash: RAML0123 is 55 % full")

    def test_part_that_is_not_inlined_is_seen(self):
        self.assertIn("angle_gate_pass", evidence.parts())
        self.refused(
            "not inlined: angle_gate_pass",
            functions=("control_isr", "drive_tick", "angle_gate_pass"),
        )

    def test_missing_listings_are_seen(self):
        self.refused("no listings", listings="")
        self.refused("no listing of control_isr()", functions=("drive_tick",))

    def test_core_is_held_to_the_budget(self):
        low, high = evidence.json.loads((evidence.ROOT / "docs/budget.json").read_text())["bound"][
            "noc"
        ]
        text, wrong = self.make()
        self.assertIn(f"| noc | {low} .. {high} | {TICK_cycles} | as expected, below", text)
        self.assertIn("largest number of passes: drive_tick.", text)
        text, wrong = self.make(listings=longer(high))
        self.assertEqual(wrong, [])
        self.assertIn(f"| noc | {low} .. {high} | {high} | as expected |", text)
        self.refused(
            f"drive_tick(): {high + 1} cycles, the budget says {low} .. {high}",
            listings=longer(high + 1),
        )

    def test_functions_in_flash_take_its_waits(self):
        slow = round((TICK_cycles - 3) / 0.62 + 3 / 0.76)
        self.assertIn(f"| {slow} | as expected, below", self.make(slow=("drive_tick",))[0])
        with mock.patch.object(evidence.code_size, "seldom", lambda: ["drive_tick"]):
            text, wrong = self.make(at={"drive_tick": 0x321000})
            self.assertIn(f"| {slow} | as expected, below", text)
            self.assertEqual(wrong, [])

    def test_functions_in_the_wrong_memory_are_seen(self):
        self.refused("drive_tick() runs at 0x321000, outside RAML", at={"drive_tick": 0x321000})
        both = ("control_isr", "drive_tick", "app_init")
        self.refused("app_init() runs at 0x8000, outside FLASH", functions=both)
        self.assertEqual(self.make(functions=both, at={"app_init": 0x321000})[1], [])
        self.refused(
            "app_align() runs at 0x9000, outside FLASH",
            functions=(*both[:2], "app_align"),
            slow=("app_align",),
            at={"app_align": 0x9000},
        )

    def test_law_without_a_budget_is_said(self):
        with mock.patch.object(evidence, "law_of", lambda build: "pid"):
            text, wrong = self.make()
        self.assertEqual(wrong, [])
        self.assertIn("The budget does not price law pid.", text)

    def test_other_laws_have_functions_of_the_same_name(self):
        with tempfile.TemporaryDirectory() as directory:
            build = pathlib.Path(directory)
            (build / "listings").mkdir()
            for law, cycles in (("noc", 100), ("pid", 10000)):
                text = longer(cycles).replace("{frame}", "8")
                (build / "listings" / f"law_{law}.lst").write_text(text)
            for image in ("flash", "ram"):
                (build / f"sdre_f28335_{image}.xml").write_text(link_information(image))
            with mock.patch.object(evidence.code_size, "is_there", lambda: False):
                self.assertEqual(evidence.make(build, ["flash", "ram"])[1], [])

    def test_frames_and_sizes_are_compared_with_the_count(self):
        graph = mock.Mock(frame={"control_isr.c:control_isr": 10, "drive_tick.c:drive_tick": 4})
        functions = {"noc": [evidence.code_size.Function("step", "control_laws_noc", 7000)]}
        with (
            mock.patch.object(evidence.check_stack, "graph_of", lambda *a: graph),
            mock.patch.object(evidence.code_size, "functions", lambda laws: functions),
            mock.patch.object(evidence.code_size, "runs_from_ram", lambda law: lambda source: True),
        ):
            self.assertEqual(self.make(there=True)[1], [])
            self.refused("frames: 490 words beyond the count", there=True, frame=500)
            functions["noc"] = [evidence.code_size.Function("step", "control_laws_noc", 5000)]
            self.refused("code in RAM: 9000 words, estimated 4389 ..", there=True)


def priced(text, name="f", in_flash=(), law="noc"):
    functions = {}
    for function, lines in re.findall(r"(\w+):\n((?:    .*\n)+)", text):
        made = functions[function] = listing.Function(function)
        for line in lines.splitlines():
            label, _, code = line.strip().rpartition("> ")
            if label:
                made.labels[label] = len(made.lines)
            mnemonic, _, operands = code.partition(" ")
            made.lines.append((mnemonic, operands))
    return pricing.dearest(functions, name, law, in_flash)


class Prices(unittest.TestCase):
    """Small ways whose cycles are counted by hand."""

    def test_calls_branches_and_loops(self):
        functions = listing.read(LISTING.replace("{frame}", "8"))
        self.assertEqual(
            pricing.dearest(functions, "drive_tick", "noc"), (TICK_cycles, set(), {"drive_tick"})
        )
        # four before the branch, not taken 4, call 4 with its callee, one issue of a pair, return 8
        self.assertEqual(
            pricing.dearest(functions, "control_isr", "noc")[0], 4 + 4 + 4 + TICK_cycles + 1 + 8
        )
        alone = {"control_isr": functions["control_isr"]}
        self.assertEqual(
            pricing.dearest(alone, "control_isr", "noc"), (4 + 4 + 4 + 1 + 8, {"drive_tick"}, set())
        )

    def test_bounds_are_those_of_the_budget(self):
        text = "{}:\n    L> ADDL ACC,XAR4\n    BANZ ||L||,AR0--\n    LRETR \n"
        for name, law, passes, unknown in (
            ("nodo_update", "noc", 2, set()),
            ("f", "noc", 3, {"f"}),
            ("f", "noc_h", 24, {"f"}),
        ):
            self.assertEqual(
                priced(text.format(name), name, law=law), (5 * passes + 8, set(), unknown)
            )

    def test_a_jump_back_is_followed(self):
        text = "f:\n    B ||M||,UNC\n    L> ADDL ACC,XAR4\n    LRETR \n    M> ADDL ACC,XAR5\n"
        self.assertEqual(priced(text + "    B ||L||,UNC\n")[0], 7 + 1 + 7 + 1 + 8)

    def test_flash_takes_its_waits(self):
        text = "f:\n    MPYF32 R0H,R1H,R2H\n    NOP \n    MOV32 R0H,*+XAR4[2]\n    LRETR \n"
        self.assertEqual(priced(text)[0], 3 + 8)
        self.assertEqual(priced(text, in_flash=("f",))[0], round(2 / 0.76 + 9 / 0.62))

    def test_the_library_has_the_budgets_prices(self):
        text = "f:\n    LCR #||__c28xabi_divf||\n    LCR #||other||\n    LRETR \n"
        self.assertEqual(priced(text), (27 + 4 + 8, {"other"}, set()))

    def test_a_repeated_instruction_counts_each_time(self):
        self.assertEqual(priced("f:\n    RPT #6\n    NOP \n    LRETR \n")[0], 8 + 8)

    def test_calls_of_the_law_are_resolved(self):
        rest = "reset:\n    NOP \n    LRETR \nstep:\n    NOP \n    NOP \n    LRETR \n"
        for word, cycles in ((2, 9), (4, 10)):
            text = f"f:\n    MOVL XAR7,*+XAR4[{word}]\n    LCR *XAR7\n    LRETR \n"
            self.assertEqual(priced(text + rest)[0], 1 + 4 + cycles + 8)

    def test_recursion_is_found(self):
        with self.assertRaises(ValueError):
            priced("f:\n    LCR #||f||\n    LRETR \n")


if __name__ == "__main__":
    unittest.main()
