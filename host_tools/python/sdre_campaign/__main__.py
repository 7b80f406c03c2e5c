# SPDX-License-Identifier: MIT
"""python -m sdre_campaign"""

from sdre_campaign.entry import main

main()
