// SPDX-License-Identifier: MIT
/// The edges of an incremental encoder's disc, where they really are: the same in every turn.
///
///     edge n is at n + e(n) counts, n of the turn                              EQ-ENCODER-7
///     e(n) = -+ quadrature/2 (track A, B) -+ duty/2 (rising, falling) + jitter u(n)
///
/// Track B is late by quadrature, so that the states of a line are 1 +- quadrature counts wide. A track's pulses exceed its
/// gaps by duty. The numbers u(n) are evenly distributed, with mean 0 and standard deviation 1. They repeat after
/// jitter_repeats edges when that is given, else after a turn.
///
/// The map of a drive has edge n at n + o(n). Here o is e with an error of its own, in the steps of app_disc.h.
#pragma once

#include <array>
#include <cstdint>

#include "common/random.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

class EncoderDisc {
public:
    EncoderDisc(const EncoderDiscSettings &settings, std::int64_t counts_per_turn,
                std::uint64_t seed);

    /// Position of the edge below a count.
    double edge_cnt(std::int64_t count) const;
    /// o(n) of the edge below a count, as the drive's map has it (EQ-DISC-1); 0 without a map.
    double mapped_cnt(std::int64_t count) const;
    /// The count of a position: the last edge that is not beyond it. Too far away for single counts: 0.
    std::int64_t count_at(double position_cnt) const;

private:
    std::int64_t in_turn(std::int64_t count) const;

    EncoderDiscSettings settings_;
    std::int64_t        counts_per_turn_;
    // In the order of a line: A rises, B rises, A falls, B falls.
    std::array<double, 4> track_cnt_;
    std::array<double, 4> pulse_cnt_;
    EvenNumbers           jitter_;
    EvenNumbers           map_error_;
    bool                  perfect_;
};

} // namespace sdre
