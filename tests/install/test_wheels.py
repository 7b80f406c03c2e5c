# SPDX-License-Identifier: MIT
"""The wheels of `./dev wheels` give virtual drive, tools and the package sdre, in a fresh
environment of each Python.

test_wheels.py DIRECTORY
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

WHEELS = pathlib.Path(sys.argv.pop() if len(sys.argv) > 1 else "build/wheels").resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PINNED = ROOT / "host_tools/python/wheels.txt"
SPEED_rpm = 400
TURNS = 0.95 * SPEED_rpm  # chosen: the reference has been reached but for noise


def run(*command, **options):
    return subprocess.run(
        [str(word) for word in command],
        capture_output=True,
        text=True,
        check=False,
        cwd="/",
        timeout=300,
        **options,
    )


def done(*command, **options):
    result = run(*command, **options)
    assert result.returncode == 0, (command, result.stdout + result.stderr)
    return result.stdout


def wheels(name, tag):
    return sorted(WHEELS.glob(f"{name}-*-{tag}*.whl"))


class Installed:
    """Both wheels in a fresh environment."""

    def __init__(self, wheel, python, directory):
        self.bin = directory / "bin"
        done(python, "-m", "venv", directory)
        pip = (self.bin / "pip", "install", "-q", "--disable-pip-version-check")
        done(*pip, "--require-hashes", "-r", PINNED)
        done(*pip, "--no-deps", "--no-index", wheel, *wheels("sdre_drive", "py3-none-any"))
        done(self.bin / "pip", "check")  # what the wheels ask for is there
        self.tools = pathlib.Path(
            done(self.bin / "python", "-c", "import sdre_tools; print(sdre_tools.ROOT)").strip()
        )

    def tool(self, name, *words, **options):
        return run(self.bin / name, *words, **options)


class Wheels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.installed = []
        for wheel in wheels("sdre", "cp3"):
            minor = re.search(r"-cp3(\d+)-", wheel.name)[1]
            python = WHEELS / f"with-3.{minor}/bin/python"
            directory = pathlib.Path(cls.work.name, minor)
            cls.installed.append(Installed(wheel, python, directory))

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def test_one_wheel_for_each_python_and_one_of_sdre_drive(self):
        self.assertGreater(len(self.installed), 0)
        self.assertEqual(len(self.installed), len(list(WHEELS.glob("with-*"))))
        self.assertEqual(len(wheels("sdre_drive", "")), 1)

    def test_the_virtual_drive_turns(self):
        for one in self.installed:
            ports = ("--tcp", "0", "--control", "0", "--for", "60")
            with subprocess.Popen(
                [one.bin / "sdre-sil", "serve", *ports], stdout=subprocess.PIPE, text=True, cwd="/"
            ) as server:
                try:
                    line = next(text for text in server.stdout if "Modbus/TCP" in text)
                    address = ("--tcp", re.search(r"127\.0\.0\.1:\d+", line)[0])
                    said = one.tool("sdre-drive", "run", SPEED_rpm, "--for", "6", *address)
                    self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
                    speeds = [float(word) for word in re.findall(r"(-?[\d.]+) r/min", said.stdout)]
                    self.assertGreater(max(speeds), TURNS, said.stdout)
                finally:
                    server.terminate()

    def test_package_and_tool_give_the_same_bits(self):
        scenario = "share/sdre-drive/host_tools/sil/scenarios/fig5_load_step.toml"
        for one in self.installed:
            csv = one.bin.parent / "run.csv"
            said = one.tool("sdre-sil", "run", one.tools / scenario, "--csv", csv)
            self.assertEqual(said.returncode, 0, said.stderr)
            code = "import sdre, sys; print(sdre.simulate(None, sys.argv[1]).csv, end='')"
            text = done(one.bin / "python", "-c", code, one.tools / scenario)
            self.assertEqual(text, csv.read_text())
            self.assertGreater(text.count("\n"), 1000)

    def test_design(self):
        drive = "share/sdre-drive/firmware/config/drives/ipmsm_390w.toml"
        for one in self.installed:
            said = one.tool("sdre-gains", "report", one.tools / drive)
            self.assertEqual(said.returncode, 0, said.stderr)

    def test_the_wheel_brings_the_libraries_that_a_bare_system_lacks(self):
        for one in self.installed:
            native = next(one.tools.parent.glob("sdre/_native.*.so"))
            for file in (native, one.tools / "bin/sdre-sil", one.tools / "bin/sdre-gains"):
                for line in done("ldd", file).splitlines():
                    if re.search("fmt|nlopt|toml", line):
                        self.assertIn(f"/lib/python3.{one.bin.parent.name}/", line)

    def test_drawing_takes_the_python_of_the_wheel_and_its_scripts(self):
        for one in self.installed:
            # Its command line is script, data, title, picture; -c asks for matplotlib.
            pen = one.bin.parent / "pen"
            pen.write_text('#!/bin/sh\n[ "$1" = -c ] || echo "$1" >"$4"\n')
            pen.chmod(0o755)
            scenario = one.tools / "share/sdre-drive/host_tools/sil/scenarios/fig5_load_step.toml"
            words = ("sdre-sil", "run", scenario, "--plot", one.bin.parent / "p.png")
            said = one.tool(*words)  # there is no matplotlib in this environment
            self.assertEqual(said.returncode, 1, said.stderr)
            self.assertIn("has no matplotlib", said.stderr)
            said = one.tool(*words, env={"SDRE_PYTHON": str(pen)})
            self.assertEqual(said.returncode, 0, said.stderr)
            script = (one.bin.parent / "p.png").read_text().strip()
            self.assertTrue(script.startswith(str(one.tools)), script)


if __name__ == "__main__":
    unittest.main()
