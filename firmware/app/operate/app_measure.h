/* SPDX-License-Identifier: MIT */
/**
 * @file app_measure.h
 * @brief First part of app_modes_tick(): the sample in SI units, angle, position, warmth.
 */
#ifndef APP_MEASURE_H
#define APP_MEASURE_H

#include "app_modes.h"

/** Takes the sample of this period. An invalid one drops the angle reference, because counts may be
 * lost. Context: control ISR. */
void app_measure(app_modes_t *m, const app_modes_input_t *in);

#endif /* APP_MEASURE_H */
