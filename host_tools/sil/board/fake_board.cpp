// SPDX-License-Identifier: MIT
#include "sil/board/fake_board.hpp"

#include <algorithm>

#include "sil/board/front_end.hpp"

namespace sdre::f28335 {
namespace {

// Three pairs at 25 MHz: 2.5 + 6 + 5 + 2 * 8 clocks from the trigger to the tick (EQ-CONVERTER-2).
constexpr double tick_delay_s = 29.5 / 25e6;

/// The counter runs down, then up; a period with two updates is one of the ways.
LegTiming pulse(int duty_cnt, int full, double counter_Hz, double dead_time_s, Count count)
{
    LegTiming leg;
    leg.duty         = static_cast<double>(2 * duty_cnt) / (2 * full);
    leg.rise_delay_s = dead_time_s;
    leg.fall_delay_s = dead_time_s;
    leg.changes[0]   = {0.0, count == Count::up ? duty_cnt > 0 : duty_cnt >= full};
    leg.count        = 1;
    if (duty_cnt <= 0 || duty_cnt >= full) {
        return leg;
    }
    const auto add = [&leg, counter_Hz](int time_cnt, bool high) {
        leg.changes.at(static_cast<std::size_t>(leg.count++)) = {time_cnt / counter_Hz, high};
    };
    if (count != Count::up) {
        add(full - duty_cnt, true);
    }
    if (count != Count::down) {
        add(count == Count::up ? duty_cnt : full + duty_cnt, false);
    }
    return leg;
}

std::uint16_t position_of(std::int64_t count, std::int64_t turn)
{
    return static_cast<std::uint16_t>(((count % turn) + turn) % turn);
}

} // namespace

FakeBoard::FakeBoard(MotorBench &bench, double dead_time_s, double dc_link_range_V,
                     double counter_Hz)
    : bench_(bench), dead_time_s_(dead_time_s), dc_link_range_V_(dc_link_range_V),
      counter_Hz_(counter_Hz)
{
}

void FakeBoard::take_sample()
{
    const RawSample &s  = bench_.sample();
    sample_.ia_cnt      = static_cast<std::uint16_t>(current_code(s.ia_code));
    sample_.ib_cnt      = static_cast<std::uint16_t>(current_code(s.ib_code));
    sample_.ic_cnt      = static_cast<std::uint16_t>(current_code(s.ic_code));
    sample_.dc_link_cnt = static_cast<std::uint16_t>(dc_link_code(s.dc_link_V, dc_link_range_V_));
    sample_.temperature_cnt = temperature_code;
    sample_.position_cnt    = position_of(s.count, setup_.positions);
    take_edge();
    sample_.index_seen = s.index;
    if (s.index) {
        sample_.index_cnt = position_of(s.index_count, setup_.positions);
    }
    sample_.valid = true;
}

/// The age of the last edge; none when the shaft has turned back, or is where it was.
void FakeBoard::take_edge()
{
    const std::vector<EncoderEdge> &edges = bench_.edges();
    const bool same_way = std::all_of(edges.begin(), edges.end(), [&](const EncoderEdge &e) {
        return e.direction == direction_;
    });
    if (!edges.empty()) {
        const double age_s   = bench_.period_s() - edges.back().time_s;
        sample_.edge_age_cnt = static_cast<std::uint16_t>(age_s * BOARD_CAPTURE_Hz);
        direction_           = edges.back().direction;
    }
    sample_.edge_seen = !edges.empty() && same_way;
}

void FakeBoard::tick()
{
    active_cnt_ = shadow_cnt_;
    count_      = updates_ == 1 ? Count::down_up : count_ == Count::down ? Count::up : Count::down;
    bench_.begin_tick();
    const int full = setup_.duty_full_cnt;
    bench_.begin_period({pulse(active_cnt_[0], full, counter_Hz_, dead_time_s_, count_),
                         pulse(active_cnt_[1], full, counter_Hz_, dead_time_s_, count_),
                         pulse(active_cnt_[2], full, counter_Hz_, dead_time_s_, count_)});
    if (enable_) { // as the board does: at the start of the period, with the duty ratios of the tick before
        enable_ = false;
        set_gates(true);
    }
    take_sample();
    tick_();
}

void FakeBoard::write_duty(const board_duty_t &duty)
{
    const int full = setup_.duty_full_cnt;
    shadow_cnt_    = {std::min<int>(duty.a_cnt, full), std::min<int>(duty.b_cnt, full),
                      std::min<int>(duty.c_cnt, full)};
}

void FakeBoard::enable_gates(bool on)
{
    enable_ = on;
    if (!on) {
        set_gates(false);
    }
}

void FakeBoard::write_brake(bool release)
{
    bench_.set_brake(release && gates_, tick_delay_s);
}

void FakeBoard::write_chopper(bool on)
{
    bench_.set_chopper(on, tick_delay_s);
}

void FakeBoard::set_gates(bool on)
{
    if (on != gates_) {
        gates_ = on;
        bench_.set_legs({on, on, on}, tick_delay_s);
        if (!on) {
            bench_.set_brake(false, tick_delay_s);
        }
    }
}

std::uint32_t FakeBoard::cycles() const
{
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(bench_.tick()) *
                                      (setup_.pwm_cycles / updates_));
}

} // namespace sdre::f28335
