// SPDX-License-Identifier: MIT
#include "design/noc_iron/iron_design.hpp"

#include <algorithm>
#include <cmath>

#include "design/motor_model.hpp"

namespace sdre {

iron_map_t iron_table(const Motor &m, const SaturatedMotor &iron)
{
    const double d_node = m.max_current_A / (IRON_NODES_D - 1);
    const double q_node = m.max_current_A / (IRON_NODES_Q - 1);

    iron_map_t t{};
    t.nodes_per_A_d = static_cast<float>(1.0 / d_node);
    t.nodes_per_A_q = static_cast<float>(1.0 / q_node);
    t.A_per_node_d  = static_cast<float>(d_node);
    t.A_per_node_q  = static_cast<float>(q_node);
    t.rs_Ohm        = static_cast<float>(m.stator_resistance_Ohm);
    t.accel_per_WbA = static_cast<float>(1.5 * m.pole_pairs * m.pole_pairs / m.inertia_kgm2);
    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            const FluxAt f           = iron.at(-d_node * i, q_node * j);
            t.node[i][j][IRON_PSI_D] = static_cast<float>(f.d_Wb);
            t.node[i][j][IRON_PSI_Q] = static_cast<float>(f.q_Wb);
            t.node[i][j][IRON_LD]    = static_cast<float>(f.dd_H);
            t.node[i][j][IRON_LQ]    = static_cast<float>(f.qq_H);
            t.node[i][j][IRON_LDQ]   = static_cast<float>(0.5 * (f.dq_H + f.qd_H));
        }
    }
    return t;
}

double iron_table_error(const Drive &drive, const iron_map_t &table)
{
    constexpr int         steps   = 40; // of the current limit
    const double          most_A  = drive.motor.max_current_A;
    const motor_reduced_t plain   = {};
    double                error   = 0.0;
    double                largest = 0.0;
    for (int i = 0; i <= steps; i++) {
        for (int j = 0; j <= steps; j++) {
            const double id_A = -most_A * i / steps;
            const double iq_A = most_A * j / steps;
            if (std::hypot(id_A, iq_A) > most_A) {
                continue;
            }
            const FluxAt         f = drive.saturation->at(id_A, iq_A);
            const iron_tangent_t t =
                iron_tangent(&table, &plain, static_cast<float>(id_A), static_cast<float>(iq_A));
            const double d = static_cast<double>(t.psi_d_Wb) - f.d_Wb;
            const double q = static_cast<double>(t.psi_q_Wb) - f.q_Wb;
            error          = std::max(error, std::hypot(d, q));
            largest        = std::max(largest, std::hypot(f.d_Wb, f.q_Wb));
        }
    }
    return error / largest;
}

} // namespace sdre
