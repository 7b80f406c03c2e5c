/* SPDX-License-Identifier: MIT */
/**
 * @file motor_stub.h
 * @brief A motor without load on an ideal averaging inverter, EQ-MOTOR-2 in single precision.
 */
#ifndef MOTOR_STUB_H
#define MOTOR_STUB_H

#include "base.h"
#include "motor.h"

typedef struct {
    float iq_A;
    float id_A;
    float omega_e_radps;
    float theta_m_rad; /**< of the shaft, 0 .. 2 pi */
} motor_stub_t;

/** Phase currents [A]. */
abc_t motor_stub_current_A(const motor_stub_t *m, uint16_t pole_pairs);

/** Advances by a period with the phases at these voltages [V]. */
void motor_stub_drive(motor_stub_t *m, const motor_reduced_t *l, uint16_t pole_pairs, abc_t v_V,
                      float ts_s);

/** Advances by a period with the bridge open: the currents become zero at once. */
void motor_stub_coast(motor_stub_t *m, const motor_reduced_t *l, uint16_t pole_pairs, float ts_s);

#endif /* MOTOR_STUB_H */
