/* SPDX-License-Identifier: MIT */
#include "app_modbus.h"

#include <stddef.h>

#define FUNCTION_READ_HOLDING 3U
#define FUNCTION_READ_INPUT   4U
#define FUNCTION_WRITE_ONE    6U
#define FUNCTION_WRITE_MANY   16U

#define EXCEPTION_FUNCTION 1U
#define EXCEPTION_ADDRESS  2U
#define EXCEPTION_VALUE    3U
#define EXCEPTION_FLAG     0x80U

#define ADDRESS_BROADCAST 0U
#define ADDRESS_MAX       247U

#define QUANTITY_READ_MAX  125U /* what fits a frame, by the protocol */
#define QUANTITY_WRITE_MAX 123U

#define FRAME_MIN    4U /* address, function, CRC */
#define REQUEST_SIZE 8U /* functions 3, 4 and 6 */
#define WRITE_HEAD   7U /* function 16, up to its data */

#define QUIET_GAPS 4U /* one ends the request; the answer to a command takes less than two more */

#define OCTETS_PER_POLL 16U /* depth of the receiver's FIFO */

ctl_status_t app_modbus_init(app_modbus_t *m, uint16_t address, uint16_t gap_ticks,
                             uint16_t timeout_ticks)
{
    m->address       = address;
    m->gap_ticks     = gap_ticks;
    m->timeout_ticks = timeout_ticks;
    m->rx_count      = 0U;
    m->rx_spoilt     = false;
    m->tx_count      = 0U;
    m->tx_sent       = 0U;
    m->heard_ticks   = 0UL;
    m->request_ticks = 0UL;
    return ((address >= 1U) && (address <= ADDRESS_MAX) && (gap_ticks > 0U) && (timeout_ticks > 0U))
               ? CTL_OK
               : CTL_BAD_CONFIG;
}

uint16_t app_modbus_crc(const uint16_t *octets, uint16_t count)
{
    uint16_t crc = 0xFFFFU;

    for (uint16_t i = 0U; i < count; i++) {
        crc = (uint16_t)(crc ^ octets[i]);
        for (uint16_t bit = 0U; bit < 8U; bit++) {
            const bool carry = (crc & 1U) != 0U;
            crc              = (uint16_t)(crc >> 1);
            if (carry) {
                crc = (uint16_t)(crc ^ 0xA001U); /* x^16 + x^15 + x^2 + 1, low bit first */
            }
        }
    }
    return crc;
}

static uint16_t word_at(const uint16_t *octets)
{
    return (uint16_t)((uint16_t)(octets[0] << 8) | octets[1]);
}

static void put_octet(app_modbus_t *m, uint16_t octet)
{
    m->tx_octets[m->tx_count] = (uint16_t)(octet & 0xFFU);
    m->tx_count               = (uint16_t)(m->tx_count + 1U);
}

static void put_word(app_modbus_t *m, uint16_t word)
{
    put_octet(m, (uint16_t)(word >> 8));
    put_octet(m, word);
}

static void put_head(app_modbus_t *m, uint16_t function)
{
    m->tx_count = 0U;
    m->tx_sent  = 0U;
    put_octet(m, m->address);
    put_octet(m, function);
}

static void answer_exception(app_modbus_t *m, uint16_t exception)
{
    put_head(m, (uint16_t)(m->rx_octets[1] | EXCEPTION_FLAG));
    put_octet(m, exception);
}

static void answer_refused(app_modbus_t *m, app_registers_result_t result)
{
    answer_exception(m,
                     (result == APP_REGISTERS_BAD_ADDRESS) ? EXCEPTION_ADDRESS : EXCEPTION_VALUE);
}

static void read_registers(app_modbus_t *m, const app_registers_t *r)
{
    const uint16_t first    = word_at(&m->rx_octets[2]);
    const uint16_t quantity = word_at(&m->rx_octets[4]);
    uint16_t       values[QUANTITY_READ_MAX];

    if ((quantity < 1U) || (quantity > QUANTITY_READ_MAX)) {
        answer_exception(m, EXCEPTION_VALUE);
        return;
    }
    const app_registers_result_t result =
        (m->rx_octets[1] == FUNCTION_READ_HOLDING)
            ? app_registers_read_holding(r, first, quantity, values)
            : app_registers_read_input(r, first, quantity, values);
    if (result != APP_REGISTERS_OK) {
        answer_refused(m, result);
        return;
    }
    put_head(m, m->rx_octets[1]);
    put_octet(m, (uint16_t)(2U * quantity));
    for (uint16_t i = 0U; i < quantity; i++) {
        put_word(m, values[i]);
    }
}

/* Both kinds of write answer with the first four octets of their data. */
static void answer_write(app_modbus_t *m, app_registers_result_t result)
{
    if (result != APP_REGISTERS_OK) {
        answer_refused(m, result);
        return;
    }
    put_head(m, m->rx_octets[1]);
    put_word(m, word_at(&m->rx_octets[2]));
    put_word(m, word_at(&m->rx_octets[4]));
}

static void write_many(app_modbus_t *m, app_registers_t *r)
{
    const uint16_t quantity = word_at(&m->rx_octets[4]);
    uint16_t       values[QUANTITY_WRITE_MAX];

    if ((quantity < 1U) || (quantity > QUANTITY_WRITE_MAX) ||
        (m->rx_octets[WRITE_HEAD - 1U] != (uint16_t)(2U * quantity))) {
        answer_exception(m, EXCEPTION_VALUE);
        return;
    }
    for (uint16_t i = 0U; i < quantity; i++) {
        values[i] = word_at(&m->rx_octets[WRITE_HEAD + (2U * i)]);
    }
    answer_write(m, app_registers_write(r, word_at(&m->rx_octets[2]), quantity, values));
}

static bool length_ok(const app_modbus_t *m)
{
    switch (m->rx_octets[1]) {
    case FUNCTION_READ_HOLDING:
    case FUNCTION_READ_INPUT:
    case FUNCTION_WRITE_ONE:
        return m->rx_count == REQUEST_SIZE;
    case FUNCTION_WRITE_MANY:
        return m->rx_count == (uint16_t)(WRITE_HEAD + m->rx_octets[WRITE_HEAD - 1U] + 2U);
    default:
        return true;
    }
}

static void answer(app_modbus_t *m, app_registers_t *r)
{
    switch (m->rx_octets[1]) {
    case FUNCTION_READ_HOLDING:
    case FUNCTION_READ_INPUT:
        read_registers(m, r);
        break;
    case FUNCTION_WRITE_ONE: {
        const uint16_t value = word_at(&m->rx_octets[4]);
        answer_write(m, app_registers_write(r, word_at(&m->rx_octets[2]), 1U, &value));
        break;
    }
    case FUNCTION_WRITE_MANY:
        write_many(m, r);
        break;
    default:
        answer_exception(m, EXCEPTION_FUNCTION);
        break;
    }
}

static bool frame_ok(const app_modbus_t *m)
{
    if (m->rx_spoilt || (m->rx_count < FRAME_MIN)) {
        return false;
    }
    const uint16_t body = (uint16_t)(m->rx_count - 2U);
    const uint16_t sent = (uint16_t)((uint16_t)(m->rx_octets[body + 1U] << 8) | m->rx_octets[body]);
    const uint16_t to   = m->rx_octets[0];
    return (sent == app_modbus_crc(m->rx_octets, body)) &&
           ((to == m->address) || (to == ADDRESS_BROADCAST)) && length_ok(m);
}

bool app_modbus_is_quiet(const app_modbus_t *m, uint32_t now_ticks)
{
    return (m->tx_sent == m->tx_count) &&
           ((uint32_t)(now_ticks - m->heard_ticks) >= (QUIET_GAPS * (uint32_t)m->gap_ticks));
}

static void end_frame(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks)
{
    if (frame_ok(m)) {
        const bool          ran    = r->command.run;
        const bool          all    = m->rx_octets[0] == ADDRESS_BROADCAST;
        app_loader_t *const loader = r->loader;

        m->request_ticks = now_ticks;
        r->loader        = all ? NULL : loader; /* nobody loads all drives at once */
        answer(m, r);
        r->loader = loader;
        if (all) {
            r->command.run = r->command.run && ran; /* it may stop all motors, and start none */
            m->tx_count    = 0U;
        } else {
            const uint16_t crc = app_modbus_crc(m->tx_octets, m->tx_count);
            put_octet(m, crc);
            put_octet(m, (uint16_t)(crc >> 8));
        }
    }
    m->rx_count  = 0U;
    m->rx_spoilt = false;
}

static void send(app_modbus_t *m)
{
    while ((m->tx_sent < m->tx_count) && board_serial_write(m->tx_octets[m->tx_sent])) {
        m->tx_sent = (uint16_t)(m->tx_sent + 1U);
    }
}

/* True when something came. */
static bool receive(app_modbus_t *m, uint32_t now_ticks)
{
    uint16_t octet = 0U;
    uint16_t taken = 0U;

    while ((taken < OCTETS_PER_POLL) && board_serial_read(&octet)) {
        taken = (uint16_t)(taken + 1U);
        if ((m->rx_count >= APP_MODBUS_FRAME_MAX) || (m->tx_sent < m->tx_count)) {
            m->rx_spoilt = true;
        } else {
            m->rx_octets[m->rx_count] = (uint16_t)(octet & 0xFFU);
            m->rx_count               = (uint16_t)(m->rx_count + 1U);
        }
    }
    if (taken > 0U) {
        m->heard_ticks = now_ticks;
    }
    return taken > 0U;
}

void app_modbus_poll(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks)
{
    send(m);
    if (!receive(m, now_ticks) && ((m->rx_count > 0U) || m->rx_spoilt) &&
        ((uint32_t)(now_ticks - m->heard_ticks) >= (uint32_t)m->gap_ticks)) {
        end_frame(m, r, now_ticks);
    }
    if ((uint32_t)(now_ticks - m->request_ticks) > (uint32_t)m->timeout_ticks) {
        app_registers_silence(r);
    }
}
