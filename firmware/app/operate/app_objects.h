/* SPDX-License-Identifier: MIT */
/**
 * @file app_objects.h
 * @brief What the operator wants, as objects of CiA 402, and the states that it is told. Numbers: docs/modbus.md.
 */
#ifndef APP_OBJECTS_H
#define APP_OBJECTS_H

#include "app_commission.h"

typedef enum {
    APP_CONTROL_NOT_READY = 0, /**< boots, measures the zeros of its current sensors */
    APP_CONTROL_SWITCH_ON_DISABLED,
    APP_CONTROL_READY_TO_SWITCH_ON,
    APP_CONTROL_SWITCHED, /**< switched on; the bridge stays off */
    APP_CONTROL_OPERATION_ENABLED,
    APP_CONTROL_QUICK_STOP_ACTIVE,
    APP_CONTROL_FAULT_REACTION_ACTIVE, /**< the motor is shorted until it is slow */
    APP_CONTROL_FAULT,
    APP_CONTROL_STATES
} app_control_state_t;

/** Modes of operation: 6060h. */
enum {
    APP_CONTROL_COMMISSIONING    = -1, /**< finds the motor, commission.h */
    APP_CONTROL_PROFILE_POSITION = 1,  /**< app_setpoint.h; of drives that take positions */
    APP_CONTROL_PROFILE_VELOCITY = 3,
    APP_CONTROL_HOMING           = 6 /**< finds the angle, app_align.h */
};

typedef struct {
    uint16_t controlword;
    int16_t  mode_of_operation;
    float    omega_e_radps;  /**< wanted speed; out of the drive's range is a fault */
    float    accel_e_radps2; /**< ramps; 0: as fast as the drive can */
    float    decel_e_radps2;
    float    quick_e_radps2;
    float    current_max_A;  /**< the largest current, within the drive's */
    float    window_e_radps; /**< around the wanted speed: it is reached */
    int16_t  quick_option;
    int16_t  shutdown_option; /**< 0: as the drive's file says, 1: along the profile deceleration */
    int16_t  disable_option;  /**< the same */
    int16_t  lost_option;     /**< when nobody talks any more */
    app_commission_bounds_t bounds;
    int32_t  target_cnt;      /**< position, or how much further, from app_position.h's zero */
    float    profile_e_radps; /**< largest speed on the way; 0: the drive's, as the next */
    float    jerk_e_radps3;
    uint16_t position_window_cnt; /**< around the target: it is reached */
} app_objects_t;

#endif /* APP_OBJECTS_H */
