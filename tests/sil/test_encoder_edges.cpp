// SPDX-License-Identifier: MIT
/// When the shaft passes which edge: against angles whose inverse is known.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sil/run/motor_bench.hpp"
#include "sil/sensors/encoder.hpp"
#include "temp_dir.hpp"

using namespace sdre;

namespace {

const double     two_pi    = 2.0 * std::acos(-1.0);
constexpr int    lines     = 2500;
constexpr int    pairs     = 2;
constexpr double period_s  = 2e-4;
const double     count_rad = pairs * two_pi / (4 * lines); // electrical

/// theta = start + speed t + acceleration t^2 / 2
struct Motion {
    double start;
    double speed;
    double acceleration;

    double theta(double t) const
    {
        return start + t * (speed + 0.5 * acceleration * t);
    }
    double omega(double t) const
    {
        return speed + acceleration * t;
    }
    /// The time at which it is at an angle: the earlier one, or the later one.
    double time_at(double angle, bool later) const
    {
        const double root = std::sqrt(speed * speed + 2.0 * acceleration * (angle - start));
        const double q    = -(speed + std::copysign(root, speed));
        const double one  = q / acceleration;
        const double two  = -2.0 * (angle - start) / q;
        return later ? std::max(one, two) : std::min(one, two);
    }
};

QuadratureEncoder encoder_with(SensorSettings settings)
{
    settings.encoder_disc = {0.0, 0.0, 0.0};
    return {settings, lines, pairs, period_s};
}

ShaftPath path_of(const Motion &m)
{
    ShaftPath path;
    path.lead_to(m.start, m.speed, period_s);
    path.restart();
    for (int n = 1; n <= 2; n++) {
        const double t = 0.5 * n * period_s;
        path.add(0.5 * period_s, m.theta(t), m.omega(t));
    }
    return path;
}

} // namespace

TEST(EncoderEdges, AreAtTheTimesOfAnAcceleratedShaft)
{
    for (const double direction : {1.0, -1.0}) {
        const Motion m{0.3, direction * 800.0, direction * 2e5}; // 40 rad/s more within the period
        QuadratureEncoder encoder = encoder_with({});
        encoder.start(m.start, m.speed);
        ShaftPath before;
        before.lead_to(m.start, m.speed, period_s);
        std::vector<EncoderEdge> edges;
        std::int64_t             now = encoder.read(before, edges).count;
        const auto               r   = encoder.read(path_of(m), edges);
        ASSERT_GT(edges.size(), 120U);
        for (const EncoderEdge &e : edges) {
            const std::int64_t edge = direction > 0 ? e.count : e.count + 1;
            now += e.direction;
            EXPECT_EQ(e.count, now);
            EXPECT_EQ(e.direction, direction > 0 ? 1 : -1);
            const double wanted_s = m.time_at(count_rad * static_cast<double>(edge), true);
            EXPECT_NEAR(e.time_s, wanted_s, 1e-13);
        }
        EXPECT_EQ(r.count, now);
        EXPECT_EQ(r.raw_count, now);
    }
}

TEST(EncoderEdges, AReversalPassesTheSameEdgesTwice)
{
    const Motion      m{0.3 * count_rad, 50.0, -5e5}; // turns around at 100 us, 1.99 counts further
    QuadratureEncoder encoder = encoder_with({});
    encoder.start(m.start, 0.0);
    std::vector<EncoderEdge> edges;
    encoder.read(path_of(m), edges);
    ASSERT_EQ(edges.size(), 4U);
    const std::array<int, 4> counts{1, 2, 1, 0};
    for (std::size_t n = 0; n < 4; n++) {
        const double edge = n == 1 || n == 2 ? 2.0 : 1.0;
        EXPECT_EQ(edges[n].count, counts[n]);
        EXPECT_EQ(edges[n].direction, n < 2 ? 1 : -1);
        EXPECT_NEAR(edges[n].time_s, m.time_at(edge * count_rad, n > 1), 1e-13);
    }
}

TEST(EncoderEdges, ChangingSpeedIsMeasuredFromEdgeToEdge)
{
    // EQ-ENCODER-5 between two known instants, not at the speed of the end.
    SensorSettings s;
    s.encoder_edge_time = true;
    const Motion      m{0.25 * count_rad, 300.0, 3e5};
    QuadratureEncoder encoder = encoder_with(s);
    encoder.start(m.start, m.speed);
    ShaftPath before;
    before.lead_to(m.start, m.speed, period_s);
    encoder.read(before);
    const double found   = encoder.read(path_of(m)).omega_e_radps;
    const double first_s = -0.25 * count_rad / m.speed;
    const double last    = std::floor(m.theta(period_s) / count_rad);
    const double wanted  = last * count_rad / (m.time_at(last * count_rad, true) - first_s);
    EXPECT_NEAR(found, wanted, 1e-7);
    EXPECT_GT(std::abs(found - m.omega(period_s)), 20.0);
}

TEST(EncoderEdges, EccentricityMovesThem)
{
    SensorSettings s;
    s.encoder_eccentricity_rad = 0.01;
    QuadratureEncoder encoder  = encoder_with(s);
    encoder.start(1.0, 500.0);
    ShaftPath path;
    path.lead_to(1.0, 500.0, period_s);
    std::vector<EncoderEdge> edges;
    encoder.read(path, edges);
    ASSERT_GT(edges.size(), 70U);
    for (const EncoderEdge &e : edges) {
        const double theta_m = (1.0 - 500.0 * (period_s - e.time_s)) / pairs;
        EXPECT_NEAR(theta_m + 0.01 * std::sin(theta_m),
                    static_cast<double>(e.count) * two_pi / (4 * lines), 1e-12);
    }
}

namespace {

Scenario scenario(const std::string &more)
{
    const support::TempDir dir;
    return read_scenario_file(dir.write(
        "s.toml", "drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/ipmsm_390w.toml\"\n"
                  "duration_s = 0.05\ninitial_speed_e_radps = 300.0\n[sensors]\nideal = false\n" +
                      more));
}

/// Every tick's edges lead from the count of the tick before to its own. Number of edges.
long edges_that_add_up(MotorBench &bench, int ticks)
{
    long         number = 0;
    std::int64_t count  = bench.sample().count;
    for (int k = 0; k < ticks; k++) {
        bench.begin_tick();
        bench.begin_period({});
        double last_s = 0.0;
        for (const EncoderEdge &e : bench.edges()) {
            EXPECT_EQ(e.count, count + e.direction);
            EXPECT_GE(e.time_s, last_s);
            EXPECT_LE(e.time_s, period_s);
            count  = e.count;
            last_s = e.time_s;
            number++;
        }
        EXPECT_EQ(bench.sample().count, count) << bench.tick();
    }
    return number;
}

} // namespace

TEST(EncoderEdges, OfTheBenchAddUpToItsCountsHeldAndFree)
{
    const Scenario s = scenario("");
    MotorBench     bench(s, 50);
    bench.begin_tick();
    EXPECT_NEAR(static_cast<double>(edges_that_add_up(bench, 49)),
                49 * 300.0 * period_s / count_rad, 1.0);
    ASSERT_EQ(bench.tick(), 49);
    EXPECT_GT(edges_that_add_up(bench, 100), 3500); // coasts with an open bridge
}

TEST(EncoderEdges, AStuckEncoderHasNone)
{
    const Scenario s = scenario("");
    MotorBench     bench(s, MotorBench::never);
    bench.begin_tick();
    bench.begin_tick();
    EXPECT_FALSE(bench.edges().empty());
    bench.stick_encoder();
    bench.begin_tick();
    EXPECT_TRUE(bench.edges().empty());
}
