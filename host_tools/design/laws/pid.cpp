// SPDX-License-Identifier: MIT
#include "design/laws/servo.hpp"

namespace sdre {
namespace {

bool is_for(const Drive &drive)
{
    return drive.law == Law::pid;
}

/// The drive file's speeds are mechanical, the firmware's electrical.
pid_law_config_t speed_constants(const Drive &drive)
{
    const PidSpec &k  = drive.pid;
    const double   ts = control_period_s(drive);
    const double   np = drive.motor.pole_pairs;
    return {static_cast<float>(k.proportional_Vs_per_rad / np),
            static_cast<float>(k.integral_V_per_rad * ts / np),
            static_cast<float>(k.derivative_Vs2_per_rad / (ts * np))};
}

void solve(Design &d)
{
    d.servo.emplace();
    law_pid_config_t c{};
    c.pid   = speed_constants(d.drive);
    c.id_pi = d_axis_constants(d.drive);
    keep_constants(d, c);
    certify_servo(d);
}

std::string summary(const Design &d)
{
    return servo_summary(d, "EQ-PID-1, 2");
}

std::vector<std::string> mismatches(const Design &)
{
    return {};
}

Layout layout(const Design &)
{
    return {};
}

} // namespace

const LawDesign pid_design = {"law_pid", "law_pid_config_t", is_for, solve,
                              summary,   mismatches,         layout};

} // namespace sdre
