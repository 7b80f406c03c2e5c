/* SPDX-License-Identifier: MIT */
#include "app_canopen_dictionary.h"

#include <stddef.h>

#include "app_canopen_block.h"
#include "app_canopen_emergency.h"

#define ERROR_REGISTER 0x1001U
#define ERRORS         0x1003U
#define NAME           0x1008U
#define SOFTWARE       0x100AU
#define ID_EMERGENCY   0x1014U
#define WATCHED        0x1016U
#define HEARTBEAT      0x1017U
#define SERVER         0x1200U
#define RECEIVED       0x1400U /* settings of PDOs, and mappings 200h above */
#define SENT           0x1800U
#define MAPPINGS       0x200U

#define NODE_ID_MOST 127UL

#define TEXT_MOST 24U /* characters, as in function 43/14 of Modbus */

/* Parts of the PDOs, by their index. */
typedef enum { NO_PDO = 0, PDO_SETTING, PDO_MAPPING } pdo_part_t;

typedef struct {
    pdo_part_t part;
    bool       receives;
    uint16_t   n;
} pdo_place_t;

typedef struct {
    uint32_t    value;
    uint16_t    octets;
    const char *text; /* instead of them */
} found_t;

static pdo_place_t pdo_of(uint16_t index)
{
    const uint16_t within  = (uint16_t)(index & 0x1FFU);
    const uint16_t base    = (uint16_t)(index & 0xFE00U);
    const bool     setting = (base == RECEIVED) || (base == SENT);
    const bool     mapping = (base == (RECEIVED + MAPPINGS)) || (base == (SENT + MAPPINGS));
    pdo_place_t    place   = {.part = NO_PDO, .receives = base < SENT, .n = 0U};

    if ((within < APP_CANOPEN_PDOS) && (setting || mapping)) {
        place.part = setting ? PDO_SETTING : PDO_MAPPING;
        place.n    = within;
    }
    return place;
}

static uint32_t read_pdo(const app_canopen_t *c, const pdo_place_t *place, uint16_t sub,
                         found_t *found)
{
    const app_canopen_pdo_t *const p =
        place->receives ? &c->received[place->n] : &c->sent[place->n];

    return (place->part == PDO_SETTING)
               ? app_canopen_pdo_setting(p, sub, &found->value, &found->octets)
               : app_canopen_pdo_mapping(p, sub, &found->value, &found->octets);
}

static uint32_t read_watched(const app_canopen_t *c, uint16_t sub, found_t *found)
{
    found->value  = (sub == 0U) ? 1UL : c->watched;
    found->octets = (uint16_t)((sub == 0U) ? 1U : 4U);
    return (sub <= 1U) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
}

static uint32_t read_server(const app_canopen_t *c, uint16_t sub, found_t *found)
{
    const uint32_t ids[] = {2UL, (uint32_t)APP_CANOPEN_ID_REQUEST + c->node,
                            (uint32_t)APP_CANOPEN_ID_ANSWER + c->node};

    found->value  = (sub <= 2U) ? ids[sub] : 0UL;
    found->octets = (uint16_t)((sub == 0U) ? 1U : 4U);
    return (sub <= 2U) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
}

static uint32_t read_identity(const app_registers_t *r, uint16_t sub, found_t *found)
{
    found->text   = app_canopen_block_text(r, sub);
    found->value  = APP_CANOPEN_IDENTITY_SUBS;
    found->octets = 1U;
    return ((sub == 0U) || (found->text != NULL)) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
}

/* Objects of one value, whose sub-index is 0. */
static bool read_single(const app_canopen_t *c, uint16_t index, found_t *found)
{
    bool known = true;

    switch (index) {
    case ERROR_REGISTER:
        found->value  = app_canopen_emergency_register(&c->emergency);
        found->octets = 1U;
        break;
    case NAME:
        found->text = "sdre-drive";
        break;
    case SOFTWARE:
        found->text = APP_REGISTERS_VERSION;
        break;
    case ID_EMERGENCY:
        found->value = (uint32_t)APP_CANOPEN_ID_EMERGENCY + c->node;
        break;
    case HEARTBEAT:
        found->value  = c->heartbeat_ms;
        found->octets = 2U;
        break;
    default:
        known = false;
        break;
    }
    return known;
}

static uint32_t read_register(const app_registers_t *r, uint16_t index, uint16_t sub,
                              found_t *found)
{
    app_canopen_object_t object = {.index = 0U};
    const uint32_t       result = app_canopen_objects_find(index, sub, &object);

    if (result == APP_CANOPEN_OK) {
        found->value  = app_canopen_objects_value(r, &object);
        found->octets = object.octets;
    }
    return result;
}

static uint32_t find_value(const app_canopen_t *c, const app_registers_t *r, uint16_t index,
                           uint16_t sub, found_t *found)
{
    const pdo_place_t pdo = pdo_of(index);
    uint32_t          result;

    if (pdo.part != NO_PDO) {
        result = read_pdo(c, &pdo, sub, found);
    } else if (index == ERRORS) {
        result = app_canopen_emergency_kept(&c->emergency, sub, &found->value, &found->octets);
    } else if (index == WATCHED) {
        result = read_watched(c, sub, found);
    } else if (index == SERVER) {
        result = read_server(c, sub, found);
    } else if (index == APP_CANOPEN_BLOCK) {
        result = app_canopen_block_selected(c, sub, &found->value, &found->octets);
    } else if (index == APP_CANOPEN_IDENTITY) {
        result = read_identity(r, sub, found);
    } else if (read_single(c, index, found)) {
        result = (sub == 0U) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
    } else {
        result = read_register(r, index, sub, found);
    }
    return result;
}

uint32_t app_canopen_dictionary_read(const app_canopen_t *c, const app_registers_t *r,
                                     uint16_t index, uint16_t sub, uint16_t *octets,
                                     uint16_t *count)
{
    found_t        found  = {.value = 0UL, .octets = 4U, .text = NULL};
    const uint32_t result = find_value(c, r, index, sub, &found);
    uint16_t       n      = 0U;

    if (found.text != NULL) {
        while ((n < TEXT_MOST) && ((unsigned char)found.text[n] != 0U)) {
            octets[n] = (uint16_t)((uint16_t)(unsigned char)found.text[n] & 0xFFU);
            n         = (uint16_t)(n + 1U);
        }
    } else {
        for (; n < found.octets; n++) {
            octets[n] = (uint16_t)((found.value >> (8UL * (uint32_t)n)) & 0xFFUL);
        }
    }
    *count = n;
    return result;
}

static uint32_t write_pdo(app_canopen_t *c, const pdo_place_t *place, uint16_t sub, uint32_t value)
{
    app_canopen_pdo_t *const p      = place->receives ? &c->received[place->n] : &c->sent[place->n];
    const uint32_t           result = (place->part == PDO_SETTING)
                                          ? app_canopen_pdo_set(p, sub, value)
                                          : app_canopen_pdo_map(p, sub, value, place->receives);

    if ((result == APP_CANOPEN_OK) && place->receives) {
        c->waiting = APP_CANOPEN_SYNC_NEW;
        app_canopen_node_listen(c);
    }
    return result;
}

static uint32_t write_watched(app_canopen_t *c, uint16_t sub, uint32_t value)
{
    const uint32_t node   = value >> 16U;
    uint32_t       result = APP_CANOPEN_VALUE;

    if (sub != 1U) {
        result = (sub == 0U) ? APP_CANOPEN_READ_ONLY : APP_CANOPEN_NO_SUB;
    } else if ((node <= NODE_ID_MOST) && (node != (uint32_t)c->node)) {
        c->watched = value;
        c->watches = false;
        app_canopen_node_listen(c);
        result = APP_CANOPEN_OK;
    } else {
        /* no such node, or its own */
    }
    return result;
}

static uint32_t write_errors(app_canopen_t *c, uint16_t sub, uint32_t value)
{
    uint32_t result = APP_CANOPEN_READ_ONLY;

    if (sub == 0U) {
        result = (value == 0UL) ? APP_CANOPEN_OK : APP_CANOPEN_VALUE;
        if (result == APP_CANOPEN_OK) {
            c->emergency.count  = 0U;
            c->emergency.unsent = 0U;
        }
    }
    return result;
}

static uint32_t write_object(app_registers_t *r, uint16_t index, uint16_t sub, uint32_t value)
{
    app_canopen_object_t object = {.index = 0U};
    uint32_t             result = app_canopen_objects_find(index, sub, &object);

    if (result == APP_CANOPEN_OK) {
        result = app_canopen_objects_put(r, &object, value);
    }
    return result;
}

static uint32_t put_value(app_canopen_t *c, app_registers_t *r, uint16_t index, uint16_t sub,
                          uint32_t value)
{
    const pdo_place_t pdo    = pdo_of(index);
    found_t           own    = {.value = 0UL, .octets = 0U, .text = NULL};
    uint32_t          result = APP_CANOPEN_OK;

    if (pdo.part != NO_PDO) {
        result = write_pdo(c, &pdo, sub, value);
    } else if (index == ERRORS) {
        result = write_errors(c, sub, value);
    } else if (index == WATCHED) {
        result = write_watched(c, sub, value);
    } else if (index == HEARTBEAT) {
        c->heartbeat_ms = (uint16_t)value;
    } else if (index == APP_CANOPEN_BLOCK) {
        result = app_canopen_block_select(c, sub, value);
    } else if ((index == SERVER) || (index == APP_CANOPEN_IDENTITY) ||
               read_single(c, index, &own)) {
        result = APP_CANOPEN_READ_ONLY;
    } else {
        result = write_object(r, index, sub, value);
    }
    return result;
}

/* An object is there and has `count` octets, or any number for 0. `octets` becomes their number. */
static uint32_t check_length(const app_canopen_t *c, const app_registers_t *r, uint16_t index,
                             uint16_t sub, uint16_t count, uint16_t *octets)
{
    found_t  now    = {.value = 0UL, .octets = 4U, .text = NULL};
    uint32_t result = find_value(c, r, index, sub, &now);

    *octets = now.octets;
    if ((result == APP_CANOPEN_OK) && (now.text != NULL)) {
        result = APP_CANOPEN_READ_ONLY;
    } else if ((result == APP_CANOPEN_OK) && (count != 0U) && (now.octets != count)) {
        result = APP_CANOPEN_LENGTH;
    } else {
        /* as it is */
    }
    return result;
}

uint32_t app_canopen_dictionary_write(app_canopen_t *c, app_registers_t *r, uint16_t index,
                                      uint16_t sub, const uint16_t *octets, uint16_t count)
{
    uint16_t all    = 0U;
    uint32_t value  = 0UL;
    uint32_t result = check_length(c, r, index, sub, count, &all);

    if (result == APP_CANOPEN_OK) {
        for (uint16_t n = all; n > 0U; n--) {
            value = (value << 8U) | ((uint32_t)octets[n - 1U] & 0xFFUL);
        }
        result = put_value(c, r, index, sub, value);
    }
    return result;
}
