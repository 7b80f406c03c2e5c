/* SPDX-License-Identifier: MIT */
/**
 * @file app_align.h
 * @brief Finds the electrical angle without an index: a current vector pulls the d axis to phase a.
 *
 *     watch    bridge off, the shaft must be at rest
 *     ramp     current vector at -180 degrees, length 0 -> I
 *     sweep    vector turns from -180 to 0 degrees; it also moves a rotor from the opposite point
 *     settle   vector at 0; the shaft must come to rest
 *
 * From the middle of the sweep to rest, the rotor must turn forward by a quarter of an electrical
 * turn. This proves phase order, direction and pole pairs. At rest the current has to be that of
 * the vector.
 *
 *     v_along = k_p (I - i_along) + integral of k_i (I - i_along),                EQ-APP-ALIGN-1
 *     v_cross = -k_p i_cross
 *     k_p = w_c L_d,  k_i = w_c R_s,  each within +-2 R_s I
 *
 * Across the vector there is no integral. The winding then acts as a resistance R_s + k_p, which
 * damps the oscillating rotor. With an ideal current source only friction would damp it, in
 * seconds.
 *
 * Load: near the vector the stiffness is 1.5 n_p (flux I - (L_q - L_d) I^2) N m per electrical
 * radian. A load or friction torque T causes an angle error of T divided by the stiffness.
 */
#ifndef APP_ALIGN_H
#define APP_ALIGN_H

#include "app_angle.h"
#include "bridge.h"
#include "drive_config.h"

typedef struct {
    float    current_A;       /**< I, > 0, at most half of the drive's current limit */
    float    bandwidth_radps; /**< w_c, > 0, far below the sampling rate */
    float    theta_e_rad;     /**< rotor angle at the end, [0, 2 pi); 0 with magnets */
    uint32_t watch_ticks;     /**< > 0, like all times below */
    uint32_t ramp_ticks;
    uint32_t sweep_ticks;
    uint32_t settle_ticks;      /**< the vector stands; longer than still_ticks */
    uint32_t still_ticks;       /**< end of settle in which the shaft must rest */
    uint16_t still_cnt;         /**< largest movement that counts as rest */
    uint16_t quarter_error_cnt; /**< accepted error of the quarter turn */
} app_align_config_t;

typedef enum {
    APP_ALIGN_WATCH = 0,
    APP_ALIGN_RAMP,
    APP_ALIGN_SWEEP,
    APP_ALIGN_SETTLE,
    APP_ALIGN_DONE,  /**< the d axis stands at phase a */
    APP_ALIGN_FAILED /**< shaft turned, went the wrong way, shaft or current did not rest */
} app_align_stage_t;

typedef struct {
    const app_align_config_t *config;
    uint16_t                  positions; /**< of a turn */
    float                     kp_VpA;
    float                     ki_VpA; /**< k_i times the period */
    float                     v_max_V;
    float                     current_max2_A2;
    float                     current_per_tick_A;
    float                     angle_per_tick_rad;
    int16_t                   quarter_cnt;
    app_align_stage_t         stage;
    uint32_t                  timer_ticks; /**< since the stage began */
    float                     integral_V;
    uint16_t                  marked_cnt; /**< position to compare with */
    uint16_t                  middle_cnt; /**< position in the middle of the sweep */
} app_align_t;

/** @return CTL_BAD_CONFIG when a constant is out of range. Context: init, or the loader. */
ctl_status_t app_align_check(const app_align_config_t *config, const drive_config_t *drive);

/** @return Result of the check. After CTL_BAD_CONFIG a is unusable. Context: init. */
ctl_status_t app_align_init(app_align_t *a, const app_align_config_t *config,
                            const drive_config_t *drive);

/** Starts at the first stage. Context: control ISR. */
void app_align_start(app_align_t *a, uint16_t position_cnt);

/** In this period the vector does not turn yet: the shaft is not free. Context: control ISR. */
static inline void app_align_wait(app_align_t *a)
{
    if (a->stage == APP_ALIGN_SWEEP) {
        a->timer_ticks = 0UL;
    }
}

/**
 * @brief Executes one period; a->stage is the result. The bridge is open in WATCH and FAILED.
 *
 * The caller checks the trip levels of currents and dc link. This function checks the current
 * limit.
 *
 * Context: control ISR. One sine, one cosine, one division (modulator).
 */
bridge_t app_align_tick(app_align_t *a, const dead_time_config_t *dead_time, float ia_A, float ib_A,
                        float dc_link_V, uint16_t position_cnt);

#endif /* APP_ALIGN_H */
