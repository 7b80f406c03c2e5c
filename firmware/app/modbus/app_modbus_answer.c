/* SPDX-License-Identifier: MIT */
#include "app_modbus_answer.h"

#include "app_modbus_device.h"
#include "app_modbus_frame.h"

#define FUNCTION_READ_HOLDING 3U
#define FUNCTION_READ_INPUT   4U
#define FUNCTION_WRITE_ONE    6U
#define FUNCTION_DIAGNOSTICS  8U
#define FUNCTION_WRITE_MANY   16U
#define FUNCTION_EXCHANGE     23U
#define FUNCTION_IDENTIFY     43U

#define WRITE_MAX    123U /* registers that fit a request, by the protocol */
#define EXCHANGE_MAX 121U

#define REQUEST_SIZE      8U /* functions 3, 4 and 6 */
#define DIAGNOSTICS_LEAST 8U
#define IDENTIFY_SIZE     7U
#define WRITE_HEAD        7U  /* function 16, up to its data */
#define EXCHANGE_HEAD     11U /* function 23 */

static void refuse(app_modbus_t *m, app_registers_result_t result)
{
    const uint16_t exception = (result == APP_REGISTERS_BAD_ADDRESS) ? APP_MODBUS_NO_ADDRESS
                               : (result == APP_REGISTERS_BUSY)      ? APP_MODBUS_NOT_NOW
                                                                     : APP_MODBUS_NO_VALUE;
    app_modbus_frame_exception(m, exception);
}

/* Number of registers at an index of the request; 0: too many. */
static uint16_t asked_quantity(const app_modbus_t *m, uint16_t at, uint16_t most)
{
    const uint16_t quantity = app_modbus_frame_asked(m, at);

    return (quantity <= most) ? quantity : 0U;
}

/* Reads registers; address and quantity are at index `at` of the request. */
static void read_registers(app_modbus_t *m, const app_registers_t *r, uint16_t at)
{
    const uint16_t first    = app_modbus_frame_asked(m, at);
    const uint16_t quantity = asked_quantity(m, (uint16_t)(at + 2U), APP_MODBUS_READ_MAX);

    if (quantity == 0U) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_VALUE);
        return;
    }
    const app_registers_result_t result =
        (app_modbus_frame_function(m) == FUNCTION_READ_INPUT)
            ? app_registers_read_input(r, first, quantity, m->values)
            : app_registers_read_holding(r, first, quantity, m->values);
    if (result != APP_REGISTERS_OK) {
        refuse(m, result);
        return;
    }
    app_modbus_frame_begin(m);
    app_modbus_frame_octet(m, (uint16_t)(2U * quantity));
    for (uint16_t i = 0U; i < quantity; i++) {
        app_modbus_frame_word(m, m->values[i]);
    }
}

/* Both kinds of write answer with the first four octets of their data. */
static void answer_write(app_modbus_t *m, app_registers_result_t result)
{
    if (result != APP_REGISTERS_OK) {
        refuse(m, result);
        return;
    }
    app_modbus_frame_begin(m);
    app_modbus_frame_word(m, app_modbus_frame_asked(m, 2U));
    app_modbus_frame_word(m, app_modbus_frame_asked(m, 4U));
}

/* Takes address, quantity, octet count and data from index `at` on. False: the quantity is
 * invalid. */
static bool take_values(app_modbus_t *m, uint16_t at, uint16_t most)
{
    const uint16_t quantity = asked_quantity(m, (uint16_t)(at + 2U), most);

    if ((quantity == 0U) || (m->rx_octets[at + 4U] != (uint16_t)(2U * quantity))) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_VALUE);
        return false;
    }
    for (uint16_t i = 0U; i < quantity; i++) {
        m->values[i] = app_modbus_frame_asked(m, (uint16_t)(at + 5U + (2U * i)));
    }
    return true;
}

static app_registers_result_t write_values(app_modbus_t *m, app_registers_t *r, uint16_t at,
                                           uint16_t most)
{
    return app_registers_write(r, app_modbus_frame_asked(m, at),
                               asked_quantity(m, (uint16_t)(at + 2U), most), m->values);
}

static void write_one(app_modbus_t *m, app_registers_t *r)
{
    m->values[0] = app_modbus_frame_asked(m, 4U);
    answer_write(m, app_registers_write(r, app_modbus_frame_asked(m, 2U), 1U, m->values));
}

static void write_many(app_modbus_t *m, app_registers_t *r)
{
    if (take_values(m, 2U, WRITE_MAX)) {
        answer_write(m, write_values(m, r, 2U, WRITE_MAX));
    }
}

/* Writes, then reads. If the read would fail, nothing is written. */
static void exchange(app_modbus_t *m, app_registers_t *r)
{
    const uint16_t first    = app_modbus_frame_asked(m, 2U);
    const uint16_t quantity = asked_quantity(m, 4U, APP_MODBUS_READ_MAX);

    if (quantity == 0U) {
        app_modbus_frame_exception(m, APP_MODBUS_NO_VALUE);
        return;
    }
    const app_registers_result_t readable =
        app_registers_read_holding(r, first, quantity, m->values);
    if (readable != APP_REGISTERS_OK) {
        refuse(m, readable);
        return;
    }
    if (!take_values(m, 6U, EXCHANGE_MAX)) {
        return;
    }
    const app_registers_result_t result = write_values(m, r, 6U, EXCHANGE_MAX);
    if (result != APP_REGISTERS_OK) {
        refuse(m, result);
        return;
    }
    read_registers(m, r, 2U);
}

bool app_modbus_answer_length_ok(const app_modbus_t *m)
{
    switch (app_modbus_frame_function(m)) {
    case FUNCTION_READ_HOLDING:
    case FUNCTION_READ_INPUT:
    case FUNCTION_WRITE_ONE:
        return m->rx_count == REQUEST_SIZE;
    case FUNCTION_DIAGNOSTICS:
        return m->rx_count >= DIAGNOSTICS_LEAST;
    case FUNCTION_IDENTIFY:
        return m->rx_count == IDENTIFY_SIZE;
    case FUNCTION_WRITE_MANY:
        return (m->rx_count > WRITE_HEAD) &&
               (m->rx_count == (uint16_t)(WRITE_HEAD + m->rx_octets[WRITE_HEAD - 1U] + 2U));
    case FUNCTION_EXCHANGE:
        return (m->rx_count > EXCHANGE_HEAD) &&
               (m->rx_count == (uint16_t)(EXCHANGE_HEAD + m->rx_octets[EXCHANGE_HEAD - 1U] + 2U));
    default:
        return true;
    }
}

void app_modbus_answer(app_modbus_t *m, app_registers_t *r)
{
    switch (app_modbus_frame_function(m)) {
    case FUNCTION_READ_HOLDING:
    case FUNCTION_READ_INPUT:
        read_registers(m, r, 2U);
        break;
    case FUNCTION_WRITE_ONE:
        write_one(m, r);
        break;
    case FUNCTION_DIAGNOSTICS:
        app_modbus_device_diagnose(m);
        break;
    case FUNCTION_WRITE_MANY:
        write_many(m, r);
        break;
    case FUNCTION_EXCHANGE:
        exchange(m, r);
        break;
    case FUNCTION_IDENTIFY:
        app_modbus_device_identify(m, r);
        break;
    default:
        app_modbus_frame_exception(m, APP_MODBUS_NO_FUNCTION);
        break;
    }
}
