// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "design/laws/near_optimal.hpp"

namespace sdre {
namespace {

// Chosen: rounding takes half a count, an edge up to another half, and the estimate follows both.
// The rest is for eccentric discs and for motors that differ from the nominal one.
constexpr double quiet_cnt = 4.0;
// Chosen: an edge is off by less than 0.5 counts, and a reading by half of one more. A smaller step
// would cut the encoder's own error, which is not symmetric, and leave a bias. With much inertia,
// loads cause less than this.
constexpr double least_step_cnt = 0.8;
// Long against any observer that is certified: its slowest pole forgets within this.
constexpr int periods = 10000;

/// Largest innovation after a step of the speed's disturbance, with currents that are known.
double step_innovation_rad(double step_e_radps2, const encoder_form_gains_t &gains, double ts_s)
{
    double theta   = 0.0; // errors of the estimates
    double omega   = 0.0;
    double d_omega = step_e_radps2;
    double worst   = 0.0;
    for (int k = 0; k < periods; k++) {
        theta += ts_s * (omega + 0.5 * ts_s * d_omega);
        omega += ts_s * d_omega;
        const double innovation = theta;
        theta -= static_cast<double>(gains.theta) * innovation;
        omega -= static_cast<double>(gains.omega_1ps) * innovation;
        d_omega -= static_cast<double>(gains.d_omega_1ps2) * innovation;
        worst = std::max(worst, std::abs(innovation));
    }
    return worst;
}

} // namespace

angle_gate_config_t angle_gate_constants(const encoder_form_limits_t &limits,
                                         const encoder_form_gains_t &gains, double ts_s)
{
    const double count_rad = static_cast<double>(gains.count_rad);
    const double step_rad =
        std::max(step_innovation_rad(static_cast<double>(limits.d_omega), gains, ts_s),
                 least_step_cnt * count_rad); // EQ-ANGLE-GATE-3
    const auto most_rad = static_cast<double>(limits.angle_rad);
    return {static_cast<float>(std::min(quiet_cnt * count_rad + step_rad, most_rad)),
            static_cast<float>(std::min(step_rad, most_rad)), gains.count_rad, limits.d_omega};
}

} // namespace sdre
