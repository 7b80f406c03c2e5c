// SPDX-License-Identifier: MIT
/// The control core against the plant, tick by tick.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "design/core_types.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// One control period: the plant at the sampling instant and what the core answered.
struct TraceRow {
    double time_s              = 0.0;
    double omega_ref_e_radps   = 0.0; ///< commanded
    double omega_e_radps       = 0.0;
    double iq_A                = 0.0;
    double id_A                = 0.0;
    double iq_ref_A            = 0.0;
    double id_ref_A            = 0.0;
    double vq_V                = 0.0; ///< commanded at this tick, after the limit
    double vd_V                = 0.0;
    double d_omega_hat         = 0.0;
    double d_q_hat             = 0.0;
    double d_d_hat             = 0.0;
    double sensor_offset_hat_A = 0.0; ///< length of the offset that noc_h's observer has found
    double load_torque_Nm      = 0.0;
    double torque_Nm           = 0.0;
    double dc_link_V           = 0.0;
    double peak_current_A      = 0.0; ///< largest |i| from this instant to the next
};

struct SimulationResult {
    std::vector<TraceRow> trace;
    int                   fault                        = 0; ///< drive_fault_t; 0 = none
    double                fault_time_s                 = 0.0;
    double                simulated_seconds_per_second = 0.0; ///< wall clock
    bool compiled_table = false;          ///< the generated table was used, not gains solved here
    std::vector<std::string> uncertified; ///< why the gains would not have been written as a table
};

/// The constants the core runs on, from the table or solved here.
struct Controller {
    drive_config_t                               config{};
    bool                                         compiled_table = false;
    std::vector<std::string>                     uncertified;
    std::shared_ptr<const nodo_harmonic_gains_t> harmonics; ///< what config points to, noc_h only
};

/// DesignError when the gains cannot be solved.
Controller prepare_controller(const Scenario &scenario);

/// Runs a scenario. DesignError when the controller's gains cannot be solved.
///
/// The samples of tick k meet duty ratios that act from t_k+1 to t_k+2; the controller is enabled at t = 0
/// on a motor that turns at the initial speed without current.
SimulationResult simulate(const Scenario &scenario);
/// The same with a controller that is ready, for runs that differ in the plant or the seed only.
SimulationResult simulate(const Scenario &scenario, const Controller &controller);

/// The drive's part of a row: references, voltages, estimated disturbances.
void add_drive(TraceRow &row, const drive_t &drive);

/// Faults beyond drive_fault_t in SimulationResult::fault, of runs with the application on a board.
constexpr int app_fault_base     = 100; ///< plus app_fault_t
constexpr int device_reset_fault = 200; ///< by its watchdog

/// "over current" and so on.
const char *fault_name(int fault);

} // namespace sdre
