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

#include "drive/core_types.hpp"
#include "sil/plant/dc_link.hpp"
#include "sil/plant/leg.hpp"
#include "sil/plant/plant.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

// Chosen: below this current the diodes' rail voltage fades out, so that the averaged model comes to rest.
constexpr double diode_fade_A = 0.05;

/// Everything of the bridge that is the same for all periods.
struct BridgeTiming {
    double period_s         = 0.0; ///< of the control
    double pwm_frequency_Hz = 0.0;
    double inductance_H     = 0.0;   ///< L_d, for EQ-INVERTER-4
    bool   half_periods     = false; ///< two updates per PWM period
};

/// Drives the plant through one control period, in pieces.
class Bridge {
public:
    Bridge(const BridgeTiming &timing, const InverterSettings &settings, double dead_time_s);

    /// Changes in flight, between two periods.
    void configure(const InverterSettings &settings, double dead_time_s);
    /// Fixes the switching instants of the coming period.
    void begin_period(const bridge_t &output);
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
    /// Plant, dc link and load of one advance().
    struct Circuit {
        Plant           &plant;
        DcLink          &dc_link;
        const ShaftLoad &load;
    };
    /// What the terminals are at for a while.
    struct Terminals {
        std::array<double, 3> v_V{};
        std::array<double, 3> share{}; ///< of the phase's current that the dc link carries
        std::array<bool, 3>   off{};   ///< both switches
        bool                  any_off = false;
    };
    /// The time until a phase current that a diode carries dies out, at most the time asked for.
    struct Piece {
        double dt_s;
        int    dying; ///< that phase, -1: none
    };

    bool      switched() const;
    double    next_event_s(double now_s, double to_s);
    void      advance_averaged(const Circuit &c, double dt_s);
    void      average_leg(Terminals &t, std::size_t x, double current_A, double dc_link_V) const;
    void      average_diodes(Terminals &t, std::size_t x, double current_A, double dc_link_V,
                             double dt_s) const;
    void      advance_switched(const Circuit &c, double now_s, double dt_s);
    Terminals terminals_at(const Circuit &c, const std::array<double, 3> &i, double now_s) const;
    Piece     piece_of(const Circuit &c, const Terminals &t, const std::array<double, 3> &i,
                       double longest_s) const;
    double    hold_voltage_V(const Plant &plant, const Terminals &t, std::size_t phase,
                             double dc_link_V) const;
    void      apply(const Circuit &c, const Terminals &t, double dt_s);

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
