/* SPDX-License-Identifier: MIT */
/**
 * @file drive_tick.h
 * @brief One control period: sensors -> observer -> reference -> law -> modulator.
 *
 * Call drive_tick() once per control period. Its duty ratios take effect one period later and hold
 * for one period. The voltage is turned to the angle in the middle of that period.       EQ-DRIVE-2
 *
 * The constants name a law (law.h), which brings observer, reference and feedback. Checks, voltage
 * limit and modulator are the same for all laws.
 *
 * Every input is checked before use. An invalid, non-finite or out-of-range sample or command opens
 * the bridge in the same call. The first reason is latched until drive_reset().
 *
 * One current sample beyond the trip level is discarded, and the predicted current replaces it. Two
 * of three such samples trip (current_gate.h). Currents that do not match the motor model trip too
 * (current_watch.h).
 */
#ifndef DRIVE_TICK_H
#define DRIVE_TICK_H

#include "base.h"
#include "bridge.h"
#include "current_gate.h"
#include "current_watch.h"
#include "drive_config.h"
#include "laws.h"
#include "motion_watch.h"
#include "sample.h"

typedef struct {
    float omega_e_radps; /**< reference speed, electrical, within +-speed_max_e_radps */
    bool  run;           /**< false opens the bridge */
    float
        derating; /**< unusable share of the current limit, 0 .. 1; for laws with near_optimal.h */
    const law_aim_t *aim; /**< position or torque; NULL: the speed is commanded */
} drive_command_t;

typedef enum { DRIVE_OFF = 0, DRIVE_RUN, DRIVE_FAULT } drive_state_t;

/** Why the bridge was opened; the first reason is kept. */
typedef enum {
    DRIVE_FAULT_NONE = 0,
    DRIVE_FAULT_SAMPLE,       /**< sample marked invalid, or angle not a number in range */
    DRIVE_FAULT_OVER_CURRENT, /**< current above its trip level in two of three samples, or NaN */
    DRIVE_FAULT_DC_LINK,      /**< dc link outside its accepted range, or not a number */
    DRIVE_FAULT_OVER_SPEED,   /**< speed beyond the trip level, or not a number */
    DRIVE_FAULT_ENCODER,      /**< the angle jumped, or stands still while the motor turns fast */
    DRIVE_FAULT_COMMAND, /**< command out of range, NaN, or a position that the drive cannot take */
    DRIVE_FAULT_NUMERIC, /**< the law produced a voltage that is not a number */
    DRIVE_FAULT_CURRENT_SENSOR, /**< a phase current does not match the model, current_watch.h */
    DRIVE_FAULT_PHASE,          /**< a phase carries no current, current_watch.h */
    DRIVE_FAULT_MODEL, /**< voltage does not match the model: encoder or sensor, motion_watch.h */
    DRIVE_FAULT_STALL, /**< no motion at the current limit, motion_watch.h */
    DRIVE_FAULT_AWAY,  /**< the speed leaves its command at the current limit, motion_watch.h */
    DRIVE_FAULT_MEMORY /**< a pointer or a count has changed; kept until drive_init() */
} drive_fault_t;

typedef struct {
    const drive_config_t *config;
    const drive_config_t *config_again;    /**< copy that reveals a flipped bit */
    const law_t          *law_again;       /**< config->law */
    const void           *constants_again; /**< config->constants */
    drive_state_t         state;
    drive_fault_t         fault;
    law_state_t           law;       /**< state of config->law */
    law_output_t          answer;    /**< last answer of the law */
    dq_t                  v_V;       /**< last voltage after limits; acts from the next tick */
    bool                  v_limited; /**< v_V was limited */
    abc_t                 i_hat_A;   /**< phase currents that the law expects */
    current_gate_t        current_gate;
    current_watch_t       current_watch;
    float                 wire_open_s;              /**< EQ-CURRENT-WATCH-4 */
    float                 jump_ApV;                 /**< EQ-CURRENT-GATE-2 */
    float                 sample_speed_max_e_radps; /**< EQ-DRIVE-3 */
    motion_watch_t        motion_watch;
} drive_t;

/**
 * @brief Binds a drive to its constants and starts in DRIVE_OFF.
 *
 * @param config Must outlive d.
 * @return CTL_BAD_CONFIG: a constant is outside its documented range. Every tick then keeps the
 * bridge
 *         open.
 *
 * Context: init.
 */
ctl_status_t drive_init(drive_t *d, const drive_config_t *config);

/** Leaves DRIVE_FAULT for DRIVE_OFF. Context: control ISR or background with the ISR masked. */
void drive_reset(drive_t *d);

/**
 * @brief Goes over to constants for another inertia, between two periods.
 *
 * @param next The drive's constants, or what law_t.believe made of them. It must outlive d.
 *
 * Nothing changes without a valid configuration. Context: control ISR.
 */
void drive_adopt(drive_t *d, const drive_config_t *next);

/**
 * @brief Executes one control period.
 *
 * @param d       Drive.
 * @param sample  Measurements of this instant.
 * @param command Reference speed, position or torque, and the run flag.
 * @return        Duty ratios for the next period and the gate request for now.
 *
 * Context: control ISR. Bounded: the only loops are sums of fixed length in the law.
 */
bridge_t drive_tick(drive_t *d, const drive_sample_t *sample, const drive_command_t *command);

#endif /* DRIVE_TICK_H */
