# SPDX-License-Identifier: MIT
"""Do the presets f28335-flash and f28335-ram ask TI's tools for the right things? TI's tools are
stood in for by stand_in_tool.py: whether they accept it, this test cannot tell."""

import json
import os
import pathlib
import re
import shlex
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

import code_size

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FAST_RTS = "rts2800_fpu32_fast_supplement_eabi.lib"
TICK = [
    *code_size.APP_UNITS,
    "control_isr.c",
    "cycles.c",
    "encoder.c",
    "flash.c",
    "pie.c",
    "pwm.c",
    "tick_watch.c",
    "trip.c",
]


def touch(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("")


def make_compiler(root):
    for tool in ("cl2000", "ar2000", "hex2000"):
        path = root / "bin" / tool
        touch(path)
        stand_in = shlex.quote(str(HERE / "stand_in_tool.py"))
        # -I -S: started hundreds of times, and half of a start is looking for packages
        path.write_text(
            f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -I -S {stand_in} {tool} "$@"\n'
        )
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    touch(root / "include" / "stdint.h")
    touch(root / "lib" / "rts2800_fpu32_eabi.lib")


def make_headers(root, fast_rts):
    touch(root / "device_support/f2833x/headers/include/DSP2833x_Device.h")
    touch(root / "device_support/f2833x/common/include/DSP28x_Project.h")
    if fast_rts:
        touch(root / "libraries/math/FPUfastRTS/c28/lib" / FAST_RTS)


class TargetBuild(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.top = pathlib.Path(directory.name)
        self.build = self.top / "build"
        self.log = self.top / "log"
        self.environment = {k: v for k, v in os.environ.items() if not k.startswith("C2000")}

    def cmake(self, *arguments, **variables):
        return subprocess.run(
            ["cmake", *map(str, arguments)],
            cwd=ROOT,
            text=True,
            check=False,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**self.environment, "STAND_IN_LOG": str(self.log), **variables},
        )

    def configure(self, preset, *arguments, **variables):
        return self.cmake("--preset", preset, "-B", self.build, *arguments, **variables)

    def calls(self, tool):
        calls = [json.loads(line) for line in self.log.read_text().splitlines()]
        return [call[1:] for call in calls if call[0] == tool]

    def build_image(self, preset, fast_rts=True, arguments=(), **variables):
        make_compiler(self.top / "cgt")
        make_headers(self.top / "ware", fast_rts)
        done = self.configure(
            preset,
            f"-DC2000_CGT_ROOT={self.top / 'cgt'}",
            *arguments,
            C2000WARE_ROOT=str(self.top / "ware"),
            **variables,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        self.log.write_text("")
        done = self.cmake("--build", self.build, **variables)
        self.assertEqual(done.returncode, 0, done.stdout)
        compiled = {}
        for call in self.calls("cl2000"):
            for argument in call:
                if argument.startswith(("--c_file=", "--asm_file=")):
                    compiled[pathlib.Path(argument).name] = call
        links = [call for call in self.calls("cl2000") if "--run_linker" in call]
        self.assertEqual(len(links), 1)
        return compiled, links[0], done.stdout

    def check_device_options(self, call):
        for option in ("--abi=eabi", "--float_support=fpu32", "--silicon_version=28"):
            self.assertIn(option, call)
        self.assertEqual(sum(option.startswith("--abi") for option in call), 1)

    def test_flash_image(self):
        compiled, link, output = self.build_image("f28335-flash")
        linker = ROOT / "linker"

        for call in [*compiled.values(), link]:
            self.check_device_options(call)
        for directory in ("firmware/control", "firmware/board/f28335", "firmware/app"):
            for source in (ROOT / directory).rglob("*.c"):
                apart = source.name in code_size.APP_UNITS or source not in code_size.app_parts()
                self.assertEqual(
                    source.name in compiled, apart and source.name != "bench.c", source.name
                )
        for name, call in compiled.items():
            if name.endswith(".c"):
                for option in (
                    "--float_operations_allowed=32",
                    "--fp_single_precision_constant",
                    "--fp_mode=strict",
                    "--gen_data_subsections=on",
                    "-O2",
                    "--c99",
                ):
                    self.assertIn(option, call, name)
        before, after = link[: link.index("--run_linker")], link[link.index("--run_linker") :]
        self.assertNotIn("--define=FAST_RTS", before)
        for option in (
            "--define=FAST_RTS",
            "--stack_size=0x700",
            "--entry_point=code_start",
            "--rom_model",
            "--priority",
            "--diag_error=10247",
            str(linker / "f28335_flash.cmd"),
            str(linker / "f28335_registers.cmd"),
        ):
            self.assertIn(option, after)
        self.assertLess(
            after.index(f"--library={FAST_RTS}"), after.index("--library=rts2800_fpu32_eabi.lib")
        )
        self.assertNotIn("--library=m", after)
        self.assertTrue((self.build / "bin" / "sdre_f28335_flash.out").exists())
        self.assertTrue((self.build / "bin" / "sdre_f28335_flash.hex").exists())
        self.assertIn("--intel", self.calls("hex2000")[0])
        self.assertIn("RAML0123     6144 of 16384 words (37 %)", output)

        # Tick and flash set-up run from RAM, and the way there does not.
        in_ram = {
            name
            for name, call in compiled.items()
            if "--ramfunc=on" in call and "--ramfunc=off" not in call
        }
        rare = {
            "check.c",
            "dead_time.c",
            "drive_adopt.c",
            "drive_config.c",
            "drive_fault.c",
            "inertia.c",
            "noc_inertia.c",
            "motor.c",
            "near_optimal_position.c",
            "noc_torque.c",
            "nodo_current.c",
            "nodo_encoder_series.c",
            "nosc_series.c",
            "position_loop.c",
            "position_ref.c",
            "position_torque.c",
        }
        control = {
            source.name
            for source in (ROOT / "firmware" / "control").rglob("*.c")
            if source.parent.name != "fields"
        }
        self.assertEqual(in_ram, control - rare | set(TICK))
        for name in ("drive_image.c", "app.c", "main.c"):
            self.assertIn("-DLAW_CONSTANTS=law_noc_config_t", compiled[name])
        self.assertIn("-DAPP_SCOPE_SAMPLES=512U", compiled["app_scope.c"])
        self.assertNotIn("-DAPP_WATCH_INERTIA=0", compiled["app_registers_inertia.c"])
        self.assertNotIn("-DAPP_BELIEVE=0", compiled["app.c"])
        self.assertNotIn("-DAPP_TRIM=0", compiled["app_registers_trim.c"])
        self.assertIn("-DAPP_DISC_MAP=0", compiled["app.c"])

    def test_a_map_of_the_disc_is_an_option(self):
        compiled, _, _ = self.build_image("f28335-flash", arguments=["-DSDRE_DISC_MAP=ON"])
        for name in ("app.c", "app_measure.c", "app_disc_index.c", "app_image.c", "main.c"):
            self.assertIn("-DAPP_DISC_MAP=1", compiled[name])
        self.assertNotIn("--ramfunc=on", compiled["app_disc_index.c"])

    def test_noc_h_leaves_room_for_half_the_scope(self):
        own = self.top / "own"
        own.mkdir()
        for name in ("gain_tables.h", "board_config.c"):
            (own / name).write_text((ROOT / "firmware" / "config" / name).read_text())
        text = (ROOT / "firmware" / "config" / "gain_tables.c").read_text()
        (own / "gain_tables.c").write_text(text.replace("&law_noc,", "&law_noc_h,"))
        arguments = [f"-DSDRE_TABLES={own}"]
        make_compiler(self.top / "cgt")
        make_headers(self.top / "ware", fast_rts=False)
        roots = [f"-DC2000_CGT_ROOT={self.top / 'cgt'}", f"-DC2000WARE_ROOT={self.top / 'ware'}"]
        refused = self.configure("f28335-flash", *roots, *arguments)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn(
            "SDRE_SCOPE_SAMPLES=512: the constants of noc_h leave room for 256",
            " ".join(refused.stdout.split()),
        )

        half = [*arguments, "-DSDRE_SCOPE_SAMPLES=256"]
        refused = self.configure("f28335-flash", *roots, *half, "-DSDRE_DISC_MAP=ON")
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn(
            "with noc_h there is room for a scope of 128 samples", " ".join(refused.stdout.split())
        )

        compiled, _, _ = self.build_image("f28335-flash", arguments=[*half, "-DSDRE_DISC_MAP=OFF"])
        self.assertIn("-DLAW_CONSTANTS=law_noc_h_config_t", compiled["drive_image.c"])
        for name in ("app.c", "app_registers_inertia.c", "main.c"):
            self.assertIn("-DAPP_WATCH_INERTIA=0", compiled[name])
            self.assertIn("-DAPP_BELIEVE=0", compiled[name])
            self.assertIn("-DAPP_TRIM=0", compiled[name])
        for name in ("app.c", "app_control.c"):
            self.assertNotIn("--ramfunc=on", compiled[name])
        self.assertIn("--ramfunc=on", compiled["app_measure.c"])

    def test_evidence_builds_all_images_with_listings(self):
        make_compiler(self.top / "cgt")
        make_headers(self.top / "ware", fast_rts=True)
        done = self.configure(
            "f28335-evidence",
            f"-DC2000_CGT_ROOT={self.top / 'cgt'}",
            f"-DC2000WARE_ROOT={self.top / 'ware'}",
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        self.log.write_text("")
        images = ("sdre_f28335_flash", "sdre_f28335_ram")
        done = self.cmake("--build", self.build, "--target", *images)
        self.assertEqual(done.returncode, 0, done.stdout)
        links = [call for call in self.calls("cl2000") if "--run_linker" in call]
        for image in images:
            self.assertTrue(
                any(f"--xml_link_info={self.build / image}.xml" in call for call in links), image
            )
            self.assertTrue((self.build / "bin" / f"{image}.out").exists())
        for call in self.calls("cl2000"):
            if any(
                argument.endswith(".c") and argument.startswith("--c_file=") for argument in call
            ):
                tables = any("gain_tables.c" in argument for argument in call)
                self.assertEqual(f"--list_directory={self.build / 'listings'}" in call, not tables)
        done = self.cmake("--build", self.build)  # the stand-in writes no listing: the page says so
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("evidence.py", done.stdout)

    def test_scope_of_another_size_is_refused(self):
        done = self.configure("f28335-flash", "-DSDRE_SCOPE_SAMPLES=100")

        self.assertNotEqual(done.returncode, 0)
        self.assertIn(
            "SDRE_SCOPE_SAMPLES=100: expected 64, 128, 256 or 512", " ".join(done.stdout.split())
        )

    def test_ram_image_without_fast_rts_and_with_an_older_compiler(self):
        compiled, link, output = self.build_image(
            "f28335-ram", fast_rts=False, STAND_IN_VERSION="00000020.00000002.00000000"
        )

        self.assertIn(str(ROOT / "linker" / "f28335_ram.cmd"), link)
        self.assertIn("bench.c", compiled)
        self.assertNotIn("main.c", compiled)
        self.assertNotIn("--define=FAST_RTS", link)
        self.assertNotIn(f"--library={FAST_RTS}", link)
        for name, call in compiled.items():
            self.assertNotIn("--fp_single_precision_constant", call, name)

    def test_missing_and_wrong_directories_are_one_line(self):
        cgt, ware = self.top / "cgt", self.top / "ware"
        make_compiler(cgt)
        empty = self.top / "empty"
        empty.mkdir()
        cases = [
            ([], "C2000_CGT_ROOT is not set"),
            ([f"-DC2000_CGT_ROOT={empty}"], f"C2000_CGT_ROOT={empty} is not TI's C2000 compiler"),
            ([f"-DC2000_CGT_ROOT={cgt}"], "C2000WARE_ROOT is not set"),
            (
                [f"-DC2000_CGT_ROOT={cgt}", f"-DC2000WARE_ROOT={empty}"],
                f"C2000WARE_ROOT={empty} is not C2000Ware",
            ),
        ]
        for arguments, message in cases:
            with self.subTest(message=message):
                done = self.configure("f28335-flash", *arguments)
                self.assertNotEqual(done.returncode, 0)
                lines = [line.strip() for line in done.stdout.splitlines()]
                self.assertEqual(sum(line.startswith(message) for line in lines), 1, done.stdout)
                self.assertEqual(done.stdout.count("CMake Error"), 1, done.stdout)
        make_headers(ware, fast_rts=False)  # the refused values are forgotten
        done = self.configure("f28335-flash", f"-DC2000_CGT_ROOT={cgt}", f"-DC2000WARE_ROOT={ware}")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_another_environment_replaces_the_directory_of_the_first(self):
        first, second, given = (self.top / name for name in ("first", "second", "given"))
        for root in (first, second, given):
            make_headers(root, fast_rts=False)

        def root_of_cache(*arguments, **variables):
            done = self.configure("board-check", *arguments, **variables)
            self.assertEqual(done.returncode, 0, done.stdout)
            cache = (self.build / "CMakeCache.txt").read_text()
            return re.search(r"^C2000WARE_ROOT:PATH=(.*)$", cache, re.M)[1]

        self.assertEqual(root_of_cache(C2000WARE_ROOT=str(first)), str(first))
        shutil.rmtree(first)
        self.assertEqual(root_of_cache(C2000WARE_ROOT=str(second)), str(second))
        self.assertEqual(root_of_cache(), str(second))
        wanted = f"-DC2000WARE_ROOT:PATH={given}"
        self.assertEqual(root_of_cache(wanted, C2000WARE_ROOT=str(second)), str(given))
        self.assertEqual(root_of_cache(C2000WARE_ROOT=str(second)), str(given))

    def test_flash_api_is_not_offered(self):
        done = self.configure("f28335-flash", f"-DSDRE_FLASH_API={self.top}")

        self.assertNotEqual(done.returncode, 0)
        self.assertIn("unknown option SDRE_FLASH_API", " ".join(done.stdout.split()))

    def test_unknown_image_is_refused(self):
        done = self.configure("f28335-flash", "-DSDRE_IMAGE=rom")

        self.assertIn("SDRE_IMAGE=rom: expected flash, ram or all", done.stdout)
        self.assertNotEqual(done.returncode, 0)

    def test_board_check_without_headers_says_so_and_fails(self):
        self.assertEqual(self.configure("board-check").returncode, 0)
        done = self.cmake("--build", self.build, "--target", "board_check")

        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn("board-check: nothing checked, C2000WARE_ROOT is not set", done.stdout)

    def test_tables_of_a_directory_take_the_place_of_the_shipped(self):
        own = self.top / "own"
        own.mkdir()
        for name in ("gain_tables.h", "gain_tables.c", "board_config.c"):
            (own / name).write_text((ROOT / "firmware" / "config" / name).read_text())
        cgt, ware = self.top / "cgt", self.top / "ware"
        make_compiler(cgt)
        make_headers(ware, fast_rts=False)
        roots = [f"-DC2000_CGT_ROOT={cgt}", f"-DC2000WARE_ROOT={ware}"]

        self.assertEqual(
            self.configure("f28335-flash", f"-DSDRE_TABLES={own}", *roots).returncode, 0
        )
        commands = json.loads((self.build / "compile_commands.json").read_text())
        sources = {command["file"] for command in commands}
        self.assertIn(str(own / "gain_tables.c"), sources)
        self.assertIn(str(own / "board_config.c"), sources)
        self.assertNotIn(str(ROOT / "firmware" / "config" / "gain_tables.c"), sources)
        main = next(c["command"] for c in commands if c["file"].endswith("program/main.c"))
        self.assertIn(str(own), main)
        self.assertNotIn(str(ROOT / "firmware" / "config"), main)

    def test_directory_without_tables_is_refused(self):
        done = self.configure("board-check", f"-DSDRE_TABLES={self.top}")

        self.assertNotEqual(done.returncode, 0)
        self.assertIn(
            f"SDRE_TABLES={self.top}: no gain_tables.h there", " ".join(done.stdout.split())
        )


if __name__ == "__main__":
    unittest.main()
