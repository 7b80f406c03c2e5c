# SPDX-License-Identifier: MIT
"""The list of components names all that the programs of a build load, and the programs are
hardened.

test_sbom.py BUILD_DIRECTORY
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import tomllib

BUILD = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else "build/host").resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
INSTALL = ROOT / "host_tools/install"
PROGRAMS = [BUILD / "bin" / name for name in ("sdre-gains", "sdre-sil")]


def run(*command):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=True
    ).stdout


class Sbom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.made = []
        for name in ("one", "two"):
            directory = pathlib.Path(cls.work.name, name)
            run(sys.executable, "-B", INSTALL / "sbom.py", directory)
            cls.made.append({path.name: path.read_bytes() for path in directory.iterdir()})
        cls.bill = json.loads(cls.made[0]["sdre-drive.cdx.json"])
        cls.components = tomllib.loads((INSTALL / "components.toml").read_text())["component"]

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def test_same_machine_same_bytes(self):
        self.assertEqual(self.made[0], self.made[1])
        self.assertNotIn(str(ROOT).encode(), b"".join(self.made[0].values()))

    def test_document_is_cyclonedx_with_a_version_of_everything(self):
        self.assertEqual((self.bill["bomFormat"], self.bill["specVersion"]), ("CycloneDX", "1.5"))
        references = [entry["bom-ref"] for entry in self.bill["components"]]
        self.assertEqual(len(references), len(set(references)))
        self.assertEqual(self.bill["dependencies"][0]["dependsOn"], references)
        for entry in self.bill["components"]:
            self.assertTrue(entry["name"] and entry["version"] and entry["purl"])

    def test_every_library_of_the_build_is_a_component(self):
        text = (ROOT / "cmake/dependencies.cmake").read_text().split("if(SDRE_BUILD_TESTS)")[0]
        wanted = set(re.findall(r"find_package\((\w+)", text)) - {"PkgConfig"}
        self.assertEqual(wanted, {c["find"] for c in self.components if "find" in c})

    def test_every_library_that_a_program_loads_is_a_component(self):
        known = {name for c in self.components for name in c.get("loads", [])}
        for program in PROGRAMS:
            loaded = re.findall(r"NEEDED.*\[(.*)\.so", run("readelf", "-dW", program))
            self.assertTrue(loaded)
            self.assertLessEqual(set(loaded), known, program)

    def test_notices_have_every_component(self):
        text = self.made[0]["THIRD_PARTY.txt"].decode()
        for component in self.components:
            self.assertRegex(text, rf"(?m)^{re.escape(component['name'])} \d")
        self.assertGreater(text.lower().count("copyright"), len(self.components))


class Hardening(unittest.TestCase):
    def test_addresses_are_random_and_fixed_before_main(self):
        for program in PROGRAMS:
            dynamic = run("readelf", "-dW", program)
            self.assertRegex(dynamic, r"FLAGS_1.*\bPIE\b", program)
            self.assertRegex(dynamic, r"\bBIND_NOW\b|FLAGS_1.*\bNOW\b", program)
            self.assertIn("GNU_RELRO", run("readelf", "-lW", program), program)

    def test_no_segment_is_written_and_executed(self):
        for program in PROGRAMS:
            for line in run("readelf", "-lW", program).splitlines():
                self.assertNotRegex(line, r"\bRWE\b", program)

    def test_stack_and_copies_are_checked(self):
        for program in PROGRAMS:
            symbols = run("readelf", "-sW", program)
            self.assertTrue("__stack_chk_fail" in symbols, program)
            self.assertTrue(
                re.search(r"__(memcpy|memmove|snprintf|read|fread)_chk", symbols), program
            )


if __name__ == "__main__":
    unittest.main()
