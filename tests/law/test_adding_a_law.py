# SPDX-License-Identifier: MIT
"""The recipe "Adding a law" of docs/architecture.md, followed in a copy of the tree.

test_adding_a_law.py COPY [FILE..]: COPY is the copy's directory, kept for the next time. The edits
of each FILE are left out: to see that the recipe needs them.
"""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).parent
COPY = pathlib.Path(sys.argv[1]).resolve()
LEFT_OUT = set(sys.argv[2:])
BUILD = COPY / "build"
OTHER = "firmware/config/drives/noc_slow_other.toml"
TUNED = "firmware/config/drives/noc_slow_tuned.toml"
DRIVE = "firmware/config/drives/noc_slow.toml"
SPECIFICATION = "firmware/config/specs/ipmsm_390w.toml"
SCENARIO = "host_tools/sil/scenarios/board_speed_step.toml"


def recipe():
    """Its numbered steps, without what is optional."""
    text = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    section = text.split("### Adding a law\n")[1].split("\n## ")[0].split("\n### ")[0]
    return section.split("Optional:")[0]


def edits():
    return tomllib.loads((HERE / "edits.toml").read_text(encoding="utf-8"))["edit"]


def new_files():
    files = HERE / "files"
    return [f.relative_to(files) for f in sorted(files.rglob("*")) if f.is_file()]


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command],
        cwd=COPY,
        capture_output=True,
        text=True,
        check=False,
        **options,
    )


def write(path, text):
    """An unchanged file keeps its time, so that nothing is built again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def edited(text, edit):
    assert text.count(edit["after"]) == 1, f"{edit['file']}: {edit['after']!r} is not there once"
    new = edit["replace"] if "replace" in edit else edit["after"] + edit["add"].removeprefix("\n")
    return text.replace(edit["after"], new)


def follow():
    """Makes the copy: the tree as it is on disk, and the law."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    changed = {}
    for edit in edits():
        if edit["file"] not in LEFT_OUT:
            text = changed.get(edit["file"]) or (ROOT / edit["file"]).read_text(encoding="utf-8")
            changed[edit["file"]] = edited(text, edit)
    for name in filter(None, listed.split("\0")):
        source, target = ROOT / name, COPY / name
        if name in changed:
            write(target, changed[name])
            shutil.copymode(source, target)
        elif source.is_file() and (
            not target.exists() or target.read_bytes() != source.read_bytes()
        ):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)  # with a new time: it is built again
    for name in new_files():
        if str(name) not in LEFT_OUT:
            write(COPY / name, (HERE / "files" / name).read_text(encoding="utf-8"))
    shipped = (ROOT / "firmware/config/drives/ipmsm_390w.toml").read_text(encoding="utf-8")
    shipped = re.sub(r"\n(#[^\n]*\n)*\[torque\]\n[^[]*", "\n", shipped)  # optional: step 8
    named = shipped.replace('name = "ipmsm_390w"', 'name = "noc_slow"\nlaw = "noc_slow"')
    write(COPY / DRIVE, named + "\n[filter]\nshare = 0.015625\n")
    step = (ROOT / SCENARIO).read_text(encoding="utf-8").replace("ipmsm_390w.toml", "noc_slow.toml")
    write(COPY / "host_tools/sil/scenarios/noc_slow_step.toml", step)


class Recipe(unittest.TestCase):
    def test_it_names_every_file_that_changes_and_no_other(self):
        def pattern(path):
            return str(path).replace("noc_slow", "NAME")

        changed = {e["file"] for e in edits()} | {
            pattern(f) for f in new_files() if "scenarios" not in f.parts
        }
        named = set(re.findall(r"`([\w/.]+\.\w+)`", recipe()))
        self.assertEqual(named, changed)


class Law(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        follow()
        programs = [
            "sdre-gains",
            "sdre-sil-run",
            "test_unit_law_noc_slow",
            "test_unit_fields_complete",
        ]
        for step in (
            ["cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
            + ["-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DSDRE_SANITIZE=OFF", "-DSDRE_BUILD_TESTS=ON"]
            + ["--log-level=WARNING", f"-DUNITY_ROOT={os.environ['UNITY_ROOT']}"],
            ["cmake", "--build", "build", "--target", *programs],
        ):
            done = run(*step)
            assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]

    def good(self, *command):
        done = run(*command)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def bad(self, *command):
        self.assertNotEqual(run(*command).returncode, 0)

    def test_unit_tests_pass(self):
        self.good("build/tests/test_unit_law_noc_slow")
        self.good("build/tests/test_unit_fields_complete")

    def test_its_report_has_its_certificate(self):
        self.assertIn("verdict: certified", self.good("build/bin/sdre-gains", "report", DRIVE))

    def test_its_tables_hold_its_constants_and_are_found_stale(self):
        self.good("build/bin/sdre-gains", "generate", DRIVE, "--out", "build/tables")
        tables = (BUILD / "tables/gain_tables.c").read_text(encoding="utf-8")
        self.assertIn("law_noc_slow_config_t", tables)
        self.assertRegex(tables, r"\.share = 1\.56250000e-02f")
        self.good("build/bin/sdre-gains", "generate", DRIVE, "--check", "build/tables")
        text = (COPY / DRIVE).read_text(encoding="utf-8")
        write(COPY / OTHER, text.replace("share = 0.015625", "share = 0.02"))
        self.bad("build/bin/sdre-gains", "generate", OTHER, "--check", "build/tables")

    def test_its_section_is_checked(self):
        text = (COPY / DRIVE).read_text(encoding="utf-8")
        for wrong in ("share = 2.0", "shape = 0.1"):
            write(COPY / OTHER, text.replace("share = 0.015625", wrong))
            self.bad("build/bin/sdre-gains", "report", OTHER)

    def test_its_digest_is_not_that_of_another_law(self):
        def digest(drive):
            return json.loads(self.good("build/bin/sdre-gains", "report", "--json", drive))[
                "digest"
            ]

        text = (COPY / DRIVE).read_text(encoding="utf-8")
        plain = text.replace('law = "noc_slow"\n', "").replace("\n[filter]\nshare = 0.015625\n", "")
        write(COPY / OTHER, plain)
        self.assertNotEqual(digest(DRIVE), digest(OTHER))

    def test_its_scenario_settles_as_the_filter_does(self):
        out = self.good(
            "build/bin/sdre-sil-run", "run", "host_tools/sil/scenarios/noc_slow_step.toml"
        )
        settled_ms = float(re.search(r"settling time \[ms\] +[\d.]+ +([\d.]+)", out)[1])
        filter_ms = 0.2 / 0.015625 * math.log(200.0 / 4.0)  # period / share, step / band
        self.assertAlmostEqual(settled_ms, filter_ms, delta=2.0)

    def test_its_weights_are_tuned(self):
        self.good(
            "build/bin/sdre-gains",
            "tune",
            DRIVE,
            "--spec",
            SPECIFICATION,
            "--out",
            TUNED,
            "--no-qualify",
        )
        text = self.good("build/bin/sdre-gains", "report", TUNED)
        self.assertIn("verdict: certified", text)

    def test_lists_by_name_have_it(self):
        self.good(sys.executable, "-B", "tests/law/test_law_lists.py")

    def test_the_linker_leaves_other_laws_out(self):
        self.good("tests/target/check_linked_law.sh", "cc")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
