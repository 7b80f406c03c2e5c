/* SPDX-License-Identifier: MIT */
/**
 * @file servo.h
 * @brief Common part of paper B's laws: speed error to q voltage, and a PI that keeps id at zero.
 *
 * They act on measurement and command directly, without prediction or reference model. They have no
 * current limit; only the trip limits the current. The measured speed must use edge times: with
 * 10,000 counts and 4 pole pairs, one count per 100 us is 63 rad/s electrical.
 */
#ifndef SERVO_H
#define SERVO_H

#include "drive_config.h"
#include "pid_law.h"
#include "sample.h"

/** Answer of a law with this voltage and this measurement. Context: control ISR. */
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

/** d voltage of EQ-PID-1 for id = 0, after EQ-PID-2 for the realised one. Context: control ISR. */
static inline float servo_d_voltage_V(pid_law_t *s, const pid_law_config_t *c,
                                      const law_input_t *in, float id_A)
{
    pid_law_realise(s, c, in->v_V.d);
    return pid_law_update(s, c, -id_A);
}

#endif /* SERVO_H */
