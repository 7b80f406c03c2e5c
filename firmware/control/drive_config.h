/* SPDX-License-Identifier: MIT */
/**
 * @file drive_config.h
 * @brief Constants of one drive. sdre-gains generates them from the drive file.
 */
#ifndef DRIVE_CONFIG_H
#define DRIVE_CONFIG_H

#include "base.h"
#include "dead_time.h"
#include "law.h"
#include "motor.h"

/** Board, bridge and encoder data that the constants assume. The application compares them. */
typedef struct {
    uint32_t encoder_positions;  /**< per mechanical turn */
    uint16_t pole_pairs;         /**< 1 .. 64 */
    uint16_t updates_per_period; /**< control periods per PWM period, 1 or 2 */
    float    dead_time_s;        /**< of the bridge, 0 or more */
    bool     edge_times;         /**< angle and speed from the times of the encoder's edges */
} drive_hardware_t;

/** Everything that depends on the motor and the board: generated, constant, checked by
 * drive_init(). */
typedef struct drive_config {
    float ts_s;               /**< control period [s], 1e-5 .. 1e-2 */
    float current_max_A;      /**< current limit, peak; > 0 */
    float trip_current_A;     /**< a phase current beyond this is a fault, > current_max_A */
    float trip_speed_e_radps; /**< a speed beyond this is a fault, > 0 */
    float speed_max_e_radps;  /**< a command beyond this is a fault, > 0, <= trip_speed_e_radps */
    float dc_link_min_V;      /**< accepted dc link, > 0 */
    float dc_link_max_V;      /**< > dc_link_min_V */
    bool  positions;          /**< the law accepts positions too */
    bool  overmodulation;     /**< voltages may use the hexagon outside the circle */
    motor_reduced_t    motor;
    dead_time_config_t dead_time;
    float              rated_current_A; /**< peak, with the rated torque: 6075h; > 0 */
    float              rated_torque_Nm; /**< 6076h; > 0 */
    bool               torques; /**< the law accepts torques too; only if law_t.takes_torque */
    drive_hardware_t   hardware;
    const law_t       *law;       /**< control law: samples to voltage */
    const void        *constants; /**< of that law: law_noc_config_t for law_noc and so on */
} drive_config_t;

/**
 * @brief Checks that every constant, the law's too, is finite and within its documented range.
 *
 * @return CTL_OK or CTL_BAD_CONFIG.
 *
 * Context: init.
 */
ctl_status_t drive_config_check(const drive_config_t *config);

#endif /* DRIVE_CONFIG_H */
