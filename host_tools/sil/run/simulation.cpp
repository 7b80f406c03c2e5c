// SPDX-License-Identifier: MIT
#include "sil/run/simulation.hpp"

#include "common/errors.hpp"

namespace sdre {

Simulation::Simulation(const Scenario &scenario, const Controller &controller)
    : period_s_(control_period_s(scenario.drive)), board_(scenario), positions_(scenario),
      torques_(scenario, controller.config)
{
    for (const InjectedFault &f : scenario.faults) {
        if (needs_processor(f.kind)) {
            throw InputError("[[fault]] of the processor needs --board f28335");
        }
        if (is_of_a_sensor(f.kind) && f.phase == 2) {
            throw InputError(
                "[[fault]] of current sensor c needs --board: the application reads it");
        }
    }
    if (drive_init(&drive_, &controller.config) != CTL_OK) {
        throw DesignError("the control core refuses these constants");
    }
    start_e_rad_ = board_.plant_state().theta_e_rad;
}

TickEnd Simulation::step(double omega_ref_e_radps)
{
    const double time_s = static_cast<double>(tick_++) * period_s_;
    board_.begin_tick(time_s);
    core_tick_.sample  = board_.sample();
    aim_               = {positions_.at(time_s, core_tick_.sample), torques_.at(time_s)};
    const bool other   = aim_.position != nullptr || aim_.torque != nullptr;
    core_tick_.command = {static_cast<float>(omega_ref_e_radps), true, 0.0F,
                          other ? &aim_ : nullptr};
    const std::optional<double> position_ref =
        positions_.reference_e_rad(drive_); // of this instant
    core_tick_.output = drive_tick(&drive_, &core_tick_.sample, &core_tick_.command);

    TickEnd end;
    end.row = row_of(time_s, omega_ref_e_radps, board_.plant_state());
    add_drive(end.row, drive_);
    end.row.position_e_rad     = end.row.position_e_rad - positions_.zero_e_rad(start_e_rad_);
    end.row.position_ref_e_rad = position_ref.value_or(end.row.position_e_rad);
    end.fault                  = drive_.state == DRIVE_FAULT ? static_cast<int>(drive_.fault) : 0;

    in_force_.gate_enable = in_force_.gate_enable && core_tick_.output.gate_enable; // off at once
    board_.run_period(in_force_);
    if (board_.runaway()) {
        end.ended              = runaway_fault; // the currents of this period may be no numbers
        end.row.peak_current_A = instant_A(end.row);
    } else {
        end.row.peak_current_A = board_.peak_current_A();
    }
    in_force_ = core_tick_.output;
    return end;
}

SimulationResult simulate(const Scenario &scenario)
{
    return simulate(scenario, prepare_controller(scenario));
}

SimulationResult simulate(const Scenario &scenario, const Controller &controller)
{
    Simulation simulation(scenario, controller);
    return run_ticks(scenario, controller,
                     [&](double, double omega_ref) { return simulation.step(omega_ref); });
}

} // namespace sdre
