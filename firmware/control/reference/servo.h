/* SPDX-License-Identifier: MIT */
/**
 * @file servo.h
 * @brief What paper B's laws share: speed to q voltage directly, a PI that keeps id at zero.
 *
 * They act on the measurement and on the command itself: they have neither a prediction nor a reference model, and no
 * current limit; the trip is the only bound. The measured speed must be time-stamped at the encoder's edges: one
 * count per 100 us period is 63 rad/s electrical with 10,000 counts and 4 pole pairs.
 */
#ifndef SERVO_H
#define SERVO_H

#include "drive_config.h"
#include "pid_law.h"
#include "sample.h"

/** The answer of a law that wants this voltage for this measurement. Context: control ISR. */
static inline void servo_answer(const drive_config_t *drive, const law_input_t *in,
                                const nodo_meas_t *y, dq_t v_V, law_output_t *out)
{
    const dq_t none = {0.0f, 0.0f};

    out->v_V             = v_V;
    out->theta_rad       = sample_middle_angle_rad(in->sample, drive->ts_s);
    out->now             = *y;
    out->i_ref_A         = none;
    out->d_omega         = 0.0f;
    out->d_q             = 0.0f;
    out->d_d             = 0.0f;
    out->ignored_angles  = 0U;
    out->without_angle   = false;
    out->plausible       = true;
    out->profile_e_radps = 0.0f;
    out->arrived         = false;
    out->waits           = false;
    out->predicted       = false;
}

/** d voltage of EQ-PID-1 for id = 0, after what the limits left of the one before. Context: control ISR. */
static inline float servo_d_voltage_V(pid_law_t *s, const pid_law_config_t *c,
                                      const law_input_t *in, float id_A)
{
    pid_law_realise(s, c, in->v_V.d);
    return pid_law_update(s, c, -id_A);
}

#endif /* SERVO_H */
