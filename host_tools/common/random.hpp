// SPDX-License-Identifier: MIT
/// Repeatable noise. std::normal_distribution differs between libraries; this does not.
#pragma once

#include <cstdint>
#include <random>

namespace sdre {

/// The user of random numbers. Each source has its own generator, so that one does not shift
/// another.
enum class NoiseStream : std::uint64_t {
    adc_a        = 1,
    adc_b        = 2,
    encoder_disc = 3,
    start_angle  = 4,
    adc_c        = 5,
    encoder_map  = 6
};

/// Number n of the sequence splitmix64: neighbouring seeds end up far apart.
inline std::uint64_t splitmix(std::uint64_t seed, std::uint64_t n)
{
    std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * n;
    z               = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z               = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
}

/// Evenly distributed numbers, a sequence per seed and stream.
class Uniform {
public:
    Uniform(std::uint64_t seed, std::uint64_t stream);

    /// lo .. hi, lo excluded.
    double next(double lo, double hi);

private:
    std::mt19937_64 generator_;
};

/// An evenly distributed number of -1 .. 1 for every index, without a generator's state.
class EvenNumbers {
public:
    EvenNumbers(std::uint64_t seed, NoiseStream stream);

    double at(std::uint64_t index) const
    {
        return static_cast<double>(splitmix(begin_, index + 1U) >> 11U) * 0x1p-52 - 1.0;
    }

private:
    std::uint64_t begin_;
};

/// Gaussian numbers: std::mt19937_64, whose sequence the standard fixes, and Box-Muller.
class Noise {
public:
    Noise(std::uint64_t seed, NoiseStream stream);

    /// Mean 0, standard deviation 1.
    double next();

private:
    Uniform uniform_;
    double  spare_     = 0.0;
    bool    has_spare_ = false;
};

} // namespace sdre
