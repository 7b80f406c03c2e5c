/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
/**
 * @file app_canopen_map.h
 * @brief Objects that a standard gives an index; docs/canopen.md has them.
 */
#ifndef APP_CANOPEN_MAP_H
#define APP_CANOPEN_MAP_H

#include "app_registers_map.h"

/** Objects of the first holding register, and of the first input register. */
#define APP_CANOPEN_HOLDING 0x2000U
#define APP_CANOPEN_INPUT   0x2800U

typedef struct {
    uint16_t index;
    uint16_t sub;
    uint16_t octets; /**< 1, 2 or 4 */
    bool     writable; /**< of a constant: it takes its own value */
    const app_registers_entry_t *entry; /**< the register; NULL: a constant */
    uint32_t value;                     /**< of the constant */
} app_canopen_object_t;

/** A PDO at the start. */
typedef struct {
    uint32_t objects[2];
    uint16_t count;
    uint16_t type; /**< of transmission */
    uint16_t inhibit_100us;
} app_canopen_preset_t;

#define APP_CANOPEN_OBJECTS 77U

/** In ascending order of index and sub-index. */
extern const app_canopen_object_t app_canopen_map[APP_CANOPEN_OBJECTS];

#define APP_CANOPEN_PDOS 4U /**< of each direction */

extern const app_canopen_preset_t app_canopen_received[APP_CANOPEN_PDOS];
extern const app_canopen_preset_t app_canopen_sent[APP_CANOPEN_PDOS];

#endif /* APP_CANOPEN_MAP_H */
