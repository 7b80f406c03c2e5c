/* SPDX-License-Identifier: MIT */
/**
 * @file commission.h
 * @brief Self-commissioning: finds what a drive file says of the motor, with the inverter, the sensors and the shaft free.
 *
 *     WATCH -> LOOK -> RESISTANCE -> DRAG -> MAP -> SPIN -> DONE,  anything wrong -> ABORTED
 *
 * One call per control period; the duty ratios that it answers act one period later, as those of drive_tick(). Anything
 * wrong opens the bridge in the same call and keeps the first reason until commission_start().
 *
 * The shaft turns: some electrical turns slowly both ways, then up to the bound of the speed both ways. Braking returns the
 * energy of the inertia to the dc link.
 */
#ifndef COMMISSION_H
#define COMMISSION_H

#include "bridge.h"
#include "commission_drag.h"
#include "commission_inductance.h"
#include "commission_resistance.h"
#include "commission_shaft.h"
#include "commission_spin.h"
#include "commission_types.h"

typedef enum {
    COMMISSION_IDLE = 0,
    COMMISSION_WATCH,      /**< bridge open: zeros of the currents, the shaft must stand */
    COMMISSION_LOOK,       /**< inductances in the stator's frame */
    COMMISSION_RESISTANCE, /**< and what the inverter loses */
    COMMISSION_DRAG,       /**< direction, pole pairs, offset */
    COMMISSION_MAP,        /**< inductances along d and q */
    COMMISSION_SPIN,       /**< flux, inertia, friction */
    COMMISSION_FINISHED,
    COMMISSION_ABORTED
} commission_stage_t;

/** Why the bridge was opened; the first reason is kept. */
typedef enum {
    COMMISSION_REASON_NONE = 0,
    COMMISSION_REASON_CONFIG,       /**< a bound is missing or out of range */
    COMMISSION_REASON_SAMPLE,       /**< marked invalid, or no number */
    COMMISSION_REASON_OVER_CURRENT, /**< a phase current above 1.05 times the bound */
    COMMISSION_REASON_DC_LINK,
    COMMISSION_REASON_OVER_SPEED,
    COMMISSION_REASON_ENCODER,    /**< the position jumped */
    COMMISSION_REASON_TIMEOUT,    /**< a stage takes too long */
    COMMISSION_REASON_WITHDRAWN,  /**< the command went away */
    COMMISSION_REASON_MOVING,     /**< the shaft turned, or a current ran, with the bridge open */
    COMMISSION_REASON_INDUCTANCE, /**< currents do not follow the voltage: a phase is open? */
    COMMISSION_REASON_RESISTANCE,
    COMMISSION_REASON_DRAG, /**< the rotor does not follow, or the pole pairs are no whole number */
    COMMISSION_REASON_SPIN, /**< the shaft does not turn as its torque says */
    COMMISSION_REASON_NUMERIC /**< a result that is no number */
} commission_reason_t;

typedef union {
    commission_inductance_t inductance;
    commission_resistance_t resistance;
    commission_drag_t       drag;
    commission_spin_t       spin;
} commission_work_t;

typedef struct {
    const commission_config_t *config;
    commission_stage_t         stage;
    commission_stage_t         last_stage; /**< that was running when it ended */
    commission_reason_t        reason;
    commission_result_t        found;
    commission_work_t          work;
    int32_t                    ticks; /**< since the stage began */
    ab_t                       i_A;
    ab_t               v_now_V;    /**< asked for at the last sample: in force after this one */
    ab_t               v_before_V; /**< in force until this one */
    float              zero_a_A;
    float              zero_b_A;
    commission_shaft_t shaft;
    int32_t            start_cnt; /**< position when the watch began */
    int16_t            rounds;    /**< of MAP and SPIN; a second one when the offset was wrong */
} commission_t;

/** @return CTL_BAD_CONFIG: a bound is out of range, and nothing will start. Context: init. */
ctl_status_t commission_init(commission_t *m, const commission_config_t *config);

/** From the beginning. Context: control ISR. */
void commission_start(commission_t *m);

/**
 * @brief One period.
 *
 * @param run false ends it with the bridge open.
 * Context: control ISR. Bounded; the longest tick is the last one of SPIN, COMMISSION_WINDOWS windows three times.
 */
bridge_t commission_tick(commission_t *m, const commission_sample_t *sample, bool run);

/** 0 .. 100 of the way; of an aborted one where it was. Context: any. */
int16_t commission_percent(commission_stage_t stage, commission_stage_t last_stage);

#endif /* COMMISSION_H */
