# SPDX-License-Identifier: MIT
"""What a user of the drive holds: reads, commands and explains it over Modbus. Registers: docs/modbus.md."""
