// SPDX-License-Identifier: MIT
#include "emit/report_parts.hpp"

#include "linalg/linalg_checks.hpp"

namespace sdre {

double report_entry(const Eigen::MatrixXd &M, Eigen::Index row, Eigen::Index column)
{
    return gain_entry(M, row, column) == 0.0F ? 0.0 : M(row, column);
}

const char *report_channel_name(nodo_harmonic_channel_t channel)
{
    switch (channel) {
    case NODO_HARMONIC_SENSOR:
        return "current sensors";
    case NODO_HARMONIC_TORQUE:
        return "torque";
    case NODO_HARMONIC_VOLTAGE_Q:
        return "q voltage";
    case NODO_HARMONIC_VOLTAGE_D:
        return "d voltage";
    }
    return "unknown";
}

} // namespace sdre
