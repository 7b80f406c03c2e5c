# SPDX-License-Identifier: MIT
"""The Debian package of a build, unpacked away from the sources, works and brings what a
distribution expects.

test_package.py BUILD_DIRECTORY
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else "build/host").resolve()


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=False, **options
    )


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.work.name)
        made = run("cpack", "-G", "DEB", "-B", root, cwd=BUILD)
        cls.packages = list(root.glob("*.deb"))
        assert len(cls.packages) == 1, made.stdout + made.stderr
        cls.root = root / "unpacked"
        assert run("dpkg", "-x", cls.packages[0], cls.root).returncode == 0

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def test_simulation_runs_with_its_own_scenarios_and_draws(self):
        picture = self.root / "picture.png"
        scenario = self.root / "usr/share/sdre-drive/host_tools/sil/scenarios/fig5_load_step.toml"
        done = run(self.root / "usr/bin/sdre-sil", "run", scenario, "--plot", picture, cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))

    def test_components_and_notices_are_there(self):
        docs = self.root / "usr/share/doc/sdre-drive"
        self.assertIn(b"CycloneDX", (docs / "sdre-drive.cdx.json").read_bytes())
        self.assertIn(b"Eigen", (docs / "THIRD_PARTY.txt").read_bytes())

    def test_design_runs(self):
        drive = self.root / "usr/share/sdre-drive/firmware/config/drives/ipmsm_390w.toml"
        done = run(self.root / "usr/bin/sdre-gains", "report", drive, cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_man_pages_name_every_command(self):
        for tool in ("sdre-gains", "sdre-sil"):
            page = next((self.root / "usr/share/man/man1").glob(f"{tool}.1*")).read_text()
            self.assertIn(f"Example:\n.B {tool}".replace("-", r"\-"), page)
            text = run(self.root / "usr/bin" / tool, "--help").stdout
            commands = [
                line.split()[0]
                for line in text[text.index("Subcommands:") :].splitlines()[1:]
                if line.strip()
            ]
            self.assertGreater(len(commands), 5)
            for command in commands:
                self.assertIn(f".SS {command.replace('-', chr(92) + '-')}", page)

    def test_programs_in_python_have_man_pages_too(self):
        for tool in ("sdre-drive", "sdre-campaign"):
            page = next((self.root / "usr/share/man/man1").glob(f"{tool}.1*")).read_text()
            self.assertIn(f"{tool} \\- ", page)

    def test_bash_completes_commands_and_options(self):
        script = self.root / "usr/share/bash-completion/completions/sdre-sil"
        for words, wanted in (("sdre-sil qua", "qualify"), ("sdre-sil run --spec", "--spectrum")):
            typed = words.split()
            done = run(
                "bash",
                "-c",
                f'source "{script}"; COMP_WORDS=({words}); COMP_CWORD={len(typed) - 1}; _sdre_sil; '
                'echo "${COMPREPLY[@]}"',
            )
            self.assertEqual(done.stdout.split(), [wanted], done.stderr)

    def test_no_file_names_the_build_directory_but_the_programs(self):
        for path in self.root.rglob("*"):
            if (
                path.is_file()
                and os.fspath(path.parent).endswith("/bin") is False
                and path.suffix != ".png"
            ):
                self.assertNotIn(os.fspath(BUILD).encode(), path.read_bytes(), path)


if __name__ == "__main__":
    unittest.main()
