/* SPDX-License-Identifier: MIT */
/**
 * @file law_pi_foc.h
 * @brief Cascaded PI field-oriented control: the usual drive (foc.h) with a PI for the speed.
 *
 *     r(k+1) = r + (command - r) Ts / T_i                                        EQ-PI-FOC-1
 *     a = k_p e + s,  e = r - w                                                  EQ-PI-FOC-2
 *     s(k+1) = s + k_i e, or s if the current limit acts towards e               EQ-PI-FOC-3
 *     a = k_p e + s - z_f                                                        EQ-PI-FOC-5
 *     a = T np / J + z_f within -k_p (w_max + w) .. k_p (w_max - w), - z_f       EQ-PI-FOC-6
 *
 * EQ-PI-FOC-1 acts against the overshoot. Here a is the acceleration requested of the motor's
 * torque. The sum s holds the load torque even after a long time at the limit. With
 * back-calculation it would not, and the speed would overshoot. k_p and T_i follow the symmetrical
 * optimum (docs/equations.md).
 *
 * With a load observer (speed_observer.h) its estimate z_f is fed forward, EQ-PI-FOC-5 in place of
 * 2. Gains of zero switch it off: z_f then stays zero.
 *
 * A torque run skips the speed loop. EQ-PI-FOC-6 is the torque T within the speed limit w_max, a P
 * of the speed. Without a load observer the speed stays load / k_p off the limit.
 */
#ifndef LAW_PI_FOC_H
#define LAW_PI_FOC_H

#include "foc.h"
#include "speed_difference.h"
#include "speed_observer.h"

/** Gains of the speed PI. */
typedef struct {
    float kp_1ps;    /**< > 0 */
    float ki_per_kp; /**< k_i Ts / k_p = Ts / T_i, of the reference's filter too, (0, 1] */
    speed_observer_gains_t load; /**< zero: no load observer */
} law_pi_foc_gains_t;

typedef struct {
    foc_config_t              foc;
    speed_difference_config_t speed;
    law_pi_foc_gains_t        gains[SPEED_DIFFERENCE_MODES];
} law_pi_foc_config_t;

typedef struct {
    foc_t              foc;
    speed_difference_t speed;
    speed_observer_t   load;
    float              r_e_radps;
    float              sum_e_radps2;
} law_pi_foc_state_t;

void law_pi_foc_fields(fields_t *f, void *constants); /**< for law_pi_foc.fields */

extern const law_t law_pi_foc;

#endif /* LAW_PI_FOC_H */
