// SPDX-License-Identifier: MIT
/// Three-phase two-level inverter: averaged over a period, or with every edge.
///
/// Phase currents are positive into the motor. A leg whose switches are both off (dead time, bridge open) is at the
/// rail of the diode that carries its current. When that current has died out the terminal floats where it keeps
/// the phase without current,
///
///     axis . di/dt = 0 solved for v_x, axis: the phase's direction             EQ-OPEN-1
///
/// and a diode takes over again as soon as v_x is beyond its rail:
///
///     v_x > v_dc + drop: the upper one,  v_x < -drop: the lower one            EQ-OPEN-2
///
/// With all legs open and no current these are the two lines whose EMF exceeds v_dc + 2 drops, else none.
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
    /// Breaks the wire of a phase, for good: its current dies out as through a diode, and none comes back.
    void break_phase(std::size_t x)
    {
        broken_[x] = true;
    }
    void mend()
    {
        broken_ = {};
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
    /// State of the terminals during an interval.
    struct Terminals {
        std::array<double, 3> v_V{};
        std::array<double, 3> share{};  ///< of the phase's current that the dc link carries
        std::array<bool, 3>   open{};   ///< both switches off
        std::array<bool, 3>   floats{}; ///< open, and no diode carries a current
        bool                  any_open = false;
        int                   floating_count() const;
    };
    /// Which diode of an open leg carries the phase's current.
    enum class Diode { none, upper, lower };
    /// The time until a phase current in a diode dies out, at most the given time.
    struct Piece {
        double dt_s;
        int    dying; ///< that phase, -1: none
    };

    void      begin_leg(std::size_t x, double rise_delay_s, double fall_delay_s);
    bool      switched() const;
    double    next_event_s(double now_s, double to_s);
    void      advance_piece(const Circuit &c, double now_s, double dt_s);
    void      average_leg(Terminals &t, std::size_t x, double current_A, double dc_link_V) const;
    void      switch_leg(Terminals &t, std::size_t x, double current_A, double dc_link_V) const;
    Terminals terminals_at(const Circuit &c, const std::array<double, 3> &i, double now_s);
    void      note_openings(const Terminals &t, const std::array<double, 3> &i);
    void      place_diodes(const Circuit &c, Terminals &t, const std::array<double, 3> &i);
    void      place_by_emf(const Circuit &c, Terminals &t);
    void place(Terminals &t, std::size_t x, Diode diode, double floating_V, double dc_link_V) const;
    Diode diode_at(std::size_t x, double floating_V, double dc_link_V) const;
    Piece piece_of(const Circuit &c, const Terminals &t, const std::array<double, 3> &i,
                   double longest_s) const;
    void  end_current(const Circuit &c, const Terminals &t, std::size_t phase);
    void  move_plant(const Circuit &c, const Terminals &t, double dt_s);
    void  apply(const Circuit &c, const Terminals &t, double dt_s);

    BridgeTiming          timing_;
    double                least_width_s_; ///< with drops alone: a hundredth of the period
    InverterSettings      settings_;
    double                dead_time_s_ = 0.0;
    std::array<double, 3> duty_{};
    std::array<double, 3> width_s_{}; ///< EQ-INVERTER-4: T_d, the longer one
    std::array<bool, 3>   enabled_{true, true, true};
    bool rising_half_ = true; ///< with half_periods: the carrier runs down, switches close
    std::array<Leg, 3>    legs_{};
    std::array<Diode, 3>  diode_{};
    std::array<bool, 3>   was_open_{};
    std::array<bool, 3>   broken_{};
    std::array<double, 3> volt_seconds_{};
};

} // namespace sdre
