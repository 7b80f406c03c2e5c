# SPDX-License-Identifier: MIT
"""The programs sdre-gains and sdre-sil of this wheel, with the drives and scenarios they read."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NoReturn

ROOT = Path(__file__).parent


def gains() -> NoReturn:
    """The command sdre-gains."""
    _become("sdre-gains")


def sil() -> NoReturn:
    """The command sdre-sil; it draws with this Python unless SDRE_PYTHON names another."""
    _become("sdre-sil")


def _become(tool: str) -> NoReturn:
    program = ROOT / "bin" / tool
    os.environ.setdefault("SDRE_PYTHON", sys.executable)
    os.execv(program, [os.fspath(program), *sys.argv[1:]])
