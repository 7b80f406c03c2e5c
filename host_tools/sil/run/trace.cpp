// SPDX-License-Identifier: MIT
#include "sil/run/trace.hpp"

#include <cmath>

namespace sdre {
namespace {

/// The voltage by which paper B's law compensates on the q axis.
double compensated_V(const law_dobc_config_t &c, const law_dobc_state_t &state)
{
    double u_V = 0.0;
    for (int i = 1; i < c.dobc.n_x; i++) {
        u_V += static_cast<double>(c.dobc.k_x[i] * state.dobc.x[i]);
    }
    return u_V;
}

/// The pair that stands still in the stator frame.
double sensor_offset_A(const nodo_harmonic_gains_t &g, const nodo_harmonic_t &state)
{
    for (int i = 0; i < g.n_pairs; i++) {
        if (g.pair[i].channel == NODO_HARMONIC_SENSOR && std::lround(g.pair[i].order) == -1) {
            const nodo_harmonic_pair_t &p = state.pair[i];
            return std::hypot(static_cast<double>(p.a), static_cast<double>(p.b));
        }
    }
    return 0.0;
}

/// Columns of a single law.
void add_law(TraceRow &row, const drive_t &drive)
{
    const drive_config_t &config = *drive.config;
    const auto            l6     = static_cast<double>(config.motor.l6); // volts as a current slope
    if (const auto *dobc = constants_of<law_dobc_config_t>(config)) {
        row.d_q_hat = compensated_V(*dobc, drive.law.dobc) * l6;
    } else if (constants_of<law_pid_config_t>(config) != nullptr) {
        row.d_q_hat = static_cast<double>(drive.law.pid.pid.integral_V) * l6;
    } else if (const auto *noc_h = constants_of<law_noc_h_config_t>(config)) {
        row.sensor_offset_hat_A = sensor_offset_A(noc_h->nodo, drive.law.noc_h.observer);
    }
}

} // namespace

double TraceRow::phase_A(int phase) const
{
    const double third = 2.0 * std::acos(-1.0) / 3.0;
    const double angle = theta_e_rad - third * phase;
    return id_A * std::cos(angle) - iq_A * std::sin(angle);
}

TraceRow row_of(double time_s, double omega_ref_e_radps, const PlantState &plant)
{
    TraceRow row;
    row.time_s            = time_s;
    row.omega_ref_e_radps = omega_ref_e_radps;
    row.omega_e_radps     = plant.omega_e_radps;
    row.iq_A              = plant.current_A.q;
    row.id_A              = plant.current_A.d;
    row.load_torque_Nm    = plant.load_Nm;
    row.torque_Nm         = plant.torque_Nm;
    row.dc_link_V         = plant.dc_link_V;
    row.theta_e_rad       = plant.theta_e_rad;
    row.position_e_rad    = plant.theta_e_rad;
    return row;
}

double instant_A(const TraceRow &row)
{
    return std::hypot(row.id_A, row.iq_A);
}

void add_drive(TraceRow &row, const drive_t &drive)
{
    row.iq_ref_A    = static_cast<double>(drive.answer.i_ref_A.q);
    row.id_ref_A    = static_cast<double>(drive.answer.i_ref_A.d);
    row.vq_V        = static_cast<double>(drive.v_V.q);
    row.vd_V        = static_cast<double>(drive.v_V.d);
    row.d_omega_hat = static_cast<double>(drive.answer.d_omega);
    row.d_q_hat     = static_cast<double>(drive.answer.d_q);
    row.d_d_hat     = static_cast<double>(drive.answer.d_d);
    if (drive.config != nullptr) {
        add_law(row, drive);
    }
}

} // namespace sdre
