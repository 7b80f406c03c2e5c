/* SPDX-License-Identifier: MIT */
#include "app_canopen_block.h"

#include <stddef.h>

#include "app_canopen_objects.h"

/* Sub-indices of 5F00h. */
#define SELECTION 1U
#define INPUTS    2U
#define HOLDINGS  3U /* the highest */

static uint16_t first_of(const app_canopen_t *c)
{
    return (uint16_t)(c->block & 0xFFFFUL);
}

bool app_canopen_block_has(uint16_t index, uint16_t sub)
{
    return (index == APP_CANOPEN_BLOCK) && ((sub == INPUTS) || (sub == HOLDINGS));
}

uint32_t app_canopen_block_select(app_canopen_t *c, uint16_t sub, uint32_t value)
{
    const uint32_t count  = value >> 16U;
    uint32_t       result = APP_CANOPEN_VALUE;

    if (sub != SELECTION) {
        result = (sub == 0U) ? APP_CANOPEN_READ_ONLY : APP_CANOPEN_NO_SUB;
    } else if ((count > 0UL) && (count <= APP_CANOPEN_SDO_WORDS)) {
        c->block = (count << 16U) + (value & 0xFFFFUL); /* so tests/prove sees both parts */
        result   = APP_CANOPEN_OK;
    } else {
        /* none, or more than a transfer holds */
    }
    return result;
}

uint32_t app_canopen_block_selected(const app_canopen_t *c, uint16_t sub, uint32_t *value,
                                    uint16_t *octets)
{
    *value  = (sub == 0U) ? HOLDINGS : c->block;
    *octets = (uint16_t)((sub == 0U) ? 1U : 4U);
    return (sub <= SELECTION) ? APP_CANOPEN_OK : APP_CANOPEN_NO_SUB;
}

uint32_t app_canopen_block_read(const app_canopen_t *c, const app_registers_t *r, uint16_t sub,
                                uint16_t *words, uint16_t *octets)
{
    const uint16_t               count = (uint16_t)(c->block >> 16U);
    const app_registers_result_t result =
        (sub == INPUTS) ? app_registers_read_input(r, first_of(c), count, words)
                        : app_registers_read_holding(r, first_of(c), count, words);

    *octets = (uint16_t)(2U * count);
    return app_canopen_objects_result(result);
}

uint32_t app_canopen_block_write(const app_canopen_t *c, app_registers_t *r, uint16_t sub,
                                 const uint16_t *words, uint16_t octets)
{
    uint32_t result;

    if (sub != HOLDINGS) {
        result = APP_CANOPEN_READ_ONLY;
    } else if ((octets == 0U) || ((octets & 1U) != 0U)) {
        result = APP_CANOPEN_LENGTH;
    } else {
        result = app_canopen_objects_write_words(r, first_of(c), (uint16_t)(octets >> 1U), words);
    }
    return result;
}

const char *app_canopen_block_text(const app_registers_t *r, uint16_t sub)
{
    const char *text = NULL;

    switch (sub) {
    case 1U:
        text = r->config->drive_name;
        break;
    case 2U:
        text = r->config->digest;
        break;
    case 3U:
        text = APP_REGISTERS_DIGEST;
        break;
    case APP_CANOPEN_IDENTITY_SUBS:
        text = app_registers_board(r);
        break;
    default:
        break; /* there is none */
    }
    return text;
}
