# SPDX-License-Identifier: MIT
"""The pages' blocks that talk to a drive, run with a virtual one.

tests/docs/blocks.py says which these are."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import List

import pytest
from conftest import ROOT, serving

sys.path.insert(0, str(ROOT / "tests/docs"))

from blocks import Block, all_blocks  # noqa: E402
from run_blocks import complaint, prepare, write_program  # noqa: E402

PAGES = {
    page: found
    for page, blocks in all_blocks().items()
    if (found := [block for block in blocks if block.room() == "drive"])
}
TOOLS = ROOT / "build/host/bin"
# A program that runs until Ctrl-C gets one after 8 s; 130 is then a good end.
CLIENT = f"""#!/bin/bash
[[ $1 =~ ^(run|move|torque|ui|watch)$ ]] && held=(timeout --preserve-status -s INT 8)
[[ $1 =~ ^(ui|bench)$ ]] && more=(--control "127.0.0.1:$SERVED_CONTROL")
[[ $1 == bench ]] || more+=(--tcp "127.0.0.1:$SERVED_TCP")
"${{held[@]}}" "{sys.executable}" -m sdre_drive "$@" "${{more[@]}}"
code=$?
exit $((code == 130 && ${{#held[@]}} ? 0 : code))
"""
# The one drive of a page is there before the page asks for it. A line that begins one has to be
# right. It gets free ports, and joins no bus.
SERVER = f"""#!/bin/bash
set -eu
if [[ $1 == serve ]]; then
    while (($# > 0)); do
        case $1 in
            --tcp | --join) shift 2 ;;
            *) words+=("$1") && shift ;;
        esac
    done
    exec "{TOOLS}/sdre-sil" "${{words[@]}}" --tcp 0 --rtu-tcp 0 --control 0 --for 0.1
fi
exec "{TOOLS}/sdre-sil" "$@"
"""


def environment_of(at: Path, tcp: int, control: int) -> dict:
    """A tree with programs that know their drive."""
    environment = prepare(at, TOOLS)
    for name in ("sdre-sil", "sdre-sil-serve"):
        (at / "build/host/bin" / name).unlink()
        write_program(at / "build/host/bin" / name, SERVER)
    write_program(at / "build/venv/bin/sdre-drive", CLIENT)
    (at / "build/venv/sdre-drive").touch()
    told = {"SERVED_TCP": str(tcp), "SERVED_CONTROL": str(control), "BROWSER": "true"}
    path = f"{at}/build/venv/bin:{environment['PATH']}"
    return {**environment, **told, "PATH": path, "PYTHONPATH": str(ROOT / "host_tools/python")}


def test_there_are_some() -> None:
    assert {"README.md", "docs/index.md", "docs/loading.md"} < set(PAGES)


@pytest.mark.skipif(os.name != "posix", reason="a shell's")
@pytest.mark.parametrize("page", PAGES)
def test_page(page: str, tmp_path: Path) -> None:
    blocks: List[Block] = PAGES[page]
    tree = tmp_path / "tree"
    tree.mkdir()
    with serving(tmp_path) as served:
        environment = environment_of(tree, served.tcp, served.control)
        for block in blocks:
            text = complaint(block, tree, environment)
            assert text is None, text
