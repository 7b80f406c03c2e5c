// SPDX-License-Identifier: MIT
#include "sil/setup/metric_names.hpp"

#include <algorithm>

namespace sdre {

const std::vector<std::string> &metric_names()
{
    static const std::vector<std::string> names{"settling_time_s",
                                                "dip_e_radps",
                                                "overshoot_e_radps",
                                                "steady_state_error_e_radps",
                                                "ripple_e_radps",
                                                "peak_current_A",
                                                "steady_current_A",
                                                "vq_noise_V",
                                                "vd_noise_V",
                                                "vq_noise_percent",
                                                "iq_noise_A",
                                                "torque_noise_percent",
                                                "audible_torque_percent",
                                                "audible_current_A",
                                                "equivalent_delay_s",
                                                "d_omega_hat",
                                                "d_q_hat",
                                                "d_d_hat",
                                                "iq_A",
                                                "id_A",
                                                "sensor_offset_hat_A",
                                                "position_off_cnt",
                                                "position_steady_cnt",
                                                "position_settled_s",
                                                "position_overshoot_cnt",
                                                "torque_rise_s",
                                                "torque_overshoot_percent",
                                                "torque_error_percent",
                                                "torque_ripple_percent",
                                                "current_distortion_percent",
                                                "fluctuation_rpm",
                                                "fluctuation_rate_percent",
                                                "offset_rpm",
                                                "decrease_rpm",
                                                "overshoot_percent",
                                                "within_5_percent_s",
                                                "within_2_percent_s",
                                                "within_1_percent_s"};
    return names;
}

bool is_metric_name(const std::string &name)
{
    const std::vector<std::string> &names = metric_names();
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace sdre
