/* SPDX-License-Identifier: MIT */
#include "app_canopen_emergency.h"

#include "app_error.h"

#define OCTET 0xFFU

/* Bits of 1001h. */
#define GENERIC       0x01U
#define CURRENT       0x02U
#define VOLTAGE       0x04U
#define TEMPERATURE   0x08U
#define COMMUNICATION 0x10U
#define PROFILE       0x20U
#define OWN           0x80U

/* The newest is the first. */
static void keep_error(app_canopen_emergency_t *e, uint16_t code, uint16_t more)
{
    for (uint16_t k = APP_CANOPEN_ERRORS - 1U; k > 0U; k--) {
        e->errors[k] = e->errors[k - 1U];
    }
    e->errors[0].code = code;
    e->errors[0].more = more;
    if (e->count < APP_CANOPEN_ERRORS) {
        e->count = (uint16_t)(e->count + 1U);
    }
    if (e->unsent < APP_CANOPEN_ERRORS) {
        e->unsent = (uint16_t)(e->unsent + 1U);
    }
}

void app_canopen_emergency_tell(app_canopen_emergency_t *e, uint16_t code)
{
    keep_error(e, code, 0U);
}

/* Code 0 says that no error is left. */
void app_canopen_emergency_hold(app_canopen_emergency_t *e, bool holds)
{
    if (e->communication && !holds && (e->fault == 0U)) {
        keep_error(e, APP_CANOPEN_NO_ERROR, 0U);
    }
    e->communication = holds;
}

void app_canopen_emergency_see(app_canopen_emergency_t *e, const app_status_t *status)
{
    const uint16_t code = app_error_code(status->fault, status->drive_fault);
    const uint16_t high = (uint16_t)((uint16_t)status->drive_fault << 8U);
    const uint16_t more = (uint16_t)(high | ((uint16_t)status->fault & OCTET));

    if (code != e->fault) {
        e->fault = code;
        if ((code != 0U) || !e->communication) {
            keep_error(e, code, (code == 0U) ? 0U : more);
        }
    }
}

/* The first digit of a code says what it is about. */
static uint16_t kind_of(uint16_t code)
{
    static const uint16_t by_digit[16] = {0U,      GENERIC, CURRENT, VOLTAGE, TEMPERATURE, GENERIC,
                                          GENERIC, PROFILE, PROFILE, GENERIC, GENERIC,     GENERIC,
                                          GENERIC, GENERIC, GENERIC, OWN};

    return by_digit[code >> 12U];
}

uint16_t app_canopen_emergency_register(const app_canopen_emergency_t *e)
{
    const uint16_t kind  = kind_of(e->fault);
    const uint16_t bus   = e->communication ? COMMUNICATION : 0U;
    const uint16_t found = (uint16_t)(kind | bus);

    return (found != 0U) ? (uint16_t)(found | GENERIC) : 0U;
}

void app_canopen_emergency_send(app_canopen_t *c)
{
    app_canopen_emergency_t *const e = &c->emergency;

    if (e->unsent > 0U) {
        const app_canopen_error_t *const oldest = &e->errors[e->unsent - 1U];
        board_can_frame_t frame = {.id     = (uint16_t)(APP_CANOPEN_ID_EMERGENCY + c->node),
                                   .length = 8U};

        frame.octets[0] = (uint16_t)(oldest->code & OCTET);
        frame.octets[1] = (uint16_t)(oldest->code >> 8U);
        frame.octets[2] = app_canopen_emergency_register(e);
        frame.octets[3] = (uint16_t)(oldest->more & OCTET);
        frame.octets[4] = (uint16_t)(oldest->more >> 8U);
        if (app_canopen_node_send(c, &frame)) {
            e->unsent = (uint16_t)(e->unsent - 1U);
        }
    }
}

uint32_t app_canopen_emergency_kept(const app_canopen_emergency_t *e, uint16_t sub, uint32_t *value,
                                    uint16_t *octets)
{
    uint32_t result = APP_CANOPEN_OK;

    if (sub == 0U) {
        *value  = e->count;
        *octets = 1U;
    } else if (sub <= e->count) {
        const app_canopen_error_t *const one = &e->errors[sub - 1U];

        *value  = ((uint32_t)one->more << 16U) | one->code;
        *octets = 4U;
    } else {
        result = APP_CANOPEN_NO_SUB;
    }
    return result;
}
