# SPDX-License-Identifier: MIT
"""Results of the last computation: guarantees.json, so that a report needs neither minutes nor
solvers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict

from ..tools import ReportError, Tools

DRIVE = "ipmsm_390w"
FILE = Path(__file__).resolve().parents[1] / "guarantees.json"


def read(tools: Tools) -> Dict[str, Any]:
    """If it is of the drive file that there is."""
    found = json.loads(FILE.read_text(encoding="ascii"))
    if found["digest"] != tools.design(DRIVE)["digest"]:
        raise ReportError(f"{FILE.name} is not of this {DRIVE}.toml: ./dev report guarantees")
    return found
