// SPDX-License-Identifier: MIT
/// Torque of the driven machine over time.
///
///     T = steps and ramps + amplitude sin(2 pi f (t - start)) + fan w_m |w_m|  EQ-LOAD-1
///     T_brake = drag + x against the motion, lag x' = command - x              EQ-LOAD-2
///
/// A magnetic powder brake. Its torque follows its coil's current at any speed. At rest it holds.
#pragma once

#include <cstddef>
#include <vector>

#include "sil/setup/load_settings.hpp"
#include "sil/setup/steps.hpp"

namespace sdre {

/// Torques on the shaft during one step of the plant.
struct ShaftLoad {
    double torque_Nm         = 0.0;
    double fan_Nm_per_radps2 = 0.0;
    double brake_Nm          = 0.0; ///< dry friction, at least 0
};

/// Steps, ramps and sine; call with rising times.
class LoadProfile {
public:
    LoadProfile(const std::vector<Step> &steps, const std::vector<LoadRamp> &ramps,
                const LoadSine &sine);

    void set_sine(const LoadSine &sine);
    /// Torque at a time. A step acts from its time on. Ramp and sine have their value `ahead_s`
    /// later: half a period, for a torque that is held over one.
    double at(double time_s, double ahead_s);

private:
    struct Piece {
        double time_s;
        double until_s; ///< = time_s for a step
        double from_Nm;
        double to_Nm;
    };
    double value_of(const Piece &piece, double time_s) const;

    std::vector<Piece> pieces_;
    std::size_t        next_ = 0; ///< the first piece that has not begun
    LoadSine           sine_;
};

/// Torque of the powder brake; call with rising times.
class PowderBrake {
public:
    explicit PowderBrake(const BrakeSettings &settings);

    /// A brake that is no part of the scenario: always without torque.
    bool present() const
    {
        return !settings_.command.empty() || settings_.drag_Nm != 0.0;
    }
    /// At a time, `ahead_s` later by the command in force.
    double at(double time_s, double ahead_s);

private:
    double after_s(double duration_s) const;

    BrakeSettings settings_;
    std::size_t   next_       = 0; ///< the first command that has not come
    double        command_Nm_ = 0.0;
    double        torque_Nm_  = 0.0; ///< at since_s_
    double        since_s_    = 0.0;
};

} // namespace sdre
