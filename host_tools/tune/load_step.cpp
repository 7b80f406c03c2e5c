// SPDX-License-Identifier: MIT
#include "tune/load_step.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: a load step is followed for this many time constants of the slowest mode, and so long at least.
constexpr double horizon_modes = 12.0;
constexpr double horizon_s     = 0.06;
constexpr double most_steps    = 20000.0; // a mode slower than that is told from its pole

int horizon_steps(const SampledModel &m)
{
    const double slowest = -1.0 / std::log(std::min(spectral_radius(m.A), 0.99999)); // periods
    return static_cast<int>(
        std::min(std::max(horizon_s / m.ts_s, horizon_modes * slowest), most_steps));
}

} // namespace

LoadStep load_step(const SampledModel &m, const TuneSpec &spec, int periods)
{
    Eigen::VectorXd x = Eigen::VectorXd::Zero(m.A.rows());
    LoadStep        step;
    for (int k = 1; k <= periods; k++) {
        x                = m.A * x + m.b_load * spec.load_step_Nm;
        step.dip_e_radps = std::max(step.dip_e_radps, std::abs(x(0)));
        step.voltage_V   = std::max(step.voltage_V, (m.C_voltage * x).norm());
        if (!(std::abs(x(0)) <= spec.band_e_radps)) {
            step.settling_time_s = k * m.ts_s;
        }
    }
    return step;
}

LoadStep load_step(const SampledModel &m, const TuneSpec &spec)
{
    return load_step(m, spec, horizon_steps(m));
}

} // namespace sdre
