// SPDX-License-Identifier: MIT
#include "sil/sensors/encoder_disc.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "drive/drive_file.hpp"
#include "sil/sensors/encoder.hpp"
#include "sil/setup/board_reader.hpp"
#include "sil/setup/scenario.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

constexpr int lines  = 2500;
constexpr int counts = 4 * lines;

double error_cnt(const EncoderDisc &disc, int n)
{
    return disc.edge_cnt(n) - n;
}

} // namespace

TEST(EncoderDisc, IsOffByATenthOfACountAsDataSheetsHaveIt)
{
    const EncoderDisc disc({}, counts, 1);
    double            square = 0.0;
    double            sum    = 0.0;
    double            worst  = 0.0;
    for (int n = 0; n < counts; n++) {
        const double e = error_cnt(disc, n);
        square += e * e / counts;
        sum += e / counts;
        worst = std::max(worst, std::abs(e));
    }
    EXPECT_NEAR(std::sqrt(square), 0.10, 0.002);
    EXPECT_NEAR(sum, 0.0, 0.001); // no alignment error
    EXPECT_GT(worst, 0.17);
    EXPECT_LT(worst, 0.25);
}

TEST(EncoderDisc, QuadratureErrorIsThatOfTheStatesAndDutyErrorThatOfThePulses)
{
    const EncoderDisc quadrature({0.3, 0.0, 0.0}, counts, 1);
    const EncoderDisc duty({0.0, 0.2, 0.0}, counts, 1);
    for (int n = -8; n < 8; n++) { // A rises at 4 k, B at 4 k + 1, A falls at 4 k + 2, B at 4 k + 3
        const double state = quadrature.edge_cnt(n + 1) - quadrature.edge_cnt(n);
        EXPECT_NEAR(state, n % 2 == 0 ? 1.3 : 0.7, 1e-12) << n; // A before B: the wide one
        const double pulse = duty.edge_cnt(n + 2) - duty.edge_cnt(n);
        EXPECT_NEAR(pulse, (n + 8) % 4 < 2 ? 2.2 : 1.8, 1e-12) << n;
        EXPECT_NEAR(quadrature.edge_cnt(n + 4) - quadrature.edge_cnt(n), 4.0, 1e-12); // whole lines
        EXPECT_NEAR(duty.edge_cnt(n + 4) - duty.edge_cnt(n), 4.0, 1e-12);
    }
}

TEST(EncoderDisc, JitterIsTheSameInEveryTurnAndOtherWithAnotherSeed)
{
    const EncoderDisc one({0.0, 0.0, 0.05}, counts, 1);
    const EncoderDisc two({0.0, 0.0, 0.05}, counts, 2);
    double            square    = 0.0;
    double            neighbour = 0.0;
    double            seeds     = 0.0;
    for (int n = 0; n < counts; n++) {
        const double e = error_cnt(one, n);
        EXPECT_NEAR(error_cnt(one, n + counts), e, 1e-11);
        EXPECT_NEAR(error_cnt(one, n - 3 * counts), e, 1e-11);
        EXPECT_LE(std::abs(e), std::sqrt(3.0) * 0.05 + 1e-12);
        square += e * e / counts;
        neighbour += e * error_cnt(one, n + 1) / counts;
        seeds += e * error_cnt(two, n) / counts;
    }
    EXPECT_NEAR(std::sqrt(square), 0.05, 0.001);
    EXPECT_NEAR(neighbour / square, 0.0, 0.04); // 4 / sqrt(10,000)
    EXPECT_NEAR(seeds / square, 0.0, 0.04);
}

TEST(EncoderDisc, ACountBeginsAtItsEdge)
{
    const EncoderDisc disc({0.4, -0.3, 0.05}, counts, 7);
    for (int n = -100; n < 100; n++) {
        const double edge = disc.edge_cnt(n);
        EXPECT_EQ(disc.count_at(edge), n);
        EXPECT_EQ(disc.count_at(edge - 1e-9), n - 1);
        EXPECT_EQ(disc.count_at(0.5 * (edge + disc.edge_cnt(n + 1))), n);
    }
}

TEST(EncoderDisc, EdgesAreTimedWhereTheyAre)
{
    SensorSettings s;
    s.encoder_disc = {0.3, 0.1, 0.05};
    const EncoderDisc disc(s.encoder_disc, counts, 5);
    QuadratureEncoder encoder(s, lines, 2, 2e-4, 5);
    encoder.start(1.0, 500.0);
    ShaftPath path;
    path.lead_to(1.0, 500.0, 2e-4);
    std::vector<EncoderEdge> edges;
    encoder.read(path, edges);
    ASSERT_GT(edges.size(), 70U);
    for (const EncoderEdge &e : edges) {
        const double turns = (1.0 - 500.0 * (2e-4 - e.time_s)) / (2 * 2.0 * std::acos(-1.0));
        EXPECT_NEAR(turns * counts, disc.edge_cnt(e.count), 1e-9);
    }
}

TEST(EncoderDisc, TimesBetweenEdgesOfOneKindKnowNothingOfStateAndPulseWidth)
{
    // 500 rad/s is 79.6 counts in a period: edges of all kinds are the last one. Whole lines apart they are exact.
    SensorSettings s;
    s.encoder_disc      = {0.3, 0.2, 0.0};
    s.encoder_edge_time = true;
    QuadratureEncoder encoder(s, lines, 2, 2e-4);
    encoder.start(0.0, 503.0);
    double worst = 0.0;
    double best  = 1e9;
    for (int k = 0; k < 500; k++) {
        const double error = std::abs(encoder.read(503.0 * 2e-4 * k, 503.0).omega_e_radps - 503.0);
        worst              = std::max(worst, error);
        best               = std::min(best, error);
    }
    EXPECT_GT(worst, 503.0 * 0.3 / 82.0); // an edge of the one and one of the other track
    EXPECT_LT(worst, 503.0 * 0.6 / 79.0);
    EXPECT_LT(best, 1e-6);
}

TEST(EncoderDisc, JitterRepeatsAfterTheEdgesThatAreGiven)
{
    const EncoderDisc repeats({0.0, 0.0, 0.1, 16}, counts, 3);
    const EncoderDisc turn({0.0, 0.0, 0.1, 0}, counts, 3);
    double            differs = 0.0;
    for (std::int64_t n = 0; n < counts; n++) {
        const auto at = static_cast<double>(n);
        EXPECT_NEAR(repeats.edge_cnt(n) - at,
                    repeats.edge_cnt(n % 16) - static_cast<double>(n % 16), 1e-9);
        differs = std::max(differs, std::abs(repeats.edge_cnt(n) - turn.edge_cnt(n)));
    }
    EXPECT_GT(differs, 0.1);
    EXPECT_EQ(repeats.edge_cnt(7), turn.edge_cnt(7));
}

TEST(EncoderDisc, AMapIsTheDiscInStepsWithItsOwnError)
{
    const EncoderDiscSettings own{0.14, 0.14, 0.05};
    EncoderDiscSettings       mapped = own;
    const EncoderDisc         without(own, counts, 3);
    for (const double error_cnt : {0.0, 0.01, 0.03}) {
        mapped.map_error_rms_cnt = error_cnt;
        const EncoderDisc disc(mapped, counts, 3);
        double            square = 0.0;
        double            shared = 0.0;
        for (std::int64_t n = 0; n < counts; n++) {
            EXPECT_EQ(disc.edge_cnt(n), without.edge_cnt(n)); // the disc itself is the same
            EXPECT_EQ(without.mapped_cnt(n), 0.0);
            const double o = disc.mapped_cnt(n);
            EXPECT_EQ(256.0 * o, std::round(256.0 * o));
            EXPECT_EQ(disc.mapped_cnt(n - 3 * counts), o);
            const double off = o - (disc.edge_cnt(n) - static_cast<double>(n));
            square += off * off / counts;
            shared += off * (disc.edge_cnt(n) - static_cast<double>(n)) / counts;
        }
        const double step_cnt = 1.0 / 256.0 / std::sqrt(12.0);
        EXPECT_NEAR(std::sqrt(square), std::hypot(error_cnt, step_cnt),
                    0.03 * (error_cnt + step_cnt));
        EXPECT_NEAR(shared, 0.0, 2e-4); // errors of the map are its own
    }
}

TEST(EncoderDisc, AMapGivesTheShaftsAngleAndSpeed)
{
    SensorSettings s;
    s.encoder_disc          = {0.3, 0.1, 0.05, 0, 0.0};
    s.encoder_edge_time     = true;
    constexpr double speed  = 503.0;
    const double     period = 2e-4;
    for (const double direction : {1.0, -1.0}) {
        QuadratureEncoder with(s, lines, 2, period, 5);
        s.encoder_disc.map_error_rms_cnt.reset();
        QuadratureEncoder without(s, lines, 2, period, 5);
        s.encoder_disc.map_error_rms_cnt = 0.0;
        with.start(0.0, direction * speed);
        without.start(0.0, direction * speed);
        const double count_rad = 2 * 2.0 * std::acos(-1.0) / counts;
        double       plain     = 0.0;
        for (int k = 1; k < 3000; k++) {
            const double theta  = direction * speed * period * k;
            const auto   mapped = with.read(theta, direction * speed);
            const auto   bare   = without.read(theta, direction * speed);
            if (k < 3) {
                continue; // the edge before the start is no edge of the disc
            }
            const double error = std::remainder(mapped.theta_e_rad - theta, 2.0 * std::acos(-1.0));
            EXPECT_NEAR(error / count_rad, 0.0, 2.1e-3) << k; // half a step of the map
            EXPECT_NEAR(mapped.omega_e_radps / (direction * speed), 1.0, 1e-4);
            EXPECT_EQ(mapped.raw_count, bare.raw_count);
            plain = std::max(
                plain, std::abs(std::remainder(bare.theta_e_rad - theta, 2.0 * std::acos(-1.0))) /
                           count_rad);
        }
        EXPECT_GT(plain, 0.2);
    }
}

namespace {

Scenario scenario(const std::string &sensors)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write("s.toml", "drive = \"" SDRE_SOURCE_DIR
                                                  "/firmware/config/drives/ipmsm_390w.toml\"\n"
                                                  "duration_s = 0.05\n[sensors]\n" +
                                                      sensors));
}

} // namespace

TEST(EncoderDisc, KeysAreReadAndChecked)
{
    const EncoderDiscSettings s =
        scenario("encoder_quadrature_error_cnt = 0.3\nencoder_duty_error_cnt = -0.1\n"
                 "encoder_jitter_rms_cnt = 0.01\n")
            .sensors.encoder_disc;
    EXPECT_EQ(s.quadrature_error_cnt, 0.3);
    EXPECT_EQ(s.duty_error_cnt, -0.1);
    EXPECT_EQ(s.jitter_rms_cnt, 0.01);
    EXPECT_EQ(scenario("").sensors.encoder_disc.quadrature_error_cnt, 0.14);
    EXPECT_EQ(scenario("encoder_jitter_repeats = 16\n").sensors.encoder_disc.jitter_repeats, 16);
    EXPECT_THROW(scenario("encoder_jitter_repeats = -1\n"), InputError);
    EXPECT_FALSE(scenario("").sensors.encoder_disc.map_error_rms_cnt);
    EXPECT_EQ(scenario("encoder_map_error_rms_cnt = 0.01\n").sensors.encoder_disc.map_error_rms_cnt,
              0.01);
    EXPECT_THROW(scenario("encoder_map_error_rms_cnt = -0.01\n"), InputError);
    EXPECT_THROW(scenario("encoder_quadrature_error_cnt = 1.0\n"), InputError);
    EXPECT_THROW(scenario("encoder_jitter_rms_cnt = -0.01\n"), InputError);
    EXPECT_THROW(scenario("encoder_quadrature_error_cnt = 0.5\nencoder_duty_error_cnt = -0.5\n"),
                 InputError);
}

TEST(EncoderDisc, TheDriveFileSaysWhichDiscTheBoardHas)
{
    Drive d        = read_drive_file(SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml");
    d.encoder.disc = {0.2, 0.05, 0.15};
    const SensorSettings s = sensors_of_drive(d);
    EXPECT_EQ(s.encoder_disc.quadrature_error_cnt, 0.2);
    EXPECT_EQ(s.encoder_disc.duty_error_cnt, 0.2);
    EXPECT_EQ(s.encoder_disc.jitter_rms_cnt, 0.05);
    EXPECT_EQ(s.encoder_disc.jitter_repeats, 0);
    EXPECT_NEAR(s.encoder_eccentricity_rad / (2.0 * std::acos(-1.0)) * 4.0 * d.encoder.lines, 0.15,
                1e-12);
}
