// SPDX-License-Identifier: MIT
#include "facts/block_commutation.hpp"

#include <cmath>

namespace sdre {
namespace {

// Chosen: sheets round both constants to two or three digits. Peak and rms are 13 % and 22 % away.
constexpr double same_within = 0.05;

} // namespace

double block_factor()
{
    return 2.0 / std::sqrt(3.0);
}

bool is_block_commutated(const Facts &facts)
{
    for (const Fact &kt : facts.of("kt")) {
        for (const Fact &kv : facts.of("kv")) {
            const bool of_the_line =
                kv.connection != Connection::phase && kv.amplitude != Amplitude::rms;
            if (kt.amplitude == Amplitude::unsaid && of_the_line &&
                std::abs(kt.si * kv.si - 1.0) < same_within) {
                return true;
            }
        }
    }
    return false;
}

double block_flux_Wb(double kt_Nm_per_A, double pole_pairs)
{
    return kt_Nm_per_A / (1.5 * pole_pairs * block_factor());
}

} // namespace sdre
