# SPDX-License-Identifier: MIT
"""Counting and pricing on code small enough to count by hand; needs no cross compiler."""

import sys
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import machine_code  # noqa: E402
from execution import Away, Steps, calls_in, path_counts  # noqa: E402
from longest_path import LongestPath  # noqa: E402

LISTING = """
00000100 <sum>:
 100:	push	{r4, lr}
 102:	vldr	s0, [pc, #20]	@ 118
 106:	vadd.f32	s0, s0, s1
 10a:	cmp	r0, r1
 10c:	bne.n	106 <sum+0x6>
 10e:	it	gt
 110:	vsqrtgt.f32	s0, s0
 112:	bl	200 <sinf>
 116:	pop	{r4, pc}
 118:	.word	0x3f800000

00000120 <tick>:
 120:	str.w	lr, [sp, #-4]!
 124:	cbz	r0, 12e <tick+0xe>
 126:	vdiv.f32	s0, s0, s1
 12a:	b.n	132 <tick+0x12>
 12e:	bl	100 <sum>
 132:	vmov.f32	s1, #112	@ 0x3f800000  1.0
 136:	ldr.w	pc, [sp], #4
"""

LAW_LISTING = """
00000100 <tick>:
 100:	push	{r4, lr}
 102:	ldr	r3, [r1, #88]	@ 0x58
 104:	ldr.w	sl, [r3, #8]
 108:	str	sl, [sp, #0]
 10a:	mov	r1, r9
 10c:	blx	sl
 10e:	ldr	r3, [r0, #4]
 110:	bx	r3

00000120 <reset>:
 120:	push	{r4, r5, lr}
 122:	pop	{r4, r5, pc}

00000124 <step>:
 124:	vadd.f32	s0, s0, s1
 128:	bx	lr
"""
LAW_FUNCTIONS = {
    0: (0x130, "check"),
    4: (0x120, "reset"),
    8: (0x124, "step"),
    12: (0x144, "believe"),
    16: (0x148, "adopt"),
    20: (0x140, "counts_ok"),
}


def code_of(listing, functions=()):
    with mock.patch.object(machine_code, "run", lambda *command: listing):
        return machine_code.read_code("", "", functions)


def unit_cost(counts):
    return sum(counts.values())


def counted(counts):
    return {name: n for name, n in counts.items() if n}


def trace(*addresses):
    return tuple(b"%08x" % address for address in addresses)


class Counting(unittest.TestCase):
    def setUp(self):
        self.code = code_of(LISTING)
        self.steps = Steps(self.code, {"sinf"}, (unit_cost,))

    def test_path_with_loop_and_library_call(self):
        # Block 100 runs through 106 to the branch; 106 is then entered once more by that branch.
        path = trace(0x120, 0x12E, 0x100, 0x106, 0x10E, 0x116, 0x132)
        self.assertEqual(
            counted(path_counts(path, self.steps)),
            {
                "store": 3,
                "integer": 4,
                "taken": 2,
                "not_taken": 1,
                "call": 1,
                "constant": 2,
                "fp_add": 2,
                "fp_sqrt": 1,
                "sinf": 1,
                "load": 1,
                "return": 2,
            },
        )

    def test_block_cut_at_the_end_of_a_page(self):
        counts, instructions = self.steps._count(b"00000126", b"0000012a")
        self.assertEqual((counted(counts), instructions), ({"fp_div": 1}, 1))

    def test_block_cut_where_the_loop_of_its_end_begins(self):
        whole = self.steps._count(b"00000100", b"00000106")[1]
        with mock.patch("execution.PAGE_BITS", 1):
            cut = Steps(self.code, {"sinf"}, (unit_cost,))._count(b"00000100", b"00000106")[1]
        self.assertLess(cut, whole)

    def test_impossible_step_is_refused(self):
        with self.assertRaisesRegex(ValueError, "no way"):
            self.steps[(b"00000120", b"00000100")]

    def test_library_function_without_a_price_is_refused(self):
        with self.assertRaisesRegex(ValueError, "sinf"):
            Steps(self.code, set(), (unit_cost,))[(b"0000010e", b"00000116")]

    def test_calls_are_found_among_whatever_else_runs(self):
        # tick twice, with what sinf calls and with other callers of sum before and between them.
        before = (0x100, 0x10E, 0x116)
        first = (0x120, 0x12E, 0x100, 0x106, 0x10E)
        away = (0x100, 0x116, 0x120)  # while sinf has control
        second = (0x120, 0x126, 0x132)
        log = trace(*before, *first, *away[:1], *away[2:], 0x116, 0x132, *before, *second, *before)

        paths = list(calls_in(log, b"00000120", self.steps, Away(self.code, {"sinf"})))

        self.assertEqual(paths, [trace(*first, 0x116, 0x132), trace(*second)])

    def test_bound_takes_the_dearest_way_and_all_passes(self):
        bound = LongestPath(self.code, {"sinf"}, {"sum": [5]}, unit_cost).function("tick")
        self.assertEqual((bound["fp_add"], bound["taken"], bound["not_taken"]), (5, 5, 1))
        self.assertNotIn("fp_div", bound)

    def test_bound_needs_every_loop(self):
        with self.assertRaisesRegex(ValueError, "1 loops, 0 bounds"):
            LongestPath(self.code, {"sinf"}, {}, unit_cost).function("tick")

    def test_recursion_is_refused(self):
        listing = "00000100 <f>:\n 100:\tbl\t100 <f>\n 104:\tbx\tlr\n"
        with self.assertRaisesRegex(ValueError, "recursion"):
            LongestPath(code_of(listing), set(), {}, unit_cost).function("f")

    def test_nested_loops_multiply(self):
        listing = (
            "00000100 <f>:\n 100:\tmovs\tr0, #0\n 102:\tvmul.f32\ts0, s0, s0\n 106:\tcmp\tr0, r1\n"
            " 108:\tbne.n\t102 <f+0x2>\n 10a:\tcmp\tr0, r2\n 10c:\tbne.n\t100 <f>\n 10e:\tbx\tlr\n"
        )
        bound = LongestPath(code_of(listing), set(), {"f": [3, 6]}, unit_cost).function("f")
        self.assertEqual(
            counted(bound),
            {
                "integer": 3 * (1 + 6 + 1),
                "fp_mul": 18,
                "taken": 3 * 5 + 2,
                "not_taken": 4,
                "return": 1,
            },
        )

    def test_only_the_first_eight_words_of_a_structure_are_near(self):
        code = code_of(
            "00000100 <f>:\n 100:\tvldr\ts0, [r0, #12]\n 104:\tvstr\ts0, [r0, #16]\n "
            "108:\tvldr\ts1, [sp, #64]\n"
            " 10c:\tldr\tr1, [r2]\n 110:\tvldr\ts2, [r0, #-4]\n 114:\tbx\tlr\n"
        )
        self.assertEqual([i.counts["far"] for i in code.values()], [0, 1, 0, 0, 1, 0])

    def test_a_function_keeps_four_float_registers_for_its_caller(self):
        code = code_of(
            "00000100 <f>:\n 100:\tvpush\t{d8-d15}\n 104:\tvpush\t{d8}\n 108:\tvpop\t{d8}\n"
            " 10c:\tvpop\t{d8-d10}\n 110:\tvldmia\tr0!, {s0-s5}\n 114:\tbx\tlr\n"
        )
        self.assertEqual([i.counts["store"] for i in code.values()], [4, 2, 0, 0, 0, 0])
        self.assertEqual([i.counts["load"] for i in code.values()], [0, 0, 2, 4, 6, 0])
        self.assertEqual(machine_code.stack_depth(code, "f"), 4 * (16 + 2))

    def test_calls_of_the_law_are_resolved(self):
        code = code_of(LAW_LISTING, LAW_FUNCTIONS)
        bound = LongestPath(code, set(), {}, unit_cost).function("tick")
        self.assertEqual(
            counted(bound),
            {
                "store": 6,
                "load": 5,
                "far": 1,
                "integer": 1,
                "call": 1,
                "branch": 1,
                "fp_add": 1,
                "return": 2,
            },
        )
        self.assertEqual(machine_code.stack_depth(code, "tick"), 8 + 12)
        steps = Steps(code, set(), (unit_cost,))
        self.assertEqual(steps[(b"00000100", b"00000124")][2]["call"], 1)
        with self.assertRaisesRegex(ValueError, "not to step"):
            steps[(b"00000100", b"00000120")]

    def test_a_call_through_anything_else_is_refused(self):
        for old, new in (
            ("#8]", "#24]"),
            ("mov\tr1, r9", "mov\tsl, r9"),
            ("mov\tr1, r9", "ldmia\tr0!, {r4, sl}"),
        ):
            with self.subTest(new=new), self.assertRaisesRegex(ValueError, "computed jump at 10c"):
                self.assertIn(old, LAW_LISTING)
                code_of(LAW_LISTING.replace(old, new, 1), LAW_FUNCTIONS)
        with self.assertRaisesRegex(ValueError, "computed jump"):
            code_of(LAW_LISTING)

    def test_a_return_restores_nothing_for_what_stands_after_it(self):
        listing = LAW_LISTING.replace(" 10a:\tmov\tr1, r9\n", " 10a:\tpop\t{sl, pc}\n")
        calls = [i for i in code_of(listing, LAW_FUNCTIONS).values() if i.name == "blx"]
        self.assertEqual([i.target_name for i in calls], ["step"])

    def test_the_law_of_an_image(self):
        answers = {
            "nm": "00000200 00000024 T law_noc\n00000300 00000004 T law_other\n",
            "objdump": "\nContents of section .text:\n 0200 31010000 21010000 25010000 45010000  "
            "1...!...%...E...\n"
            " 0210 49010000 41010000 51010000 01000000  I...A...Q.......\n"
            " 0220 34010000                             4...\n",
        }
        with mock.patch.object(machine_code, "run", lambda command, *_: answers[command]):
            self.assertEqual(machine_code.law_functions("", "image"), LAW_FUNCTIONS)
            answers["nm"] += "00000224 00000024 T law_pid\n"
            with self.assertRaisesRegex(ValueError, "law_pid"):
                machine_code.law_functions("", "image")

    def test_functions_of_one_name_are_refused(self):
        with self.assertRaisesRegex(ValueError, "two functions are called step"):
            code_of(LAW_LISTING.replace("<reset>", "<step>"), LAW_FUNCTIONS)

    def test_unknown_instruction_is_refused(self):
        for instruction in ("tbb\t[pc, r0]", "vcvt.f64.f32\td0, s0", "ldr.w\tpc, [pc, r0, lsl #2]"):
            with self.assertRaisesRegex(ValueError, "unknown|double"):
                code_of(f"00000100 <f>:\n 100:\t{instruction}\n")

    def test_stack(self):
        self.assertEqual(machine_code.stack_depth(self.code, "tick"), 4 + 8)


if __name__ == "__main__":
    unittest.main()
