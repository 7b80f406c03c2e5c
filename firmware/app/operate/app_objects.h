/* SPDX-License-Identifier: MIT */
/**
 * @file app_objects.h
 * @brief Commands of the operator as CiA 402 objects, and the states reported back.
 *
 * docs/modbus.md has the numbers.
 */
#ifndef APP_OBJECTS_H
#define APP_OBJECTS_H

#include "app_commission.h"

typedef enum {
    APP_CONTROL_NOT_READY = 0, /**< boots, measures the current offsets */
    APP_CONTROL_SWITCH_ON_DISABLED,
    APP_CONTROL_READY_TO_SWITCH_ON,
    APP_CONTROL_SWITCHED, /**< switched on; the bridge stays off */
    APP_CONTROL_OPERATION_ENABLED,
    APP_CONTROL_QUICK_STOP_ACTIVE,
    APP_CONTROL_FAULT_REACTION_ACTIVE, /**< the motor is shorted until it is slow */
    APP_CONTROL_FAULT,
    APP_CONTROL_STATES
} app_control_state_t;

/** Bits of the control word. */
enum {
    APP_CONTROL_SWITCH_ON      = 1,
    APP_CONTROL_ENABLE_VOLTAGE = 2,
    APP_CONTROL_NO_QUICK_STOP  = 4,
    APP_CONTROL_ENABLE         = 8,
    APP_CONTROL_NEW_SETPOINT   = 16, /**< profile position, as the next two: app_setpoint.h */
    APP_CONTROL_AT_ONCE        = 32,
    APP_CONTROL_RELATIVE       = 64,
    APP_CONTROL_FAULT_RESET    = 128, /**< acts when it rises */
    APP_CONTROL_HALT           = 256  /**< stops at zero speed and stays enabled */
};

/** Modes of operation: 6060h. */
enum {
    APP_CONTROL_FIND_ANGLE       = -2, /**< aligns the rotor, app_align.h */
    APP_CONTROL_COMMISSIONING    = -1, /**< measures the motor, commission.h */
    APP_CONTROL_PROFILE_POSITION = 1,  /**< app_setpoint.h; only with a position law */
    APP_CONTROL_PROFILE_VELOCITY = 3,
    APP_CONTROL_PROFILE_TORQUE   = 4, /**< along a slope, as the next only with a torque law */
    APP_CONTROL_HOMING           = 6, /**< finds the zero of positions, app_homing.h */
    APP_CONTROL_CYCLIC_POSITION  = 8, /**< from set-point to set-point, app_path.h; as 1 */
    APP_CONTROL_CYCLIC_VELOCITY  = 9, /**< from set-point to set-point, app_control_change.h */
    APP_CONTROL_CYCLIC_TORQUE    = 10 /**< the newest value at once, with its offset */
};

typedef struct {
    uint16_t controlword;
    int16_t  mode_of_operation;
    float    omega_e_radps;  /**< target speed; a fault outside the drive's range */
    float    accel_e_radps2; /**< acceleration, as the next two; 0: the drive's limit */
    float    decel_e_radps2;
    float    quick_e_radps2;
    float    current_max_A;  /**< current limit, <= the drive's */
    float    window_e_radps; /**< tolerance of "target speed reached" */
    int16_t  quick_option;
    int16_t  shutdown_option; /**< 0: as in the drive file, 1: profile deceleration */
    int16_t  disable_option;  /**< same values */
    int16_t  lost_option;     /**< after a communication time-out */
    app_commission_bounds_t bounds;
    int32_t                 target_cnt;      /**< target position from the zero, or a distance */
    float                   profile_e_radps; /**< speed limit, as the next; 0: the drive's */
    float                   jerk_e_radps3;
    float                   torque_share;     /**< target, of the rated torque, as the next */
    float                   torque_offset;    /**< cyclic torque: added to it */
    float                   torque_most;      /**< limit of both, either way, >= 0 */
    float                   torque_slope_1ps; /**< profile torque; 0: a step */
    float    torque_speed_max_e_radps;        /**< speed limit of a torque; 0: the drive's */
    float    omega_offset_e_radps;            /**< cyclic velocity: added to the target speed;
                                                      cyclic position: speed at the set-point */
    float    interpolation_s;                 /**< between two set-points, > 0 */
    int32_t  offset_cnt;    /**< cyclic position, as the next: added to the target position */
    uint16_t target_number; /**< counts the writes of the target position */
    uint32_t following_window_cnt; /**< of the following error; 0: any */
    float    following_s;          /**< that it may be beyond it */
    bool     limits;               /**< set-points of positions keep within the next two */
    int32_t  least_cnt;
    int32_t  most_cnt;
    bool     reversed;        /**< positions count against the motor's sense */
    uint16_t inputs_used;     /**< BOARD_INPUT_ bits, as the next */
    uint16_t inputs_inverted; /**< active when low */
    int16_t  homing_method;   /**< app_homing.h, as the next */
    float    homing_switch_e_radps;
    float    homing_zero_e_radps;
    float    homing_accel_e_radps2; /**< 0: the drive's limit */
    float    homing_time_s;         /**< that it may take */
    int32_t  home_offset_cnt;       /**< from home to the zero */
    uint16_t brake_used;            /**< 1: app_brake.h, as the next two */
    uint16_t brake_release_ms;
    uint16_t brake_close_ms;
} app_objects_t;

/** True for the modes of operation that command a torque. */
static inline bool app_control_is_torque(int16_t mode)
{
    return (mode == APP_CONTROL_PROFILE_TORQUE) || (mode == APP_CONTROL_CYCLIC_TORQUE);
}

/** True for the modes of operation that command a speed. */
static inline bool app_control_is_speed(int16_t mode)
{
    return (mode == APP_CONTROL_PROFILE_VELOCITY) || (mode == APP_CONTROL_CYCLIC_VELOCITY);
}

/** True for the modes of operation that command a position. */
static inline bool app_control_is_position(int16_t mode)
{
    return (mode == APP_CONTROL_PROFILE_POSITION) || (mode == APP_CONTROL_CYCLIC_POSITION);
}

/** True for a mode of operation in which the law controls the bridge. */
static inline bool app_control_is_run(int16_t mode)
{
    return app_control_is_speed(mode) || app_control_is_position(mode) ||
           app_control_is_torque(mode) || (mode == APP_CONTROL_HOMING);
}

/** Inputs that are in use and active, of the levels of board_inputs(). */
static inline uint16_t app_control_active(const app_objects_t *o, uint16_t levels)
{
    return (uint16_t)((levels ^ o->inputs_inverted) & o->inputs_used);
}

/** Target of a torque mode within its limit, of the rated torque. */
static inline float app_control_target_torque(const app_objects_t *o, int16_t mode)
{
    const float offset = (mode == APP_CONTROL_CYCLIC_TORQUE) ? o->torque_offset : 0.0f;

    return base_clamp(o->torque_share + offset, -o->torque_most, o->torque_most);
}

/** Target of a velocity mode, before the drive's limit. */
static inline float app_control_target_e_radps(const app_objects_t *o, int16_t mode)
{
    const float offset = (mode == APP_CONTROL_CYCLIC_VELOCITY) ? o->omega_offset_e_radps : 0.0f;

    return o->omega_e_radps + offset;
}

/** A set-point within the limits of position. */
static inline int32_t app_control_limited_cnt(const app_objects_t *o, int32_t cnt)
{
    const int32_t up = (cnt > o->most_cnt) ? o->most_cnt : cnt;
    const int32_t at = (up < o->least_cnt) ? o->least_cnt : up;

    return o->limits ? at : cnt;
}

/** True if the word has this bit. */
static inline bool app_control_has(uint16_t word, int bit)
{
    return (word & (uint16_t)bit) != 0U;
}

#endif /* APP_OBJECTS_H */
