/* SPDX-License-Identifier: MIT */
#include "app_modbus_device.h"

#include <stddef.h>

#include "app_modbus_frame.h"

/* Sub-functions of 8, by the protocol. */
#define LOOP_BACK       0U
#define CLEAR           10U
#define COUNT_FRAMES    11U
#define COUNT_BAD       12U
#define COUNT_EXCEPTION 13U
#define COUNT_REQUESTS  14U
#define COUNT_SILENT    15U
#define COUNT_OVERRUNS  18U

#define DIAGNOSTICS_SIZE 8U /* length of all but the loop-back, with CRC */

#define MEI_IDENTIFY 14U
#define READ_BASIC   1U
#define READ_REGULAR 2U
#define READ_ALL     3U
#define READ_ONE     4U
#define CONFORMITY   0x83U /* all objects, as a stream or one by one */

#define LAST_BASIC   2U
#define LAST_REGULAR 0x7FU
#define LAST_ALL     0xFFU

#define OBJECTS  8U
#define TEXT_MAX 24U /* chosen: all objects fit one answer */

/* Source of an object: a text, a name in image words of two characters, or a hexadecimal number. */
typedef struct {
    uint16_t    id;
    const char *text;
} object_t;

static void answer_number(app_modbus_t *m, uint16_t number)
{
    app_modbus_frame_begin(m);
    app_modbus_frame_word(m, app_modbus_frame_asked(m, 2U));
    app_modbus_frame_word(m, number);
}

static void loop_back(app_modbus_t *m)
{
    const uint16_t end = (m->rx_count > 2U) ? (uint16_t)(m->rx_count - 2U) : 0U; /* CRC */

    app_modbus_frame_begin(m);
    for (uint16_t i = 2U; i < end; i++) {
        m->tx_octets[i] = (uint16_t)(m->rx_octets[i] & 0xFFU);
    }
    m->tx_count = end;
}

static void clear(app_modbus_t *m)
{
    const app_modbus_counts_t none = {.frames = 0U};
    m->counts                      = none;
}

static void tell_count(app_modbus_t *m, uint16_t which)
{
    switch (which) {
    case COUNT_FRAMES:
        answer_number(m, m->counts.frames);
        break;
    case COUNT_BAD:
        answer_number(m, m->counts.bad_frames);
        break;
    case COUNT_EXCEPTION:
        answer_number(m, m->counts.exceptions);
        break;
    case COUNT_REQUESTS:
        answer_number(m, m->counts.requests);
        break;
    case COUNT_SILENT:
        answer_number(m, m->counts.unanswered);
        break;
    case COUNT_OVERRUNS:
        answer_number(m, m->counts.overruns);
        break;
    default:
        app_modbus_frame_exception(m, APP_MODBUS_NO_FUNCTION);
        break;
    }
}

void app_modbus_device_diagnose(app_modbus_t *m)
{
    const uint16_t which = app_modbus_frame_asked(m, 2U);

    if (which == LOOP_BACK) {
        loop_back(m);
    } else if ((m->rx_count != DIAGNOSTICS_SIZE) || (app_modbus_frame_asked(m, 4U) != 0U)) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_VALUE);
    } else if (which == CLEAR) {
        clear(m);
        answer_number(m, 0U);
    } else {
        tell_count(m, which);
    }
}

static void put_text(app_modbus_t *m, const char *text)
{
    for (uint16_t n = 0U; (n < TEXT_MAX) && (text[n] != '\0'); n++) {
        app_modbus_frame_octet(m, (uint16_t)((uint16_t)text[n] & 0x7FU));
    }
}

static void put_object(app_modbus_t *m, const object_t *o)
{
    app_modbus_frame_octet(m, o->id);
    app_modbus_frame_octet(m, 0U); /* its length: below */
    const uint16_t at = m->tx_count;
    put_text(m, o->text);
    m->tx_octets[at - 1U] = (uint16_t)(m->tx_count - at);
}

/* Last object in a stream of this kind. */
static uint16_t last_of(uint16_t code)
{
    uint16_t last = LAST_ALL;

    if (code == READ_BASIC) {
        last = LAST_BASIC;
    } else if (code == READ_REGULAR) {
        last = LAST_REGULAR;
    } else {
        /* all objects */
    }
    return last;
}

static bool belongs(uint16_t id, uint16_t code, uint16_t wanted)
{
    const uint16_t last = last_of(code);

    return (id == wanted) || ((code != READ_ONE) && (id > wanted) && (id <= last));
}

static bool is_known(const object_t *objects, uint16_t id)
{
    bool known = false;

    for (uint16_t k = 0U; k < OBJECTS; k++) {
        known = known || (objects[k].id == id);
    }
    return known;
}

void app_modbus_device_identify(app_modbus_t *m, const app_registers_t *r)
{
    const object_t objects[OBJECTS] = {{0U, "sdre-drive"},
                                       {1U, "SDRE"},
                                       {2U, APP_REGISTERS_VERSION},
                                       {4U, "sdre-drive"},
                                       {0x80U, r->config->drive_name},
                                       {0x81U, r->config->digest},
                                       {0x82U, APP_REGISTERS_DIGEST},
                                       {0x83U, app_registers_board(r)}};
    const uint16_t code             = m->rx_octets[3];
    const uint16_t known            = is_known(objects, m->rx_octets[4]) ? 1U : 0U;
    const uint16_t wanted           = ((code == READ_ONE) || (known != 0U)) ? m->rx_octets[4] : 0U;
    uint16_t       count            = 0U;

    if (m->rx_octets[2] != MEI_IDENTIFY) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_FUNCTION);
        return;
    }
    if ((code < READ_BASIC) || (code > READ_ONE)) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_VALUE);
        return;
    }
    if ((code == READ_ONE) && (known == 0U)) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_ADDRESS);
        return;
    }
    app_modbus_frame_begin(m);
    app_modbus_frame_octet(m, MEI_IDENTIFY);
    app_modbus_frame_octet(m, code);
    app_modbus_frame_octet(m, CONFORMITY);
    app_modbus_frame_octet(m, 0U); /* nothing follows: all fits one answer */
    app_modbus_frame_octet(m, 0U);
    app_modbus_frame_octet(m, 0U); /* how many: below */
    const uint16_t at = (uint16_t)(m->tx_count - 1U);
    for (uint16_t k = 0U; k < OBJECTS; k++) {
        if (belongs(objects[k].id, code, wanted)) {
            put_object(m, &objects[k]);
            count = (uint16_t)(count + 1U);
        }
    }
    m->tx_octets[at] = count;
}
