// SPDX-License-Identifier: MIT
/// The simulated motor on a test bench, for boards that are simulated down to codes and edges.
///
/// A dynamometer holds the shaft until the scenario starts. It turns at the scenario's initial
/// speed, so that the electrical angle is zero at the start. If that speed is low, it first turns
/// once past the encoder's index. Instants are control ticks: the tops of the PWM counter.
#pragma once

#include <array>
#include <climits>
#include <memory>
#include <vector>

#include "sil/run/board.hpp"

namespace sdre {

class MotorBench {
public:
    static constexpr long never = LONG_MAX;

    /// @param start_tick Tick that is the scenario's time zero; `never`: the shaft stays held.
    MotorBench(const Scenario &scenario, long start_tick);

    /// The next tick has come: ends the period before, takes the samples.
    void begin_tick();
    /// Gate commands of the bridge from this tick to the next.
    void begin_period(const std::array<LegTiming, 3> &legs);
    /// Opens or frees legs, this long after the tick.
    void set_legs(const std::array<bool, 3> &enabled, double into_period_s);

    /// The motor is this long after the tick; it has started.
    void advance_to(double into_period_s);

    /// The holding brake's output, this long after the tick.
    void set_brake(bool released, double into_period_s);
    /// The chopper's output, likewise.
    void set_chopper(bool on, double into_period_s);

    /// Number of the present tick; -1 before the first.
    long tick() const
    {
        return tick_;
    }
    const RawSample &sample() const
    {
        return sample_;
    }
    double period_s() const
    {
        return period_s_;
    }
    /// The encoder's edges in the period that the present tick has ended; the shaft may be held.
    const std::vector<EncoderEdge> &edges() const
    {
        return edges_;
    }
    /// The encoder's count within the period; the shaft turns evenly so far.
    std::int64_t count_after(double into_period_s) const;
    /// At the present tick.
    const PlantState &plant_state() const
    {
        return plant_state_;
    }
    /// Largest |i| in the period that the present tick has ended.
    double peak_current_A() const
    {
        return peak_current_A_;
    }
    /// Some leg follows its gates.
    bool bridge_on() const
    {
        return legs_[0] || legs_[1] || legs_[2];
    }
    bool runaway() const
    {
        return board_ && board_->runaway();
    }
    /// Somebody drove the motor while the shaft was held, earlier than the board's precharge.
    bool driven_while_held() const
    {
        return driven_while_held_;
    }

    /// The board with its motor, once the scenario has started; null before.
    Board *board()
    {
        return board_.get();
    }
    const Board *board() const
    {
        return board_.get();
    }
    /// Stops the encoder's tracks.
    void stick_encoder()
    {
        stuck_ = true;
    }

private:
    double held_theta_e_rad(long tick) const;
    void   hold();

    Scenario                 scenario_;
    double                   period_s_;
    long                     start_tick_;
    long                     tick_ = -1;
    RawSample                sample_;
    std::vector<EncoderEdge> edges_;
    PlantState               plant_state_;
    double                   peak_current_A_ = 0.0;
    std::array<bool, 3>      legs_{};
    bool                     brake_             = false; ///< released
    bool                     chopper_           = false;
    double                   reached_s_         = 0.0; ///< how far into the period the plant is
    bool                     driven_while_held_ = false;
    bool                     stuck_             = false;
    QuadratureEncoder        held_encoder_;
    Noise                    held_noise_a_;
    Noise                    held_noise_b_;
    Noise                    held_noise_c_;
    std::unique_ptr<Board>   board_;
};

} // namespace sdre
