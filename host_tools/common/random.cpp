// SPDX-License-Identifier: MIT
#include "common/random.hpp"

#include <cmath>

namespace sdre {
namespace {

/// The finaliser of splitmix64: neighbouring seeds end up far apart.
std::uint64_t mix(std::uint64_t z)
{
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
}

// The step of splitmix64: its sequence is mix(seed + n step).
constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;

} // namespace

Uniform::Uniform(std::uint64_t seed, std::uint64_t stream) : generator_(mix(seed + step * stream))
{
}

double Uniform::next(double lo, double hi)
{
    // 53 random bits fill a double's mantissa; + 1 keeps 0 out, which has no logarithm.
    const double share = static_cast<double>((generator_() >> 11U) + 1U) * 0x1p-53;
    return lo + (hi - lo) * share;
}

double even_number(std::uint64_t seed, NoiseStream stream, std::uint64_t index)
{
    const std::uint64_t begin = mix(seed + step * static_cast<std::uint64_t>(stream));
    return static_cast<double>(mix(begin + step * (index + 1U)) >> 11U) * 0x1p-52 - 1.0;
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
