# SPDX-License-Identifier: MIT
"""A first `./dev serve` and `./dev demo` compile what their command needs.

test_first_build.py BUILD_DIRECTORY (of Ninja)
"""

import re
import subprocess
import sys
import unittest

BUILD = sys.argv.pop() if len(sys.argv) > 1 else "build/host"
OTHERS = {  # rooms of other commands: their compilation is half a minute of CPU
    "sdre-sil-serve": {"commission", "eval", "facts", "gains", "emit", "qualify", "tune"},
    "sdre-sil-run": {"commission", "facts", "gains", "emit", "qualify", "serve", "tune"},
}


def rooms(program):
    """Rooms of host_tools of which the program's build compiles something."""
    told = subprocess.run(
        ["ninja", "-C", BUILD, "-t", "commands", program],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return set(re.findall(r"-o host_tools/\S*?CMakeFiles/sdre_(\w+)\.dir/", told))


class FirstBuild(unittest.TestCase):
    def test_programs_of_one_command_compile_no_other_room(self):
        for program, others in OTHERS.items():
            with self.subTest(program=program):
                found = rooms(program)
                self.assertLessEqual({"common", "design", "board"}, found)
                self.assertEqual(others & found, set())

    def test_the_names_are_those_of_rooms(self):
        known = rooms("sdre-sil") | rooms("sdre-gains")
        self.assertLessEqual(set.union(*OTHERS.values()), known)


if __name__ == "__main__":
    unittest.main()
