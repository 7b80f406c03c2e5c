// SPDX-License-Identifier: MIT
/// Three-phase two-level inverter: averaged over a period, or with every edge.
///
/// Phase currents are positive into the motor. A leg whose switches are both off (dead time) is at the
/// rail of the diode that carries its current; when the current dies out within the dead time it stays zero
/// until the next switch closes.
///
/// Averaged, per phase with duty d in (0, 1) and sat(x) = x held in [-1, 1]:
///
///     share = d - sat(i / i_clamp) T_d f                                      EQ-INVERTER-2
///     v = share v_dc - sat(i / i_clamp) (drops)                                EQ-INVERTER-3
///     i_clamp = T_d v_dc / L_d: what the current can change in the dead time   EQ-INVERTER-4
///
/// so that a current below i_clamp sees the resistance f L_d and fades within about a PWM period: the mean of
/// being held at zero.
#pragma once

#include <array>

#include "design/core_types.hpp"
#include "sil/plant/dc_link.hpp"
#include "sil/plant/plant.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

/// Stator voltage over one period from three duty ratios (EQ-INVERTER-1). With the gates off the diodes
/// conduct: each phase is at the rail that opposes its current; a phase without current floats.
StatorVector inverter_voltage(const drive_output_t &output, double dc_link_V,
                              StatorVector current_A);

/// Everything of the bridge that is the same for all periods.
struct BridgeTiming {
    double period_s         = 0.0; ///< of the control
    double pwm_frequency_Hz = 0.0;
    double inductance_H     = 0.0;   ///< L_d, for EQ-INVERTER-4
    bool   half_periods     = false; ///< two updates per PWM period
};

/// What a leg is told over one control period, edge by edge. A change turns one switch off at once and the
/// other on after the delay.
struct LegTiming {
    struct Change {
        double time_s = 0.0;
        bool   high   = false;
    };
    std::array<Change, 4> changes{}; ///< in order of time, the first at 0
    int                   count        = 0;
    double                duty         = 0.0; ///< share of the period that is high
    double                rise_delay_s = 0.0; ///< upper switch
    double                fall_delay_s = 0.0; ///< lower switch
};

/// Drives the plant through one control period, in pieces.
class Bridge {
public:
    Bridge(const BridgeTiming &timing, const InverterSettings &settings, double dead_time_s);

    /// Changes in flight, between two periods.
    void configure(const InverterSettings &settings, double dead_time_s);
    /// Fixes the switching instants of the coming period.
    void begin_period(const drive_output_t &output);
    /// The same from the edges themselves; the dead time is then that of the edges.
    void begin_period(const std::array<LegTiming, 3> &legs);
    /// Opens (false: both switches off) or frees legs, now.
    void set_legs(const std::array<bool, 3> &enabled)
    {
        enabled_ = enabled;
    }
    /// Moves plant and dc link from `from_s` to `to_s` within the period that has begun.
    void advance(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double from_s, double to_s);

    /// Volt-seconds of each phase terminal against the negative rail since begin_period() [V s].
    const std::array<double, 3> &volt_seconds() const
    {
        return volt_seconds_;
    }

private:
    struct Edge {
        double time_s;
        bool   high;
        double dead_s;
    };
    struct Leg {
        std::array<Edge, 4> edges{};
        int                 count        = 0;
        int                 next         = 0;
        bool                high         = false; ///< commanded
        double              dead_until_s = 0.0;
        bool                held         = false; ///< its current died out in this dead time
        double              rise_dead_s  = 0.0;
        double              fall_dead_s  = 0.0;
        void                plan(double time_s, bool to_high);
    };

    void plan_leg(Leg &leg, double duty) const;
    bool any_enabled() const
    {
        return enabled_[0] || enabled_[1] || enabled_[2];
    }
    double next_event_s(double now_s, double to_s);
    void   advance_averaged(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double dt_s);
    void   advance_switched(Plant &plant, DcLink &dc_link, const ShaftLoad &load, double now_s,
                            double dt_s);
    double hold_voltage_V(const Plant &plant, const std::array<double, 3> &v, int phase,
                          double vdc) const;
    /// Applies three terminal voltages; share[x] is the part of phase x's current that the dc link carries.
    void apply(Plant &plant, DcLink &dc_link, const ShaftLoad &load,
               const std::array<double, 3> &terminal_V, const std::array<double, 3> &share,
               double dt_s);

    BridgeTiming          timing_;
    InverterSettings      settings_;
    double                dead_time_s_ = 0.0;
    std::array<double, 3> duty_{};
    std::array<bool, 3>   enabled_{true, true, true};
    bool rising_half_ = true; ///< with half_periods: the carrier runs down, switches close
    std::array<Leg, 3>    legs_{};
    std::array<double, 3> volt_seconds_{};
};

} // namespace sdre
