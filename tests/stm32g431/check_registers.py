# SPDX-License-Identifier: MIT
"""registers.h against the maker's own description of the STM32G431, in the form of the crate
stm32g4, which is made from ST's SVD.

    check_registers.py DIRECTORY       sources of the crate
    check_registers.py --self-test DIRECTORY

Compared are the address of each peripheral, the offset of each register and the place of each
field. STM32G4_CRATE names the directory for the test; without it nothing is compared.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEADER = ROOT / "firmware/board/stm32g431/registers.h"

# Structure of registers.h: peripherals, module of the crate.
BLOCKS = {
    "rcc_t": (["RCC"], "rcc"),
    "pwr_t": (["PWR"], "pwr"),
    "flash_t": (["FLASH"], "flash"),
    "gpio_t": (["GPIOA", "GPIOB", "GPIOC"], "gpioa"),
    "syscfg_t": (["SYSCFG"], "syscfg"),
    "tim_t": (["TIM1", "TIM2", "TIM4"], "tim1"),
    "adc_t": (["ADC1", "ADC2"], "adc1"),
    "adc_common_t": (["ADC12_COMMON"], "adc12_common"),
    "dac_t": (["DAC3"], "dac1"),
    "comp_t": (["COMP"], "comp"),
    "opamp_t": (["OPAMP"], "opamp"),
    "usart_t": (["USART2"], "usart1"),
    "fdcan_t": (["FDCAN1"], "fdcan"),
    "iwdg_t": (["IWDG"], "iwdg"),
}
# The crate numbers what RM0440 names, and it has other names for some.
REGISTERS = {
    "tim_t": {f"CCR{n}": f"ccr[{n - 1}]" for n in (1, 2, 3, 4)},
    "adc_t": {f"JDR{n}": f"jdr[{n - 1}]" for n in (1, 2, 3)},
    "comp_t": {f"C{n}CSR": f"ccsr[{n - 1}]" for n in (1, 2, 3, 4)},
}
# Prefix of a field: module and file of its register.
FIELD_FILES = {
    "ADC_CCR": "adc12_common/ccr",
    "COMP_CCSR": "comp/ccsr",
    "OPAMP_CSR": "opamp/opamp1_csr",
    "TIM_CCMR1_OC": "tim1/ccmr1_output",
    "TIM_CCMR2_OC": "tim1/ccmr2_output",
    "TIM_CCMR1": "tim1/ccmr1_input",
    "TIM_CCMR2": "tim1/ccmr2_input",
    "TIM_SR": "tim3/sr",
    "TIM": "tim1",
    "ADC": "adc1",
    "DAC": "dac1",
    "USART": "usart1",
}
# Fields that the crate numbers or names otherwise.
FIELDS = {
    "OPAMP_CSR_OPAMPxEN": "opaen",
    "TIM_CR2_MMS_3": None,  # ST's SVD has this part of the field in no register
    "USART_ISR_NE": "nf",
}
# Only what reads the whole word.
NO_FIELD = {"FDCAN_RXF0S_F0FL_OF", "FDCAN_RXF0S_F0GI_OF"}


def structures(text):
    """{structure: {register: offset}}"""
    found = {}
    for body, name in re.findall(r"typedef struct \{\n(.*?)\} (\w+);", text, flags=re.S):
        offset, registers = 0, {}
        for register, count in re.findall(r"^    reg_t +(\w+)(?:\[(\d+)\])?;", body, flags=re.M):
            if register.startswith("reserved"):
                assert int(register.split("_")[1], 16) == offset, (name, register, hex(offset))
            else:
                registers[register] = offset
            offset += 4 * int(count or 1)
        found[name] = registers
    return found


def fields(text):
    """{field: (first bit, width)}; width None: not said"""
    found = {}
    for name, bit in re.findall(r"#define (\w+) +\(1UL << (\d+)U\)", text):
        found[name] = (int(bit), 1)
    for name, bit in re.findall(r"#define (\w+)\(x\) +\(\(uint32_t\)\(x\) << (\d+)U\)", text):
        found[name] = (int(bit), None)
    for name, bit, mask in re.findall(
        r"#define (\w+)\(value\) +\(\(\(?value\)?(?: >> (\d+)U\))? ?& ?(\d+)UL\)", text
    ):
        found[name] = (int(bit or 0), int(mask).bit_length())
    return found


def crate_offsets(source):
    """{register: offset} of a RegisterBlock."""
    found = {}
    for offset, end, name in re.findall(
        r"///0x([0-9a-f]+)(?:\.\.0x([0-9a-f]+))? - .*?\n(?:    ///.*\n)*    #\[inline\(always\)\]\n"
        r"    pub (?:const )?fn (\w+)\(&self",
        source,
    ):
        if end:
            for n in range((int(end, 16) - int(offset, 16)) // 4):
                found.setdefault(f"{name}[{n}]", int(offset, 16) + 4 * n)
        else:
            found[name] = int(offset, 16)
    return found


def crate_fields(source):
    """{field: (first bit, width)} of a register."""
    found = {}
    for first, last, name in re.findall(
        r"///Bits? (\d+)(?::(\d+))? - .*?\n(?:    ///.*\n)*    #\[inline\(always\)\]\n"
        r"    pub fn (\w+)\(&(?:mut )?self\)",
        source,
    ):
        found[name] = (int(first), int(last or first) - int(first) + 1)
    return found


def compare(header, crate):
    """Differences, and how much was compared."""
    wrong, counted = [], {"addresses": 0, "registers": 0, "fields": 0}
    text = header
    top = (crate / "mod.rs").read_text()
    addresses = {
        name: int(value.replace("_", ""), 16)
        for name, value in re.findall(
            r"pub type (\w+) = crate::Periph<\w+::RegisterBlock, 0x([0-9a-f_]+)>", top
        )
    }
    for name, value in re.findall(r"#define (\w+) +\(\(\w+ \*\)0x([0-9A-F]+)UL\)", text):
        theirs = addresses.get("FDCAN" if name == "FDCAN_MEMORY" else name)
        counted["addresses"] += 1
        if int(value, 16) != theirs:
            wrong.append(f"{name}: 0x{value}, theirs {theirs and hex(theirs)}")

    blocks = structures(text)
    for block, (_, module) in BLOCKS.items():
        theirs = crate_offsets((crate / f"{module}.rs").read_text())
        for register, offset in blocks[block].items():
            name = REGISTERS.get(block, {}).get(register, register.lower())
            if block == "tim_t" and register in ("CCMR1", "CCMR2"):
                name = f"{register.lower()}_output"
            counted["registers"] += 1
            if theirs.get(name) != offset:
                wrong.append(f"{block}.{register}: 0x{offset:02X}, theirs {theirs.get(name)}")

    for field, (bit, width) in fields(text).items():
        if FIELDS.get(field, "") is None or field in NO_FIELD:
            continue
        prefix = max((p for p in FIELD_FILES if field.startswith(p)), key=len, default=None)
        parts = field.split("_")
        if prefix and "/" in FIELD_FILES[prefix]:
            file = FIELD_FILES[prefix]
        else:
            file = f"{FIELD_FILES.get(prefix, parts[0].lower())}/{parts[1].lower()}"
        name = FIELDS.get(field, re.sub(r"_of$", "", "_".join(parts[2:]).lower()))
        path = crate / f"{file}.rs"
        theirs = crate_fields(path.read_text()) if path.exists() else {}
        counted["fields"] += 1
        if name not in theirs:
            wrong.append(f"{field}: {file}.rs has no {name}")
        elif theirs[name][0] != bit or (width not in (None, theirs[name][1])):
            wrong.append(f"{field}: bit {bit}, theirs {theirs[name]}")
    return wrong, counted


def main():
    arguments = [a for a in sys.argv[1:] if a != "--self-test"]
    directory = arguments[0] if arguments else os.environ.get("STM32G4_CRATE")
    if not directory:
        print("stm32g431.registers: nothing compared, STM32G4_CRATE is not set")
        return 0
    crate = Path(directory) / "src/stm32g431"
    text = HEADER.read_text()
    if "--self-test" in sys.argv:
        for seed, instead in (
            (r"0x40021000UL", "0x40021400UL"),
            (r"( +reg_t +)EGR;", r"\1DEGR;\1EGR;"),
            (r"(TIM_BDTR_MOE +)\(1UL << 15U\)", r"\1(1UL << 14U)"),
        ):
            seeded, count = re.subn(seed, instead, text)
            assert count == 1 and compare(seeded, crate)[0], f"not found: {seed}"
    wrong, counted = compare(text, crate)
    for line in wrong:
        print(line)
    print(", ".join(f"{n} {what}" for what, n in counted.items()), "compared,", len(wrong), "wrong")
    return 1 if wrong or min(counted.values()) == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
