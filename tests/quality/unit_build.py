# SPDX-License-Identifier: MIT
"""The unit tests of firmware/control and firmware/app built by hand, quickly: for coverage.py and
mutate.py."""

import os
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
UNITY = Path(os.environ.get("UNITY_ROOT") or ROOT / "build/unity").resolve()
BOARD = ROOT / "firmware/board/f28335"
ROOMS = ("control", "app", "store", "commission")  # of firmware; each with the rooms inside it
INCLUDES = [
    path
    for name in ROOMS
    for path in (ROOT / "firmware" / name, *sorted((ROOT / "firmware" / name).glob("*/")))
]
INCLUDES += [UNITY]
INCLUDES += [
    ROOT / p
    for p in (
        "firmware/board",
        "firmware/board/f28335",
        "firmware/config",
        "tests/support",
    )
]
FLAGS = [
    "-std=c99",
    "-w",
    "-ffp-contract=off",
    "-DUNITY_INCLUDE_DOUBLE",
    "-DUNITY_SUPPORT_64",
    "-DFIELDS_NAMED",  # as on every host, and the next
    "-DBOARD_CURRENT_SENSORS=3",
    "-DBOARD_CHOPPER=1",
    "-DAPP_DISC_MAP=1",
    *[f"-I{p}" for p in INCLUDES],
]
# As tests/CMakeLists.txt: tables of drives that the shipped one is not.
TABLES = {
    "speed_tables": "ipmsm_390w_speed",
    "conventional_tables": "ipmsm_390w_conventional",
    "harmonic_tables": "ipmsm_390w_noc_h",
    "shaft_tables": "ipmsm_390w_shaft",
    "iron_tables": "ipmsm_390w_iron",
}
JOBS = os.cpu_count() or 1


def run(command, **options):
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, **options
    )


def require(command):
    result = run(command)
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}:\n{result.stderr}")


def sources():
    """Measured files: every .c file of the core, the application, the store and the
    commissioning."""
    return [file for name in ROOMS for file in sorted((ROOT / "firmware" / name).rglob("*.c"))]


def room_of(source):
    """The room of firmware that a source stands in, at any depth."""
    return source.relative_to(ROOT / "firmware").parts[0]


def tests():
    """Names of the unit tests that need nothing but core, application and the fake board."""
    other = {
        "test_app_main",  # of the board's main()
        "test_fields_complete",  # without padding, which gcov's own structures need
    }
    return [n for n in sorted(test_files()) if n not in other]


def test_files():
    """{name: file} of all unit tests."""
    return {p.stem: p for p in (ROOT / "tests/unit").rglob("test_*.c")}


class Build:
    """Objects of everything in one directory."""

    def __init__(self, directory, extra):
        self.directory = Path(directory)
        self.flags = [*FLAGS, *extra]
        self.directory.mkdir(parents=True, exist_ok=True)
        tables = [self._table(name, drive) for name, drive in TABLES.items()]
        work = [(p, p.stem, []) for p in sources()]
        work += [
            (ROOT / "firmware/config/board_config.c", "board_config", []),
            (ROOT / "firmware/config/gain_tables.c", "gain_tables", []),
            (UNITY / "unity.c", "unity", []),
            (ROOT / "tests/support/fake_board.c", "fake_board", []),
        ]
        files = test_files()
        work += [(files[n], n, []) for n in tests()]
        work += [(path, name, [f"-Dgain_tables_drive={name}_drive"]) for name, path in tables]
        with ThreadPoolExecutor(JOBS) as pool:
            list(
                pool.map(
                    lambda w: require(
                        ["gcc", *self.flags, *w[2], "-c", w[0], "-o", self.object(w[1])]
                    ),
                    work,
                )
            )
        self.common = [self.object(p.stem) for p in sources()]
        self.common += [
            self.object(n) for n in ("board_config", "gain_tables", "unity", "fake_board", *TABLES)
        ]

    def object(self, stem):
        return self.directory / f"{stem}.o"

    def _table(self, name, drive):
        out = self.directory / name
        require(
            [
                ROOT / "build/host/bin/sdre-gains",
                "generate",
                ROOT / f"firmware/config/drives/{drive}.toml",
                "--out",
                out,
                "--uncertified",
            ]
        )
        return name, out / "gain_tables.c"

    def link(self, test, program, instead=None):
        """The test's program; `instead` maps a module to another object of it."""
        objects = [(instead or {}).get(o.stem, o) for o in self.common]
        return run(["gcc", *self.flags, self.object(test), *objects, "-lm", "-o", program])


def passes(program, seconds):
    """Whether a test program ends well in time."""
    try:
        return run([program], timeout=seconds).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def code_lines(text):
    """The lines of a C file without comments, preprocessor and strings, each as long as it was."""
    text = re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)
    lines = text.split("\n")
    return ["" if line.lstrip().startswith("#") else line.split("//")[0] for line in lines]
