/* SPDX-License-Identifier: MIT */
/**
 * @file estimate.h
 * @brief The first half of a control period: from a sample to the state that the laws of near optimal control act on.
 *
 * Writes observer, angle, d_w' and state of a drive; which observer runs is the law's and the form's choice.
 */
#ifndef ESTIMATE_H
#define ESTIMATE_H

#include "drive_tick.h"

/** Speed and currents as measured, in the frame of the measured angle. Context: control ISR. */
nodo_meas_t estimate_measurement(const drive_sample_t *s);

/** From the measured speed: the angle of the middle of the period in which the new voltage acts, EQ-DRIVE-2. */
float estimate_middle_angle_rad(const drive_config_t *c, const drive_sample_t *s);

/** The observers take over the measurement; nothing is known of any disturbance. Context: control ISR. */
void estimate_start(drive_t *d, const drive_sample_t *s);

/**
 * @brief One period of the drive's observer.
 *
 * @param d         Drive; its observer and state are updated.
 * @param s         Measurements, in range.
 * @param plausible Set false when the angle cannot be right; otherwise left alone.
 * @return          The angle as of estimate_middle_angle_rad(), measured or estimated.
 *
 * Context: control ISR.
 */
float estimate_update(drive_t *d, const drive_sample_t *s, bool *plausible);

#endif /* ESTIMATE_H */
