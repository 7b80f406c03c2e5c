/* SPDX-License-Identifier: MIT */
/**
 * @file modbus_frame.h
 * @brief A request with its sum, as the fake board receives it.
 */
#ifndef MODBUS_FRAME_H
#define MODBUS_FRAME_H

#include "app_modbus.h"
#include "fake_board.h"

#define MODBUS_FRAME_MOST 32

/** Address, function and data of a frame, at most MODBUS_FRAME_MOST octets. */
static inline void modbus_frame_receive(const int *octets, int count)
{
    uint16_t words[MODBUS_FRAME_MOST];
    int      all[MODBUS_FRAME_MOST + 2];

    for (int n = 0; n < count; n++) {
        words[n] = (uint16_t)octets[n];
        all[n]   = octets[n];
    }
    const uint16_t crc = app_modbus_crc(words, (uint16_t)count);
    all[count]         = crc & 0xFF;
    all[count + 1]     = crc >> 8;
    fake_board_receive(all, count + 2);
}

#endif /* MODBUS_FRAME_H */
