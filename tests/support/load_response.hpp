// SPDX-License-Identifier: MIT
/// A small load step: of the control core on a motor, and of a linear model.
#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "design/design.hpp"
#include "sil/plant/plant.hpp"

namespace support {

/// One motor with the control core on it: exact sensors, no dead time, the duty one period late.
class Loop {
public:
    Loop(const sdre::Design &d, double omega, double theta, const sdre::MotorEffects &effects = {})
        : config_(d.config), plant_(d.drive.motor), dc_V_(d.drive.inverter.dc_link_V)
    {
        config_.dead_time.share = 0.0F;
        if (drive_init(&drive_, &config_) != CTL_OK) {
            throw std::runtime_error("refused");
        }
        plant_.set_effects(effects);
        plant_.reset(omega, theta);
        command_ = {static_cast<float>(omega), true, 0.0F, nullptr};
    }

    /// One control period; false when the drive has tripped.
    bool tick(double load_Nm)
    {
        const sdre::StatorVector i = sdre::to_stator(plant_.current_A(), plant_.theta_e_rad());
        const double             b = 0.5 * (-i.alpha + std::sqrt(3.0) * i.beta);
        drive_sample_t           sample{};
        sample.ia_A      = static_cast<float>(i.alpha);
        sample.ib_A      = static_cast<float>(b);
        sample.dc_link_V = static_cast<float>(dc_V_);
        sample.theta_e_rad =
            static_cast<float>(std::remainder(plant_.theta_e_rad(), 6.283185307179586));
        sample.omega_e_radps = static_cast<float>(plant_.omega_e_radps());
        sample.valid         = true;
        const bridge_t out   = drive_tick(&drive_, &sample, &command_);
        limited_             = limited_ || drive_.v_limited;
        plant_.step(voltage_, load_Nm, static_cast<double>(config_.ts_s), 20);
        const auto a = static_cast<double>(out.duty.a);
        const auto c = static_cast<double>(out.duty.c);
        const auto m = static_cast<double>(out.duty.b);
        voltage_     = {dc_V_ * (2.0 * a - m - c) / 3.0, dc_V_ * (m - c) / std::sqrt(3.0)};
        return drive_.state == DRIVE_RUN;
    }

    const sdre::Plant &plant() const
    {
        return plant_;
    }
    bool limited() const
    {
        return limited_;
    }
    void forget_limit()
    {
        limited_ = false;
    }

private:
    drive_config_t     config_;
    sdre::Plant        plant_;
    double             dc_V_;
    drive_t            drive_{};
    drive_command_t    command_{};
    sdre::StatorVector voltage_;
    bool               limited_ = false;
};

struct StepResponse {
    std::vector<double>  deviation_e_radps; ///< after each period from the load step on
    sdre::OperatingPoint before;
    bool                 limited = false; ///< the voltage limit was reached after the step
};

/// The loop settles for 0.4 s.
constexpr int settle_ticks = 2000;
/// The response takes 40 ms.
constexpr int response_ticks = 200;

inline StepResponse nonlinear_step(const sdre::Design &d, double omega, double load_Nm,
                                   double step_Nm, double theta,
                                   const sdre::MotorEffects &effects = {})
{
    Loop         loop(d, omega, theta, effects);
    StepResponse out;
    for (int k = 0; k < settle_ticks; k++) {
        EXPECT_TRUE(loop.tick(load_Nm));
    }
    const sdre::RotorVector i = loop.plant().current_A();
    out.before                = {loop.plant().omega_e_radps(), i.q, i.d};
    loop.forget_limit();
    for (int k = 0; k < response_ticks; k++) {
        EXPECT_TRUE(loop.tick(load_Nm + step_Nm));
        out.deviation_e_radps.push_back(loop.plant().omega_e_radps() - out.before.omega_e_radps);
    }
    out.limited = loop.limited();
    return out;
}

inline std::vector<double> linear_step(const sdre::SampledModel &m, double step_Nm)
{
    Eigen::VectorXd     x = Eigen::VectorXd::Zero(m.A.rows());
    std::vector<double> out;
    for (int k = 0; k < response_ticks; k++) {
        x = m.A * x + m.b_load * step_Nm;
        out.push_back(x(0));
    }
    return out;
}

} // namespace support
