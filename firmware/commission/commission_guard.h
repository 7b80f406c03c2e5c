/* SPDX-License-Identifier: MIT */
/**
 * @file commission_guard.h
 * @brief Compares the applied voltage with the measured current: finds a false current sensor.
 *
 * The flux linkage of the winding changes by the voltage only. The guard sums what measured
 * current and voltage say differently, and forgets it in 16 periods, in MAP and SPIN in 24:
 *
 *     e = (1 - 1/n) e + (v - u) Ts - (lambda - lambda_before)                  EQ-COMMISSION-16
 *
 * u is the known or the slow part of the voltage. With L, e is the current that the sensors do not
 * show. A jump of a sensor, or a voltage that brings no current, exceeds its limit in some periods.
 */
#ifndef COMMISSION_GUARD_H
#define COMMISSION_GUARD_H

#include "commission_check.h"
#include "commission_types.h"

/* Chosen: unexplained mean voltage, share of that of R at the bound. Healthy 0.12 in MAP, 0.26 in
 * SPIN. */
#define COMMISSION_GUARD_MAP_MEAN  0.24f
#define COMMISSION_GUARD_SPIN_MEAN 0.4f

typedef struct {
    ab_t linkage_Wb; /**< at the last sample */
    ab_t error_Wb;   /**< e */
    ab_t mean_Wb;    /**< the same, forgotten in 0.1 s */
    ab_t slow_V;     /**< slow mean of the voltage */
    bool begun;
} commission_guard_t;

/** Starts, at the begin of a stage. Context: control ISR. */
void commission_guard_start(commission_guard_t *g);

/** True while LOOK's voltage explains its current by the admittance of the check. */
bool commission_guard_look(commission_guard_t *g, const commission_config_t *c,
                           const commission_signal_t *s, const commission_admittance_t *y);

/** The same in RESISTANCE and DRAG: the rotor's angle is unknown, slow voltages are not judged. */
bool commission_guard_vector(commission_guard_t *g, const commission_config_t *c,
                             const commission_signal_t *s, const commission_result_t *known);

/** The same in MAP and SPIN, with the rotor's angle, flux and inductances. The unexplained mean
 * voltage has a limit of its own, as share of that of R at the bound. */
bool commission_guard_rotor(commission_guard_t *g, const commission_config_t *c,
                            const commission_signal_t *s, const commission_result_t *known,
                            float mean_share);

/** True when the inductances of LOOK and the check agree. Context: control ISR. */
bool commission_guard_agrees(const commission_admittance_t *y, const commission_result_t *known);

#endif /* COMMISSION_GUARD_H */
