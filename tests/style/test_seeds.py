# SPDX-License-Identifier: MIT
"""Does every check of ./dev style find a defect? Each is put into a file of its own. Run it with
the Python of build/style."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOLS = Path(sys.executable).parent
TIDY = ROOT / "tests/style/clang-tidy.yml"
TIDY_SEEDS = {
    "bugprone-branch-clone": "int f(int a) { if (a > 1) { return a; } else { return a; } }",
    "bugprone-infinite-loop": "void g(void); void f(int n) { int i = 0; while (i < n) { g(); } }",
    "bugprone-integer-division": "float f(int a, int b) { return 1.0f + a / b; }",
    "bugprone-misplaced-widening-cast": "long f(int a, int b) { return (long)(a * b); }",
    "bugprone-redundant-branch-condition": (
        "void g(void); void f(int a) { if (a) { if (a) { g(); } } }"
    ),
    "bugprone-sizeof-expression": "unsigned long f(void) { return sizeof(sizeof(int)); }",
    "bugprone-suspicious-memset-usage": (
        "void *memset(void *, int, unsigned long); void f(int *p) { memset(p, '0', 8); }"
    ),
    "bugprone-suspicious-semicolon": "void g(void); void f(int a) { if (a);\n    g(); }",
    "bugprone-too-small-loop-variable": (
        "void g(void); void f(long n) { for (short i = 0; i < n; i++) { g(); } }"
    ),
    "clang-analyzer-core.CallAndMessage": "void g(int); void f(void) { int a; g(a); }",
    "clang-analyzer-core.DivideZero": "int f(int a) { if (a == 0) { return 1 / a; } return 2; }",
    "clang-analyzer-core.NullDereference": "int f(int *p) { if (!p) { return *p; } return 2; }",
    "clang-analyzer-core.StackAddressEscape": "int *p; void f(void) { int a = 1; p = &a; }",
    "clang-analyzer-core.uninitialized.Branch": (
        "int f(void) { int a; if (a) { return 1; } return 2; }"
    ),
    "clang-analyzer-core.uninitialized.UndefReturn": "int f(void) { int a; return a; }",
}
RUFF_SEEDS = {
    "E501": "x = 1  # " + 100 * "x" + "\n",
    "E711": "def f(x):\n    return x == None\n",
    "F401": "import os\n",
    "F821": "print(missing)\n",
    "W291": '"""a \nb"""\n',
    "I001": "import sys\nimport os\n\nprint(os, sys)\n",
    "B006": "def f(x=[]):\n    return x\n",
}


def found_by(*words):
    """Exit code and output."""
    packages = ROOT / "host_tools/python"
    run = subprocess.run(list(map(str, words)), cwd=packages, capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


class Seeds(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)

    def seed(self, name, text):
        path = self.directory / name
        path.write_text(text)
        return path

    def refused(self, expected, *words):
        code, text = found_by(*words)
        self.assertNotEqual(code, 0, text)
        self.assertIn(expected, text)

    def test_every_check_of_clang_tidy_has_a_defect(self):
        self.assertEqual(
            sorted(re.findall(r"^  ([a-z][\w.-]+)", TIDY.read_text(), re.M)), sorted(TIDY_SEEDS)
        )

    def test_clang_tidy(self):
        for check, text in TIDY_SEEDS.items():
            with self.subTest(check):
                path = self.seed("seed.c", text + "\n")
                self.refused(
                    f"[{check}",
                    TOOLS / "clang-tidy",
                    f"--config-file={TIDY}",
                    "--quiet",
                    path,
                    "--",
                    "-std=c99",
                )

    def test_clang_format(self):
        path = self.seed("seed.c", "int  f(void) {return 1;}\n")
        style = f"--style=file:{ROOT / '.clang-format'}"
        self.refused(
            "clang-format-violations", TOOLS / "clang-format", "--dry-run", "-Werror", style, path
        )

    def test_ruff_check(self):
        for rule, text in RUFF_SEEDS.items():
            with self.subTest(rule):
                path = self.seed("seed.py", text)
                self.refused(
                    rule,
                    TOOLS / "ruff",
                    "check",
                    "--no-cache",
                    "--config",
                    ROOT / "ruff.toml",
                    path,
                )

    def test_ruff_format(self):
        path = self.seed("seed.py", "x = {'a':1}\n")
        self.refused(
            "would be reformatted",
            TOOLS / "ruff",
            "format",
            "--no-cache",
            "--check",
            "--config",
            ROOT / "ruff.toml",
            path,
        )

    def test_mypy(self):
        path = self.seed("seed.py", "from sdre_drive.connection import Target\n\nTarget(host=1)\n")
        config = ROOT / "host_tools/python/pyproject.toml"
        self.refused(
            "[arg-type]",
            TOOLS / "mypy",
            "--config-file",
            config,
            "--cache-dir",
            ROOT / "build/style/mypy",
            path,
        )


if __name__ == "__main__":
    unittest.main()
