// SPDX-License-Identifier: MIT
#include "sil/run/motor_bench.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

const double two_pi = 2.0 * std::acos(-1.0);

// Chosen: in the time in which the application boots and calibrates, with a margin before a run.
constexpr long   index_ticks = 1400;
constexpr double index_turns = 1.5; // passes the mark wherever it starts
// A shaft that turns once within these ticks by itself needs no extra turn.
constexpr double turning_s = 0.2;
// Where a held shaft has angle zero when no start is known.
constexpr long any_start = 2000;

double smooth(double x)
{
    const double y = std::clamp(x, 0.0, 1.0);
    return y * y * y * (10.0 - y * (15.0 - 6.0 * y));
}

} // namespace

MotorBench::MotorBench(const Scenario &s, long start_tick)
    : scenario_(s), period_s_(control_period_s(s.drive)), start_tick_(start_tick),
      held_encoder_(s.sensors, s.drive.encoder.lines, s.drive.motor.pole_pairs, period_s_, s.seed),
      held_noise_a_(s.seed, NoiseStream::adc_a), held_noise_b_(s.seed, NoiseStream::adc_b),
      held_noise_c_(s.seed, NoiseStream::adc_c)
{
    held_encoder_.start(held_theta_e_rad(0), 0.0);
}

double MotorBench::held_theta_e_rad(long tick) const
{
    const double omega = scenario_.initial_speed_e_radps;
    const double pp    = scenario_.drive.motor.pole_pairs;
    const long   zero  = start_tick_ == never ? any_start : start_tick_;
    double       theta =
        start_theta_e_rad(scenario_) + static_cast<double>(tick - zero) * period_s_ * omega;
    const bool   turns = std::abs(omega) * turning_s > two_pi * pp;
    const double missed =
        1.0 - smooth(static_cast<double>(tick) / static_cast<double>(index_ticks));
    if (!turns && missed > 0.0) {
        theta -= std::copysign(two_pi * pp * index_turns * missed, omega);
    }
    return theta;
}

void MotorBench::hold()
{
    const double theta = held_theta_e_rad(tick_);
    ShaftPath    path;
    path.lead_to(theta, (theta - held_theta_e_rad(tick_ - 1)) / period_s_, period_s_);
    const QuadratureEncoder::Reading position = held_encoder_.read(path, edges_);
    sample_.ia_code = adc_code(channel_a(scenario_.sensors), 0.0, held_noise_a_);
    sample_.ib_code = adc_code(channel_b(scenario_.sensors), 0.0, held_noise_b_);
    if (scenario_.sensors.current_sensors == 3) {
        sample_.ic_code = adc_code(channel_c(scenario_.sensors), 0.0, held_noise_c_);
    }
    sample_.dc_link_V   = scenario_.dc_link_V;
    sample_.count       = position.raw_count;
    sample_.index       = position.index;
    sample_.index_count = position.index_count;
}

void MotorBench::begin_tick()
{
    if (board_) {
        board_->advance_raw(reached_s_, period_s_);
        peak_current_A_ = board_->peak_current_A();
    }
    reached_s_ = 0.0;
    tick_++;
    if (tick_ == start_tick_) {
        board_ = std::make_unique<Board>(scenario_);
        board_->set_legs(legs_);
        board_->command_chopper(chopper_);
        board_->command_brake(brake_, 0.0);
    }
    const RawSample before = sample_;
    if (board_) {
        board_->begin_tick(static_cast<double>(tick_ - start_tick_) * period_s_);
        sample_      = board_->raw_sample();
        edges_       = board_->edges();
        plant_state_ = board_->plant_state();
    } else {
        hold();
    }
    if (stuck_) {
        sample_.count = before.count;
        sample_.index = false;
        edges_.clear();
    }
}

void MotorBench::begin_period(const std::array<LegTiming, 3> &legs)
{
    if (board_) {
        board_->begin_raw_period(legs);
    }
}

void MotorBench::set_legs(const std::array<bool, 3> &enabled, double into_period_s)
{
    legs_ = enabled;
    if (!board_) {
        // Before a run all lower switches charge the gates' supplies.
        const long charge_ticks = std::lround(scenario_.drive.board.precharge_s / period_s_);
        const bool on           = enabled[0] || enabled[1] || enabled[2];
        driven_while_held_      = driven_while_held_ || (on && tick_ < start_tick_ - charge_ticks);
        return;
    }
    advance_to(into_period_s);
    board_->set_legs(enabled);
}

void MotorBench::advance_to(double into_period_s)
{
    const double until_s = std::clamp(into_period_s, reached_s_, period_s_);
    board_->advance_raw(reached_s_, until_s);
    reached_s_ = until_s;
}

void MotorBench::set_brake(bool released, double into_period_s)
{
    brake_ = released;
    if (board_) {
        board_->command_brake(released, into_period_s);
    }
}

void MotorBench::set_chopper(bool on, double into_period_s)
{
    chopper_ = on;
    if (board_) {
        advance_to(into_period_s);
        board_->command_chopper(on);
    }
}

std::int64_t MotorBench::count_after(double into_period_s) const
{
    if (stuck_) {
        return sample_.count;
    }
    const double omega_e =
        board_ ? board_->plant().omega_e_radps() : scenario_.initial_speed_e_radps;
    const double turns = omega_e / scenario_.drive.motor.pole_pairs * into_period_s / two_pi;
    return sample_.count +
           static_cast<std::int64_t>(std::floor(4.0 * scenario_.drive.encoder.lines * turns));
}

} // namespace sdre
