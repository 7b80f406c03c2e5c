/* SPDX-License-Identifier: MIT */
/**
 * @file app_control.h
 * @brief The operator's side of the drive in the terms of CiA 402 (IEC 61800-7-201): control word, states, modes of
 *        operation, ramps and stop options. It turns them into the command of app_modes.h, which does the work.
 *
 *     NOT_READY -> SWITCH_ON_DISABLED -> READY_TO_SWITCH_ON -> SWITCHED_ON -> OPERATION_ENABLED -> QUICK_STOP_ACTIVE
 *     any state -> FAULT_REACTION_ACTIVE -> FAULT -> SWITCH_ON_DISABLED
 *
 * Transitions that a control word asks for are a table; docs/modbus.md has it. What is not in it is not done. A fault wins
 * over every control word, and the operation is enabled only by bit 3 rising while nothing is in its way.
 *
 * The bridge may be on in OPERATION_ENABLED and QUICK_STOP_ACTIVE, which are left after the bridge has opened. Without a
 * deceleration of its own (0) a drive stops as its file says (app_stop.h) or, along a ramp, as fast as it can.
 */
#ifndef APP_CONTROL_H
#define APP_CONTROL_H

#include "app_config.h"
#include "app_setpoint.h"
#include "app_status.h"

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
    APP_CONTROL_HALT           = 256  /**< to zero speed, and stays enabled */
};

/** Control words of the commands. */
enum {
    APP_CONTROL_DISABLE_VOLTAGE  = 0,
    APP_CONTROL_QUICK_STOP       = 2,
    APP_CONTROL_SHUT_DOWN        = 6,
    APP_CONTROL_SWITCHED_ON      = 7, /**< from OPERATION_ENABLED: disable operation */
    APP_CONTROL_ENABLE_OPERATION = 15
};

/** What an option is about: 605Ah. */
enum {
    APP_CONTROL_QUICK_OFF       = 0, /**< as if disabled */
    APP_CONTROL_QUICK_RAMP      = 1, /**< profile deceleration, then SWITCH_ON_DISABLED */
    APP_CONTROL_QUICK_FAST      = 2, /**< quick-stop deceleration, then SWITCH_ON_DISABLED */
    APP_CONTROL_QUICK_RAMP_STAY = 5, /**< the same two, and stays in QUICK_STOP_ACTIVE */
    APP_CONTROL_QUICK_FAST_STAY = 6
};

/** Reactions to silence: 6007h. */
enum { APP_CONTROL_LOST_DISABLE = 2, APP_CONTROL_LOST_QUICK_STOP = 3 };

typedef struct {
    const app_config_t *config;
    float               ts_s;
    float               speed_max_e_radps; /**< of a command */
    float               per_current_max;   /**< 1 / largest current */
    app_control_state_t state;
    int16_t             mode;        /**< of operation, in force */
    bool                armed;       /**< bit 3 was seen low since the last start */
    bool                reset_high;  /**< bit 7 was there before */
    bool                asked;       /**< the modes have had a tick to begin */
    bool                moved;       /**< and have begun */
    bool                done;        /**< homing or commissioning has ended */
    float               ref_e_radps; /**< of the ramp */
    bool                holds;       /**< profile position: the set-points have begun */
    app_setpoint_t      setpoint;
} app_control_t;

/** What the modes tell of the tick before. */
typedef struct {
    app_mode_t mode;
    bool       shorted;    /**< FAULT: the motor is shorted */
    bool       in_the_way; /**< something keeps a run from starting; of use in READY only */
    float      speed_e_radps;
    bool       arrived; /**< at the commanded position */
    const app_position_t *position;
} app_control_seen_t;

/** @return CTL_BAD_CONFIG when there is no largest current. Context: init. */
ctl_status_t app_control_init(app_control_t *c, const app_config_t *config,
                              const drive_config_t *drive);

/** What the operator wants before anyone has said so. */
app_objects_t app_control_default(const drive_config_t *drive);

/** Whether these objects are ones that the drive knows: mode of operation and options. */
bool app_control_knows(const app_objects_t *o, const drive_config_t *drive);

/** Whether a word has a bit. */
static inline bool app_control_has(uint16_t word, int bit)
{
    return (word & (uint16_t)bit) != 0U;
}

/** The control word asks for OPERATION_ENABLED. */
bool app_control_enables(uint16_t controlword);

/** One period: the command of the modes, in place. Its bounds are set with `commission` only. Context: control ISR. */
void app_control_tick(app_control_t *c, const app_objects_t *wanted, const app_control_seen_t *seen,
                      app_command_t *out);

#endif /* APP_CONTROL_H */
