# SPDX-License-Identifier: MIT
"""Moves of float registers on code small enough to count by hand."""

import sys
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import machine_code  # noqa: E402


def spills(*lines):
    """Moves of each instruction."""
    text = "\n".join(f" {0x100 + 4 * n:x}:\t{line}" for n, line in enumerate(lines))
    with mock.patch.object(machine_code, "run", lambda *command: f"00000100 <f>:\n{text}\n"):
        code = machine_code.read_code("", "")
    return [i.counts["spill"] for i in code.values()]


def loads(first, last):
    return [f"vldr\ts{n}, [r0, #{4 * n}]" for n in range(first, last)]


class Registers(unittest.TestCase):
    def test_eight_values_fit(self):
        uses = [f"vadd.f32\ts{n}, s{n}, s{n + 1}" for n in range(7)]
        self.assertEqual(sum(spills(*loads(0, 8), *uses, "bx\tlr")), 0)

    def test_a_ninth_loaded_value_costs_a_load(self):
        # s0 is needed last: it gives way when s8 comes, has its copy in memory, and is loaded
        # again.
        uses = [f"vstr\ts{n}, [r1, #{4 * n}]" for n in range(8, 0, -1)]
        found = spills(*loads(0, 9), *uses, "vstr\ts0, [r1]", "bx\tlr")
        self.assertEqual(found, [0] * 9 + [0] * 8 + [1, 0])

    def test_a_ninth_computed_value_costs_a_store_and_a_load(self):
        made = [f"vadd.f32\ts{n}, s0, s0" for n in range(1, 9)]
        uses = [f"vstr\ts{n}, [r1]" for n in range(1, 9)]
        # s8 is made while s0 .. s7 are live: s0, loaded, gives way for nothing, and s0 comes back
        # at the end.
        self.assertEqual(
            spills(*loads(0, 1), *made, *uses, "vstr\ts0, [r1]", "bx\tlr"), [0] * 17 + [1, 0]
        )
        # Without a copy in memory it is stored first.
        self.assertEqual(
            spills("vmov\ts0, r2", *made, *uses, "vstr\ts0, [r1]", "bx\tlr"),
            [0] * 8 + [1] + [0] * 8 + [1, 0],
        )

    def test_a_value_that_nobody_reads_again_gives_way_for_nothing(self):
        made = [f"vadd.f32\ts{n}, s0, s0" for n in range(1, 9)]
        self.assertEqual(
            sum(spills(*loads(0, 1), *made, *(f"vstr\ts{n}, [r1]" for n in range(1, 9)), "bx\tlr")),
            0,
        )

    def test_further_arguments_arrive_in_memory(self):
        uses = [f"vstr\ts{n}, [r1]" for n in range(6)]
        self.assertEqual(spills(*uses, "bx\tlr"), [0, 0, 0, 0, 1, 1, 0])

    def test_a_call_keeps_four(self):
        made = [f"vmov\ts{16 + n}, r{n}" for n in range(6)]
        uses = [f"vstr\ts{16 + n}, [r1]" for n in range(6)]
        self.assertEqual(
            spills(*made, "bl\t100 <f>", *uses, "bx\tlr"), [0] * 6 + [2] + [0] * 4 + [1, 1, 0]
        )

    def test_what_a_called_function_leaves_alone_is_counted_beyond_eight(self):
        # gcc knows that f leaves s0 .. s9 alone, and ten values live on behind the call. The tool
        # takes them for results: it stores the last two, and loads them again.
        made = [f"vmov\ts{n}, r{n}" for n in range(10)]
        uses = [f"vstr\ts{n}, [r1]" for n in range(10)]
        found = spills(*made, "bl\t100 <f>", *uses, "bx\tlr")
        self.assertEqual(found[10:], [2] + [0] * 8 + [1, 1, 0])

    def test_a_division_is_a_call(self):
        made = [f"vmov\ts{n}, r{n}" for n in range(6)]
        uses = [f"vstr\ts{n}, [r1]" for n in range(6)]
        # s0 and s1 are read, s0 is written: s1 .. s5 live on, one of five gives way.
        self.assertEqual(
            spills(*made, "vdiv.f32\ts0, s0, s1", *uses, "bx\tlr"), [0] * 6 + [1] + [0] * 5 + [1, 0]
        )

    def test_each_side_of_a_branch_goes_on_with_what_was_held(self):
        # Nine values; s0 gives way at the ninth load. The way that needs it loads it again, and
        # still holds s8.
        uses = [f"vstr\ts{n}, [r1]" for n in range(1, 8)]
        lines = [
            *loads(0, 9),
            *uses,
            "cbz\tr2, 148 <f+0x48>",
            "bx\tlr",
            "vstr\ts8, [r1]",
            "vstr\ts0, [r1]",
            "bx\tlr",
        ]
        self.assertEqual(0x100 + 4 * lines.index("vstr\ts8, [r1]"), 0x148)
        self.assertEqual(spills(*lines), [0] * 19 + [1, 0])

    def test_a_value_lives_around_a_loop(self):
        # s0 is read at the head of the loop only: it is not dead behind it, and is stored once.
        # Further passes are not walked.
        made = [f"vadd.f32\ts{n}, s0, s0" for n in range(1, 9)]
        uses = [f"vstr\ts{n}, [r1]" for n in range(1, 9)]
        found = spills("vmov\ts0, r2", *made, *uses, "bne.n\t104 <f+0x4>", "bx\tlr")
        self.assertEqual(found, [0] * 8 + [1] + [0] * 10)


if __name__ == "__main__":
    unittest.main()
