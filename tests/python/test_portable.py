# SPDX-License-Identifier: MIT
"""sdre-drive uses nothing of the standard library that Windows lacks. Nobody has run it there."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Set

import pytest
from conftest import ROOT

FILES = sorted((ROOT / "host_tools/python/sdre_drive").rglob("*.py"))
# The modules and names that Python's documentation says are for Unix.
MODULES = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty"}
NAMES = {
    "os": {"O_NOCTTY", "O_NONBLOCK", "fork", "geteuid", "getuid", "killpg", "openpty", "setsid"},
    "signal": {"SIGALRM", "SIGHUP", "SIGKILL", "SIGUSR1", "SIGUSR2", "alarm", "setitimer"},
    "socket": {"AF_UNIX"},
}


def of_unix(text: str) -> Set[str]:
    """Returns the modules and names of Unix that the source uses."""
    found: Set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {a.name for a in node.names} & MODULES
        elif isinstance(node, ast.ImportFrom):
            found |= {node.module} & MODULES
            found |= {a.name for a in node.names} & NAMES.get(node.module or "", set())
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found |= {node.attr} & NAMES.get(node.value.id, set())
    return found


def test_there_are_some() -> None:
    assert len(FILES) > 30


@pytest.mark.parametrize("text", ["import fcntl", "from os import fork", "x = os.O_NOCTTY"])
def test_each_kind_is_seen(text: str) -> None:
    assert of_unix(text)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_file_uses_nothing_of_unix(file: Path) -> None:
    assert of_unix(file.read_text(encoding="utf-8")) == set()
