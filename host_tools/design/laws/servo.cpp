// SPDX-License-Identifier: MIT
#include "design/laws/servo.hpp"

#include <fmt/format.h>

#include "design/certificate.hpp"
#include "design/servo/servo_loop.hpp"

namespace sdre {

pid_law_config_t d_axis_constants(const Drive &drive)
{
    return {static_cast<float>(drive.d_axis.proportional_V_per_A),
            static_cast<float>(drive.d_axis.integral_V_per_As * control_period_s(drive)), 0.0F};
}

/// Both axes are linear and the same everywhere, so one point is sufficient. Paper B considers no
/// other motor.
void certify_servo(Design &d)
{
    LoopFamily family;
    family.channels = {"speed loop", "d axis"};
    family.points   = {{}};
    family.loops    = [&d](const Motor &motor, const OperatingPoint &) {
        return std::vector<BrokenLoop>{speed_loop(motor, d.config), d_axis_loop(motor, d.config)};
    };
    certify_loop(d, family);
}

std::string servo_summary(const Design &d, const std::string &method)
{
    return fmt::format(" * method     {}, {}\n", law_name(d.drive.law), method) +
           verdict_lines(*d.certificate.loop);
}

} // namespace sdre
