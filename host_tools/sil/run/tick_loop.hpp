// SPDX-License-Identifier: MIT
/// The loop over the control periods of a scenario, with the core alone or an application on a
/// board.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sil/run/controller.hpp"
#include "sil/run/trace.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

struct SimulationResult {
    Trace  trace;
    int    fault                        = 0; ///< drive_fault_t; 0 = none
    double fault_time_s                 = 0.0;
    int    ended                        = 0;   ///< why the trace stops early; 0 = it does not
    double simulated_seconds_per_second = 0.0; ///< wall clock
    bool   compiled_table = false;        ///< the generated table was used, not gains solved here
    std::vector<std::string> uncertified; ///< why the gains would not have been written as a table
};

/// Result of one control period.
struct TickEnd {
    TraceRow row;
    int      fault = 0; ///< the core's or the application's at this tick
    int      ended = 0; ///< why nothing can follow; 0: the run goes on
};

/// Control periods of a scenario; the last begins at its end.
inline long ticks_of(const Scenario &s)
{
    return static_cast<long>(std::floor(s.duration_s / control_period_s(s.drive) + 1e-9)) + 1;
}

/// step(time_s, omega_ref_e_radps) runs one control period and gives its TickEnd. The first fault stays.
template <typename Step>
SimulationResult run_ticks(const Scenario &s, const Controller &controller, const Step &step)
{
    const double     ts    = control_period_s(s.drive);
    const long       ticks = ticks_of(s);
    StepCursor       reference(s.speed_reference, s.initial_speed_e_radps);
    SimulationResult result;
    result.compiled_table = controller.compiled_table;
    result.uncertified    = controller.uncertified;
    result.trace.reserve(static_cast<std::size_t>(ticks));
    const auto start = std::chrono::steady_clock::now();
    for (long k = 0; k < ticks; k++) {
        const double  t   = static_cast<double>(k) * ts;
        const TickEnd end = step(t, reference.at(t));
        result.trace.push_back(end.row);
        const int fault = end.fault != 0 ? end.fault : end.ended;
        if (fault != 0 && result.fault == 0) {
            result.fault        = fault;
            result.fault_time_s = t;
        }
        if (end.ended != 0) {
            result.ended = end.ended;
            break;
        }
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    result.simulated_seconds_per_second =
        static_cast<double>(result.trace.size()) * ts / wall.count();
    return result;
}

} // namespace sdre
