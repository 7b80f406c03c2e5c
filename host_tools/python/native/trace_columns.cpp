// SPDX-License-Identifier: MIT
#include "trace_columns.hpp"

namespace sdre {
namespace {

template <double TraceRow::*Value> double value(const TraceRow &row)
{
    return row.*Value;
}

template <std::size_t Phase> double phase_A(const TraceRow &row)
{
    return row.phase_A[Phase];
}

} // namespace

const std::vector<TraceColumn> &trace_columns()
{
    static const std::vector<TraceColumn> columns{
        {"time_s", value<&TraceRow::time_s>},
        {"omega_ref_e_radps", value<&TraceRow::omega_ref_e_radps>},
        {"omega_e_radps", value<&TraceRow::omega_e_radps>},
        {"iq_A", value<&TraceRow::iq_A>},
        {"id_A", value<&TraceRow::id_A>},
        {"iq_ref_A", value<&TraceRow::iq_ref_A>},
        {"id_ref_A", value<&TraceRow::id_ref_A>},
        {"vq_V", value<&TraceRow::vq_V>},
        {"vd_V", value<&TraceRow::vd_V>},
        {"d_omega_hat", value<&TraceRow::d_omega_hat>},
        {"d_q_hat", value<&TraceRow::d_q_hat>},
        {"d_d_hat", value<&TraceRow::d_d_hat>},
        {"sensor_offset_hat_A", value<&TraceRow::sensor_offset_hat_A>},
        {"load_torque_Nm", value<&TraceRow::load_torque_Nm>},
        {"torque_Nm", value<&TraceRow::torque_Nm>},
        {"dc_link_V", value<&TraceRow::dc_link_V>},
        {"position_e_rad", value<&TraceRow::position_e_rad>},
        {"position_ref_e_rad", value<&TraceRow::position_ref_e_rad>},
        {"ia_A", phase_A<0>},
        {"ib_A", phase_A<1>},
        {"ic_A", phase_A<2>},
        {"peak_current_A", value<&TraceRow::peak_current_A>}};
    return columns;
}

} // namespace sdre
