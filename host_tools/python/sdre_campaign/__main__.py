# SPDX-License-Identifier: MIT
"""python -m sdre_campaign"""

from sdre_campaign.cli import main

main()
