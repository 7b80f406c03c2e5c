// SPDX-License-Identifier: MIT
#include "common/random.hpp"

#include <cmath>

namespace sdre {
Uniform::Uniform(std::uint64_t seed, std::uint64_t stream) : generator_(splitmix(seed, stream)) {}

double Uniform::next(double lo, double hi)
{
    // 53 random bits fill a double's mantissa; + 1 keeps 0 out, which has no logarithm.
    const double share = static_cast<double>((generator_() >> 11U) + 1U) * 0x1p-53;
    return lo + (hi - lo) * share;
}

EvenNumbers::EvenNumbers(std::uint64_t seed, NoiseStream stream)
    : begin_(splitmix(seed, static_cast<std::uint64_t>(stream)))
{
}

Noise::Noise(std::uint64_t seed, NoiseStream stream)
    : uniform_(seed, static_cast<std::uint64_t>(stream))
{
}

double Noise::next()
{
    if (has_spare_) {
        has_spare_ = false;
        return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform_.next(0.0, 1.0)));
    const double angle  = 2.0 * std::acos(-1.0) * uniform_.next(0.0, 1.0);
    spare_              = radius * std::sin(angle);
    has_spare_          = true;
    return radius * std::cos(angle);
}

} // namespace sdre
