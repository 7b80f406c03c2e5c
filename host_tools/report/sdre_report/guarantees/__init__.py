# SPDX-License-Identifier: MIT
"""What can be proved of the default drive's sampled loop, beside what was sampled."""
