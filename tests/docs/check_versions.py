# SPDX-License-Identifier: MIT
"""Checks that firmware, tools, packages and citation name one version, and that CHANGELOG.md has
it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLACES = {
    "CMakeLists.txt": r"project\(sdre-drive VERSION ([\d.]+)",
    "host_tools/python/pyproject.toml": r'^version = "([\d.]+)"',
    "host_tools/python/drive/pyproject.toml": r'^version = "([\d.]+)"',
    "host_tools/python/sdre_drive/register_map.py": r'^VERSION = "([\d.]+)"',
    "firmware/app/registers/app_registers_map.h": r'APP_REGISTERS_VERSION "([\d.]+)"',
    "CITATION.cff": r"^version: ([\d.]+)",
    "CHANGELOG.md": r"^## (\d[\d.]+)",
}


def main() -> int:
    """Prints each place and its version when they differ."""
    found = {}
    for name, pattern in PLACES.items():
        match = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"), re.M)
        found[name] = match[1] if match else "none"
    if len(set(found.values())) > 1:
        print("\n".join(f"{name}: {version}" for name, version in found.items()), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
