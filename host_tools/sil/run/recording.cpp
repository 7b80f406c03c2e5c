// SPDX-License-Identifier: MIT
#include "sil/run/recording.hpp"

namespace sdre {

Recording record(const Scenario &scenario, const Controller &controller)
{
    Simulation simulation(scenario, controller);
    Recording  r;
    run_ticks(scenario, controller, [&](double, double omega_ref) {
        r.drives.push_back(simulation.drive());
        const TickEnd               end  = simulation.step(omega_ref);
        const Simulation::CoreTick &tick = simulation.core_tick();
        r.samples.push_back(tick.sample);
        r.commands.push_back(tick.command);
        const law_aim_t aim = tick.command.aim != nullptr ? *tick.command.aim : law_aim_t{};
        r.positions.push_back(aim.position != nullptr ? *aim.position : position_command_t{});
        r.torques.push_back(aim.torque != nullptr ? *aim.torque : torque_command_t{});
        r.aims.push_back(aim);
        r.outputs.push_back(tick.output);
        return end;
    });
    return r;
}

} // namespace sdre
