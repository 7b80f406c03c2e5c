# SPDX-License-Identifier: MIT
"""What campaigns of the default drive have found: docs/campaign.md."""
