/* SPDX-License-Identifier: MIT */
#include "app_modbus.h"

#include <stddef.h>

#include "app_modbus_answer.h"
#include "app_modbus_frame.h"

#define ADDRESS_BROADCAST 0U

#define FRAME_MIN 4U /* address, function, CRC */

#define QUIET_GAPS 4U /* one gap ends the request; the answer takes less than two more */

#define GAP_OCTETS 3.5f  /* by the protocol, as the next */
#define OCTET_BITS 11.0f /* start, eight, parity or a second stop, stop */

#define OCTETS_PER_POLL 16U /* depth of the receiver's FIFO */

ctl_status_t app_modbus_init(app_modbus_t *m, uint16_t gap_ticks)
{
    const app_modbus_counts_t none = {.frames = 0U};

    m->gap_ticks     = gap_ticks;
    m->address       = ADDRESS_BROADCAST;
    m->rx_count      = 0U;
    m->rx_spoilt     = false;
    m->tx_count      = 0U;
    m->tx_sent       = 0U;
    m->heard_ticks   = 0UL;
    m->request_ticks = 0UL;
    m->counts        = none;
    return (gap_ticks > 0U) ? CTL_OK : CTL_BAD_CONFIG;
}

void app_modbus_follow(app_modbus_t *m, const board_line_t *line, float ts_s, uint16_t least_ticks)
{
    const float silence_s = GAP_OCTETS * OCTET_BITS / (float)line->baud_Bd;
    /* rounded up, plus one: the first tick may be almost over */
    const float    up    = base_min(silence_s / ts_s, 65000.0f) + 2.0f;
    const uint16_t ticks = (uint16_t)up;

    m->gap_ticks = (ticks > least_ticks) ? ticks : least_ticks;
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

static void count(uint16_t *counter)
{
    *counter = (uint16_t)(*counter + 1U);
}

/* True if the frame has a good CRC, for any server. */
static bool frame_ok(app_modbus_t *m)
{
    if (m->rx_spoilt) {
        count(&m->counts.overruns);
        return false;
    }
    if (m->rx_count < FRAME_MIN) {
        count(&m->counts.bad_frames);
        return false;
    }
    const uint16_t body = (uint16_t)(m->rx_count - 2U);
    const uint16_t sent = (uint16_t)((uint16_t)(m->rx_octets[body + 1U] << 8) | m->rx_octets[body]);
    const bool     good = sent == app_modbus_crc(m->rx_octets, body);
    count(good ? &m->counts.frames : &m->counts.bad_frames);
    return good;
}

static void put_crc(app_modbus_t *m)
{
    const uint16_t crc = app_modbus_crc(m->tx_octets, m->tx_count);

    app_modbus_frame_octet(m, crc);
    app_modbus_frame_octet(m, (uint16_t)(crc >> 8));
}

bool app_modbus_is_quiet(const app_modbus_t *m, uint32_t now_ticks)
{
    return (m->tx_sent == m->tx_count) &&
           ((uint32_t)(now_ticks - m->heard_ticks) >= (QUIET_GAPS * (uint32_t)m->gap_ticks));
}

static void take_request(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks)
{
    const uint16_t                before     = r->requested.objects.controlword;
    const bool                    all        = m->rx_octets[0] == ADDRESS_BROADCAST;
    app_loader_t *const           loader     = r->loader;
    const app_parameters_t *const parameters = r->parameters;

    m->request_ticks = now_ticks;
    count(&m->counts.requests);
    r->loader     = all ? NULL : loader; /* a broadcast cannot load drives */
    r->parameters = all ? NULL : parameters;
    app_modbus_answer(m, r);
    r->loader     = loader;
    r->parameters = parameters;
    if (all) {
        if (app_control_enables(r->requested.objects.controlword) && !app_control_enables(before)) {
            r->requested.objects.controlword =
                before; /* a broadcast may stop motors, but not start them */
        }
        m->tx_count = 0U;
        count(&m->counts.unanswered);
    } else {
        put_crc(m);
    }
}

static void end_frame(app_modbus_t *m, app_registers_t *r, uint32_t now_ticks)
{
    if (frame_ok(m)) {
        const uint16_t to = m->rx_octets[0];

        m->address = r->requested.modbus_address;
        if (((to == m->address) || (to == ADDRESS_BROADCAST)) && app_modbus_answer_length_ok(m)) {
            take_request(m, r, now_ticks);
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

/* True if an octet was received. */
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
    if (!r->by_can &&
        ((uint32_t)(now_ticks - m->request_ticks) > r->requested.modbus_timeout_ticks)) {
        app_registers_silence(r);
    }
}
