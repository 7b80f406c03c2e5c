# SPDX-License-Identifier: MIT
"""Every law of the firmware stands in the lists by name, with its number where there is one."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def laws():
    """Number and name of each, from the firmware."""
    for file in sorted((ROOT / "firmware/control/laws").glob("law_*.c")):
        found = re.search(
            r"const law_t law_(\w+) = \{.*?\.number\s*= (\d+)U",
            file.read_text(encoding="utf-8"),
            re.S,
        )
        yield int(found[2]), found[1]


class Lists(unittest.TestCase):
    laws = dict(laws())

    def test_numbers_are_unique(self):
        self.assertEqual(len(self.laws), len(list(laws())))

    def test_numbers_that_are_read_from_a_drive(self):
        told = text("host_tools/python/sdre_drive/load.py").split("LAWS = {")[1].split("}")[0]
        found = re.findall(r'(\d+): "(\w+)"', told)
        self.assertEqual({int(n): name for n, name in found}, self.laws)

    def test_numbers_of_the_page(self):
        table = text("docs/loading.md").split("| number | law |")[1].split("\n\n")[0]
        found = re.findall(r"^\| (\d+) \| (\w+) \|$", table, re.M)
        self.assertEqual({int(n): name for n, name in found}, self.laws)

    def test_linked_and_proved(self):
        for script in ("tests/target/check_linked_law.sh", "tests/prove/prove.sh"):
            named = re.search(r"^laws=\((.*)\)$", text(script), re.M)[1].split()
            self.assertEqual(set(named), set(self.laws.values()), script)

    def test_walks_are_tested_for_completeness(self):
        test = text("tests/unit/control/fields/test_fields_complete.c")
        named = re.findall(r"assert_law\(law_(\w+)_fields, sizeof\(law_(\w+)_config_t\)", test)
        self.assertEqual(set(named), {(name, name) for name in self.laws.values()})

    def test_whole_numbers_are_said_for_the_proof(self):
        named = set(re.findall(r"\bPROVE_(\w+)", text("tests/prove/prove_tick.c"))) - {"LAW"}
        self.assertEqual(named, set(self.laws.values()))


if __name__ == "__main__":
    unittest.main()
