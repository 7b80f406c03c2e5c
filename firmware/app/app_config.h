/* SPDX-License-Identifier: MIT */
/**
 * @file app_config.h
 * @brief Constants of one board with its drive. sdre-gains generates them from the drive file.
 *
 * Times are in ticks. In board_config.c a tick is a PWM period. app_init() converts them to control
 * periods for a drive with two updates per PWM period.
 */
#ifndef APP_CONFIG_H
#define APP_CONFIG_H

#include "app_align.h"
#include "app_angle.h"
#include "app_chopper.h"
#include "app_gate.h"
#include "app_scale.h"
#include "app_stop.h"
#include "app_watch_heat.h"

typedef struct {
    board_setup_t           board;
    float                   pwm_period_s; /**< the drive's control period times its updates */
    float                   dead_time_s;  /**< of the gates; the drive's must be the same */
    app_scale_config_t      scale;
    app_angle_config_t      angle;
    app_align_config_t      align;
    app_gate_config_t       gate;
    app_stop_config_t       stop;
    app_watch_heat_config_t heat;
    app_chopper_config_t    chopper;
    float       zero_drift_A; /**< allowed drift of a current offset with the bridge open, > 0 */
    float       temperature_limit_degC; /**< no start above */
    float       temperature_trip_degC;  /**< fault above; > the limit */
    uint16_t    boot_ticks;
    uint16_t    calibrate_ticks;      /**< samples in the mean of a current's zero, > 0 */
    uint16_t    background_ticks;     /**< longest time without background, > 0 */
    uint16_t    modbus_address;       /**< 1 .. 247 */
    uint16_t    modbus_gap_ticks;     /**< silence that ends a frame, > 0 */
    uint16_t    modbus_timeout_ticks; /**< silence that withdraws run, > 0 */
    const char *drive_name;           /**< for the identification over Modbus, as the next */
    const char *digest;               /**< of the drive file */
} app_config_t;

/** Copies the constants and converts their times from PWM to control periods. Context: init. */
void app_config_for(app_config_t *out, const app_config_t *config, uint16_t updates_per_period);

#endif /* APP_CONFIG_H */
