# SPDX-License-Identifier: MIT
"""A kept man page beside the commands that it is made from."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "host_tools/install"))
import python_pages  # noqa: E402


def require_kept_page(name: str) -> None:
    """It is what the commands are now."""
    made = python_pages.page(name)
    kept = (python_pages.DIRECTORY / f"{name}.1").read_text()
    assert kept == made, f"run host_tools/install/python_pages.py {name}"
