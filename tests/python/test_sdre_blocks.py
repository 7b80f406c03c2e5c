# SPDX-License-Identifier: MIT
"""The pages' blocks of Python, TOML and sdre-campaign: tests/docs/blocks.py has their rules."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import List

import pytest
from test_sdre import ROOT, TOOLS

from sdre_campaign.spec import read_spec

sys.path.insert(0, str(ROOT / "tests/docs"))

from blocks import Block, all_blocks  # noqa: E402
from run_blocks import complaint, prepare, write_program  # noqa: E402

PAGES = {
    page: found
    for page, blocks in all_blocks().items()
    if (found := [block for block in blocks if block.room() == "python"])
}


def replaced(file: Path, text: str) -> str:
    """A specification with these lines in place of its own."""
    whole = file.read_text(encoding="utf-8")
    for line in text.splitlines():
        key = line.split()[0]
        whole, count = re.subn(rf"(?m)^{key}\b.*$", line.replace("\\", r"\\"), whole, count=1)
        whole = whole if count else f"{line}\n{whole}"
    return whole.replace("../../sil/scenarios", str(ROOT / "host_tools/sil/scenarios"))


def run_one(block: Block, at: Path, environment: dict, program: List[str]) -> None:
    """Fails when the block does."""
    if block.language == "sh":
        text = complaint(block, at, environment)
        assert text is None, text
    elif block.marked("as"):
        (at / block.marked("as")[0]).write_text(block.text, encoding="utf-8")
    elif block.language == "toml":
        file = at / "changed.toml"
        file.write_text(replaced(ROOT / block.marked("changes")[0], block.text), encoding="utf-8")
        read_spec(file)
    else:
        program.append(block.text)
        text = "\n".join(program)
        done = subprocess.run(
            [sys.executable, "-c", text], cwd=at, capture_output=True, text=True, timeout=200
        )
        assert done.returncode == 0, f"{block.where()}: {done.stderr}"


@pytest.mark.parametrize("page", PAGES)
def test_page(page: str, tmp_path: Path) -> None:
    environment = prepare(tmp_path, TOOLS)
    campaign = f'#!/bin/sh\nexec "{sys.executable}" -m sdre_campaign "$@"\n'
    write_program(tmp_path / "build/venv/bin/sdre-campaign", campaign)
    program: List[str] = []
    for block in PAGES[page]:
        run_one(block, tmp_path, environment, program)
