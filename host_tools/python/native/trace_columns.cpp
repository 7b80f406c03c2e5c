// SPDX-License-Identifier: MIT
#include "trace_columns.hpp"

namespace sdre {

const std::vector<TraceColumn> &trace_columns()
{
    static const std::vector<TraceColumn> columns{
        {"time_s", &TraceRow::time_s},
        {"omega_ref_e_radps", &TraceRow::omega_ref_e_radps},
        {"omega_e_radps", &TraceRow::omega_e_radps},
        {"iq_A", &TraceRow::iq_A},
        {"id_A", &TraceRow::id_A},
        {"iq_ref_A", &TraceRow::iq_ref_A},
        {"id_ref_A", &TraceRow::id_ref_A},
        {"vq_V", &TraceRow::vq_V},
        {"vd_V", &TraceRow::vd_V},
        {"d_omega_hat", &TraceRow::d_omega_hat},
        {"d_q_hat", &TraceRow::d_q_hat},
        {"d_d_hat", &TraceRow::d_d_hat},
        {"sensor_offset_hat_A", &TraceRow::sensor_offset_hat_A},
        {"load_torque_Nm", &TraceRow::load_torque_Nm},
        {"torque_Nm", &TraceRow::torque_Nm},
        {"dc_link_V", &TraceRow::dc_link_V},
        {"peak_current_A", &TraceRow::peak_current_A}};
    return columns;
}

} // namespace sdre
