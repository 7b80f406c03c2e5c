// SPDX-License-Identifier: MIT
#include "sil/sensors/adc.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

using namespace sdre;

namespace {

constexpr double lsb_A = 20.0 / 4096.0;

const AdcChannel quiet{12, 10.0, 0.0, 0.0, 1.0};

int code_of(const AdcChannel &channel, double current_A)
{
    Noise noise(1, NoiseStream::adc_a);
    return adc_code(channel, current_A, noise);
}

} // namespace

TEST(Adc, RoundsToTheNearestCode)
{
    for (int n = -2000; n <= 2000; n += 7) {
        EXPECT_EQ(code_of(quiet, (n + 0.49) * lsb_A), n);
        EXPECT_EQ(code_of(quiet, (n - 0.49) * lsb_A), n);
    }
    EXPECT_DOUBLE_EQ(adc_current_A(quiet, 100), 100 * lsb_A);
}

/// Codes of one ampere: the halves are exact, and std::round() takes them away from zero.
TEST(Adc, HalvesAreRoundedAwayFromZero)
{
    const AdcChannel one{12, 2048.0, 0.0, 0.0, 1.0};
    for (int eighth = -8 * 2047; eighth <= 8 * 2046; eighth += 3) {
        const double current_A = eighth / 8.0;
        EXPECT_EQ(code_of(one, current_A), static_cast<int>(std::round(current_A))) << current_A;
    }
    for (int n = -2040; n < 2040; n++) {
        EXPECT_EQ(code_of(one, n + 0.5), static_cast<int>(std::round(n + 0.5))) << n;
    }
}

TEST(Adc, WhatIsNoNumberIsACode)
{
    for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        EXPECT_GE(code_of(quiet, x), -2048);
        EXPECT_LE(code_of(quiet, x), 2047);
    }
    EXPECT_EQ(code_of(quiet, -HUGE_VAL), -2048);
    EXPECT_EQ(code_of(quiet, HUGE_VAL), 2047);
}

/// Noise is added after gain and offset, with its own sign: against the same numbers drawn again.
TEST(Adc, NoiseIsAddedToTheSignal)
{
    const AdcChannel channel{16, 10.0, 0.05, -0.3, 0.9};
    Noise            noise(9, NoiseStream::adc_b);
    Noise            again(9, NoiseStream::adc_b);
    for (double i = -9.0; i < 9.0; i += 0.0137) {
        const double signal_A = 0.9 * i - 0.3 + 0.05 * again.next();
        const double code     = std::round(signal_A / (10.0 / 32768.0));
        EXPECT_EQ(adc_code(channel, i, noise), static_cast<int>(code)) << i;
    }
}

TEST(Adc, ChannelsHaveTheirOwnSettings)
{
    SensorSettings s;
    s.adc_bits         = 11;
    s.adc_full_scale_A = 7.0;
    s.adc_noise_rms_A  = 0.5;
    s.adc_offset_a_A   = 0.1;
    s.adc_offset_b_A   = 0.2;
    s.adc_gain_a       = 0.3;
    s.adc_gain_b       = 0.4;
    const AdcChannel a = channel_a(s);
    const AdcChannel b = channel_b(s);
    EXPECT_EQ(a.offset_A, 0.1);
    EXPECT_EQ(b.offset_A, 0.2);
    EXPECT_EQ(a.gain, 0.3);
    EXPECT_EQ(b.gain, 0.4);
    for (const AdcChannel &c : {a, b}) {
        EXPECT_EQ(c.bits, 11);
        EXPECT_EQ(c.full_scale_A, 7.0);
        EXPECT_EQ(c.noise_rms_A, 0.5);
    }
}

TEST(Adc, SaturatesAtFullScale)
{
    EXPECT_EQ(code_of(quiet, 1e6), 2047);
    EXPECT_EQ(code_of(quiet, -1e6), -2048);
    EXPECT_EQ(code_of(quiet, 10.0), 2047);
    EXPECT_EQ(code_of(quiet, -10.0), -2048);
}

TEST(Adc, OffsetAndGain)
{
    const AdcChannel channel{16, 10.0, 0.0, 0.25, 1.02};
    for (double i = -8.0; i < 8.0; i += 0.37) {
        EXPECT_NEAR(adc_current_A(channel, code_of(channel, i)), 1.02 * i + 0.25,
                    0.5 * 20.0 / 65536.0);
    }
}

TEST(Adc, NoiseHasItsMeanAndDeviation)
{
    const AdcChannel channel{20, 10.0, 0.010, 0.0, 1.0};
    Noise            noise(3, NoiseStream::adc_a);
    constexpr int    n       = 200000;
    double           sum     = 0.0;
    double           squares = 0.0;
    int              beyond  = 0;
    for (int k = 0; k < n; k++) {
        const double error = adc_current_A(channel, adc_code(channel, 1.5, noise)) - 1.5;
        sum += error;
        squares += error * error;
        beyond += std::abs(error) > 0.02 ? 1 : 0;
    }
    EXPECT_NEAR(sum / n, 0.0, 5.0 * 0.010 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares / n), 0.010, 5.0 * 0.010 / std::sqrt(2.0 * n));
    EXPECT_NEAR(static_cast<double>(beyond) / n, 0.0455, 0.0025); // two sigma of a Gaussian
}

TEST(Noise, RepeatsForASeedAndDiffersBetweenSeedsAndSources)
{
    const auto draw = [](std::uint64_t seed, NoiseStream stream) {
        Noise               noise(seed, stream);
        std::vector<double> out;
        for (int k = 0; k < 20000; k++) {
            out.push_back(noise.next());
        }
        return out;
    };
    const auto correlation = [](const std::vector<double> &x, const std::vector<double> &y) {
        double sum = 0.0;
        for (std::size_t k = 0; k < x.size(); k++) {
            sum += x[k] * y[k];
        }
        return sum / static_cast<double>(x.size());
    };
    const auto a = draw(1, NoiseStream::adc_a);
    EXPECT_EQ(a, draw(1, NoiseStream::adc_a));
    const double bound = 5.0 / std::sqrt(20000.0);
    EXPECT_LT(std::abs(correlation(a, draw(2, NoiseStream::adc_a))), bound);
    EXPECT_LT(std::abs(correlation(a, draw(1, NoiseStream::adc_b))), bound);
    EXPECT_LT(std::abs(correlation(draw(1, NoiseStream::adc_b), draw(2, NoiseStream::adc_a))),
              bound);
}
