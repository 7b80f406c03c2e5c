# SPDX-License-Identifier: MIT
"""Proofs about the default drive's sampled loop, beside samples of it."""
