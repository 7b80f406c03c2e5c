# SPDX-License-Identifier: MIT
"""The command sdre-campaign, or one line about what it lacks."""

from __future__ import annotations

import sys


def main() -> None:
    """Imports late: an installation need not have the packages."""
    try:
        from sdre_campaign.cli import main as run
    except ImportError as error:
        sys.exit(
            f"sdre-campaign: {error.name} is missing: pip install './host_tools/python[campaign]'"
        )
    run()
