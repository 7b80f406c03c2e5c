// SPDX-License-Identifier: MIT
#include "sil/run/recording.hpp"

#include <cmath>

#include "common/errors.hpp"
#include "sil/run/board.hpp"

namespace sdre {

Recording record(const Scenario &s, const Controller &controller)
{
    const double   ts    = control_period_s(s.drive);
    const auto     ticks = static_cast<long>(std::floor(s.duration_s / ts + 1e-9)) + 1;
    Board          board(s);
    StepCursor     reference(s.speed_reference, s.initial_speed_e_radps);
    drive_t        drive{};
    drive_output_t in_force{{0.5F, 0.5F, 0.5F}, true};
    Recording      r;
    if (drive_init(&drive, &controller.config) != CTL_OK) {
        throw DesignError("the control core refuses these constants");
    }
    for (long k = 0; k < ticks; k++) {
        const double t = static_cast<double>(k) * ts;
        board.begin_tick(t);
        r.drives.push_back(drive);
        r.samples.push_back(board.sample());
        r.commands.push_back({static_cast<float>(reference.at(t)), true});
        r.outputs.push_back(drive_tick(&drive, &r.samples.back(), &r.commands.back()));
        in_force.gate_enable = in_force.gate_enable && r.outputs.back().gate_enable;
        board.run_period(in_force);
        in_force = r.outputs.back();
    }
    return r;
}

} // namespace sdre
