# SPDX-License-Identifier: MIT
"""The page: `sdre-drive ui`."""
