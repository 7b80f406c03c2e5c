/* SPDX-License-Identifier: MIT */
/**
 * @file app_control.h
 * @brief State machine of CiA 402 (IEC 61800-7-201), towards the operator.
 *
 * It turns control word, mode of operation, ramps and stop options into the command of app_modes.h.
 *
 *     NOT_READY -> SWITCH_ON_DISABLED -> READY_TO_SWITCH_ON -> SWITCHED_ON -> OPERATION_ENABLED
 *         -> QUICK_STOP_ACTIVE
 *     any state -> FAULT_REACTION_ACTIVE -> FAULT -> SWITCH_ON_DISABLED
 *
 * A table defines the transitions by control word (docs/modbus.md). All other requests are ignored.
 * A fault has priority over every control word. Only a rising bit 3 enables the operation, if no
 * condition prevents a start.
 *
 * The bridge may be on in OPERATION_ENABLED and QUICK_STOP_ACTIVE. The drive leaves these states
 * after the bridge has opened. A deceleration of 0 means a ramp at the drive's limit. Without a
 * ramp, a run ends as the drive file says (app_stop.h).
 */
#ifndef APP_CONTROL_H
#define APP_CONTROL_H

#include "app_config.h"
#include "app_homing.h"
#include "app_setpoint.h"
#include "app_status.h"

/** Control words of the commands. */
enum {
    APP_CONTROL_DISABLE_VOLTAGE  = 0,
    APP_CONTROL_QUICK_STOP       = 2,
    APP_CONTROL_SHUT_DOWN        = 6,
    APP_CONTROL_SWITCHED_ON      = 7, /**< from OPERATION_ENABLED: disable operation */
    APP_CONTROL_ENABLE_OPERATION = 15
};

/** Quick stop options: 605Ah. */
enum {
    APP_CONTROL_QUICK_OFF       = 0, /**< as if disabled */
    APP_CONTROL_QUICK_RAMP      = 1, /**< profile deceleration, then SWITCH_ON_DISABLED */
    APP_CONTROL_QUICK_FAST      = 2, /**< quick-stop deceleration, then SWITCH_ON_DISABLED */
    APP_CONTROL_QUICK_RAMP_STAY = 5, /**< the same two, and stays in QUICK_STOP_ACTIVE */
    APP_CONTROL_QUICK_FAST_STAY = 6
};

/** Reactions to a communication time-out: 6007h. */
enum { APP_CONTROL_LOST_DISABLE = 2, APP_CONTROL_LOST_QUICK_STOP = 3 };

typedef struct {
    const app_config_t *config;
    float               ts_s;
    float               speed_max_e_radps; /**< speed limit of a command */
    float               per_current_max;   /**< 1 / largest current */
    float               accel_e_radps2;    /**< largest of a path */
    app_control_state_t state;
    int16_t             mode;         /**< present mode of operation */
    bool                armed;        /**< bit 3 was low after the last start */
    bool                reset_high;   /**< bit 7 in the previous tick */
    bool                asked;        /**< app_modes had one tick to begin */
    bool                moved;        /**< app_modes has begun */
    bool                done;         /**< alignment or commissioning has ended */
    float               ref_e_radps;  /**< output of the ramp, as the next three */
    float               goal_e_radps; /**< its end */
    float               up_e_radps;   /**< its step up in a period, >= 0 */
    float               down_e_radps; /**< its step down */
    app_follows_t       follows;      /**< of the command */
    bool                stopping;     /**< a stop was asked for */
    bool                blocked;      /**< a limit switch or the holding brake stops the motion */
    bool                braked;       /**< the holding brake may hold the shaft; of app.c */
    bool                holds;        /**< positions, cyclic velocity: the set-points have begun */
    app_setpoint_t      setpoint;
    app_homing_t        homing;
    app_path_t          path;          /**< of cyclic position, as the next */
    uint16_t            target_number; /**< of its last set-point */
    bool                velocity;      /**< a velocity offset was given since it began */
    bool                limited;       /**< its last set-point was beyond the limits of position */
} app_control_t;

/** Status of app_modes after the previous tick. */
typedef struct {
    app_mode_t            mode;
    bool                  shorted;    /**< FAULT: the motor is shorted */
    bool                  in_the_way; /**< a condition prevents a start; valid in READY */
    float                 speed_e_radps;
    bool                  arrived; /**< at the commanded position */
    const app_position_t *position;
    const app_angle_t    *angle;
    uint16_t              inputs; /**< levels of board_inputs() */
    uint32_t              ticks;
} app_control_seen_t;

/** @return CTL_BAD_CONFIG when there is no largest current. Context: init. */
ctl_status_t app_control_init(app_control_t *c, const app_config_t *config,
                              const drive_config_t *drive);

/** Default values of the operator's objects. */
app_objects_t app_control_default(const drive_config_t *drive);

/** True if the drive supports this mode of operation and these options. */
bool app_control_knows(const app_objects_t *o, const drive_config_t *drive);

/** True if the control word requests OPERATION_ENABLED. */
bool app_control_enables(uint16_t controlword);

/**
 * @brief Moves the reference speed along its ramp. Context: control ISR, every period.
 *
 * app_control_aim() sets the ramp by the sign of the reference. After a zero crossing the steps of
 * the other direction hold until its next call.
 */
static inline void app_control_follow(app_control_t *c, app_command_t *out)
{
    const float ref = c->ref_e_radps;

    c->ref_e_radps     = base_clamp(c->goal_e_radps, ref - c->down_e_radps, ref + c->up_e_radps);
    out->omega_e_radps = c->ref_e_radps;
}

/**
 * @brief Decides what app_modes shall do, and updates its command in place.
 *
 * The bounds in the command are set only together with `commission`.
 *
 * Context: control ISR, at each change and once in a millisecond.
 */
void app_control_decide(app_control_t *c, const app_objects_t *requested,
                        const app_control_seen_t *seen, app_command_t *out);

/** Sets target, ramp and current limit of what was decided. Context: as above, after it. */
void app_control_aim(app_control_t *c, const app_objects_t *requested,
                     const app_control_seen_t *seen, app_command_t *out);

/** Executes one period: all three. Context: control ISR, without a running law. */
void app_control_tick(app_control_t *c, const app_objects_t *requested,
                      const app_control_seen_t *seen, app_command_t *out);

#endif /* APP_CONTROL_H */
