# SPDX-License-Identifier: MIT
"""TMS320F28335 as the linker files have to see it; from the data sheet. [first, last + 1), words of
16 bits."""

BOOT_ENTRY = {"flash": 0x33FFF6, "ram": 0x000000}  # two words
ZERO_WAIT_CODE = (0x008000, 0x00C000)  # L0 .. L3
ZERO_WAIT_DATA = (0x008000, 0x010000)  # L0 .. L7
STACK_LIMIT = 0x010000  # the stack pointer has 16 bits

RAM = [(0x000050, 0x000800), (0x008000, 0x010000)]  # M0 behind the boot ROM's stack, M1; L0 .. L7
FLASH = [(0x300000, 0x33FF80)]
STORE_WORDS = 0x20000  # four sectors
ROM_TABLES = [(0x3FEBDC, 0x3FF27C)]
RESET_VECTOR = [(0x3FFFC0, 0x3FFFC2)]
SECURITY = [(0x33FF80, 0x33FFF6), (0x33FFF8, 0x340000)]  # reserved words, passwords

# The compiler and its run-time library make these with EABI.
LOADED = [
    ".text",
    ".cinit",
    ".const",
    ".switch",
    ".init_array",
    ".binit",
    ".ovly",
    ".args",
    ".TI.ramfunc",
]
NOT_LOADED = [".stack", ".bss", ".bss:cio", ".data", ".sysmem", ".TI.noinit"]
OWN = ["codestart", ".seldom", ".tables", ".in_force", "FPUmathTables", ".reset"]

PERIPHERALS = {
    "FlashRegs": 0x0A80,
    "AdcMirror": 0x0B00,
    "CpuTimer0Regs": 0x0C00,
    "CpuTimer1Regs": 0x0C08,
    "PieCtrlRegs": 0x0CE0,
    "PieVectTable": 0x0D00,
    "ECanaRegs": 0x6000,
    "ECanaMOTSRegs": 0x6080,
    "ECanaMboxes": 0x6100,
    "EPwm1Regs": 0x6800,
    "EPwm2Regs": 0x6840,
    "EPwm3Regs": 0x6880,
    "EPwm5Regs": 0x6900,
    "EPwm6Regs": 0x6940,
    "EQep1Regs": 0x6B00,
    "GpioCtrlRegs": 0x6F80,
    "GpioDataRegs": 0x6FC0,
    "SysCtrlRegs": 0x7010,
    "SciaRegs": 0x7050,
    "AdcRegs": 0x7100,
    "ADC_cal": 0x380080,
    "board_store_memory": 0x300000,
}
