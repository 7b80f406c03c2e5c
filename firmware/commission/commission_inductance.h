/* SPDX-License-Identifier: MIT */
/**
 * @file commission_inductance.h
 * @brief Inductances from square-wave voltages in the stator frame.
 *
 *     v Ts = L di + (R i + loss) Ts,  L 2 x 2 by least squares from v and di              EQ-COMMISSION-4
 *     axis of the larger one: tan 2 a = 2 L_ab / (L_aa - L_bb)                            EQ-COMMISSION-5
 *
 * No rotor angle is needed. R i and the inverter loss are odd in the current and di is even over a
 * full wave: both hardly change L.
 *
 * The sums of di have its noise in them, which is measured with the motor at rest. Without this
 * correction L would be too small, and the noise would turn the axis of the larger one. The waves
 * along d and q use the same measurement of the noise: commission_map.h.
 */
#ifndef COMMISSION_INDUCTANCE_H
#define COMMISSION_INDUCTANCE_H

#include "commission_angle.h"
#include "commission_fit.h"
#include "commission_types.h"
#include "commission_wave.h"

typedef struct {
    float dd; /**< sum of di^2 */
    float dv; /**< sum of di (v - R i - e) */
    float vv;
    float n;
} commission_bin_t;

typedef struct {
    commission_wave_t  wave;
    int16_t            axis;      /**< LOOK: 0 .. 3, MAP: 0 .. COMMISSION_MAP_WAVES + 1 */
    frames_angle_t     direction; /**< of the wave in LOOK */
    int16_t            wait_ticks;
    commission_fit_t   alpha; /**< v_alpha against di, both axes' waves */
    commission_fit_t   beta;
    commission_bin_t   bins[COMMISSION_MAP_ROWS][COMMISSION_BINS]; /**< of MAP */
    bool               turned;                                     /**< MAP exchanged the axes */
    commission_fit_t   noise;   /**< sums of di at rest; the two sensors' noise is not isotropic */
    float              power_W; /**< LOOK: sum of v i, and of |i| */
    float              size_A;
    float              most_V;   /**< largest amplitude; more if the current needs it: */
    float              most_Ohm; /**< per ampere of the wave */
    int32_t            before_cnt;
    commission_angle_t angle; /**< tracks the angle for the speed */
} commission_inductance_t;

/**
 * @brief Starts LOOK or MAP.
 *
 * @param most_V   Largest amplitude of the wave.
 * @param most_Ohm The same per ampere of the wave; the larger one counts.
 *
 * Context: control ISR.
 */
void commission_inductance_start(commission_inductance_t *l, float most_V, float most_Ohm);

/** Executes one period of LOOK: inductances and their axis in the stator frame. */
commission_answer_t commission_inductance_look(commission_inductance_t   *l,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found);

/** True at rest before a wave. Context: control ISR. */
bool commission_inductance_rests(const commission_inductance_t *l);

/** True in the first half of a rest: the current of the wave before decays. Context: control ISR. */
bool commission_inductance_decays(const commission_inductance_t *l);

/** Zero voltage of a rest, whose noise is measured. Context: control ISR. */
commission_answer_t commission_inductance_rest(commission_inductance_t   *l,
                                               const commission_signal_t *s);

/** Variance of di by noise [A^2], mean of both axes. Context: control ISR. */
float commission_inductance_noise(const commission_inductance_t *l);

/** Goes on to the rest before the next wave. Context: control ISR. */
void commission_inductance_next(commission_inductance_t *l);

#endif /* COMMISSION_INDUCTANCE_H */
