/* SPDX-License-Identifier: MIT */
/**
 * @file commission_sensors.h
 * @brief Whether the current sensors still answer while a stage of the self-commissioning runs.
 */
#ifndef COMMISSION_SENSORS_H
#define COMMISSION_SENSORS_H

#include "commission.h"

/** LOOK, which begins with the check. Another check interrupts a wave that does not reach its
 * current: a sensor may have died. Context: control ISR. */
commission_answer_t commission_sensors_look(commission_t *m, const commission_signal_t *s);

/** False when the sensors do not show the current of the voltage. Context: control ISR. */
bool commission_sensors_explain(commission_t *m, const commission_signal_t *s);

/** Adds pulses to a direct current that is off its reference, and to the first one. The sensors
 * have to answer as in the check. Context: control ISR. */
void commission_sensors_probe(commission_t *m, const commission_signal_t *s,
                              commission_answer_t *out);

#endif /* COMMISSION_SENSORS_H */
