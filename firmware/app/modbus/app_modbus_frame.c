/* SPDX-License-Identifier: MIT */
#include "app_modbus_frame.h"

#define EXCEPTION_FLAG 0x80U

uint16_t app_modbus_frame_function(const app_modbus_t *m)
{
    return m->rx_octets[1];
}

uint16_t app_modbus_frame_asked(const app_modbus_t *m, uint16_t at)
{
    return (uint16_t)((uint16_t)(m->rx_octets[at] << 8) | m->rx_octets[at + 1U]);
}

void app_modbus_frame_octet(app_modbus_t *m, uint16_t octet)
{
    if (m->tx_count < APP_MODBUS_FRAME_MAX) {
        m->tx_octets[m->tx_count] = (uint16_t)(octet & 0xFFU);
        m->tx_count               = (uint16_t)(m->tx_count + 1U);
    }
}

void app_modbus_frame_word(app_modbus_t *m, uint16_t word)
{
    app_modbus_frame_octet(m, (uint16_t)(word >> 8));
    app_modbus_frame_octet(m, word);
}

void app_modbus_frame_begin(app_modbus_t *m)
{
    m->tx_count = 0U;
    m->tx_sent  = 0U;
    app_modbus_frame_octet(m, m->address);
    app_modbus_frame_octet(m, app_modbus_frame_function(m));
}

void app_modbus_frame_exception(app_modbus_t *m, uint16_t exception)
{
    app_modbus_frame_begin(m);
    m->tx_octets[1] = (uint16_t)(m->tx_octets[1] | EXCEPTION_FLAG);
    app_modbus_frame_octet(m, exception);
    m->counts.exceptions = (uint16_t)(m->counts.exceptions + 1U);
}
