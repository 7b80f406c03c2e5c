# SPDX-License-Identifier: MIT
"""Drives that answer on a CAN bus: all 127 nodes are asked for their identification."""

from __future__ import annotations

from dataclasses import replace
from typing import Dict, List, Tuple

from sdre_drive.can_link import CanLink
from sdre_drive.link import DriveError, Target


def find(target: Target) -> List[Tuple[Target, Dict[int, str]]]:
    """Each node with the texts of its identification; DriveError without an adapter."""
    link = CanLink(target, 1)
    found = []
    try:
        for node in link.nodes():
            link.turn_to(node)
            try:
                texts = {**link.identify(), **link.identify_basic()}
            except DriveError:
                continue  # another device
            found.append((replace(target, node=node), texts))
    finally:
        link.close()
    return found
