// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

using sdre::QuadratureEncoder;
using sdre::SensorSettings;

namespace {

const double     pi       = std::acos(-1.0);
constexpr int    lines    = 2500;
constexpr int    pairs    = 2;
constexpr double period_s = 2e-4;

/// With a perfect disc.
QuadratureEncoder encoder_with(SensorSettings settings)
{
    settings.encoder_disc = {0.0, 0.0, 0.0};
    QuadratureEncoder encoder(settings, lines, pairs, period_s);
    encoder.start(0.0, 0.0);
    return encoder;
}

/// Middle of count n as an electrical angle in [0, 2 pi), by the library's remainder.
double middle_e_rad(std::int64_t n)
{
    const double theta =
        std::fmod(pairs * 2.0 * pi * (static_cast<double>(n) + 0.5) / (4 * lines), 2.0 * pi);
    return theta < 0.0 ? theta + 2.0 * pi : theta;
}

} // namespace

TEST(Encoder, CountsAreTheFloorOverManyTurnsBothWays)
{
    for (double direction : {1.0, -1.0}) {
        QuadratureEncoder encoder = encoder_with({});
        std::int64_t      before  = 0;
        for (int k = 0; k < 20000; k++) { // 20 turns
            const double theta_e = direction * (0.0123 + 2.0 * pi * 40.0 * k / 20000.0);
            const auto   r       = encoder.read(theta_e);
            const auto   n =
                static_cast<std::int64_t>(std::floor(theta_e / pairs / (2.0 * pi) * (4 * lines)));
            ASSERT_EQ(r.count, n);
            ASSERT_NEAR(r.theta_e_rad, middle_e_rad(n), 1e-9);
            ASSERT_GE(r.theta_e_rad, 0.0);
            ASSERT_LT(r.theta_e_rad, 2.0 * pi);
            if (k > 0) {
                ASSERT_NEAR(r.omega_e_radps,
                            static_cast<double>(n - before) * pairs * 2.0 * pi / (4 * lines) /
                                period_s,
                            1e-9);
            }
            before = n;
        }
    }
}

TEST(Encoder, AngleIsWithinHalfACount)
{
    QuadratureEncoder encoder = encoder_with({});
    std::mt19937_64   random(7);
    for (int k = 0; k < 1000; k++) {
        const double theta_e = std::uniform_real_distribution<>(-50.0, 50.0)(random);
        const double error = std::remainder(encoder.read(theta_e).theta_e_rad - theta_e, 2.0 * pi);
        EXPECT_LE(std::abs(error), 0.5 * pairs * 2.0 * pi / (4 * lines) + 1e-12);
    }
}

TEST(Encoder, ReversalAtACountEdgeTogglesOneCount)
{
    QuadratureEncoder encoder = encoder_with({});
    const double      edge    = pairs * 2.0 * pi * 100.0 / (4 * lines);
    for (int k = 0; k < 6; k++) {
        const auto below = encoder.read(edge - 1e-9);
        const auto above = encoder.read(edge + 1e-9);
        EXPECT_EQ(below.count, 99);
        EXPECT_EQ(above.count, 100);
        EXPECT_NEAR(above.omega_e_radps, 6.2832, 1e-4); // one count per period
    }
}

TEST(Encoder, StartsWithTheSpeedItHad)
{
    QuadratureEncoder encoder = encoder_with({});
    encoder.start(1.0, 300.0);
    EXPECT_NEAR(encoder.read(1.0).omega_e_radps, 300.0, 6.3); // one count
}

TEST(Encoder, EccentricityIsOnePerTurnAndOffsetElectrical)
{
    SensorSettings s;
    s.encoder_lines            = 1000000; // quantisation below what is looked at
    s.encoder_eccentricity_rad = 0.01;
    s.encoder_offset_e_rad     = 0.2;
    QuadratureEncoder encoder  = encoder_with(s);
    for (double theta_m = -7.0; theta_m < 7.0; theta_m += 0.1) {
        const double found = encoder.read(pairs * theta_m).theta_e_rad;
        const double shift = std::remainder(found - pairs * theta_m, 2.0 * pi);
        EXPECT_NEAR(shift, 0.2 + pairs * 0.01 * std::sin(theta_m), 1e-5);
    }
}

TEST(Encoder, IndexRestoresLostCounts)
{
    for (bool index : {true, false}) {
        SensorSettings s;
        s.encoder_index           = index;
        QuadratureEncoder encoder = encoder_with(s);
        encoder.lose(37);
        const double half = pairs * pi + 1e-4; // half a turn, just past an edge
        EXPECT_EQ(encoder.read(half).count, 5000 - 37);
        EXPECT_EQ(encoder.read(half + pairs * pi).count, index ? 10000 : 10000 - 37);
    }
}

namespace {

/// EQ-ENCODER-5 after a run of periods at a constant speed.
double edge_speed(double omega_e_radps)
{
    SensorSettings settings;
    settings.encoder_edge_time = true;
    QuadratureEncoder encoder  = encoder_with(settings);
    double            speed    = 0.0;
    for (int k = 1; k <= 200; k++) {
        speed = encoder.read(0.3 + omega_e_radps * k * period_s, omega_e_radps).omega_e_radps;
    }
    return speed;
}

} // namespace

TEST(Encoder, EdgeTimesGiveTheSpeedBetweenCounts)
{
    for (const double omega :
         {400.0, 37.0, 8.0, -8.0, -37.0, -400.0}) { // counts alone: steps of 6.3
        EXPECT_NEAR(edge_speed(omega), omega, 1e-6 * std::abs(omega)) << omega;
    }
}

TEST(Encoder, WithoutAnEdgeTheSpeedFades)
{
    SensorSettings settings;
    settings.encoder_edge_time = true;
    QuadratureEncoder encoder  = encoder_with(settings);
    double            theta    = 0.0;
    for (int k = 0; k < 50; k++) {
        theta += 100.0 * period_s;
        encoder.read(theta, 100.0);
    }
    double before = 1e9;
    for (int k = 1; k <= 100; k++) {
        const double speed = encoder.read(theta, 0.0).omega_e_radps;
        EXPECT_LE(speed, before);
        before = speed;
    }
    EXPECT_LE(before, pairs * 2.0 * pi / (4 * lines) / (99 * period_s)); // one count in that time
}

namespace {

/// Largest error of EQ-ENCODER-6 over a run at constant speed, from the first reading on.
double largest_angle_error(double omega_e_radps)
{
    SensorSettings settings;
    settings.encoder_edge_time = true;
    QuadratureEncoder encoder  = encoder_with(settings);
    encoder.start(0.3, omega_e_radps);
    double worst = 0.0;
    for (int k = 0; k < 2000; k++) {
        const double theta = 0.3 + omega_e_radps * k * period_s;
        const double error = encoder.read(theta, omega_e_radps).theta_e_rad - theta;
        worst              = std::max(worst, std::abs(std::remainder(error, 2.0 * pi)));
    }
    return worst;
}

} // namespace

TEST(Encoder, EdgeTimesGiveTheAngleWithinACount)
{
    for (const double omega : {400.0, 37.0, 8.0, -8.0, -37.0, -400.0}) { // a count is 1.3e-3
        EXPECT_LT(largest_angle_error(omega), 1e-6) << omega;
    }
}

TEST(Encoder, AStandingAngleStaysWithinItsCount)
{
    SensorSettings settings;
    settings.encoder_edge_time = true;
    QuadratureEncoder encoder  = encoder_with(settings);
    const double      count    = pairs * 2.0 * pi / (4 * lines);
    double            theta    = 0.0;
    for (int k = 0; k < 50; k++) {
        theta += 100.0 * period_s;
        encoder.read(theta, 100.0);
    }
    const double cell = std::floor(theta / count) * count;
    for (int k = 0; k < 50; k++) {
        const double read = encoder.read(theta, 0.0).theta_e_rad;
        EXPECT_GE(read, cell - 1e-12);
        EXPECT_LE(read, cell + count + 1e-12);
    }
}

TEST(Encoder, IndexIsSeenWhenItsCountIsEnteredFromEitherSide)
{
    const auto middle_of = [](double count) {
        return pairs * 2.0 * pi * (count + 0.5) / (4 * lines);
    };
    struct Step {
        double before;
        double now;
        bool   index;
    };
    for (const Step &s : {Step{9999, 10000, true}, // forwards onto the mark
                          {9990, 10005, true},     // and past it
                          {10000, 10001, false},   // off it again
                          {9990, 9999, false},
                          {10001, 10000, true}, // backwards onto it
                          {10005, 9990, true},
                          {10000, 9999, false},
                          {10005, 10001, false},
                          {3, -2, true}}) {
        QuadratureEncoder encoder = encoder_with({});
        encoder.start(middle_of(s.before), 0.0);
        encoder.lose(5);
        const auto r = encoder.read(middle_of(s.now));
        EXPECT_EQ(r.index, s.index) << s.before << " to " << s.now;
        EXPECT_EQ(r.raw_count, static_cast<std::int64_t>(s.now) - 5); // no index puts it right
        if (s.index) {
            EXPECT_EQ(r.index_count, (s.now < 5000 ? 0 : 10000) - 5);
        }
    }
}

/// The middle of a count may be a whole number of turns: the angle is 0 then, never 2 pi.
TEST(Encoder, AngleOfWholeTurnsIsZero)
{
    SensorSettings s;
    s.encoder_disc = {0.0, 0.0, 0.0};
    for (int n = -9; n <= 9; n++) {
        QuadratureEncoder encoder(s, 1, 8, period_s);
        const double      middle = 8 * 2.0 * pi * (n + 0.5) / 4.0;
        encoder.start(middle, 0.0);
        const auto r = encoder.read(middle);
        EXPECT_EQ(r.count, n);
        EXPECT_EQ(r.theta_e_rad, 0.0);
    }
}
