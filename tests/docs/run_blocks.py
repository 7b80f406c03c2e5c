# SPDX-License-Identifier: MIT
"""Runs the shell blocks of the pages in a directory that looks like the project's.

run_blocks.py tools|long BIN [--record]    BIN has sdre-gains and sdre-sil; exit code 1 when a block
fails. --record writes the figures that the commands print into the pages."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Dict, List, Optional

from blocks import ROOT, Block, all_blocks, blocks_of, output_complaint, recorded

LONGEST_S = 600
LINKED = "cmake CMakeLists.txt CMakePresets.json docs firmware host_tools linker tests".split()
# ./dev compiles nothing: the programs are there.
DEV = """#!/bin/sh
PATH=$PWD/stand_in:$PATH exec bash ./dev_itself "$@"
"""


def write_program(path: Path, text: str) -> None:
    """Executable."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


def prepare(at: Path, programs: Path) -> Dict[str, str]:
    """A tree like the project's, with these programs; the environment of its shell."""
    for name in LINKED:
        (at / name).symlink_to(ROOT / name)
    tools = at / "build/host/bin"
    tools.mkdir(parents=True)
    for name in ("sdre-gains", "sdre-sil"):
        (tools / name).symlink_to(programs / name)
    for part in ("run", "serve"):
        (tools / f"sdre-sil-{part}").symlink_to(programs / "sdre-sil")
    (at / "dev_itself").symlink_to(ROOT / "dev")
    write_program(at / "dev", DEV)
    write_program(
        at / "stand_in/cmake", '#!/bin/sh\n[ "$1" != --version ] || echo cmake version 4\n'
    )
    return {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "LC_ALL": "C"}


def give(block: Block, at: Path) -> None:
    """The files that its comment names."""
    for words in block.marked("with"):
        name, _, file = words.partition(" = ")
        (at / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / file, at / name)


def record(shown: Block, printed: str) -> Block:
    """The output with the figures that were printed; the page has them too."""
    page = ROOT / shown.page
    text = recorded(shown, printed, page.read_text(encoding="utf-8"))
    page.write_text(text, encoding="utf-8")
    return next(b for b in blocks_of(shown.page, text) if b.line == shown.line)


def complaint(block: Block, at: Path, environment: Dict[str, str]) -> Optional[str]:
    """Words for the error of a shell block."""
    give(block, at)
    expected = int((block.marked("exit") or ["0"])[0])
    done = subprocess.run(
        ["bash", "-euc", block.commands()],
        cwd=at,
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=LONGEST_S,
    )
    printed = done.stdout + done.stderr
    if done.returncode == expected:
        if block.shown is None:
            return None
        shown = record(block.shown, printed) if "--record" in sys.argv else block.shown
        return output_complaint(shown, printed)
    tail = "\n".join(printed.strip().splitlines()[-5:])
    return f"{block.where()}: exit code {done.returncode}, not {expected}\n{block.text}\n{tail}"


def page_complaints(blocks: List[Block], programs: Path) -> List[str]:
    """Those of one page, in its own directory."""
    found = []
    with tempfile.TemporaryDirectory() as name:
        at = Path(name)
        environment = prepare(at, programs)
        for block in blocks:
            began = time.monotonic()
            text = complaint(block, at, environment)
            print(f"{time.monotonic() - began:6.1f} s {block.where()}", flush=True)
            found += [text] if text else []
    return found


def main() -> int:
    """Every page that has a block of this room."""
    room, programs = sys.argv[1], Path(sys.argv[2]).resolve()
    found: List[str] = []
    for blocks in all_blocks().values():
        found += page_complaints([b for b in blocks if b.room() == room], programs)
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
