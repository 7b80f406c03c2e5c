// SPDX-License-Identifier: MIT
#include "design/laws/servo.hpp"

#include <fmt/format.h>

namespace sdre {

void judge_loop(const char *name, const LoopCheck &loop, std::vector<std::string> &failures)
{
    if (!(loop.spectral_radius < 1.0)) {
        failures.push_back(fmt::format("{}: the sampled loop is unstable: spectral radius {:.5f}",
                                       name, loop.spectral_radius));
    }
    if (!(loop.peak <= peak_sensitivity_limit)) {
        failures.push_back(fmt::format("{}: sensitivity peak {:.3g} at {:.0f} Hz exceeds {:g}",
                                       name, loop.peak, loop.peak_Hz, peak_sensitivity_limit));
    }
}

std::string loop_line(const char *name, const LoopCheck &loop)
{
    return fmt::format(" * checked    {:<11} sensitivity peak {:.3g} at {:.0f} Hz, sampled "
                       "spectral radius {:.4f}\n",
                       name, loop.peak, loop.peak_Hz, loop.spectral_radius);
}

pid_law_config_t d_axis_constants(const Drive &drive)
{
    return {static_cast<float>(drive.d_axis.proportional_V_per_A),
            static_cast<float>(drive.d_axis.integral_V_per_As * control_period_s(drive)), 0.0F};
}

void certify_servo(Design &d)
{
    ServoDesign &servo = *d.servo;
    servo.speed = check_loop(speed_loop(d.drive.motor, d.config), disturbance_frequencies(d.drive));
    servo.d_axis =
        check_loop(d_axis_loop(d.drive.motor, d.config), disturbance_frequencies(d.drive));
    judge_loop("speed loop", servo.speed, d.certificate.failures);
    judge_loop("d axis", servo.d_axis, d.certificate.failures);
}

std::string servo_summary(const Design &d, const std::string &method)
{
    const ServoDesign &servo = *d.servo;
    return fmt::format(" * method     {}, {}\n", law_name(d.drive.law), method) +
           loop_line("speed loop:", servo.speed) + loop_line("d axis:", servo.d_axis);
}

std::string pid_block(const char *name, const pid_law_config_t &c)
{
    return c_block(name, c_field("kp", c.kp) + c_field("ki_per_tick", c.ki_per_tick) +
                             c_field("kd_tick", c.kd_tick));
}

} // namespace sdre
