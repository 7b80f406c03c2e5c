// SPDX-License-Identifier: MIT
#include "tune/position_weights.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "drive/drive_file.hpp"
#include "tune/objective.hpp"
#include "tune/start_weights.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

constexpr int most_halvings = 8; // chosen: the angle is held with a sixteenth of the stiffness

// The weights of ipmsm_390w.toml in motor_units(): those of the angle, by its unit, over those of the speed.
constexpr double angle_per_speed = 1.1e-3;

} // namespace

bool follows_speed(const Drive &d)
{
    return d.position && d.position->Q[1] == d.nosc.Q[0] && d.position->Q[2] == d.nosc.Q[1] &&
           d.position->Q[3] == d.nosc.Q[2] && d.position->T == d.nosc.T;
}

Drive with_position(Drive drive, const PositionSpec &before)
{
    const NoscSpec &c = drive.nosc;
    double          q = before.Q[0] / before.Q[1] * c.Q[0];
    for (int i = 0; i <= most_halvings; i++, q *= 0.5) {
        drive.position = {{written(q), c.Q[0], c.Q[1], c.Q[2]}, c.T};
        if (is_certified(drive)) {
            break;
        }
    }
    return drive;
}

std::optional<PositionSpec> start_position(const Drive &drive)
{
    const NoscSpec    &c      = drive.nosc;
    const double       time_s = motor_units(drive, pace_of_sensors(drive)).time_s;
    const double       angle  = angle_per_speed * c.Q[0] / (time_s * time_s);
    const PositionSpec wanted = {{written(angle), c.Q[0], c.Q[1], c.Q[2]}, c.T};
    const Drive        found  = with_position(drive, wanted);
    return is_certified(found) ? found.position : std::nullopt;
}

std::string position_text(const PositionSpec &p)
{
    return fmt::format("\n[position]\n# angle: halved until the certificate passed; speed, i_q, "
                       "i_d: as [nosc]\nQ = [{:.3g}, {:.3g}, {:.3g}, {:.3g}]\nT = [{:.3g}, "
                       "{:.3g}]\n",
                       p.Q[0], p.Q[1], p.Q[2], p.Q[3], p.T[0], p.T[1]);
}

} // namespace sdre
