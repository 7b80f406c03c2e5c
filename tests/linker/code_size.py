# SPDX-License-Identifier: MIT
"""Estimates how many words an image's code takes on the C28x. The linker of a Cortex-M4F tells what
it keeps of the same sources, function by function. A factor with a band turns its sizes into words.
How both were found: docs/hardware.md, "Build"."""

import pathlib
import re
import shutil
import subprocess
import tempfile
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor

import command_file

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "firmware"
BOARD = FIRMWARE / "board" / "f28335"
STAND_IN = ROOT / "host_tools" / "sil" / "f28335" / "include"

# fitted: words of 12 listings of TI's compiler by halfwords (two octets) of the same functions here
WORDS_PER_HALFWORD = 1.14
# fitted: how far the words of a file were off that the fit had not seen, rms weighted by size
BAND = 0.23
LIBRARY_words = (
    512  # chosen: run-time library and fastRTS; a public map of TI's linker has 450 words of them
)

COMPILER = "arm-none-eabi-gcc"
OPTIONS = [
    "-std=c99",
    "-O2",
    "-w",
    "-ffreestanding",
    "-fno-math-errno",
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfpu=fpv4-sp-d16",
    "-mfloat-abi=hard",
    "-fno-short-enums",
    "-ffinite-math-only",
    "-fno-signed-zeros",
    "-fno-optimize-sibling-calls",
    "-ffunction-sections",
    "-fdata-sections",
    "-D_Bool=unsigned short",
    *[
        f"-I{path}"
        for d in ("control", "commission", "store", "app", "config")
        for path in (FIRMWARE / d, *sorted((FIRMWARE / d).glob("*/")))
    ],
    *[f"-I{FIRMWARE / d}" for d in ("board", "board/program", "board/f28335")],
    "-isystem",
    str(ROOT / "tests/target/include"),
    "-isystem",
    str(STAND_IN),
    "-include",
    str(STAND_IN / "c28_cpu.h"),
]
LINK = [
    COMPILER,
    "-nostdlib",
    "-nostartfiles",
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfpu=fpv4-sp-d16",
    "-mfloat-abi=hard",
    "-Wl,--gc-sections",
    "-Wl,--unresolved-symbols=ignore-all",
    "-Wl,-e,main",
    "-Wl,-u,control_isr",
    "-Wl,--no-warn-rwx-segments",
]

APP_UNITS = ("app.c", "app_measure.c")
Function = namedtuple("Function", "name source halfwords")


def words_at_most(halfwords):
    """Upper end of the band."""
    return round(halfwords * WORDS_PER_HALFWORD * (1 + BAND))


def is_there():
    return shutil.which(COMPILER) is not None


def core_sources():
    """firmware/control as an image has it: tick and laws as one translation unit each."""
    text = (
        (FIRMWARE / "CMakeLists.txt")
        .read_text()
        .replace("${sdre_tick}", "one_unit")
        .replace("${sdre_laws}", "one_unit")
    )
    library = text[
        text.index("add_library(control_core") : text.index(
            "target_include_directories(control_core"
        )
    ]
    return [
        FIRMWARE / name for name in re.findall(r"(?:control|one_unit)/(?:\w+/)?\w+\.c", library)
    ]


def app_parts():
    """Files that app.c and app_measure.c of one_unit have in them."""
    text = (FIRMWARE / "CMakeLists.txt").read_text()
    units = re.findall(r"set\(sdre_app_(?:measure_)?unit ([^)]*)\)", text)
    return {FIRMWARE / "app" / name for unit in units for name in unit.split()}


def sources():
    found, parts = core_sources(), app_parts()
    for folder in ("app", "commission", "store", "board/program", "board/f28335"):
        found += [
            source
            for source in sorted((FIRMWARE / folder).rglob("*.c"))
            if source.name != "bench.c" and source not in parts
        ]
    units = [FIRMWARE / "one_unit" / name for name in APP_UNITS]
    return [*found, *units, FIRMWARE / "config" / "board_config.c"]


def _compile(source, work):
    room = (
        source.relative_to(FIRMWARE).parts[0]
        if source.is_relative_to(FIRMWARE)
        else source.parent.name
    )
    made = work / f"{'f28335' if room == 'board' else room}_{source.stem}.o"
    subprocess.run([COMPILER, *OPTIONS, "-c", str(source), "-o", str(made)], check=True, cwd=work)
    return made


def _kept(text):
    """Functions of a linker's map that it has kept."""
    lines = re.sub(
        r"^( \.text\S+)\n +", r"\1 ", text[text.index("Linker script and memory map") :], flags=re.M
    )
    for section, size, made in re.findall(
        r"^ (\.text\S*)\s+0x[0-9a-f]+\s+0x([0-9a-f]+) (\S+\.o)$", lines, flags=re.M
    ):
        if int(size, 16):
            name = re.sub(
                r"\.(part|constprop|isra|cold)\..*",
                "",
                section.removeprefix(".text.").removeprefix("startup."),
            )
            yield Function(name, pathlib.Path(made).stem, (int(size, 16) + 1) // 2)


def functions(laws):
    """{law: functions of an image with that law}; without the law of another."""
    with tempfile.TemporaryDirectory() as directory:
        work = pathlib.Path(directory)
        with ThreadPoolExecutor() as pool:
            made = list(pool.map(lambda source: _compile(source, work), sources()))
        found = {}
        for law in laws:
            tables = work / f"tables_{law}.c"
            tables.write_text(
                f'#include "laws.h"\nconst drive_config_t gain_tables_drive = {{.law = '
                f"&law_{law}}};\n"
            )
            objects = [str(o) for o in made] + [str(_compile(tables, work))]
            layout = work / f"{law}.map"
            subprocess.run(
                [*LINK, f"-Wl,-Map,{layout}", *objects, "-o", str(work / law)], check=True
            )
            found[law] = list(_kept(layout.read_text()))
    return found


def bench_functions():
    """Functions of the image for a debugger."""
    with tempfile.TemporaryDirectory() as directory:
        work = pathlib.Path(directory)
        made = [_compile(source, work) for source in sources() if source.parent == BOARD]
        made += [
            _compile(BOARD / "bench.c", work),
            _compile(FIRMWARE / "config" / "board_config.c", work),
        ]
        subprocess.run(
            [*LINK, f"-Wl,-Map,{work / 'bench.map'}", *map(str, made), "-o", str(work / "bench")],
            check=True,
        )
        return list(_kept((work / "bench.map").read_text()))


def _listed(text, name):
    return (
        re.findall(r"[\w*]+\.c", match.group(1))
        if (match := re.search(rf"set\({name}\s([^)]*)\)", text))
        else []
    )


def runs_from_ram(law):
    """-> whether the build compiles a source, named as folder_file, with --ramfunc=on in an image
    with this law."""
    text = (BOARD / "CMakeLists.txt").read_text()
    ram = {
        "app": set(_listed(text, "app_ram_sources"))
        - set(_listed(text, f"app_flash_sources_{law}")),
        "f28335": set(_listed(text, "board_ram_sources")),
    }
    flash = [pattern.replace("*", ".*") for pattern in _listed(text, "core_flash_sources")]

    def answer(source):
        folder, name = re.fullmatch(
            r"(app|f28335|control|one_unit|commission|store|config|tables)_(\w+)", source
        ).groups()
        if source in {f"one_unit_{pathlib.Path(unit).stem}" for unit in APP_UNITS}:
            return f"{name}.c" in ram["app"]
        if folder in ("control", "one_unit"):
            return not any(re.fullmatch(pattern, f"{name}.c") for pattern in flash)
        return f"{name}.c" in ram.get(folder, ())

    return answer


def seldom():
    """Functions that the linker puts into the flash although their file is compiled for the RAM."""
    _, sections = command_file.parse((ROOT / "linker" / "f28335_flash.cmd").read_text())
    return [
        re.fullmatch(r"\*\(\.TI\.ramfunc:(\w+)\)", line).group(1)
        for line in sections[".seldom"].inputs
    ]
