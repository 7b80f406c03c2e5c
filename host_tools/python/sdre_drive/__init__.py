# SPDX-License-Identifier: MIT
"""The user's tool: reads, commands and explains the drive over Modbus. Registers:
docs/modbus.md."""
