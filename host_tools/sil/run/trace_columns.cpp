// SPDX-License-Identifier: MIT
#include "sil/run/trace_columns.hpp"

namespace sdre {
namespace {

template <double TraceRow::*Value> double value(const TraceRow &row)
{
    return row.*Value;
}

template <int Phase> double phase_A(const TraceRow &row)
{
    return row.phase_A(Phase);
}

} // namespace

const std::vector<TraceColumn> &trace_columns()
{
    static const std::vector<TraceColumn> columns{
        {"time_s", value<&TraceRow::time_s>, 10},
        {"omega_ref_e_radps", value<&TraceRow::omega_ref_e_radps>, 10},
        {"omega_e_radps", value<&TraceRow::omega_e_radps>, 10},
        {"iq_A", value<&TraceRow::iq_A>, 9},
        {"id_A", value<&TraceRow::id_A>, 9},
        {"iq_ref_A", value<&TraceRow::iq_ref_A>, 9},
        {"id_ref_A", value<&TraceRow::id_ref_A>, 9},
        {"vq_V", value<&TraceRow::vq_V>, 9},
        {"vd_V", value<&TraceRow::vd_V>, 9},
        {"d_omega_hat", value<&TraceRow::d_omega_hat>, 9},
        {"d_q_hat", value<&TraceRow::d_q_hat>, 9},
        {"d_d_hat", value<&TraceRow::d_d_hat>, 9},
        {"sensor_offset_hat_A", value<&TraceRow::sensor_offset_hat_A>, 0},
        {"load_torque_Nm", value<&TraceRow::load_torque_Nm>, 9},
        {"torque_Nm", value<&TraceRow::torque_Nm>, 9},
        {"dc_link_V", value<&TraceRow::dc_link_V>, 9},
        {"position_e_rad", value<&TraceRow::position_e_rad>, 12},
        {"position_ref_e_rad", value<&TraceRow::position_ref_e_rad>, 12},
        {"ia_A", phase_A<0>, 9},
        {"ib_A", phase_A<1>, 9},
        {"ic_A", phase_A<2>, 9},
        {"peak_current_A", value<&TraceRow::peak_current_A>, 0}};
    return columns;
}

} // namespace sdre
