/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_block.h
 * @brief Several registers in one transfer (5F00h), and the drive's identification (5F01h).
 *
 * The values of a block are of one pass of the background. Values that are written act together, or
 * none does. Scope, record and the state of the loader have no other objects. Context: background.
 */
#ifndef APP_CANOPEN_BLOCK_H
#define APP_CANOPEN_BLOCK_H

#include "app_canopen_node.h"

#define APP_CANOPEN_BLOCK    0x5F00U
#define APP_CANOPEN_IDENTITY 0x5F01U

#define APP_CANOPEN_IDENTITY_SUBS 4U /**< highest sub-index */

/** Selection at the start: input or holding register 0 alone. */
#define APP_CANOPEN_BLOCK_START 0x00010000UL

/** True if the object has the registers themselves, and not their selection. */
bool app_canopen_block_has(uint16_t index, uint16_t sub);

/** Selects registers. @param value First one in the low word, number in the high word.
 * @return an abort code. */
uint32_t app_canopen_block_select(app_canopen_t *c, uint16_t sub, uint32_t value);

/** Number of sub-indices, or the selection. @return an abort code. */
uint32_t app_canopen_block_selected(const app_canopen_t *c, uint16_t sub, uint32_t *value,
                                    uint16_t *octets);

/** Reads the selected registers. @param words Room for APP_CANOPEN_SDO_WORDS. @param octets Becomes
 * their number. @return an abort code. */
uint32_t app_canopen_block_read(const app_canopen_t *c, const app_registers_t *r, uint16_t sub,
                                uint16_t *words, uint16_t *octets);

/** Writes holding registers from the selected one on. @return an abort code. */
uint32_t app_canopen_block_write(const app_canopen_t *c, app_registers_t *r, uint16_t sub,
                                 const uint16_t *words, uint16_t octets);

/** Text of a sub-index from 1 on: drive, digest of its file, digest of the registers, board. */
const char *app_canopen_block_text(const app_registers_t *r, uint16_t sub);

#endif /* APP_CANOPEN_BLOCK_H */
