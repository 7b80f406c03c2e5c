# SPDX-License-Identifier: MIT
"""Sums by feature, limits, the record and the tables of docs/hardware.md."""

import contextlib
import io
import json
import sys
import unittest
from collections import Counter
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
import budget  # noqa: E402
import report  # noqa: E402
import tables  # noqa: E402
from costs import Costs  # noqa: E402


class Seldom(unittest.TestCase):
    def verdict(self, calls):
        said = []
        budget.check_seldom(lambda good, text: said.append((good, text)), "x", calls, {"reset"})
        return said[0]

    def test_one_tick_of_a_thousand_may_run_them(self):
        start, hot = frozenset({"tick", "reset.part.0"}), frozenset({"tick"})
        self.assertTrue(self.verdict({start: 1, hot: 999})[0])
        good, text = self.verdict({start: 1, hot: 998})
        self.assertFalse(good)
        self.assertTrue(text.endswith("but not reset"), text)


class Figures(unittest.TestCase):
    def test_calls_of_the_board_stand_with_the_interrupt(self):
        costs = Costs()
        core = {"law": Counter(fp_compare=100), "observer": Counter(fp_compare=300)}
        app = {"gates": Counter(fp_compare=7, board_cycles=2), "law": Counter(fp_compare=50)}
        found = report.by_feature(costs, core, app)
        self.assertEqual(
            found,
            {
                report.BOARD: round(costs.interrupt + 2 * costs.of["board_cycles"]),
                "observer": 300,
                "law": 150,
                "gates": 7,
            },
        )
        self.assertEqual(sorted(found.values(), reverse=True), list(found.values()))

    def test_flash_counts_as_the_same_operation(self):
        found = report.operations(
            Costs(), {"fp_add": 2, "fp_add, flash": 3, "taken": 1, "not_taken, flash": 1}
        )
        self.assertEqual((found["add, subtract"], found["branch"]), (5, 2))
        with self.assertRaises(AssertionError):
            report.operations(Costs(), {"unknown": 1})

    def test_both_ends_of_the_band(self):
        self.assertEqual(Costs().span(1000), (890, 1110))

    def test_plain_division(self):
        self.assertEqual(Costs().slow({"fp_div": 2, "limit": 1}), round(1.11 * 445))

    def test_the_period_that_starts_a_run_counts(self):
        f = {
            "whole_period": {
                "noc": [1, 5],
                "noc, start": [2, 7],
                "noc, position": [3, 9],
                "noc_h": [4, 8],
            }
        }
        self.assertEqual(
            [report.dearest(f, column) for column in f["whole_period"]],
            [[2, 7], [2, 7], [3, 9], [4, 8]],
        )

    def test_json_has_a_line_for_each_entry(self):
        f = {"band_percent": 11, "law": {"noc": {"cycles": [1, 2]}, "noc_h": {}}, "bound": {}}
        self.assertEqual(json.loads(report.text(f)), f)
        self.assertEqual(report.text(f).count("\n"), 8)

    def test_a_limit_is_met_up_to_its_value(self):
        self.assertEqual(report.verdict(4500, 4500), "met")
        self.assertEqual(report.verdict(4950, 4500), "missed by 10 %")


class Record(unittest.TestCase):
    def growth(self, spent, recorded):
        check, said = budget.Checks(), io.StringIO()
        with contextlib.redirect_stdout(said):
            budget.check_growth(check, spent, recorded)
        return check.failed, said.getvalue()

    def test_a_dearer_period_fails(self):
        failed, said = self.growth({"noc": [0, 101]}, {"noc": [0, 100]})
        self.assertTrue(failed)
        self.assertIn(
            "FAIL whole period of noc: 101 cycles, recorded 100: ./dev budget record", said
        )

    def test_a_period_without_a_record_fails(self):
        self.assertTrue(self.growth({"noc": [0, 1]}, {})[0])

    def test_a_cheaper_or_equal_one_passes(self):
        self.assertEqual(
            self.growth({"noc": [0, 100]}, {"noc": [0, 100]}),
            (False, "ok   whole period of noc: 100 cycles, recorded 100\n"),
        )
        failed, said = self.growth({"noc": [0, 99]}, {"noc": [0, 100]})
        self.assertFalse(failed)
        self.assertIn("./dev budget record", said)


class Ceiling(unittest.TestCase):
    """The default drive only becomes cheaper; the others may cost more."""

    def record(self, start, before, failed=False):
        """(text written or None, what was said)"""
        check, said, kept = budget.Checks(), io.StringIO(), []
        check.failed = failed
        figures = {"whole_period": {"noc": [1, 90], "noc, start": [2, start], "noc_h": [3, 999]}}
        with contextlib.redirect_stdout(said), mock.patch.object(budget, "tables") as written:
            written.RECORDED.write_text = kept.append
            budget.record_figures(check, figures, before)
        return (json.loads(kept[0]) if kept else None), said.getvalue()

    def test_a_cheaper_period_lowers_it(self):
        self.assertEqual(self.record(100, {"ceiling": 110})[0]["ceiling"], 100)
        self.assertEqual(self.record(110, {"ceiling": 110})[0]["ceiling"], 110)
        self.assertEqual(self.record(100, {})[0]["ceiling"], 100)

    def test_a_dearer_one_is_not_recorded(self):
        kept, said = self.record(111, {"ceiling": 110})
        self.assertIsNone(kept)
        self.assertIn(
            "FAIL whole period of the default drive: 111 cycles, its ceiling is 110", said
        )

    def test_nothing_is_recorded_after_a_failed_check(self):
        self.assertIsNone(self.record(100, {"ceiling": 110}, failed=True)[0])

    def test_the_record_of_this_tree_is_under_it(self):
        figures = json.loads(tables.RECORDED.read_text())
        self.assertEqual(report.exceeds(figures, tables.SHIPPED), "")
        for kind in ("noc", "noc, start"):
            dearer = json.loads(tables.RECORDED.read_text())
            dearer["whole_period"][kind][1] = dearer["ceiling"] + 1
            self.assertIn("ceiling", report.exceeds(dearer, tables.SHIPPED))
        del figures["ceiling"]
        self.assertIn("no ceiling", report.exceeds(figures, tables.SHIPPED))


class Tables(unittest.TestCase):
    def setUp(self):
        self.figures = json.loads(tables.RECORDED.read_text())
        self.page = "".join(
            f"a\n<!-- budget {name} -->\n<!-- end -->\n"
            for name in ("limits", "laws", "features", "operations", "memory", "frequencies")
        )

    def test_tables_follow_the_figures(self):
        costs = Costs()
        costs.limits = {"noc": {"goal": 1, "step": 10**6}}
        page = tables.filled(self.page, self.figures, costs)
        self.assertEqual(page, tables.filled(page, self.figures, costs))
        self.assertRegex(
            page,
            r"\| encoder form \| \d+ \.\. \d+ \| [^|]+ \| 1, missed by \d+ % \| 1000000, met \|",
        )
        self.figures["whole_period"]["noc"][1] += 1
        self.assertNotEqual(page, tables.filled(page, self.figures, costs))

    def test_header_follows_the_figures(self):
        for n, column in enumerate(("noc", "noc, start", "noc, position", "conventional")):
            before = tables.header(self.figures, 0.1)
            self.figures["whole_period"][column][1] = 20000 + 1000 * n  # the dearest so far
            self.assertNotEqual(before, tables.header(self.figures, 0.1))
        self.assertNotEqual(tables.header(self.figures, 0.1), tables.header(self.figures, 0.2))

    def test_features_add_up_to_the_whole_period(self):
        for kind, parts in self.figures["features"].items():
            middle = sum(self.figures["whole_period"][kind]) / 2
            self.assertAlmostEqual(sum(parts.values()), middle, delta=1 + len(parts) / 2)

    def test_a_page_without_a_marker_is_refused(self):
        with self.assertRaisesRegex(ValueError, "markers"):
            tables.filled(self.page.replace("budget laws", "budget law"), self.figures, Costs())


if __name__ == "__main__":
    unittest.main()
