/* SPDX-License-Identifier: MIT */
/**
 * @file commission_inductance.h
 * @brief Inductances from square-wave voltages, in the stator frame or along d and q.
 *
 *     v Ts = L di + (R i + loss) Ts,  L 2 x 2 by least squares from v and di              EQ-COMMISSION-4
 *     axis of the larger one: tan 2 a = 2 L_ab / (L_aa - L_bb)                            EQ-COMMISSION-5
 *     along an axis: L = Ts sum(di (v - R i - e)) / (sum(di^2) - n var)                   EQ-COMMISSION-6
 *
 * The stator-frame measurement needs no rotor angle. R i and the inverter loss are odd in the
 * current and di is even over a full wave: both hardly change L. The known part of R i is
 * subtracted anyway.
 *
 * Here e is the back-EMF in the q axis, from the counted speed. The variance var is that of the
 * noise of di, from samples with the motor at rest. Without this correction L would be too small. In
 * the stator frame the noise would also turn the axis of the larger one.
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
    int16_t            axis;      /**< LOOK: 0 .. 3, MAP: d, q */
    frames_angle_t     direction; /**< of the wave in LOOK */
    int16_t            wait_ticks;
    commission_fit_t   alpha; /**< v_alpha against di, both axes' waves */
    commission_fit_t   beta;
    commission_bin_t   bins[2][2][COMMISSION_BINS]; /**< axis, sign of the current, bin */
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

/** Executes one period of MAP: inductances along d and q. The rotor angle is known; it may move. */
commission_answer_t commission_inductance_map(commission_inductance_t   *l,
                                              const commission_config_t *c,
                                              const commission_signal_t *s,
                                              commission_result_t *found, commission_map_t *map);

#endif /* COMMISSION_INDUCTANCE_H */
