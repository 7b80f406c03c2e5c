/* SPDX-License-Identifier: MIT */
#include "app_canopen_pdo.h"

#include <stddef.h>

#include "app_registers_place.h"

#define UNUSED         ((uint32_t)0x80000000UL)
#define NO_REMOTE      ((uint32_t)0x40000000UL) /* of a TPDO: nobody asks for it; it is taken */
#define ID_LEAST       0x181UL                  /* by CiA 301 */
#define ID_MOST        0x57FUL
#define TYPE_EVENT     254U
#define FIRST_RECEIVED ((uint32_t)0x200UL)
#define FIRST_SENT     ((uint32_t)0x180UL)
#define SETTINGS       5U /* highest sub-index */
#define OCTETS         8U
/* Standard types of CiA 301 that map octets nothing takes. */
#define DUMMY_LAST 7U

static uint16_t octets_of(uint32_t what)
{
    return (uint16_t)((what & 0xFFUL) / 8UL);
}

static uint16_t index_of(uint32_t what)
{
    return (uint16_t)((what >> 16U) & 0xFFFFUL);
}

static uint16_t sub_of(uint32_t what)
{
    return (uint16_t)((what >> 8U) & 0xFFUL);
}

void app_canopen_pdo_reset(app_canopen_pdo_t *p, uint16_t n, uint16_t node, bool receives)
{
    static const app_canopen_pdo_t    empty = {.cob = UNUSED};
    const app_canopen_preset_t *const d =
        receives ? &app_canopen_received[n] : &app_canopen_sent[n];
    const uint32_t first = receives ? FIRST_RECEIVED : FIRST_SENT;

    *p               = empty;
    p->type          = d->type;
    p->inhibit_100us = d->inhibit_100us;
    for (uint16_t k = 0U; k < d->count; k++) {
        (void)app_canopen_pdo_map(p, (uint16_t)(k + 1U), d->objects[k], receives);
    }
    (void)app_canopen_pdo_map(p, 0U, d->count, receives);
    p->cob = (uint32_t)(first + (0x100UL * (uint32_t)n) + (uint32_t)node);
}

uint32_t app_canopen_pdo_setting(const app_canopen_pdo_t *p, uint16_t sub, uint32_t *value,
                                 uint16_t *octets)
{
    uint32_t result = APP_CANOPEN_OK;

    *octets = 2U;
    switch (sub) {
    case 0U:
        *value  = SETTINGS;
        *octets = 1U;
        break;
    case 1U:
        *value  = p->cob;
        *octets = 4U;
        break;
    case 2U:
        *value  = p->type;
        *octets = 1U;
        break;
    case 3U:
        *value = p->inhibit_100us;
        break;
    case 5U:
        *value = p->event_ms;
        break;
    default:
        result = APP_CANOPEN_NO_SUB;
        break;
    }
    return result;
}

/* An identifier changes while the PDO is not used. */
static uint32_t set_cob(app_canopen_pdo_t *p, uint32_t value)
{
    const uint32_t cob    = value & ~NO_REMOTE;
    const uint32_t id     = cob & ~UNUSED;
    const bool     off    = ((cob | p->cob) & UNUSED) != 0UL;
    const bool     same   = (p->cob & ~UNUSED) == id;
    uint32_t       result = APP_CANOPEN_VALUE;

    if ((id >= ID_LEAST) && (id <= ID_MOST) && (off || same)) {
        p->cob     = cob;
        p->full    = false;
        p->watched = false;
        p->syncs   = 0U;
        p->wanted  = app_canopen_pdo_has_events(p); /* what it has is news */
        result     = APP_CANOPEN_OK;
    }
    return result;
}

uint32_t app_canopen_pdo_set(app_canopen_pdo_t *p, uint16_t sub, uint32_t value)
{
    uint32_t result = APP_CANOPEN_OK;

    switch (sub) {
    case 0U:
        result = APP_CANOPEN_READ_ONLY;
        break;
    case 1U:
        result = set_cob(p, value);
        break;
    case 2U:
        if ((value <= APP_CANOPEN_SYNC_MOST) || (value >= TYPE_EVENT)) {
            p->type = (uint16_t)value;
        } else {
            result = APP_CANOPEN_VALUE;
        }
        break;
    case 3U:
        p->inhibit_100us = (uint16_t)value;
        break;
    case 5U:
        p->event_ms = (uint16_t)value;
        break;
    default:
        result = APP_CANOPEN_NO_SUB;
        break;
    }
    return result;
}

uint32_t app_canopen_pdo_mapping(const app_canopen_pdo_t *p, uint16_t sub, uint32_t *value,
                                 uint16_t *octets)
{
    uint32_t result = APP_CANOPEN_OK;

    if (sub == 0U) {
        *value  = p->count;
        *octets = 1U;
    } else if (sub <= APP_CANOPEN_MAPPED) {
        *value  = p->map[sub - 1U].what;
        *octets = 4U;
    } else {
        result = APP_CANOPEN_NO_SUB;
    }
    return result;
}

/* Takes an object into the mapping, which nothing uses meanwhile. */
static uint32_t map_object(app_canopen_mapped_t *m, uint32_t what, bool receives)
{
    const uint16_t       index  = index_of(what);
    const bool           dummy  = receives && (index >= 1U) && (index <= DUMMY_LAST);
    app_canopen_object_t object = {.index = 0U};
    uint32_t             result = APP_CANOPEN_OK;

    if (!dummy && (what != 0UL)) {
        result = app_canopen_objects_find(index, sub_of(what), &object);
        if ((result == APP_CANOPEN_OK) &&
            ((object.entry == NULL) || (object.entry->signature != 0UL) ||
             (receives && !object.writable) || (octets_of(what) != object.octets) ||
             ((what & 7UL) != 0UL))) {
            result = APP_CANOPEN_NOT_MAPPABLE;
        }
    }
    if (result == APP_CANOPEN_OK) {
        m->what  = what;
        m->entry = object.entry;
    }
    return result;
}

/* Octets of the first objects; more than OCTETS: they are too many. */
static uint32_t add_lengths(const app_canopen_pdo_t *p, uint16_t count, uint16_t *length)
{
    uint32_t result = APP_CANOPEN_OK;

    for (uint16_t k = 0U; (k < count) && (*length <= OCTETS); k++) {
        *length = (uint16_t)(*length + octets_of(p->map[k].what));
        if (p->map[k].what == 0UL) {
            result = APP_CANOPEN_NO_OBJECT;
        }
    }
    return result;
}

static uint32_t set_count(app_canopen_pdo_t *p, uint32_t count)
{
    uint16_t length = 0U;
    uint32_t result = APP_CANOPEN_TOO_MUCH;

    if (count <= APP_CANOPEN_MAPPED) {
        result = add_lengths(p, (uint16_t)count, &length);
        if (length > OCTETS) {
            result = APP_CANOPEN_TOO_MUCH;
        } else if (result == APP_CANOPEN_OK) {
            p->count  = (uint16_t)count;
            p->length = length;
        } else {
            /* one of them is not mapped */
        }
    }
    return result;
}

uint32_t app_canopen_pdo_map(app_canopen_pdo_t *p, uint16_t sub, uint32_t value, bool receives)
{
    const bool off    = (p->cob & UNUSED) != 0UL; /* the PDO is switched off meanwhile */
    uint32_t   result = APP_CANOPEN_STATE;

    if (sub > APP_CANOPEN_MAPPED) {
        result = APP_CANOPEN_NO_SUB;
    } else if (off && (sub == 0U)) {
        result = set_count(p, value);
    } else if (off && (sub != 0U) && (p->count == 0U)) {
        result = map_object(&p->map[sub - 1U], value, receives);
    } else {
        /* in use, or the number of objects is not 0 */
    }
    return result;
}

static bool pass_objects(const app_canopen_pdo_t *p, app_registers_t *r, bool tries)
{
    uint16_t at = 0U;
    bool     ok = true;

    for (uint16_t k = 0U; ok && (k < p->count); k++) {
        const app_registers_entry_t *const entry  = p->map[k].entry;
        const uint16_t                     octets = octets_of(p->map[k].what);
        uint32_t                           value  = 0UL;

        /*@ split octets; */ /* for tests/prove: each length by itself */
        at = (uint16_t)(at + octets);
        ok = at <= OCTETS; /* as set_count() has made sure */
        for (uint16_t n = octets; ok && (n > 0U); n--) {
            value = (value << 8U) | p->octets[(at - octets) + (n - 1U)];
        }
        if (ok && (entry != NULL)) {
            ok = tries ? app_canopen_objects_try(r, entry, octets, value)
                       : (app_canopen_objects_write(r, entry, octets, value) == APP_CANOPEN_OK);
        }
    }
    return ok;
}

bool app_canopen_pdo_act(const app_canopen_pdo_t *p, app_registers_t *r)
{
    return pass_objects(p, r, false);
}

bool app_canopen_pdo_try(const app_canopen_pdo_t *p, app_registers_t *r)
{
    return pass_objects(p, r, true);
}

bool app_canopen_pdo_read(app_canopen_pdo_t *p, const app_registers_t *r)
{
    uint16_t at      = 0U;
    bool     changed = false;

    for (uint16_t k = 0U; k < p->count; k++) {
        uint32_t value =
            (p->map[k].entry != NULL) ? app_registers_place_value(r, p->map[k].entry) : 0UL;

        for (uint16_t n = 0U; (n < octets_of(p->map[k].what)) && (at < OCTETS); n++) {
            const uint16_t octet = (uint16_t)(value & 0xFFUL);

            changed       = changed || (octet != p->octets[at]);
            p->octets[at] = octet;
            value >>= 8U;
            at = (uint16_t)(at + 1U);
        }
    }
    return changed;
}
