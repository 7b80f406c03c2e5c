# SPDX-License-Identifier: MIT
"""Every file that `./dev coverage` and `./dev mutate` compile by hand compiles with their flags."""

import unittest
from concurrent.futures import ThreadPoolExecutor

import unit_build as ub


class Files(unittest.TestCase):
    def test_all_compile(self):
        files = ub.test_files()
        work = ub.sources() + [files[name] for name in ub.tests()]

        def complaint(file):
            done = ub.run(["gcc", *ub.FLAGS, "-fsyntax-only", file])
            return "" if done.returncode == 0 else f"{file}:\n{done.stderr}"

        with ThreadPoolExecutor(ub.JOBS) as pool:
            self.assertEqual("".join(pool.map(complaint, work)), "")


if __name__ == "__main__":
    unittest.main()
