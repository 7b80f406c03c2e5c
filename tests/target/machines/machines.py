# SPDX-License-Identifier: MIT
"""The core and its unit tests on machines unlike this one.

    machines.py m4f     Cortex-M4F with a single-precision unit, emulated by QEMU: unit tests, and
                        the numbers of a run
    machines.py avr     ATmega2560, whose int has 16 bits and double 32, simulated by simavr: the
                        numbers of a run

The numbers (same_numbers.c) have to be those of this machine within MOST_ULP.
"""

import re
import struct
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "quality"), str(HERE.parent / "budget")]
import unit_build as ub  # noqa: E402

from execution import EMULATOR  # noqa: E402

STUB = ub.ROOT / "firmware/board/host_stub"
# In units of the last place of a duty ratio near one half, 6e-8, and of the speed. The arithmetic
# is IEEE 754 in both, without fused operations.
MOST_ULP = {"m4f": 0, "avr": 0}
SECONDS = 900  # of a program: the tests' oracles are in double, by software

M4F = [
    "arm-none-eabi-gcc",
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
    "-fno-math-errno",
]
M4F_LINK = [
    "-nostartfiles",
    "--specs=nosys.specs",
    f"-T{STUB}/image.ld",
    "-Wl,--defsym=end=0x20200000",
    "-Wl,--no-warn-rwx-segments",
]
M4F_START = [STUB / "startup.c", STUB / "semihosting.c", HERE / "out_m4f.c"]
AVR = ["avr-gcc", "-mmcu=atmega2560", "-Wl,--gc-sections", "-ffunction-sections", "-fdata-sections"]
SIMULATOR = ["simavr", "-m", "atmega2560", "-f", "16000000"]

COMMON = ["-O2", "-fno-strict-aliasing", *ub.FLAGS, f"-I{HERE}", f"-I{STUB}"]
CORE = [p for p in ub.sources() if ub.room_of(p) == "control"] + [
    ub.ROOT / "firmware/config/gain_tables.c"
]
# It lets a timer of the host interrupt the application.
LEFT_OUT = {"test_app"}


def words(text):
    """The numbers that same_numbers.c printed; simulators colour the lines."""
    rows = re.findall(" ".join(["([0-9a-f]{8})"] * 4), text)
    return [[struct.unpack(">f", bytes.fromhex(word))[0] for word in row] for row in rows]


def compare(machine, mine, theirs):
    if not mine or len(mine) != len(theirs):
        raise SystemExit(f"{machine}: {len(theirs)} rows, {len(mine)} here")
    worst = 0.0
    for a, b in zip(mine, theirs):
        for x, y, size in zip(a, b, (0.5, 0.5, 0.5, max(abs(a[3]), 1.0))):
            worst = max(worst, abs(x - y) / (size * 2.0**-23))
    print(
        f"{machine}: {len(mine)} rows of a run, worst difference {worst:.1f} ULP, allowed "
        f"{MOST_ULP[machine]}"
    )
    return worst <= MOST_ULP[machine]


def numbers_here(out):
    ub.require(
        [
            "gcc",
            *COMMON,
            HERE / "same_numbers.c",
            HERE / "out_host.c",
            *CORE,
            "-lm",
            "-o",
            out / "here",
        ]
    )
    return words(ub.run([out / "here"]).stdout)


def emulate(command, image):
    try:
        done = subprocess.run(
            [*command, str(image)],
            capture_output=True,
            text=True,
            timeout=SECONDS,
            errors="replace",
        )
    except subprocess.TimeoutExpired:
        return 124, ""
    return done.returncode, done.stdout + done.stderr


def numbers_m4f(out):
    ub.require(
        [
            *M4F,
            *COMMON,
            HERE / "same_numbers.c",
            *M4F_START,
            *CORE,
            *M4F_LINK,
            "-lm",
            "-o",
            out / "numbers.elf",
        ]
    )
    return words(emulate([*EMULATOR, "-kernel"], out / "numbers.elf")[1])


def numbers_avr(out):
    ub.require(
        [
            *AVR,
            *COMMON,
            HERE / "same_numbers.c",
            HERE / "out_avr.c",
            *CORE,
            "-lm",
            "-o",
            out / "numbers.elf",
        ]
    )
    return words(emulate(SIMULATOR, out / "numbers.elf")[1])


def unit_tests_m4f(out):
    """Every unit test, its output character by character; a failure is its exit code."""
    tables = []
    for name, drive in ub.TABLES.items():
        ub.require(
            [
                ub.ROOT / "build/host/bin/sdre-gains",
                "generate",
                ub.ROOT / f"firmware/config/drives/{drive}.toml",
                "--out",
                out / name,
                "--uncertified",
            ]
        )
        tables.append((out / name / "gain_tables.c", [f"-Dgain_tables_drive={name}_drive"]))
    unity = ["-DUNITY_OUTPUT_CHAR=out_char", "-include", HERE / "out.h"]
    parts = [(p, []) for p in ub.sources()] + tables + [(p, []) for p in M4F_START]
    parts += [
        (ub.ROOT / "firmware/config/board_config.c", []),
        (ub.ROOT / "firmware/config/gain_tables.c", []),
        (ub.ROOT / "build/unity/unity.c", unity),
        (ub.ROOT / "tests/support/fake_board.c", []),
    ]
    objects = []
    for n, (source, extra) in enumerate(parts):
        objects.append(out / f"{n}_{Path(source).stem}.o")
        ub.require([*M4F, *COMMON, "-std=gnu99", *extra, "-c", source, "-o", objects[-1]])

    files = ub.test_files()

    def one(name):
        image = out / f"{name}.elf"
        built = ub.run(
            [
                *M4F,
                *COMMON,
                *unity,
                files[name],
                *objects,
                *M4F_LINK,
                "-lm",
                "-o",
                image,
            ]
        )
        if built.returncode != 0:
            return name, "does not link: " + built.stderr[-300:]
        code, text = emulate([*EMULATOR, "-kernel"], image)
        return name, "" if code == 0 else f"exit code {code}: " + " ".join(
            t for t in text.splitlines() if "FAIL" in t
        )[:400]

    with ThreadPoolExecutor(ub.JOBS) as pool:
        results = list(pool.map(one, [n for n in ub.tests() if n not in LEFT_OUT]))
    for name, problem in results:
        if problem:
            print(f"m4f: {name}: {problem}")
    failed = sum(bool(problem) for _, problem in results)
    print(f"m4f: {len(results) - failed} of {len(results)} unit tests pass")
    return failed == 0


def main():
    machine = sys.argv[1] if len(sys.argv) == 2 else ""
    if machine not in MOST_ULP:
        raise SystemExit(__doc__)
    out = ub.ROOT / "build/machines" / machine
    out.mkdir(parents=True, exist_ok=True)
    theirs = numbers_m4f(out) if machine == "m4f" else numbers_avr(out)
    good = compare(machine, numbers_here(out), theirs)
    if machine == "m4f":
        good = unit_tests_m4f(out) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
