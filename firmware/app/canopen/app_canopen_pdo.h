/* SPDX-License-Identifier: MIT */
/**
 * @file app_canopen_pdo.h
 * @brief A process data object of CiA 301: its settings, its mapping, its octets. Context:
 * background.
 */
#ifndef APP_CANOPEN_PDO_H
#define APP_CANOPEN_PDO_H

#include "app_canopen_objects.h"
#include "board.h"

#define APP_CANOPEN_MAPPED 8U /**< objects of one */

#define APP_CANOPEN_SYNC_MOST 240U /**< transmission types up to this go by SYNC */

typedef struct {
    uint32_t                     what;  /**< index, sub-index and bits, as 1600h has them */
    const app_registers_entry_t *entry; /**< NULL: octets that nothing takes */
} app_canopen_mapped_t;

typedef struct {
    uint32_t             cob; /**< identifier; bit 31: not used */
    uint16_t             type;
    uint16_t             inhibit_100us; /**< between two of them */
    uint16_t             event_ms;      /**< sent at least so often, or expected; 0: off */
    uint16_t             count;         /**< objects in use; 0: the mapping may change */
    app_canopen_mapped_t map[APP_CANOPEN_MAPPED];
    uint16_t             length;    /**< octets in use */
    uint16_t             octets[8]; /**< the last ones */
    bool                 full;      /**< received, and waits for SYNC */
    bool                 wanted;    /**< is to be sent */
    bool                 watched;   /**< received: the event timer runs */
    uint16_t             syncs;     /**< since it was sent */
    uint32_t             at_ticks;  /**< sent or received */
} app_canopen_pdo_t;

/** As after power-on. @param n 0 .. APP_CANOPEN_PDOS - 1. @param node 1 .. 127. */
void app_canopen_pdo_reset(app_canopen_pdo_t *p, uint16_t n, uint16_t node, bool receives);

/** True if it is in use. */
static inline bool app_canopen_pdo_is_used(const app_canopen_pdo_t *p)
{
    return ((p->cob & 0x80000000UL) == 0UL) && (p->count > 0U);
}

/** Its identifier on the bus. */
static inline uint16_t app_canopen_pdo_id(const app_canopen_pdo_t *p)
{
    return (uint16_t)(p->cob & 0x7FFUL);
}

/** True if a change makes it wanted. */
static inline bool app_canopen_pdo_has_events(const app_canopen_pdo_t *p)
{
    return (p->type == 0U) || (p->type > APP_CANOPEN_SYNC_MOST);
}

/** Reads sub-index `sub` of 1400h or 1800h. @return an abort code. */
uint32_t app_canopen_pdo_setting(const app_canopen_pdo_t *p, uint16_t sub, uint32_t *value,
                                 uint16_t *octets);

/** Writes it. */
uint32_t app_canopen_pdo_set(app_canopen_pdo_t *p, uint16_t sub, uint32_t value);

/** Reads sub-index `sub` of 1600h or 1A00h. */
uint32_t app_canopen_pdo_mapping(const app_canopen_pdo_t *p, uint16_t sub, uint32_t *value,
                                 uint16_t *octets);

/** Writes it. @param receives Of 1600h: its objects have to be writable. */
uint32_t app_canopen_pdo_map(app_canopen_pdo_t *p, uint16_t sub, uint32_t value, bool receives);

/** Writes the received octets to the objects, in their order. @return false: an object refused its
 * value, and the ones after it were not written. */
bool app_canopen_pdo_act(const app_canopen_pdo_t *p, app_registers_t *r);

/** Tries the same, app_registers_try(). @return false: an object refused its value. */
bool app_canopen_pdo_try(const app_canopen_pdo_t *p, app_registers_t *r);

/** Reads the objects. @return true if an octet has changed. */
bool app_canopen_pdo_read(app_canopen_pdo_t *p, const app_registers_t *r);

#endif /* APP_CANOPEN_PDO_H */
