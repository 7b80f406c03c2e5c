// SPDX-License-Identifier: MIT
/// The simulated board with its motor: samples for the core in, duty ratios of the core out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sil/plant/bridge.hpp"
#include "sil/plant/holding_brake.hpp"
#include "sil/plant/load.hpp"
#include "sil/plant/plant.hpp"
#include "sil/sensors/adc.hpp"
#include "sil/sensors/encoder.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// Converter codes and counter of a real board at a tick.
struct RawSample {
    int          ia_code     = 0; ///< two's complement
    int          ib_code     = 0;
    int          ic_code     = 0; ///< of a drive with three current sensors
    double       dc_link_V   = 0.0;
    std::int64_t count       = 0; ///< of a counter without corrections, since the shaft's zero
    bool         index       = false;
    std::int64_t index_count = 0;
};

/// The motor at a tick.
struct PlantState {
    double      omega_e_radps = 0.0;
    RotorVector current_A;
    double      torque_Nm   = 0.0;
    double      load_Nm     = 0.0; ///< all of the load; a brake that holds counts as none
    double      dc_link_V   = 0.0;
    double      theta_e_rad = 0.0; ///< not wrapped
};

class Board {
public:
    explicit Board(const Scenario &scenario);

    /// Everything that happens at a tick's time: changes, drifts, load. Call before sample().
    void begin_tick(double time_s);
    /// The core's sample at this tick.
    drive_sample_t sample();
    /// One period with the duty ratios in force; ends at the next tick.
    void run_period(const bridge_t &in_force);

    /// The same for a board that is simulated down to its codes and edges: instead of sample(), ...
    RawSample raw_sample();
    /// The encoder's edges in the period that raw_sample() has ended.
    const std::vector<EncoderEdge> &edges() const
    {
        return edges_;
    }
    /// ... and instead of run_period(), in pieces.
    void begin_raw_period(const std::array<LegTiming, 3> &legs);
    void set_legs(const std::array<bool, 3> &enabled)
    {
        bridge_.set_legs(enabled);
    }
    void advance_raw(double from_s, double to_s)
    {
        bridge_.advance(plant_, dc_link_, shaft_load_, from_s, to_s);
    }

    /// The holding brake's output of the board's firmware, this long after the tick. The torque follows at the next tick.
    void command_brake(bool released, double into_period_s)
    {
        holding_brake_.command(released, time_s_ + into_period_s);
    }
    /// A brake that is closed now.
    void set_holding_brake(const HoldingBrakeSettings &settings)
    {
        holding_brake_ = HoldingBrake(settings);
    }
    bool brake_is_closed() const
    {
        return holding_brake_.torque_Nm(time_s_) > 0.0;
    }
    /// The chopper's output of the board's firmware.
    void command_chopper(bool on)
    {
        dc_link_.command_chopper(on);
    }
    /// Heat of the chopper's resistor so far.
    double chopper_J() const
    {
        return dc_link_.chopper_J();
    }

    // Changes by a person during the run.
    /// Beside the scenario's load.
    void set_extra_load_Nm(double torque_Nm)
    {
        extra_load_Nm_ = torque_Nm;
    }
    /// Beside the scenario's brake, at least 0.
    void set_extra_brake_Nm(double torque_Nm)
    {
        extra_brake_Nm_ = torque_Nm;
    }
    void set_source_V(double voltage_V);
    void break_part(const InjectedFault &fault)
    {
        faults_.add(fault);
    }
    /// Removes all injected faults.
    void mend();
    void apply(const PlantChange &change);

    PlantState plant_state() const;
    /// The motor turns half an electrical turn or more per control period, or its state is not a
    /// number. The samples then carry no information, and the plant's steps are too long. A load
    /// that drives the shaft after a trip ends there.
    bool         runaway() const;
    const Plant &plant() const
    {
        return plant_;
    }
    /// Largest |i| since the tick before.
    double peak_current_A() const
    {
        return plant_.peak_current_A();
    }

private:
    void           begin_faults();
    void           update_motor();
    void           configure_inverter();
    bool           plain_period() const;
    drive_sample_t ideal_sample() const;
    drive_sample_t measured_sample();

    const Scenario &scenario_;
    double          period_s_;
    Motor           motor_; ///< scaled, before any drift
    MotorScale      scale_;
    std::optional<SaturatedMotor>
                      iron_; ///< before any scale; none where L is constant or the scenario's
    SensorSettings    sensors_;
    InverterSettings  inverter_;
    double            source_V_;
    Plant             plant_;
    Bridge            bridge_;
    DcLink            dc_link_;
    QuadratureEncoder encoder_;
    std::vector<EncoderEdge> edges_;
    AdcChannel               channel_a_;
    AdcChannel               channel_b_;
    AdcChannel               channel_c_;
    Noise                    noise_a_;
    Noise                    noise_b_;
    Noise                    noise_c_;
    LoadProfile              load_;
    PowderBrake              brake_;
    HoldingBrake             holding_brake_;
    double                   first_dead_time_s_; ///< the gates\'
    ShaftLoad                shaft_load_;
    Glitch                   glitch_; ///< of the sample of this tick
    InjectedFaults           faults_;
    int                      lost_counts_    = 0; ///< of the encoder, by a fault
    double                   time_s_         = 0.0;
    double                   extra_load_Nm_  = 0.0;
    double                   extra_brake_Nm_ = 0.0;
    std::size_t              next_change_    = 0;
    bool                     plain_inverter_ = true;
    bool                     plain_motor_    = true;
    bool                     have_early_     = false; ///< early_sample_ was taken before this tick
    drive_sample_t           early_sample_{};
};

} // namespace sdre
