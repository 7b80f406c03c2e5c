/* SPDX-License-Identifier: MIT */
/**
 * @file commission_inductance.h
 * @brief Inductances from square waves of voltage, in the stator's frame without knowing the angle, or along d and q.
 *
 *     v Ts = L di + (R i + loss) Ts,  L 2 x 2 by least squares from v and di              EQ-COMMISSION-4
 *     axis of the larger one: tan 2 a = 2 L_ab / (L_aa - L_bb)                            EQ-COMMISSION-5
 *     along an axis: L = Ts sum(di (v - R i - e)) / (sum(di^2) - n var)                   EQ-COMMISSION-6
 *
 * R i and what the inverter loses are odd in the current and di is even over a full wave, so that both hardly touch L;
 * what is known of R is subtracted all the same. e is what the moving magnet induces in q, from the counted speed. var:
 * of the noise of di, from the samples of a standing motor; it would make L too small.
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
    int16_t            axis;      /**< of the look 0 .. 3, of the map d, q */
    frames_angle_t     direction; /**< of the look's wave */
    int16_t            wait_ticks;
    commission_fit_t   alpha; /**< v_alpha against di, both axes' waves */
    commission_fit_t   beta;
    commission_bin_t   bins[2][2][COMMISSION_BINS]; /**< axis, sign of the current, bin */
    float              noise_A2; /**< variance of di of a standing current, both axes' mean */
    float              noise_n;
    int32_t            before_cnt;
    commission_angle_t angle; /**< its speed */
} commission_inductance_t;

/** Context: control ISR. */
void commission_inductance_start(commission_inductance_t *l);

/** One period of the first look: L and its axis in the stator's frame. */
commission_answer_t commission_inductance_look(commission_inductance_t   *l,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found);

/** One period along d and q of a rotor whose angle is known; it may move. */
commission_answer_t commission_inductance_map(commission_inductance_t   *l,
                                              const commission_config_t *c,
                                              const commission_signal_t *s,
                                              commission_result_t       *found);

#endif /* COMMISSION_INDUCTANCE_H */
