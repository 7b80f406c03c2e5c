// SPDX-License-Identifier: MIT
/// The control core against the plant, tick by tick.
#pragma once

#include <string>
#include <vector>

#include "sil/run/controller.hpp"
#include "sil/run/faults.hpp"
#include "sil/run/trace.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

struct SimulationResult {
    std::vector<TraceRow> trace;
    int                   fault                        = 0; ///< drive_fault_t; 0 = none
    double                fault_time_s                 = 0.0;
    double                simulated_seconds_per_second = 0.0; ///< wall clock
    bool compiled_table = false;          ///< the generated table was used, not gains solved here
    std::vector<std::string> uncertified; ///< why the gains would not have been written as a table
};

/// Runs a scenario. DesignError when the controller's gains cannot be solved.
///
/// The samples of tick k meet duty ratios that act from t_k+1 to t_k+2; the controller is enabled at t = 0
/// on a motor that turns at the initial speed without current.
SimulationResult simulate(const Scenario &scenario);
/// The same with a controller that is ready, for runs that differ in the plant or the seed only.
SimulationResult simulate(const Scenario &scenario, const Controller &controller);

} // namespace sdre
