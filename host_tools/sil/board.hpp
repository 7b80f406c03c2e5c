// SPDX-License-Identifier: MIT
/// The simulated board with its motor: samples for the core in, duty ratios of the core out.
#pragma once

#include "adc.hpp"
#include "encoder.hpp"
#include "inverter.hpp"
#include "load.hpp"
#include "plant.hpp"
#include "scenario.hpp"

namespace sdre {

class Board {
public:
    explicit Board(const Scenario &scenario);

    /// Everything that happens at a tick's time: changes, drifts, load. Call before sample().
    void begin_tick(double time_s);
    /// What the core gets at this tick.
    drive_sample_t sample();
    /// One period with the duty ratios in force; ends at the next tick.
    void run_period(const drive_output_t &in_force);

    const Plant &plant() const
    {
        return plant_;
    }
    double dc_link_V() const
    {
        return dc_link_.voltage_V();
    }
    double load_Nm() const; ///< all of the load at this tick
    /// Largest |i| since the tick before.
    double peak_current_A() const
    {
        return plant_.peak_current_A();
    }

private:
    void           apply(const PlantChange &change);
    void           update_motor();
    void           configure_inverter();
    bool           plain_period() const;
    drive_sample_t ideal_sample() const;
    drive_sample_t measured_sample();

    const Scenario   &scenario_;
    double            period_s_;
    Motor             motor_; ///< scaled, before any drift
    MotorScale        scale_;
    SensorSettings    sensors_;
    InverterSettings  inverter_;
    double            source_V_;
    Plant             plant_;
    Bridge            bridge_;
    DcLink            dc_link_;
    QuadratureEncoder encoder_;
    Noise             noise_a_;
    Noise             noise_b_;
    LoadProfile       load_;
    ShaftLoad         shaft_load_;
    double            time_s_         = 0.0;
    std::size_t       next_change_    = 0;
    bool              plain_inverter_ = true;
    bool              plain_motor_    = true;
    bool              have_early_     = false; ///< early_sample_ was taken before this tick
    drive_sample_t    early_sample_{};
};

} // namespace sdre
