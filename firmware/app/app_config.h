/* SPDX-License-Identifier: MIT */
/**
 * @file app_config.h
 * @brief The constants of one board, by const pointer; made by hand, each with its derivation (board_config.h).
 */
#ifndef APP_CONFIG_H
#define APP_CONFIG_H

#include "app_align.h"
#include "app_angle.h"
#include "app_gate.h"
#include "app_scale.h"

typedef struct {
    float              ts_s; /**< control period of the board; the drive's must be the same */
    app_scale_config_t scale;
    app_angle_config_t angle;
    app_align_config_t align;
    app_gate_config_t  gate;
    float              temperature_limit_degC; /**< no start above */
    float              temperature_trip_degC;  /**< fault above; > the limit */
    uint16_t           boot_ticks;
    uint16_t           calibrate_ticks;  /**< samples in the mean of a current's zero, > 0 */
    uint16_t           background_ticks; /**< without the background for longer is a fault, > 0 */
    uint16_t           modbus_address;   /**< 1 .. 247 */
    uint16_t           modbus_gap_ticks; /**< silence that ends a frame, > 0 */
    uint16_t           modbus_timeout_ticks; /**< silence that withdraws run, > 0 */
} app_config_t;

#endif /* APP_CONFIG_H */
