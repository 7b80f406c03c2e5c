// SPDX-License-Identifier: MIT
#include "sil/run/trace.hpp"

#include <cmath>

namespace sdre {
namespace {

/// What paper B's law compensates on the q axis, as a current slope.
double disturbance_Aps(const drive_t &drive)
{
    const servo_law_config_t &c   = drive.config->servo;
    double                    u_V = static_cast<double>(drive.servo.pid.integral_V);
    if (c.kind == SERVO_LAW_DOBC) {
        u_V = 0.0;
        for (int i = 1; i < c.dobc.n_x; i++) {
            u_V += static_cast<double>(c.dobc.k_x[i] * drive.servo.dobc.x[i]);
        }
    }
    return u_V * static_cast<double>(drive.config->motor.l6);
}

/// The pair that stands still in the stator frame.
double sensor_offset_A(const drive_t &drive)
{
    const nodo_harmonic_gains_t &g = *drive.config->nodo_harmonic;
    for (int i = 0; i < g.n_pairs; i++) {
        if (g.pair[i].channel == NODO_HARMONIC_SENSOR && std::lround(g.pair[i].order) == -1) {
            const nodo_harmonic_pair_t &p = drive.harmonic.pair[i];
            return std::hypot(static_cast<double>(p.a), static_cast<double>(p.b));
        }
    }
    return 0.0;
}

} // namespace

void add_drive(TraceRow &row, const drive_t &drive)
{
    row.iq_ref_A    = static_cast<double>(drive.current_ref.i_A.q);
    row.id_ref_A    = static_cast<double>(drive.current_ref.i_A.d);
    row.vq_V        = static_cast<double>(drive.v_V.q);
    row.vd_V        = static_cast<double>(drive.v_V.d);
    row.d_omega_hat = static_cast<double>(drive.observer.d_omega);
    row.d_q_hat     = static_cast<double>(drive.observer.d_q);
    row.d_d_hat     = static_cast<double>(drive.observer.d_d);
    if (drive.config != nullptr && drive.config->law == DRIVE_LAW_SERVO) {
        row.d_q_hat = disturbance_Aps(drive);
    }
    if (drive.config != nullptr && drive.config->law == DRIVE_LAW_NOC_H) {
        row.sensor_offset_hat_A = sensor_offset_A(drive);
    }
}

} // namespace sdre
