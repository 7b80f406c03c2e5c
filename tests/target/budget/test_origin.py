# SPDX-License-Identifier: MIT
"""Feature, memory and intrinsics of instructions, and what they change in the price; small enough
to count by hand."""

import re
import sys
import unittest
from collections import Counter
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import machine_code  # noqa: E402
import origin  # noqa: E402
from costs import Costs  # noqa: E402
from execution import Steps, path_counts  # noqa: E402
from longest_path import LongestPath  # noqa: E402

LIMIT = ("vcmpe.f32\ts0, s1", "vmrs\tAPSR_nzcv, fpscr", "it\tgt", "vmovgt.f32\ts0, s1")
LISTING = """
00000100 <tick>:
 100:	vadd.f32	s0, s0, s1
 104:	cbz	r0, 10c <tick+0xc>
 108:	bl	200 <shown>
 10c:	bx	lr

00000200 <shown>:
 200:	vmul.f32	s0, s0, s1
 204:	ldr	r0, [r1]
 208:	bx	lr
"""
FRAMES = {
    0x100: (("base_half", "base.h"), ("ask", "asks.c"), ("tick", "tick.c")),
    0x104: (("tick", "tick.c"),),
    0x108: (("tick", "tick.c"),),
    0x10C: (("tick", "tick.c"),),
    0x200: (("part", "parts.h"), ("shown", "shows.c")),
    0x204: (("shown", "shows.c"),),
    0x208: (("shown", "shows.c"),),
}
BOARD_TEXT = """
set(board_ram_sources
    adc.c clock.c)
set(core_flash_sources *fields*.c motor.c)
target_compile_options(control_core PRIVATE --ramfunc=on)
set(app_ram_sources app.c # every tick
    operate/app_gate.c)
set(app_flash_sources_noc_h app_gate.c)
"""


def code_of(listing, frames=None, features=None, flash=(), one_instruction=()):
    source = origin.Origin(features or {}, set(flash), set(one_instruction)) if frames else None
    with (
        mock.patch.object(machine_code, "run", lambda *command: listing),
        mock.patch.object(machine_code, "read_frames", lambda *_: frames),
    ):
        return machine_code.read_code("", "", (), source)


def trace(*addresses):
    return tuple(b"%08x" % address for address in addresses)


def unit_cost(counts):
    return sum(counts.values())


class Choices(unittest.TestCase):
    def counts_of(self, *lines, intrinsic=False):
        text = "\n".join(f" {0x100 + 4 * n:x}:\t{line}" for n, line in enumerate(lines))
        frames = {
            0x100 + 4 * n: (("base_min" if intrinsic else "f", "base.h"),)
            for n in range(len(lines))
        }
        self.code = code_of(f"00000100 <f>:\n{text}\n", frames, one_instruction={"base_min"})
        return dict(+sum((i.counts for i in self.code.values()), Counter()))

    def test_a_chosen_float_takes_a_branch(self):
        self.assertEqual(
            self.counts_of(*LIMIT, "bx\tlr"),
            {"fp_compare": 1, "fp_flags": 1, "select": 1, "fp_move": 1},
        )
        costs = Costs().of
        self.assertEqual(costs["select"], costs["branch"])

    def test_the_choice_of_an_intrinsic_is_one_instruction(self):
        self.assertEqual(self.counts_of(*LIMIT, "bx\tlr", intrinsic=True), {"limit": 1})
        self.assertEqual(Costs().of["limit"], 1)

    def test_a_branch_of_an_intrinsic_is_free(self):
        lines = (
            "vcmpe.f32\ts0, s1",
            "vmrs\tAPSR_nzcv, fpscr",
            "ble.n\t110 <f+0x10>",
            "vmov.f32\ts0, s1",
            "bx\tlr",
        )
        self.assertEqual(self.counts_of(*lines, intrinsic=True), {"limit": 1, "fp_move": 1})
        steps = Steps(self.code, set(), (unit_cost,))
        self.assertEqual(
            +path_counts(trace(0x100, 0x110), steps), Counter(limit=1, **{"return": 1})
        )
        bound = LongestPath(self.code, set(), {}, unit_cost).function("f")
        self.assertEqual(+Counter(bound), Counter(limit=1, fp_move=1, **{"return": 1}))

    def test_a_chosen_integer_is_a_move_on_a_condition(self):
        lines = (*LIMIT[:2], "ite\tgt", "movgt\tr0, #1", "movle\tr0, #0", "bx\tlr")
        self.assertEqual(self.counts_of(*lines), {"fp_compare": 1, "fp_flags": 1, "integer": 3})

    def test_the_quotient_of_an_intrinsic_is_an_estimate(self):
        lines = (
            "vmov.f32\ts1, #112",
            "vsqrt.f32\ts0, s0",
            "vdiv.f32\ts0, s1, s0",
            "bx\tlr",
        )
        self.assertEqual(self.counts_of(*lines, intrinsic=True), {"estimate": 1})
        self.assertEqual(self.counts_of(*lines), {"constant": 1, "fp_sqrt": 1, "fp_div": 1})

    def test_intrinsics_are_read_from_base_h(self):
        text = (
            "static inline float base_min(float a, float b)\n{\n    return __fmin(a, b);\n}\n"
            "static inline float estimate(float x)\n{\n    return __einvf32(x);\n}\n"
            "static inline float base_sum(float a, float b)\n{\n    return a + b;\n}\n"
            "static inline float base_clamp(float x, float lo, float hi)\n{\n    return "
            "__fmin(__fmax(x, lo), hi);\n}\n"
        )
        self.assertEqual(origin.intrinsics(text), {"base_min", "estimate", "base_clamp"})


class Memory(unittest.TestCase):
    def setUp(self):
        self.code = code_of(
            LISTING,
            FRAMES,
            {"questions": ["asks.c"], "display": ["shown"], "tick": ["tick.c"]},
            {"shows.c"},
        )
        self.path = trace(0x100, 0x108, 0x200, 0x10C)
        self.steps = Steps(self.code, set(), (unit_cost,))

    def test_instructions_of_a_flash_file_say_so(self):
        counts = +path_counts(self.path, self.steps)
        self.assertEqual(
            counts,
            Counter(
                {
                    "fp_add": 1,
                    "integer": 1,
                    "not_taken": 1,
                    "call": 1,
                    "fp_mul, flash": 1,
                    "load, flash": 1,
                    "return, flash": 1,
                    "return": 1,
                }
            ),
        )
        bound = LongestPath(self.code, set(), {}, unit_cost).function("tick")
        self.assertEqual(+Counter(bound), counts)

    def test_flash_divides_by_its_speed(self):
        costs = Costs()
        self.assertAlmostEqual(costs.of["fp_mul, flash"], costs.of["fp_mul"] / 0.76)
        self.assertAlmostEqual(costs.of["load, flash"], costs.of["load"] / 0.62)
        self.assertAlmostEqual(
            costs.in_flash({"load, flash": 31, "load": 9}), 50 * costs.of["load"]
        )

    def test_functions_that_the_linker_names_come_from_the_flash(self):
        source = origin.Origin({}, set(), set(), {"shown"})
        self.assertTrue(source.in_flash(FRAMES[0x200]))
        self.assertTrue(source.in_flash((("shown.part.0", "shows.c"),)))
        self.assertFalse(source.in_flash(FRAMES[0x100]))
        self.assertFalse(source.in_flash((("shown", "parts.h"), ("tick", "tick.c"))))

    def test_the_linker_file_is_read(self):
        text = "    .seldom :\n    {\n  *(.TI.ramfunc:a_b)\n  *(.TI.ramfunc:c)\n    }\n > FLASH\n"
        self.assertEqual(origin.seldom_functions(text + "*(.TI.ramfunc:d)"), {"a_b", "c"})
        with self.assertRaises(ValueError):
            origin.seldom_functions(text.replace(".seldom", ".rare"))

    def test_cycles_go_to_the_innermost_named_source(self):
        found = {
            name: +counts
            for name, counts in self.steps.by_feature(
                zip(self.path, self.path[1:] + (None,))
            ).items()
        }
        self.assertEqual(
            found,
            {
                "questions": Counter(fp_add=1),
                "tick": Counter({"integer": 1, "not_taken": 1, "call": 1, "return": 1}),
                "display": Counter({"fp_mul, flash": 1, "load, flash": 1, "return, flash": 1}),
            },
        )

    def test_what_no_feature_names_is_other(self):
        self.assertEqual(code_of(LISTING, FRAMES)[0x100].feature, "other")

    def test_a_name_in_two_features_is_refused(self):
        with self.assertRaisesRegex(ValueError, "two features"):
            origin.Origin({"a": ["x.c"], "b": ["x.c"]}, (), ())

    def test_files_in_flash_are_those_that_the_board_leaves_out(self):
        core, others = (
            {"nosc.c", "motor.c", "law_noc_fields.c"},
            {"app.c", "app_gate.c", "app_stop.c", "adc.c", "serial.c"},
        )
        flash = {"law_noc_fields.c", "motor.c", "app_stop.c", "serial.c"}
        self.assertEqual(origin.flash_files(BOARD_TEXT, "noc", core, others), flash)
        self.assertEqual(
            origin.flash_files(BOARD_TEXT, "noc_h", core, others), flash | {"app_gate.c"}
        )
        for old in ("app_ram_sources", "board_ram_sources", "core_flash_sources", "--ramfunc=on"):
            with self.subTest(old=old), self.assertRaises(ValueError):
                origin.flash_files(BOARD_TEXT.replace(old, "other"), "noc", set(), set())

    def test_frames_are_read_in_the_order_of_inlining(self):
        answer = (
            "0x00000100\nbase_half\n/a/base.h:7\ntick\n/a/b/../tick.c:9 (discriminator "
            "2)\n0x00000104\ntick\n/a/b/../tick.c:9\n"
        )
        with mock.patch.object(origin.subprocess, "run", lambda *_, **__: mock.Mock(stdout=answer)):
            self.assertEqual(
                origin.read_frames("", "", (0x100, 0x104)),
                {
                    0x100: (("base_half", "base.h"), ("tick", "tick.c")),
                    0x104: (("tick", "tick.c"),),
                },
            )

    def test_every_feature_names_what_exists(self):
        firmware = origin.FIRMWARE
        files = {
            path.name: path.read_text()
            for name in origin.FOLDERS
            for path in (firmware / name).rglob("*.[ch]")
        }
        for feature, names in Costs().features.items():
            for name in names:
                with self.subTest(feature=feature, name=name):
                    self.assertTrue(
                        name in files or any(f" {name}(" in text for text in files.values())
                    )

    def test_every_function_of_the_tick_is_named(self):
        """Those that no row names would count as checks of the core, as drive_tick.c does."""
        text = (origin.FIRMWARE / "control/drive_tick.c").read_text()
        found = re.findall(r"^static (?:inline )?\w+ (\w+)\(", text, re.M)
        named = {name for names in Costs().features.values() for name in names}
        self.assertGreater(len(found), 15)
        self.assertEqual(set(found) - named, set())


if __name__ == "__main__":
    unittest.main()
