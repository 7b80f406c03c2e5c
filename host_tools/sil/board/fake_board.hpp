// SPDX-License-Identifier: MIT
/// firmware/board/board.h on the motor bench, without registers: same codes, same counts, same duty counts.
#pragma once

#include "sil/f28335/gate_edges.hpp"
#include "sil/run/motor_bench.hpp"

extern "C" {
#include "board.h"
}

namespace sdre::f28335 {

class FakeBoard {
public:
    /// @param dc_link_range_V Range of the dc link's converter.
    /// @param counter_Hz Clock of the PWM counter.
    FakeBoard(MotorBench &bench, double dead_time_s, double dc_link_range_V, double counter_Hz);

    /// One control period: the tick that board_start() got.
    void tick();
    /// Duty of the bridge in the present period.
    const std::array<int, 3> &duty_cnt() const
    {
        return active_cnt_;
    }

    // board.h
    void init(const board_setup_t &setup)
    {
        setup_ = setup;
    }
    void start(void (*control_tick)(void), unsigned updates_per_period)
    {
        tick_    = control_tick;
        updates_ = updates_per_period;
    }
    const board_sample_t &sample() const
    {
        return sample_;
    }
    void          write_duty(const board_duty_t &duty);
    void          enable_gates(bool on);
    void          write_brake(bool release);
    void          write_chopper(bool on);
    std::uint32_t cycles() const;

private:
    void take_sample();
    void take_edge();
    void set_gates(bool on);

    MotorBench   &bench_;
    double        dead_time_s_;
    double        dc_link_range_V_;
    double        counter_Hz_;
    board_setup_t setup_{};
    void (*tick_)(void)         = nullptr;
    unsigned           updates_ = 1;
    Count              count_   = Count::up; ///< the first period begins at the top
    board_sample_t     sample_{};
    std::array<int, 3> shadow_cnt_{};
    std::array<int, 3> active_cnt_{};
    int                direction_ = 1; ///< of the last edge
    bool               gates_     = false;
    bool               enable_    = false; ///< requested for the next period
};

} // namespace sdre::f28335
