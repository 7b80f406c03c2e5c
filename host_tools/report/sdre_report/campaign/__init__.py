# SPDX-License-Identifier: MIT
"""Results of campaigns of the default drive: docs/campaign.md."""
