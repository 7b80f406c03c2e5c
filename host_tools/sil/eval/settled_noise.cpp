// SPDX-License-Identifier: MIT
#include "sil/eval/settled_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/parallel.hpp"

namespace sdre {
namespace {

constexpr std::size_t seeds        = 20;
constexpr double      ripple_ratio = 5.0; // chosen: a motor with half the inertia has 1.6
constexpr double      noise_ratio  = 3.0; // chosen: ringing has 4 and more

using Runs = std::vector<std::vector<Metrics>>;

double median(const Runs &runs, std::size_t measure, double (*value)(const Metrics &))
{
    std::vector<double> values;
    for (const std::vector<Metrics> &run : runs) {
        values.push_back(value(run[measure]));
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double ripple(const Metrics &m)
{
    return m.ripple_e_radps;
}

double vq_noise(const Metrics &m)
{
    return m.effort.vq_noise_V;
}

double vd_noise(const Metrics &m)
{
    return m.effort.vd_noise_V;
}

} // namespace

std::vector<NoiseLimit> noise_limits(const Scenario &scenario, const Controller &controller)
{
    Scenario believed    = scenario;
    believed.plant_scale = scenario.controller_scale;
    Runs             runs(seeds);
    std::vector<int> faults(seeds);
    parallel_for(seeds, [&](std::size_t i) {
        Scenario one                  = believed;
        one.seed                      = i + 1;
        const SimulationResult result = simulate(one, controller);
        faults[i]                     = result.fault;
        runs[i]                       = measure(one, result.trace);
    });
    if (std::any_of(faults.begin(), faults.end(), [](int fault) { return fault != 0; })) {
        return {};
    }
    const Drive &d       = scenario.drive;
    const double quiet_V = quiet_voltage_share * d.inverter.dc_link_V / std::sqrt(3.0);
    const double quiet   = quiet_speed_share * d.motor.rated_speed_e_radps;

    std::vector<NoiseLimit> limits;
    for (std::size_t m = 0; m < runs[0].size(); m++) {
        limits.push_back({runs[0][m].time_s,
                          std::max(quiet, ripple_ratio * median(runs, m, ripple)),
                          std::max(quiet_V, noise_ratio * median(runs, m, vq_noise)),
                          std::max(quiet_V, noise_ratio * median(runs, m, vd_noise))});
    }
    return limits;
}

std::vector<std::string> noise_reasons(const std::vector<Metrics>    &metrics,
                                       const std::vector<NoiseLimit> &limits)
{
    std::vector<std::string> reasons;
    const auto beyond = [&](const Metrics &m, const char *what, double is, double most,
                            const char *unit) {
        if (!(is <= most)) {
            reasons.push_back(
                fmt::format("{}: {} {:.3g} {}, allowed {:.3g}", m.name, what, is, unit, most));
        }
    };
    for (const Metrics &m : metrics) {
        const auto limit = std::find_if(limits.begin(), limits.end(), [&](const NoiseLimit &one) {
            return one.time_s == m.time_s;
        });
        if (limit != limits.end()) {
            beyond(m, "ripple", m.ripple_e_radps, limit->ripple_e_radps, "rad/s");
            beyond(m, "v_q noise", m.effort.vq_noise_V, limit->vq_noise_V, "V");
            beyond(m, "v_d noise", m.effort.vd_noise_V, limit->vd_noise_V, "V");
        }
    }
    return reasons;
}

} // namespace sdre
