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
        r.positions.push_back(tick.command.position ? *tick.command.position
                                                    : position_command_t{});
        r.outputs.push_back(tick.output);
        return end;
    });
    return r;
}

} // namespace sdre
