# SPDX-License-Identifier: MIT
"""Campaigns: a scenario with very many motors, loads, sensors, faults or seeds.
docs/campaign.md."""
