// SPDX-License-Identifier: MIT
/// Repeatable noise. std::normal_distribution differs between libraries; this does not.
#pragma once

#include <cstdint>
#include <random>

namespace sdre {

/// The user of random numbers. Each source has its own generator, so that one does not shift
/// another.
enum class NoiseStream : std::uint64_t { adc_a = 1, adc_b = 2, encoder_disc = 3, start_angle = 4 };

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
double even_number(std::uint64_t seed, NoiseStream stream, std::uint64_t index);

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
