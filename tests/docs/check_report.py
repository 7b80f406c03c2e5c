# SPDX-License-Identifier: MIT
"""Checks that the report keeps results of the present drive file. Argument: sdre-gains."""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "host_tools/report/sdre_report"


class Kept(unittest.TestCase):
    def test_digests_are_those_of_the_drives(self) -> None:
        for name in ("guarantees.json", "campaign.json"):
            found = json.loads((KEPT / name).read_text(encoding="ascii"))
            drive = ROOT / f"firmware/config/drives/{found['drive']}.toml"
            said = subprocess.run(
                [gains, "report", str(drive)], capture_output=True, text=True, check=True
            ).stdout
            digest = re.search(r"\((fnv1a64:[0-9a-f]{16})\)", said)
            self.assertIsNotNone(digest)
            self.assertEqual(
                found["digest"],
                digest[1],
                f"{name} is stale: ./dev report guarantees, ./dev report campaign",
            )


if __name__ == "__main__":
    gains = sys.argv.pop(1)
    unittest.main()
