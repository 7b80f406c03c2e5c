// SPDX-License-Identifier: MIT
/// The control core against the plant, tick by tick.
///
/// The duty ratios computed from the samples of tick k act from t_k+1 to t_k+2. The controller is
/// enabled at t = 0 on a motor that turns at the initial speed without current.
#pragma once

#include "drive/core_types.hpp"
#include "sil/run/board.hpp"
#include "sil/run/controller.hpp"
#include "sil/run/faults.hpp"
#include "sil/run/position_commands.hpp"
#include "sil/run/tick_loop.hpp"
#include "sil/run/torque_commands.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// A run that the caller steps. Scenario and controller must outlive it.
class Simulation {
public:
    /// DesignError when the core refuses the controller's constants.
    Simulation(const Scenario &scenario, const Controller &controller);
    Simulation(const Simulation &)            = delete; // the core points to its constants
    Simulation &operator=(const Simulation &) = delete;

    /// One control period: the core's tick with this commanded speed, then the plant up to the next tick.
    TickEnd step(double omega_ref_e_radps);

    /// The core goes over to these constants, which must outlive it (firmware/control/drive_tick.h).
    void adopt(const drive_config_t &next)
    {
        drive_adopt(&drive_, &next);
    }

    /// Load on the shaft beside the scenario's, from the next tick on.
    void set_extra_load_Nm(double torque_Nm)
    {
        board_.set_extra_load_Nm(torque_Nm);
    }

    /// Input and output of the core at the last tick.
    struct CoreTick {
        drive_sample_t  sample;
        drive_command_t command;
        bridge_t        output;
    };
    const CoreTick &core_tick() const
    {
        return core_tick_;
    }
    /// The core between two ticks.
    const drive_t &drive() const
    {
        return drive_;
    }

private:
    double           period_s_;
    Board            board_;
    PositionCommands positions_;
    TorqueCommands   torques_;
    law_aim_t        aim_{};
    drive_t          drive_{};
    CoreTick         core_tick_{};
    bridge_t in_force_{{0.5F, 0.5F, 0.5F}, true}; ///< no voltage until the first result acts
    long     tick_        = 0;
    double   start_e_rad_ = 0.0; ///< of the shaft
};

/// Runs a scenario. DesignError when the controller's gains cannot be solved.
SimulationResult simulate(const Scenario &scenario);
/// The same with a controller that is ready, for runs that differ in the plant or the seed only.
SimulationResult simulate(const Scenario &scenario, const Controller &controller);

} // namespace sdre
