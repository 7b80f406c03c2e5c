// SPDX-License-Identifier: MIT
/// Current sensors of the shipped drive whose zero drifts while it holds a speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/parallel.hpp"
#include "sil/run/simulation.hpp"
#include "temp_dir.hpp"

namespace drifts {

constexpr double when_s = 0.1; // of the first error

struct Drift {
    double speed_e_radps = 0.0;
    double load_Nm       = 0.0; ///< motoring with the sign of the speed
    double rate_Aps      = 0.0;
    double until_A       = 0.0;
    char   phase         = 'a';
    int    fault         = 0;
    double fault_time_s  = 0.0; ///< from the first error
    double peak_A        = 0.0; ///< of the true current

    std::string text() const
    {
        return fmt::format(
            "{} rad/s, {} N m, {} A/s to {} A in {}: fault {} after {:.3f} s, {:.2f} A",
            speed_e_radps, load_Nm, rate_Aps, until_A, phase, fault, fault_time_s, peak_A);
    }
};

struct Sweep {
    std::vector<double> speeds_e_radps, loads_Nm, rates_Aps, until_A;
};

inline sdre::Scenario scenario_of(const Drift &d)
{
    const support::TempDir dir;
    return sdre::read_scenario_file(dir.write(
        "s.toml",
        fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml\"\n"
                    "duration_s = {}\ninitial_speed_e_radps = {}\n[sensors]\n"
                    "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = {}\n"
                    "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = {}\n"
                    "[[fault]]\ntime_s = {}\nkind = \"current_drift\"\nphase = \"{}\"\n"
                    "rate_Aps = {}\nuntil_A = {}\n",
                    when_s + d.until_A / std::abs(d.rate_Aps) + 0.3, d.speed_e_radps,
                    d.speed_e_radps, d.load_Nm, when_s, d.phase, d.rate_Aps, d.until_A)));
}

/// Every combination, with both signs of the drift and in both phases. Each has another rotor angle and disc.
inline std::vector<Drift> run(const Sweep &sweep)
{
    std::vector<Drift> all;
    for (const double speed : sweep.speeds_e_radps) {
        for (const double load : sweep.loads_Nm) {
            for (const double rate : sweep.rates_Aps) {
                for (const double until : sweep.until_A) {
                    for (const double sign : {-1.0, 1.0}) {
                        all.push_back({speed, load, sign * rate, until, 'a'});
                        all.push_back({speed, load, sign * rate, until, 'b'});
                    }
                }
            }
        }
    }
    const sdre::Controller controller = sdre::prepare_controller(scenario_of(all.front()));
    sdre::parallel_for(all.size(), [&](std::size_t n) {
        Drift         &d                    = all[n];
        sdre::Scenario s                    = scenario_of(d);
        s.seed                              = n + 1;
        const sdre::SimulationResult result = sdre::simulate(s, controller);
        d.fault                             = result.fault;
        d.fault_time_s                      = result.fault_time_s - when_s;
        for (const sdre::TraceRow &row : result.trace) {
            d.peak_A = std::max(d.peak_A, row.time_s < when_s ? 0.0 : row.peak_current_A);
        }
    });
    return all;
}

} // namespace drifts
