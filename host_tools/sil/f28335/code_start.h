/* SPDX-License-Identifier: MIT */
/**
 * @file code_start.h
 * @brief Words that codestart.asm has copied from the flash to the RAM: code first, then tables.
 */
#ifndef CODE_START_H
#define CODE_START_H

#include <stdint.h>

#define CODE_START_WORDS 120U /* chosen; neither part is a multiple of what one pass compares */
#define CODE_START_CODE  100U

extern volatile uint16_t code_start_flash[CODE_START_WORDS];
extern volatile uint16_t code_start_ram[CODE_START_WORDS];

#endif /* CODE_START_H */
