# SPDX-License-Identifier: MIT
"""The report of both papers: `./dev report`. Python, because matplotlib draws the project's plots
there already."""
