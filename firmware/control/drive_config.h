/* SPDX-License-Identifier: MIT */
/**
 * @file drive_config.h
 * @brief The constants of one drive, made by sdre-gains from its drive file.
 */
#ifndef DRIVE_CONFIG_H
#define DRIVE_CONFIG_H

#include "base.h"
#include "current_ref.h"
#include "motor.h"
#include "nodo.h"
#include "nosc.h"

/** Everything that depends on the motor and the board: generated, constant, checked by drive_init(). */
typedef struct {
    float           ts_s;               /**< control period [s], 1e-5 .. 1e-2 */
    float           accel_max_e_radps2; /**< of the speed reference, > 0 */
    float           trip_current_A; /**< a phase current beyond this is a fault, > current_max_A */
    float           trip_speed_e_radps; /**< a speed beyond this is a fault, > 0 */
    float           dc_link_min_V;      /**< accepted dc link, > 0 */
    float           dc_link_max_V;      /**< > dc_link_min_V */
    motor_reduced_t motor;
    current_ref_config_t current_ref;
    nosc_gains_t         nosc;
    nodo_gains_t         nodo;
} drive_config_t;

/**
 * @brief CTL_OK when every constant is finite and within its documented range.
 *
 * Context: init.
 */
ctl_status_t drive_config_check(const drive_config_t *config);

#endif /* DRIVE_CONFIG_H */
