# SPDX-License-Identifier: MIT
"""`python3 -m sdre_drive`, where the script is not on the path."""

from sdre_drive.cli import main

main()
