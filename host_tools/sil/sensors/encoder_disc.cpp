// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder_disc.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {

EncoderDisc::EncoderDisc(const EncoderDiscSettings &s, std::int64_t counts_per_turn,
                         std::uint64_t seed)
    : settings_(s), counts_per_turn_(counts_per_turn), track_cnt_{-0.5 * s.quadrature_error_cnt,
                                                                  0.5 * s.quadrature_error_cnt,
                                                                  -0.5 * s.quadrature_error_cnt,
                                                                  0.5 * s.quadrature_error_cnt},
      pulse_cnt_{-0.5 * s.duty_error_cnt, -0.5 * s.duty_error_cnt, 0.5 * s.duty_error_cnt,
                 0.5 * s.duty_error_cnt},
      jitter_(seed, NoiseStream::encoder_disc), map_error_(seed, NoiseStream::encoder_map),
      perfect_(s.quadrature_error_cnt == 0.0 && s.duty_error_cnt == 0.0 && s.jitter_rms_cnt == 0.0)
{
}

std::int64_t EncoderDisc::in_turn(std::int64_t count) const
{
    const std::int64_t rest = count % counts_per_turn_;
    return rest < 0 ? rest + counts_per_turn_ : rest;
}

double EncoderDisc::mapped_cnt(std::int64_t count) const
{
    if (!settings_.map_error_rms_cnt) {
        return 0.0;
    }
    constexpr double   steps = 256.0;
    const std::int64_t n     = in_turn(count);
    const double       error = *settings_.map_error_rms_cnt * std::sqrt(3.0) *
                         map_error_.at(static_cast<std::uint64_t>(n));
    const double off = edge_cnt(n) - static_cast<double>(n) + error;
    return std::clamp(std::round(steps * off), -128.0, 127.0) / steps;
}

double EncoderDisc::edge_cnt(std::int64_t count) const
{
    const auto at = static_cast<double>(count);
    if (perfect_) {
        return at;
    }
    const std::int64_t n     = in_turn(count);
    const auto         place = static_cast<std::size_t>(n % 4);
    const std::int64_t own   = settings_.jitter_repeats > 0 ? n % settings_.jitter_repeats : n;
    const double       u     = std::sqrt(3.0) * jitter_.at(static_cast<std::uint64_t>(own));
    return at + track_cnt_[place] + pulse_cnt_[place] +
           settings_.jitter_rms_cnt * u; // EQ-ENCODER-7
}

std::int64_t EncoderDisc::count_at(double position_cnt) const
{
    // Further away a double has no single counts; a plant that runs away gets there before its run ends.
    constexpr double furthest = 0x1p53;
    if (!(std::abs(position_cnt) < furthest)) {
        return 0;
    }
    auto n = static_cast<std::int64_t>(position_cnt); // std::floor() without a call
    n -= static_cast<double>(n) > position_cnt ? 1 : 0;
    if (perfect_) {
        return n;
    }
    // No edge is off by half a count.
    return position_cnt < edge_cnt(n) ? n - 1 : position_cnt >= edge_cnt(n + 1) ? n + 1 : n;
}

} // namespace sdre
