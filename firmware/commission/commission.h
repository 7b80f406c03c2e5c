/* SPDX-License-Identifier: MIT */
/**
 * @file commission.h
 * @brief Self-commissioning: measures the motor data of a drive file with the drive's own sensors.
 *
 *     WATCH -> LOOK -> RESISTANCE -> DRAG -> MAP -> SPIN -> RING -> DONE,  else -> ABORTED
 *
 * Call it once per control period. Its duty ratios act one period later, like those of
 * drive_tick(). Any error opens the bridge in the same call. The first reason is kept until
 * commission_start().
 *
 * The shaft must be free. It turns slowly for some electrical turns in both directions, then up to
 * the speed limit in both directions. Braking returns the kinetic energy to the dc link.
 */
#ifndef COMMISSION_H
#define COMMISSION_H

#include "bridge.h"
#include "commission_check.h"
#include "commission_drag.h"
#include "commission_guard.h"
#include "commission_inductance.h"
#include "commission_map.h"
#include "commission_probe.h"
#include "commission_resistance.h"
#include "commission_ring.h"
#include "commission_shaft.h"
#include "commission_spin.h"
#include "commission_types.h"

typedef enum {
    COMMISSION_IDLE = 0,
    COMMISSION_WATCH,      /**< bridge open: current offsets; the shaft must be at rest */
    COMMISSION_LOOK,       /**< check of phases and sensors; inductances in the stator frame */
    COMMISSION_RESISTANCE, /**< resistance and inverter voltage loss */
    COMMISSION_DRAG,       /**< direction, pole pairs, offset */
    COMMISSION_MAP,        /**< inductances along d and q over both currents */
    COMMISSION_SPIN,       /**< flux, inertia, friction */
    COMMISSION_RING,       /**< resonance of the shaft */
    COMMISSION_FINISHED,
    COMMISSION_ABORTED
} commission_stage_t;

/** Why the bridge was opened; the first reason is kept. */
typedef enum {
    COMMISSION_REASON_NONE = 0,
    COMMISSION_REASON_CONFIG,       /**< a bound is missing or out of range */
    COMMISSION_REASON_SAMPLE,       /**< a sample is invalid or not a finite number */
    COMMISSION_REASON_OVER_CURRENT, /**< a phase current exceeds 1.05 times its limit */
    COMMISSION_REASON_DC_LINK,
    COMMISSION_REASON_OVER_SPEED,
    COMMISSION_REASON_ENCODER,    /**< the position jumped */
    COMMISSION_REASON_TIMEOUT,    /**< a stage exceeded its time limit */
    COMMISSION_REASON_WITHDRAWN,  /**< the command was withdrawn */
    COMMISSION_REASON_MOVING,     /**< with the bridge open: shaft turns or current flows */
    COMMISSION_REASON_INDUCTANCE, /**< currents do not follow the voltage; phase open? */
    COMMISSION_REASON_RESISTANCE,
    COMMISSION_REASON_DRAG, /**< the rotor does not follow, or the pole pair count is not whole */
    COMMISSION_REASON_SPIN, /**< the acceleration does not match the torque */
    COMMISSION_REASON_NUMERIC, /**< a result is not a finite number */
    COMMISSION_REASON_SENSOR,  /**< a current sensor or a phase does not answer as it should */
    COMMISSION_REASON_RING     /**< the shaft oscillates beyond its limit */
} commission_reason_t;

typedef union {
    commission_inductance_t inductance;
    commission_resistance_t resistance;
    commission_drag_t       drag;
    commission_spin_t       spin;
    commission_ring_t       ring;
} commission_work_t;

/** The check asks the sensors in LOOK, the probe in RESISTANCE and DRAG. */
typedef union {
    commission_check_t check;
    commission_probe_t probe;
} commission_asked_t;

typedef struct {
    const commission_config_t *config;
    commission_stage_t         stage;
    commission_stage_t         last_stage; /**< stage that ran when it ended */
    commission_reason_t        reason;
    commission_result_t        found;
    commission_map_t           map;
    commission_work_t          work;
    commission_asked_t         asked;
    bool                       checked;    /**< phases and sensors answer */
    bool                       looked;     /**< LOOK has begun; a check may interrupt it */
    commission_admittance_t    admittance; /**< from the check */
    commission_guard_t         guard;
    int32_t                    ticks; /**< since the stage began */
    ab_t                       i_A;
    ab_t                       v_now_V;    /**< requested at the last sample; acts after this one */
    ab_t                       v_before_V; /**< acted until this sample */
    float                      zero_a_A;
    float                      zero_b_A;
    commission_shaft_t         shaft;
    int32_t                    start_cnt; /**< position when the watch began */
    int16_t                    rounds; /**< of MAP and SPIN; a second one if the offset was wrong */
} commission_t;

/** Sets up. @return CTL_BAD_CONFIG: a limit is out of range; a start then aborts. Context: init. */
ctl_status_t commission_init(commission_t *m, const commission_config_t *config);

/** Starts at the first stage and clears the reason. Context: control ISR. */
void commission_start(commission_t *m);

/**
 * @brief Executes one control period.
 *
 * @param run false ends the commissioning and opens the bridge.
 *
 * Context: control ISR. The last tick of SPIN is the longest: three passes over COMMISSION_WINDOWS.
 */
bridge_t commission_tick(commission_t *m, const commission_sample_t *sample, bool run);

/** Progress, 0 .. 100 %. After an abort it is that of `last_stage`. Context: any. */
int16_t commission_percent(commission_stage_t stage, commission_stage_t last_stage);

#endif /* COMMISSION_H */
