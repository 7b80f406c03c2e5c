// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder_disc.hpp"

#include <cmath>

#include "common/random.hpp"

namespace sdre {

EncoderDisc::EncoderDisc(const EncoderDiscSettings &s, std::int64_t counts_per_turn,
                         std::uint64_t seed)
    : settings_(s), counts_per_turn_(counts_per_turn), seed_(seed),
      perfect_(s.quadrature_error_cnt == 0.0 && s.duty_error_cnt == 0.0 && s.jitter_rms_cnt == 0.0)
{
}

double EncoderDisc::edge_cnt(std::int64_t count) const
{
    const auto at = static_cast<double>(count);
    if (perfect_) {
        return at;
    }
    const std::int64_t rest    = count % counts_per_turn_;
    const std::int64_t n       = rest < 0 ? rest + counts_per_turn_ : rest;
    const bool         track_b = n % 2 == 1; // A rises, B rises, A falls, B falls
    const bool         falls   = n % 4 >= 2;
    const double       u       = std::sqrt(3.0) *
                     even_number(seed_, NoiseStream::encoder_disc, static_cast<std::uint64_t>(n));
    return at + (track_b ? 0.5 : -0.5) * settings_.quadrature_error_cnt +
           (falls ? 0.5 : -0.5) * settings_.duty_error_cnt +
           settings_.jitter_rms_cnt * u; // EQ-ENCODER-7
}

std::int64_t EncoderDisc::count_at(double position_cnt) const
{
    // Further away a double has no single counts; a plant that runs away gets there before its run ends.
    constexpr double furthest = 0x1p53;
    const double     below    = std::floor(position_cnt);
    if (!(std::abs(below) < furthest)) {
        return 0;
    }
    const auto n = static_cast<std::int64_t>(below);
    if (perfect_) {
        return n;
    }
    // No edge is off by half a count.
    return position_cnt < edge_cnt(n) ? n - 1 : position_cnt >= edge_cnt(n + 1) ? n + 1 : n;
}

} // namespace sdre
