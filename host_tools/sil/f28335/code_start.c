/* SPDX-License-Identifier: MIT */
/* Stands in for codestart.asm. No firmware runs from these words: a test may write them. */
#include "code_start.h"

#include "peripherals.h"

volatile uint16_t code_start_flash[CODE_START_WORDS];
volatile uint16_t code_start_ram[CODE_START_WORDS];

const board_copy_t board_copies[BOARD_COPIES] = {
    {code_start_flash, code_start_ram, CODE_START_CODE},
    {&code_start_flash[CODE_START_CODE], &code_start_ram[CODE_START_CODE],
     CODE_START_WORDS - CODE_START_CODE},
};
