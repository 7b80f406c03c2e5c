// SPDX-License-Identifier: MIT
/// Every figure of a reading against the edges of a shaft that turns at one speed for a while, then at another. The edges
/// are known in advance: number and instant of each. The expected figures are their definitions in encoder.hpp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sil/sensors/encoder.hpp"

using namespace sdre;

namespace {

const double     two_pi    = 2.0 * std::acos(-1.0);
constexpr int    lines     = 16; // few, so that index marks are frequent
constexpr int    counts    = 4 * lines;
constexpr int    pairs     = 3;
constexpr double period_s  = 2e-4;
const double     count_rad = pairs * two_pi / counts;

/// The shaft passes line n at an instant, upwards or downwards.
struct Passage {
    double       time_s;
    std::int64_t line;
    int          direction;
};

/// The end of a period, and all passages in it.
struct Tick {
    double               theta_e_rad;
    double               omega_e_radps;
    std::int64_t         count;
    std::vector<Passage> passed;
};

/// Speeds from standstill to three counts a period, either way, each for some periods.
std::vector<Tick> ride(unsigned seed, int length)
{
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> exponent(-3.0, 0.5);
    std::uniform_int_distribution<int>     choice(0, 9);
    const double                           one = count_rad / period_s; // a count in a period
    std::vector<Tick>                      out;
    double                                 theta = 0.31 * count_rad;
    double                                 speed = 0.73 * one;
    int                                    left  = 4;
    for (int k = 0; k < length; k++) {
        if (left-- == 0) {
            const int what = choice(random);
            speed = what == 0 ? 0.0 : (what < 5 ? -one : one) * std::pow(10.0, exponent(random));
            left  = 1 + 4 * choice(random);
        }
        Tick         t{theta + speed * period_s, speed, 0, {}};
        const double from = theta / count_rad;
        const double to   = t.theta_e_rad / count_rad;
        t.count           = static_cast<std::int64_t>(std::floor(to));
        const auto at     = [&](std::int64_t line, int direction) {
            t.passed.push_back(
                    {k * period_s + (static_cast<double>(line) - from) * count_rad / speed, line,
                 direction});
        };
        for (auto n = static_cast<std::int64_t>(std::floor(from)) + 1; static_cast<double>(n) <= to;
             n++) {
            at(n, 1);
        }
        for (auto n = static_cast<std::int64_t>(std::floor(from)); static_cast<double>(n) > to;
             n--) {
            at(n, -1);
        }
        out.push_back(t);
        theta = t.theta_e_rad;
    }
    return out;
}

QuadratureEncoder encoder_of(bool edge_time, const Tick &first, bool index = true)
{
    SensorSettings s;
    s.encoder_disc      = {0.0, 0.0, 0.0};
    s.encoder_edge_time = edge_time;
    s.encoder_index     = index;
    QuadratureEncoder encoder(s, lines, pairs, period_s);
    encoder.start(first.theta_e_rad, first.omega_e_radps);
    return encoder;
}

double wrapped(double theta)
{
    const double rest = std::fmod(theta, two_pi);
    return rest < 0.0 ? rest + two_pi : rest;
}

void expect_angle(double found, double wanted)
{
    EXPECT_GE(found, 0.0);
    EXPECT_LT(found, two_pi + 1e-12);
    EXPECT_NEAR(std::remainder(found - wanted, two_pi), 0.0, 1e-9);
}

constexpr double cap_s = 0.05;

} // namespace

/// An edge after the end of the period is counted there, and the angle is a count ahead: its time is another edge's.
TEST(EncoderReadings, OfALateCountAreAheadByTheEdgesItHas)
{
    constexpr double late_s = 0.3 * period_s;
    for (const bool edge_time : {false, true}) {
        const std::vector<Tick> ticks = ride(7, 4000);
        SensorSettings          s;
        s.encoder_disc         = {0.0, 0.0, 0.0};
        s.encoder_edge_time    = edge_time;
        s.encoder_count_late_s = late_s;
        QuadratureEncoder late(s, lines, pairs, period_s);
        QuadratureEncoder prompt = encoder_of(edge_time, ticks[0]);
        late.start(ticks[0].theta_e_rad, ticks[0].omega_e_radps);
        int ahead = 0;
        for (std::size_t k = 1; k < ticks.size(); k++) {
            const Tick        &t      = ticks[k];
            const auto         r      = late.read(t.theta_e_rad, t.omega_e_radps);
            const auto         p      = prompt.read(t.theta_e_rad, t.omega_e_radps);
            const double       later  = t.theta_e_rad + t.omega_e_radps * late_s;
            const auto         wanted = static_cast<std::int64_t>(std::floor(later / count_rad));
            const std::int64_t edges  = wanted - t.count;
            ASSERT_EQ(r.count, wanted) << k;
            ASSERT_EQ(r.raw_count, wanted) << k;
            if (edge_time) {
                expect_angle(r.theta_e_rad, p.theta_e_rad + static_cast<double>(edges) * count_rad);
                EXPECT_EQ(r.omega_e_radps, p.omega_e_radps);
                if (p.edge_of_pattern > 0) {
                    EXPECT_EQ(((r.edge_of_pattern - p.edge_of_pattern - edges) % 16 + 16) % 16, 0)
                        << k;
                }
            }
            ahead += edges != 0 ? 1 : 0;
        }
        EXPECT_GT(ahead, 200);
    }
}

/// EQ-ENCODER-5, 6: from one period's last edge to the last one of an earlier period.
TEST(EncoderReadings, WithTimesAreThoseOfTheLastEdges)
{
    int with_edge = 0, without = 0, held = 0, far = 0;
    for (unsigned seed = 1; seed <= 20; seed++) {
        const std::vector<Tick> ticks   = ride(seed, 1500);
        QuadratureEncoder       encoder = encoder_of(true, ticks[0]);
        // The edge before the first reading, as if the shaft had always turned at this speed.
        Passage last{-(0.31 / 0.73) * period_s, 0, 1};
        double  speed = ticks[0].omega_e_radps;
        double  gap_s = 0.0;
        for (std::size_t k = 0; k < ticks.size(); k++) {
            const Tick  &t     = ticks[k];
            const double now_s = static_cast<double>(k + 1) * period_s;
            const auto   r     = encoder.read(t.theta_e_rad, t.omega_e_radps);
            ASSERT_EQ(r.count, t.count) << seed << " " << k;
            if (!t.passed.empty()) {
                const Passage &p = t.passed.back();
                speed =
                    count_rad * static_cast<double>(p.line - last.line) / (p.time_s - last.time_s);
                gap_s                   = std::min(p.time_s - last.time_s, cap_s);
                last                    = p;
                const double beyond_cnt = speed * (now_s - last.time_s) / count_rad;
                expect_angle(r.theta_e_rad, count_rad * (static_cast<double>(last.line) +
                                                         std::clamp(beyond_cnt, -1.5, 1.5)));
                EXPECT_EQ(r.edge_of_pattern, 1 + static_cast<int>((last.line % 16 + 16) % 16));
                EXPECT_NEAR(r.edge_gap_s, gap_s, 1e-9);
                EXPECT_NEAR(r.edge_age_s, now_s - last.time_s, 1e-9);
                EXPECT_EQ(r.band_e_rad, 0.0);
                with_edge++;
                far += std::abs(beyond_cnt) > 1.0 ? 1 : 0;
            } else {
                const double age_s = now_s - last.time_s;
                held += std::abs(speed) > count_rad / age_s ? 1 : 0;
                speed = std::clamp(speed, -count_rad / age_s, count_rad / age_s);
                expect_angle(r.theta_e_rad, count_rad * (static_cast<double>(t.count) + 0.5));
                EXPECT_EQ(r.edge_of_pattern, 0);
                EXPECT_NEAR(r.edge_gap_s, std::min(std::max(age_s, gap_s), cap_s), 1e-9);
                EXPECT_EQ(r.edge_age_s, 0.0);
                EXPECT_NEAR(r.band_e_rad, 0.5 * count_rad, 1e-15);
                without++;
            }
            ASSERT_NEAR(r.omega_e_radps, speed, 1e-6 * std::abs(speed) + 1e-6) << seed << " " << k;
        }
    }
    EXPECT_GT(with_edge, 1000);
    EXPECT_GT(without, 1000);
    EXPECT_GT(held, 100);
    EXPECT_GT(far, 2);
}

/// EQ-ENCODER-4, 8: a count that changed is from the middle of its period.
TEST(EncoderReadings, WithoutTimesAreThoseOfTheCounts)
{
    int alone = 0, many = 0, none = 0;
    for (unsigned seed = 1; seed <= 20; seed++) {
        const std::vector<Tick> ticks   = ride(seed, 1500);
        QuadratureEncoder       encoder = encoder_of(false, ticks[0]);
        std::int64_t            before  = 0;
        double last_s = -(0.31 / 0.73) * period_s; // at the start the edge is known
        double gap_s  = 0.0;
        for (std::size_t k = 0; k < ticks.size(); k++) {
            const Tick  &t      = ticks[k];
            const double now_s  = static_cast<double>(k + 1) * period_s;
            const auto   r      = encoder.read(t.theta_e_rad, t.omega_e_radps);
            const auto   turned = t.count - before;
            ASSERT_EQ(r.count, t.count);
            ASSERT_NEAR(r.omega_e_radps, static_cast<double>(turned) * count_rad / period_s, 1e-6);
            if (turned != 0) {
                gap_s  = std::min(now_s - last_s, 1.0) - 0.5 * period_s;
                last_s = now_s - 0.5 * period_s;
            }
            if (std::abs(turned) == 1) {
                const auto   line   = static_cast<double>(turned > 0 ? t.count : t.count + 1);
                const double beyond = 0.5 * period_s / gap_s * static_cast<double>(turned);
                expect_angle(r.theta_e_rad, count_rad * (line + std::clamp(beyond, -1.5, 1.5)));
                EXPECT_NEAR(r.edge_gap_s, gap_s, 1e-9);
                EXPECT_NEAR(r.edge_age_s, 0.5 * period_s, 1e-12);
                EXPECT_EQ(r.band_e_rad, 0.0);
                alone++;
            } else {
                expect_angle(r.theta_e_rad, count_rad * (static_cast<double>(t.count) + 0.5));
                EXPECT_EQ(r.edge_age_s, 0.0);
                EXPECT_NEAR(r.band_e_rad, (turned == 0 ? 0.5 : 0.25) * count_rad, 1e-15);
                EXPECT_NEAR(r.edge_gap_s,
                            turned == 0 ? std::min(std::max(now_s - last_s, gap_s), cap_s) : 0.0,
                            1e-9);
                (turned == 0 ? none : many)++;
            }
            EXPECT_EQ(r.edge_of_pattern, 0);
            before = t.count;
        }
    }
    EXPECT_GT(alone, 1000);
    EXPECT_GT(many, 1000);
    EXPECT_GT(none, 1000);
}

/// Lost counts come back with the next turn where there is an index; a plain counter never gets them back. A misread count is
/// of one reading. The mark is seen in the period in which its count is entered.
TEST(EncoderReadings, CountEdgesAndIndexWithLostAndMisreadCounts)
{
    int marks = 0, restored = 0;
    for (const bool index : {true, false}) {
        for (unsigned seed = 1; seed <= 20; seed++) {
            const std::vector<Tick>            ticks   = ride(seed, 1500);
            QuadratureEncoder                  encoder = encoder_of(seed % 2 == 0, ticks[0], index);
            std::mt19937                       random(seed);
            std::uniform_int_distribution<int> chance(0, 40);
            const auto                         turn_of = [](std::int64_t n) {
                return (n - ((n % counts) + counts) % counts) / counts;
            };
            std::int64_t             lost = 0, for_good = 0, before = 0;
            std::vector<EncoderEdge> edges;
            for (std::size_t k = 0; k < ticks.size(); k++) {
                const Tick &t       = ticks[k];
                const int   misread = chance(random) == 0 ? chance(random) - 20 : 0;
                if (chance(random) == 0) {
                    encoder.lose(3);
                    lost += 3;
                    for_good += 3;
                }
                encoder.misread(misread);
                ShaftPath path;
                path.lead_to(t.theta_e_rad, t.omega_e_radps, period_s);
                const auto r = encoder.read(path, edges);
                if (index && turn_of(t.count) != turn_of(before)) {
                    restored += lost != 0 ? 1 : 0;
                    lost = 0;
                }
                ASSERT_EQ(r.count, t.count - lost + misread) << seed << " " << k;
                ASSERT_EQ(r.raw_count, t.count - for_good + misread);
                ASSERT_EQ(edges.size(), t.passed.size());
                bool         marked = false;
                std::int64_t mark   = 0;
                for (std::size_t n = 0; n < edges.size(); n++) {
                    const Passage     &p     = t.passed[n];
                    const std::int64_t after = p.direction > 0 ? p.line : p.line - 1;
                    EXPECT_NEAR(edges[n].time_s, p.time_s - static_cast<double>(k) * period_s,
                                1e-9);
                    EXPECT_EQ(edges[n].direction, p.direction);
                    EXPECT_EQ(edges[n].count, after - for_good);
                    if (after % counts == 0) {
                        marked = true;
                        mark   = after;
                    }
                }
                ASSERT_EQ(r.index, index && marked);
                if (r.index) {
                    EXPECT_EQ(r.index_count, mark - for_good);
                    marks++;
                }
                before = t.count;
            }
        }
    }
    EXPECT_GT(marks, 100);
    EXPECT_GT(restored, 50);
}

/// The shaft turns on; what is read stands.
TEST(EncoderReadings, OfADeadEncoderStayWhereTheyWere)
{
    for (const bool edge_time : {true, false}) {
        SensorSettings s;
        s.encoder_disc            = {0.0, 0.0, 0.0};
        s.encoder_edge_time       = edge_time;
        const std::vector<Tick> t = ride(7, 400);
        QuadratureEncoder       encoder(s, lines, pairs, period_s);
        encoder.start(t[0].theta_e_rad, t[0].omega_e_radps);
        std::size_t k = 0;
        for (; k < 100; k++) {
            encoder.read(t[k].theta_e_rad, t[k].omega_e_radps);
        }
        s.encoder_dead = true;
        encoder.configure(s);
        std::vector<EncoderEdge> edges;
        for (; k < 300; k++) {
            ShaftPath path;
            path.lead_to(t[k].theta_e_rad, t[k].omega_e_radps, period_s);
            EXPECT_EQ(encoder.read(path, edges).count, t[99].count);
            EXPECT_TRUE(edges.empty());
        }
        s.encoder_dead = false; // it answers again, with every count
        encoder.configure(s);
        EXPECT_EQ(encoder.read(t[k].theta_e_rad, t[k].omega_e_radps).count, t[k].count);
    }
}

/// A start at a speed is as if the shaft had always turned: the first reading is as good as all others.
TEST(EncoderReadings, BeginWithTheSpeedBeforeTheStart)
{
    const double one = count_rad / period_s;
    for (const double rate : {-2.3, -0.6, -0.01, -1e-4, 0.0, 1e-4, 0.02, 0.7, 0.99, 3.1}) {
        for (const double place : {0.05, 0.31, 0.77, 0.96}) {
            const double   speed = rate * one;
            const double   at    = (place + 5.0) * count_rad;
            SensorSettings s;
            s.encoder_disc      = {0.0, 0.0, 0.0};
            s.encoder_edge_time = true;
            QuadratureEncoder encoder(s, lines, pairs, period_s);
            encoder.start(at, speed);
            const auto   r       = encoder.read(at, speed);
            const double to_edge = rate > 0.0 ? place : (rate < 0.0 ? place - 1.0 : HUGE_VAL);
            const double age_s   = rate == 0.0 ? HUGE_VAL : to_edge / rate * period_s;
            EXPECT_EQ(r.count, 5);
            if (age_s <= period_s) {
                EXPECT_NEAR(r.omega_e_radps, speed, 1e-6 * std::abs(speed));
                expect_angle(r.theta_e_rad, wrapped(at));
                EXPECT_NEAR(r.edge_age_s, age_s, 1e-12);
                EXPECT_NEAR(r.edge_gap_s,
                            std::ceil((period_s - age_s) / (count_rad / std::abs(speed))) *
                                count_rad / std::abs(speed),
                            1e-9);
            } else {
                const double most = count_rad / std::min(age_s, 1.0 + period_s);
                EXPECT_NEAR(r.omega_e_radps, std::clamp(speed, -most, most),
                            1e-9 + 1e-6 * std::abs(speed));
                EXPECT_NEAR(r.edge_gap_s, std::min(age_s, cap_s), 1e-9);
            }
        }
    }
}
