/* SPDX-License-Identifier: MIT */
#include "app_canopen_objects.h"

#include <stddef.h>

#include "app_registers_count.h"
#include "app_registers_place.h"

#define WORD_MASK 0xFFFFUL

/* Row of a register by its address; NULL: there is none, or it is the second half of one. */
static const app_registers_entry_t *entry_at(const app_registers_entry_t *rows, uint16_t count,
                                             uint16_t address)
{
    const app_registers_entry_t *found = NULL;

    for (uint16_t k = 0U; (k < count) && (found == NULL); k++) {
        if (rows[k].address == address) {
            found = &rows[k];
        }
    }
    return found;
}

static uint32_t find_register(uint16_t index, uint16_t sub, app_canopen_object_t *found)
{
    const bool                         input = index >= APP_CANOPEN_INPUT;
    const app_registers_entry_t *const entry =
        input ? entry_at(app_registers_map_input, APP_REGISTERS_MAP_INPUT,
                         (uint16_t)(index - APP_CANOPEN_INPUT))
              : entry_at(app_registers_map_holding, APP_REGISTERS_MAP_HOLDING,
                         (uint16_t)(index - APP_CANOPEN_HOLDING));
    uint32_t result = APP_CANOPEN_NO_OBJECT;

    if (entry != NULL) {
        found->index    = index;
        found->sub      = 0U;
        found->octets   = (uint16_t)(2U * app_registers_count_words(entry));
        found->writable = !input;
        found->entry    = entry;
        found->value    = 0UL;
        result          = (sub == 0U) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
    }
    return result;
}

static uint32_t find_standard(uint16_t index, uint16_t sub, app_canopen_object_t *found)
{
    uint32_t result = APP_CANOPEN_NO_OBJECT;

    for (uint16_t k = 0U; (k < APP_CANOPEN_OBJECTS) && (result != APP_CANOPEN_OK); k++) {
        if (app_canopen_map[k].index == index) {
            result = APP_CANOPEN_NO_SUB;
            if (app_canopen_map[k].sub == sub) {
                *found = app_canopen_map[k];
                result = APP_CANOPEN_OK;
            }
        }
    }
    return result;
}

uint32_t app_canopen_objects_find(uint16_t index, uint16_t sub, app_canopen_object_t *found)
{
    const bool is_register =
        (index >= APP_CANOPEN_HOLDING) && (index < (APP_CANOPEN_INPUT + APP_REGISTERS_INPUTS_TOO));

    return is_register ? find_register(index, sub, found) : find_standard(index, sub, found);
}

uint32_t app_canopen_objects_value(const app_registers_t *r, const app_canopen_object_t *o)
{
    return (o->entry != NULL) ? app_registers_place_value(r, o->entry) : o->value;
}

static uint32_t mask_of(uint16_t octets)
{
    const uint32_t all = 0xFFFFFFFFU;

    return (octets < 4U) ? ~(all << (8UL * (uint32_t)octets)) : all;
}

/* The low octets of a value, with the sign in all 32 bits if the register has one. */
static uint32_t extended(const app_registers_entry_t *entry, uint16_t octets, uint32_t value)
{
    const bool is_signed = (entry->type == APP_REGISTERS_I16) || (entry->type == APP_REGISTERS_I32);
    const uint32_t mask  = mask_of(octets);
    const uint32_t sign  = mask & ~(mask >> 1U);
    uint32_t       out   = value & mask;

    if (is_signed && ((out & sign) != 0U)) {
        out |= ~mask;
    }
    return out;
}

/* True if the register's type holds the value. */
static bool holds(const app_registers_entry_t *entry, uint32_t value)
{
    bool ok = true;

    if (entry->type == APP_REGISTERS_U16) {
        ok = value <= WORD_MASK;
    } else if (entry->type == APP_REGISTERS_I16) {
        ok = (uint32_t)(value + 0x8000U) <= WORD_MASK;
    } else {
        /* 32 bits */
    }
    return ok;
}

uint32_t app_canopen_objects_result(app_registers_result_t result)
{
    uint32_t code = APP_CANOPEN_VALUE;

    switch (result) {
    case APP_REGISTERS_OK:
        code = APP_CANOPEN_OK;
        break;
    case APP_REGISTERS_BAD_ADDRESS:
        code = APP_CANOPEN_NO_OBJECT;
        break;
    case APP_REGISTERS_BUSY:
        code = APP_CANOPEN_STATE;
        break;
    case APP_REGISTERS_BAD_VALUE:
    default:
        break;
    }
    return code;
}

uint32_t app_canopen_objects_write_words(app_registers_t *r, uint16_t first, uint16_t count,
                                         const uint16_t *words)
{
    const app_registers_result_t result = app_registers_write(r, first, count, words);

    if ((result == APP_REGISTERS_OK) && (first == (uint16_t)APP_REGISTERS_CONTROLWORD)) {
        r->by_can = true;
    }
    return app_canopen_objects_result(result);
}

/* Words of a register, the high one first. @return their number. */
static uint16_t words_of(const app_registers_entry_t *entry, uint32_t value, uint16_t words[2])
{
    const uint16_t high = (uint16_t)((value >> 16U) & WORD_MASK);
    const uint16_t low  = (uint16_t)(value & WORD_MASK);
    const uint16_t all  = app_registers_count_words(entry);

    words[0] = (all == 2U) ? high : low;
    words[1] = low;
    return all;
}

uint32_t app_canopen_objects_write(app_registers_t *r, const app_registers_entry_t *entry,
                                   uint16_t octets, uint32_t value)
{
    const uint32_t whole  = extended(entry, octets, value);
    uint32_t       result = APP_CANOPEN_VALUE;

    if (holds(entry, whole)) {
        uint16_t       words[2];
        const uint16_t count = words_of(entry, whole, words);

        result = app_canopen_objects_write_words(r, entry->address, count, words);
    }
    return result;
}

bool app_canopen_objects_try(app_registers_t *r, const app_registers_entry_t *entry,
                             uint16_t octets, uint32_t value)
{
    const uint32_t whole = extended(entry, octets, value);
    bool           ok    = holds(entry, whole);

    if (ok) {
        uint16_t       words[2];
        const uint16_t count = words_of(entry, whole, words);

        ok = app_registers_try(r, entry->address, count, words) == APP_REGISTERS_OK;
    }
    return ok;
}

uint32_t app_canopen_objects_put(app_registers_t *r, const app_canopen_object_t *o, uint32_t value)
{
    uint32_t result = APP_CANOPEN_VALUE;

    if (!o->writable) {
        result = APP_CANOPEN_READ_ONLY;
    } else if (o->entry != NULL) {
        result = app_canopen_objects_write(r, o->entry, o->octets, value);
    } else if (((value ^ o->value) & mask_of(o->octets)) == 0U) {
        result = APP_CANOPEN_OK;
    } else {
        /* not the value of the constant */
    }
    return result;
}
