// SPDX-License-Identifier: MIT
#include "sil/eval/metrics.hpp"

#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sil/eval/results.hpp"

namespace {

constexpr double ts_s = 1e-3;

/// One measure from t = 0 unless more are given.
sdre::Scenario scenario_with(std::vector<sdre::Measure> measures)
{
    sdre::Scenario scenario;
    scenario.measures = std::move(measures);
    return scenario;
}

sdre::Measure event(const std::string &name, double time_s, double band)
{
    sdre::Measure m;
    m.name         = name;
    m.time_s       = time_s;
    m.band_e_radps = band;
    return m;
}

sdre::Trace trace_of(int rows, const std::function<double(double)> &speed, double reference)
{
    sdre::Trace trace(static_cast<std::size_t>(rows));
    for (int k = 0; k < rows; k++) {
        sdre::TraceRow &row   = trace[static_cast<std::size_t>(k)];
        row.time_s            = k * ts_s;
        row.omega_ref_e_radps = reference;
        row.omega_e_radps     = speed(row.time_s);
    }
    return trace;
}

sdre::Metrics only(const sdre::Trace &trace, double band)
{
    const auto all = sdre::measure(scenario_with({event("m", 0.0, band)}), trace);
    EXPECT_EQ(all.size(), 1U);
    return all.at(0);
}

} // namespace

TEST(Metrics, FirstOrderResponseSettlesAtTheLogarithm)
{
    const double tau   = 0.02;
    const auto   trace = trace_of(
          501, [&](double t) { return 100.0 * (1.0 - std::exp(-t / tau)); }, 100.0);

    const sdre::Metrics m = only(trace, 1.0);

    ASSERT_TRUE(m.settling_time_s.has_value());
    EXPECT_NEAR(*m.settling_time_s, 0.093, 1e-9); // tau ln 100 = 92.1 ms, next sample
    EXPECT_EQ(m.overshoot_e_radps, 0.0);
    EXPECT_NEAR(m.dip_e_radps, 100.0 * std::exp(-0.093 / tau), 1e-9); // where it enters the band
    EXPECT_LT(m.steady_state_error_e_radps, 1e-6);
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.time_s, 0.0);
}

TEST(Metrics, RingingSettlesAfterItsLastExcursion)
{
    const auto speed = [](double t) { // 100 + 50 e^(-10 t) cos(2 pi 10 t), from 150 down
        return 100.0 + 50.0 * std::exp(-10.0 * t) * std::cos(20.0 * std::acos(-1.0) * t);
    };
    const auto trace = trace_of(1001, speed, 100.0);

    const sdre::Metrics m = only(trace, 5.0);

    ASSERT_TRUE(m.settling_time_s.has_value());
    const auto at = static_cast<std::size_t>(std::lround(*m.settling_time_s / ts_s));
    EXPECT_GT(std::abs(trace[at - 1].omega_e_radps - 100.0), 5.0);
    for (std::size_t k = at; k < trace.size(); k++) {
        EXPECT_LE(std::abs(trace[k].omega_e_radps - 100.0), 5.0);
    }
    // Downward step: beyond the target is below it.
    EXPECT_NEAR(m.overshoot_e_radps, 100.0 - speed(0.049), 0.2); // measured 0.1: sampling
    EXPECT_NEAR(m.dip_e_radps, speed(0.098) - 100.0, 0.2);
}

TEST(Metrics, UpwardStepCountsOnlyAfterReachingTheBand)
{
    const auto trace = trace_of(
        401,
        [](double t) {
            return t < 0.1 ? 1000.0 * t : (t < 0.2 ? 112.0 : (t < 0.3 ? 93.0 : 100.0));
        },
        100.0);

    const sdre::Metrics m = only(trace, 2.0);

    EXPECT_NEAR(m.overshoot_e_radps, 12.0, 1e-9);
    EXPECT_NEAR(m.dip_e_radps, 7.0, 1e-9);
    ASSERT_TRUE(m.settling_time_s.has_value());
    EXPECT_NEAR(*m.settling_time_s, 0.3, 1e-9);
}

TEST(Metrics, DownwardStepToANegativeTarget)
{
    const auto trace = trace_of(
        401, [](double t) { return t < 0.1 ? 50.0 : (t < 0.2 ? -108.0 : -100.0); }, -100.0);

    const sdre::Metrics m = only(trace, 1.0);

    EXPECT_NEAR(m.overshoot_e_radps, 8.0, 1e-9);
    EXPECT_NEAR(m.dip_e_radps, 0.0, 1e-9);
    EXPECT_NEAR(m.settling_time_s.value_or(-1.0), 0.2, 1e-9);
}

TEST(Metrics, NeverSettlingHasNoSettlingTime)
{
    const auto trace = trace_of(
        500, [](double t) { return std::fmod(t + 0.5 * ts_s, 0.02) < 0.01 ? 96.0 : 106.0; }, 100.0);

    const sdre::Metrics m = only(trace, 3.0);

    EXPECT_FALSE(m.settling_time_s.has_value());
    EXPECT_NEAR(m.ripple_e_radps, 5.0, 1e-9);
    EXPECT_NEAR(m.steady_state_error_e_radps, 1.0, 1e-9);
    for (const auto &[name, value] : sdre::metric_values(m)) {
        EXPECT_NE(name, "settling_time_s");
    }
}

TEST(Metrics, LeavingTheBandInTheLastRowIsNotSettled)
{
    const auto trace = trace_of(
        101, [](double t) { return t > 0.0995 ? 90.0 : 100.0; }, 100.0);

    EXPECT_FALSE(only(trace, 3.0).settling_time_s.has_value());
}

TEST(Metrics, EnteringTheBandInTheLastRowIsSettled)
{
    const auto trace = trace_of(
        101, [](double t) { return t > 0.0995 ? 100.0 : 90.0; }, 100.0);

    EXPECT_NEAR(only(trace, 3.0).settling_time_s.value_or(-1.0), 0.1, 1e-9);
}

TEST(Metrics, LoadDipIsADisturbance)
{
    const auto trace = trace_of(
        501,
        [](double t) {
            return t < 0.05 ? 300.0 - 800.0 * t : (t < 0.1 ? 306.0 : (t < 0.2 ? 302.0 : 300.0));
        },
        300.0);

    const sdre::Metrics m = only(trace, 3.0);

    EXPECT_NEAR(m.dip_e_radps, 0.049 * 800.0, 1e-9);
    EXPECT_NEAR(m.overshoot_e_radps, 6.0, 1e-9);
    EXPECT_NEAR(m.settling_time_s.value_or(-1.0), 0.1, 1e-9);
}

TEST(Metrics, UndisturbedSpeedIsSettledAtOnce)
{
    const sdre::Metrics m = only(trace_of(
                                     100, [](double) { return 102.0; }, 100.0),
                                 3.0);

    EXPECT_EQ(m.settling_time_s, 0.0);
    EXPECT_EQ(m.overshoot_e_radps, 2.0);
    EXPECT_EQ(m.dip_e_radps, 0.0);
    EXPECT_EQ(m.steady_state_error_e_radps, 2.0);
    EXPECT_EQ(m.ripple_e_radps, 0.0);
}

TEST(Metrics, BandIncludesItsEdge)
{
    const sdre::Metrics m = only(trace_of(
                                     100, [](double) { return 103.0; }, 100.0),
                                 3.0);

    EXPECT_EQ(m.settling_time_s, 0.0);
    EXPECT_EQ(m.overshoot_e_radps, 3.0);
}

TEST(Metrics, TailIsTheLastFifth)
{
    sdre::Trace trace = trace_of(
        100, [](double) { return 100.0; }, 100.0);
    for (std::size_t k = 0; k < trace.size(); k++) {
        const double x         = k < 80 ? 1000.0 : static_cast<double>(k) - 80.0; // 0 .. 19
        trace[k].d_omega_hat   = x;
        trace[k].d_q_hat       = 2.0 * x;
        trace[k].d_d_hat       = 3.0 * x;
        trace[k].iq_A          = 4.0 * x;
        trace[k].id_A          = -x;
        trace[k].omega_e_radps = k < 80 ? 500.0 : 100.0 + x;
    }

    const sdre::Metrics m = only(trace, 1.0);

    EXPECT_NEAR(m.d_omega_hat, 9.5, 1e-12);
    EXPECT_NEAR(m.d_q_hat, 19.0, 1e-12);
    EXPECT_NEAR(m.d_d_hat, 28.5, 1e-12);
    EXPECT_NEAR(m.iq_A, 38.0, 1e-12);
    EXPECT_NEAR(m.id_A, -9.5, 1e-12);
    EXPECT_NEAR(m.steady_state_error_e_radps, 9.5, 1e-12);
    EXPECT_NEAR(m.ripple_e_radps, 9.5, 1e-12);
}

TEST(Metrics, PeakCurrentIsTheLargestLengthInTheWindow)
{
    sdre::Trace trace = trace_of(
        100, [](double) { return 0.0; }, 0.0);
    trace[10].iq_A = 100.0; // before the window
    trace[50].iq_A = -3.0;
    trace[50].id_A = -4.0;
    trace[60].iq_A = 4.5;

    const auto all = sdre::measure(scenario_with({event("late", 0.04, 1.0)}), trace);

    EXPECT_EQ(all.at(0).peak_current_A, 5.0);
}

TEST(Metrics, PeakCurrentBetweenTheInstantsCounts)
{
    sdre::Trace trace = trace_of(
        100, [](double) { return 0.0; }, 0.0);
    trace[50].iq_A           = -3.0;
    trace[50].id_A           = -4.0;
    trace[60].peak_current_A = 6.5;

    EXPECT_EQ(only(trace, 1.0).peak_current_A, 6.5);
}

TEST(Metrics, SteadyCurrentIsTheMeanLengthInTheTail)
{
    sdre::Trace trace = trace_of(
        100, [](double) { return 0.0; }, 0.0);
    for (std::size_t k = 0; k < trace.size(); k++) {
        trace[k].iq_A = k < 80 ? 100.0 : (k % 2 == 0 ? 3.0 : -6.0);
        trace[k].id_A = k < 80 ? 0.0 : (k % 2 == 0 ? -4.0 : 8.0);
    }

    EXPECT_NEAR(only(trace, 1.0).steady_current_A, 7.5, 1e-12); // lengths of 5 and 10
}

TEST(Metrics, RatesOfANegativeSpeedAreSizes)
{
    sdre::Trace trace = trace_of(
        100, [](double t) { return t < 0.04 ? 0.0 : (t < 0.06 ? -110.0 : -100.0); }, -100.0);
    for (std::size_t k = 80; k < trace.size(); k++) {
        trace[k].omega_e_radps = k % 2 == 0 ? -101.0 : -99.0;
    }

    const sdre::Metrics m = only(trace, 5.0);

    EXPECT_NEAR(m.overshoot_percent, 10.0, 1e-9);
    EXPECT_NEAR(m.fluctuation_rate_percent, 1.0, 1e-9);
}

TEST(Metrics, WindowsEndWhereTheNextBegins)
{
    const auto trace = trace_of(
        301, [](double t) { return t < 0.0995 ? 10.0 : (t < 0.1995 ? 20.0 : 30.0); }, 10.0);
    sdre::Trace stepped = trace;
    for (sdre::TraceRow &row : stepped) {
        row.omega_ref_e_radps = row.time_s < 0.1995 ? 20.0 : 30.0;
    }

    const auto all = sdre::measure(
        scenario_with({event("a", 0.0, 1.0), event("b", 0.1, 1.0), event("c", 0.2, 1.0)}), stepped);

    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].name, "a");
    EXPECT_FALSE(all[0].settling_time_s.has_value()); // 10 where 20 is wanted, to its last row
    EXPECT_EQ(all[1].settling_time_s, 0.0);
    EXPECT_EQ(all[2].settling_time_s, 0.0);
    EXPECT_EQ(all[2].steady_state_error_e_radps, 0.0);
    EXPECT_EQ(all[2].time_s, 0.2);
}

TEST(Metrics, TargetIsTheReferenceAtTheEndOfTheWindow)
{
    sdre::Trace trace = trace_of(
        200, [](double) { return 80.0; }, 80.0);
    for (std::size_t k = 0; k < 50; k++) {
        trace[k].omega_ref_e_radps = 20.0;
    }

    const sdre::Metrics m = only(trace, 1.0);

    EXPECT_EQ(m.settling_time_s, 0.0);
    EXPECT_EQ(m.steady_state_error_e_radps, 0.0);
}

TEST(Metrics, ShortWindowStillHasATail)
{
    const sdre::Metrics m = only(trace_of(
                                     2, [](double t) { return t > 0 ? 7.0 : 0.0; }, 7.0),
                                 1.0);

    EXPECT_EQ(m.steady_state_error_e_radps, 0.0); // one row
    EXPECT_NEAR(m.settling_time_s.value_or(-1.0), ts_s, 1e-12);
}

/// A sine of 0.3 A on iq and a cosine on id: a vector of 0.3 A that turns about (-0.6, 0.8) A.
TEST(Metrics, DistortionIsWhatTurnsAgainstTheFundamental)
{
    sdre::Trace trace = trace_of(
        1000, [](double) { return 100.0; }, 100.0);
    for (std::size_t k = 0; k < trace.size(); k++) {
        const double phase           = 2.0 * std::acos(-1.0) * static_cast<double>(k) / 20.0;
        trace[k].iq_A                = 0.8 + 0.3 * std::sin(phase);
        trace[k].id_A                = -0.6 + 0.3 * std::cos(phase);
        trace[k].sensor_offset_hat_A = 0.25;
    }

    const sdre::Metrics m = only(trace, 1.0);

    EXPECT_NEAR(m.current_distortion_percent.value(), 30.0, 1e-9);
    EXPECT_NEAR(m.sensor_offset_hat_A, 0.25, 1e-12);
}

TEST(Metrics, DistortionOfNextToNoCurrentIsNone)
{
    const auto distortion = [](double iq_A) {
        sdre::Scenario scenario;
        sdre::Measure  m;
        m.name                             = "m";
        scenario.measures                  = {m};
        scenario.drive.motor.pole_pairs    = 2;
        scenario.drive.motor.max_current_A = 4.0;
        sdre::Trace trace(1000);
        for (std::size_t k = 0; k < trace.size(); k++) {
            trace[k].time_s = ts_s * static_cast<double>(k);
            trace[k].iq_A   = iq_A + (k % 2 == 0 ? 0.1 : -0.1);
        }
        return sdre::measure(scenario, trace).at(0).current_distortion_percent;
    };

    EXPECT_NEAR(distortion(0.041).value_or(0.0), 100.0 * 0.1 / 0.041, 1e-6);
    EXPECT_FALSE(distortion(0.039)); // below 1 % of 4 A
    EXPECT_FALSE(distortion(0.0));
}

TEST(Metrics, NoiseOfTheVoltagesIsTheirDeviationFromTheMeanInTheTail)
{
    auto trace = trace_of(
        1000, [](double) { return 100.0; }, 100.0);
    for (std::size_t k = 0; k < trace.size(); k++) {
        const bool tail = k >= 800;
        trace[k].vq_V   = 60.0 + (tail ? (k % 2 == 0 ? 3.0 : -3.0) : 90.0);
        trace[k].vd_V =
            -20.0 + (tail ? 2.0 * std::sin(0.1 * std::acos(-1.0) * static_cast<double>(k)) : 0.0);
    }
    const sdre::Metrics m = only(trace, 1.0);
    EXPECT_NEAR(m.effort.vq_noise_V, 3.0, 1e-9);
    EXPECT_NEAR(m.effort.vd_noise_V, std::sqrt(2.0), 1e-9);
}

/// Sines of torque and currents, half of them below 100 Hz: closed forms of the deviations and of the high-pass.
TEST(Metrics, EffortIsTheDeviationOfTorqueAndCurrentAndItsPartAbove100Hz)
{
    const double two_pi = 2.0 * std::acos(-1.0);
    auto         trace  = trace_of(
                 5000, [](double) { return 100.0; }, 100.0);
    const double ts = trace[1].time_s - trace[0].time_s;
    for (sdre::TraceRow &r : trace) {
        r.dc_link_V = 300.0;
        r.vq_V      = 10.0 * std::sin(two_pi * 10.0 * r.time_s);
        r.torque_Nm = 1.0 + 0.03 * std::sin(two_pi * 10.0 * r.time_s) +
                      0.02 * std::sin(two_pi * 0.1 / ts * r.time_s);
        r.iq_A = 2.0 + 0.05 * std::sin(two_pi * 0.1 / ts * r.time_s);
        r.id_A = 0.02 * std::sin(two_pi * 0.1 / ts * r.time_s);
    }
    sdre::Motor motor;
    motor.rated_torque_Nm = 2.0;
    const sdre::Effort e  = sdre::effort_of(trace.begin(), trace.end(), motor, ts);

    const double rms = std::sqrt(0.5);
    EXPECT_NEAR(e.vq_noise_V, 10.0 * rms, 1e-3);
    EXPECT_NEAR(e.vq_noise_percent, 100.0 * 10.0 * rms / (300.0 / std::sqrt(3.0)), 1e-2);
    EXPECT_NEAR(e.iq_noise_A, 0.05 * rms, 1e-4);
    EXPECT_NEAR(e.torque_noise_percent, 100.0 * std::hypot(0.03, 0.02) * rms / 2.0, 1e-2);
    // |1 - (1 - p) / (z - p)| of the high-pass that takes the difference to the value before
    const auto gain = [&](double hz) {
        const double               p = std::exp(-two_pi * 100.0 * ts);
        const std::complex<double> z = std::exp(std::complex<double>(0.0, two_pi * hz * ts));
        return std::abs(1.0 - (1.0 - p) / (z - p));
    };
    const double slow = 0.03 * gain(10.0);
    const double fast = gain(0.1 / ts);
    EXPECT_NEAR(e.audible_torque_percent, 100.0 * std::hypot(slow, 0.02 * fast) * rms / 2.0, 1e-2);
    EXPECT_NEAR(e.audible_current_A, std::hypot(0.05, 0.02) * fast * rms, 1e-4);
}

TEST(Metrics, EquivalentDelayIsTheDipOverTheUnansweredDeceleration)
{
    auto trace = trace_of(
        100, [](double) { return 100.0; }, 100.0);
    for (sdre::TraceRow &r : trace) {
        r.load_torque_Nm = 1.5;
    }
    sdre::Motor motor;
    motor.rated_torque_Nm = 1.5;
    motor.inertia_kgm2    = 4.2e-4;
    motor.pole_pairs      = 2;
    const auto delay      = [&](double before_Nm) {
        return sdre::equivalent_delay_s(trace.begin(), trace.end(), before_Nm, 5.0, motor);
    };
    EXPECT_NEAR(delay(0.75).value_or(0.0), 5.0 * 4.2e-4 / (2 * 0.75), 1e-12);
    EXPECT_FALSE(delay(1.5)); // no step
    EXPECT_FALSE(delay(2.0)); // relieved: no dip
    trace.back().load_torque_Nm = 1.4;
    EXPECT_FALSE(delay(0.75)); // another change follows
}

TEST(Metrics, NamesAreTheJsonKeys)
{
    sdre::Metrics m;
    m.settling_time_s            = 1.0;
    m.dip_e_radps                = 2.0;
    m.overshoot_e_radps          = 3.0;
    m.steady_state_error_e_radps = 4.0;
    m.ripple_e_radps             = 5.0;
    m.peak_current_A             = 6.0;
    m.steady_current_A           = 6.5;
    m.effort                     = {6.7, 6.8, 6.81, 6.82, 6.83, 6.84, 6.85};
    m.equivalent_delay_s         = 6.9;
    m.d_omega_hat                = 7.0;
    m.d_q_hat                    = 8.0;
    m.d_d_hat                    = 9.0;
    m.iq_A                       = 10.0;
    m.id_A                       = 11.0;
    m.sensor_offset_hat_A        = 11.3;
    m.position_off_cnt           = 11.4;
    m.position_steady_cnt        = 11.45;
    m.position_settled_s         = 11.5;
    m.position_overshoot_cnt     = 11.6;
    m.torque                     = sdre::TorqueMetrics{11.7, 11.8, 11.85, 11.9};
    m.current_distortion_percent = 11.6;
    m.fluctuation_rpm            = 12.0;
    m.fluctuation_rate_percent   = 13.0;
    m.offset_rpm                 = 14.0;
    m.decrease_rpm               = 15.0;
    m.overshoot_percent          = 16.0;
    m.within_5_percent_s         = 17.0;
    m.within_2_percent_s         = 18.0;
    m.within_1_percent_s         = 19.0;

    const std::vector<std::pair<std::string, double>> expected{{"settling_time_s", 1.0},
                                                               {"dip_e_radps", 2.0},
                                                               {"overshoot_e_radps", 3.0},
                                                               {"steady_state_error_e_radps", 4.0},
                                                               {"ripple_e_radps", 5.0},
                                                               {"peak_current_A", 6.0},
                                                               {"steady_current_A", 6.5},
                                                               {"vq_noise_V", 6.7},
                                                               {"vd_noise_V", 6.8},
                                                               {"vq_noise_percent", 6.81},
                                                               {"iq_noise_A", 6.82},
                                                               {"torque_noise_percent", 6.83},
                                                               {"audible_torque_percent", 6.84},
                                                               {"audible_current_A", 6.85},
                                                               {"equivalent_delay_s", 6.9},
                                                               {"d_omega_hat", 7.0},
                                                               {"d_q_hat", 8.0},
                                                               {"d_d_hat", 9.0},
                                                               {"iq_A", 10.0},
                                                               {"id_A", 11.0},
                                                               {"sensor_offset_hat_A", 11.3},
                                                               {"position_off_cnt", 11.4},
                                                               {"position_steady_cnt", 11.45},
                                                               {"position_settled_s", 11.5},
                                                               {"position_overshoot_cnt", 11.6},
                                                               {"torque_rise_s", 11.7},
                                                               {"torque_overshoot_percent", 11.8},
                                                               {"torque_error_percent", 11.85},
                                                               {"torque_ripple_percent", 11.9},
                                                               {"current_distortion_percent", 11.6},
                                                               {"fluctuation_rpm", 12.0},
                                                               {"fluctuation_rate_percent", 13.0},
                                                               {"offset_rpm", 14.0},
                                                               {"decrease_rpm", 15.0},
                                                               {"overshoot_percent", 16.0},
                                                               {"within_5_percent_s", 17.0},
                                                               {"within_2_percent_s", 18.0},
                                                               {"within_1_percent_s", 19.0}};
    EXPECT_EQ(sdre::metric_values(m), expected);
    ASSERT_EQ(sdre::metric_names().size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); n++) {
        EXPECT_EQ(sdre::metric_names()[n], expected[n].first);
        EXPECT_TRUE(sdre::is_metric_name(expected[n].first)) << expected[n].first;
    }
    EXPECT_FALSE(sdre::is_metric_name("time_s"));
    EXPECT_FALSE(sdre::is_metric_name(""));
}

namespace {

/// Four pole pairs, 500 r/min wanted; speed in r/min over time, the last 50 ms are the tail.
sdre::Metrics of_rpm(double (*rpm)(double))
{
    const double   radps     = std::acos(-1.0) / 30.0 * 4;
    sdre::Scenario s         = scenario_with({event("m", 0.0, 0.05 * 500.0 * radps)});
    s.measures[0].tail_s     = 0.05;
    s.drive.motor.pole_pairs = 4;
    const auto all =
        sdre::measure(s, trace_of(
                             200, [&](double t) { return rpm(t) * radps; }, 500.0 * radps));
    EXPECT_EQ(all.size(), 1U);
    return all.at(0);
}

} // namespace

TEST(Metrics, PaperBsFigures)
{
    // A dip to 430, back through 5 %, 2 % and 1 % of 500 about the mean of 498 at 20, 40 and 60 ms.
    const sdre::Metrics m = of_rpm([](double t) {
        const double swing = std::fmod(t + 0.5e-3, 2e-3) < 1e-3 ? 4.0 : -4.0;
        return t < 0.0195 ? 430.0 : t < 0.0395 ? 484.0 : t < 0.0595 ? 490.0 : 498.0 + swing;
    });

    EXPECT_NEAR(m.fluctuation_rpm, 4.0, 1e-9);
    EXPECT_NEAR(m.fluctuation_rate_percent, 100.0 * 8.0 / 996.0, 1e-9);
    EXPECT_NEAR(m.offset_rpm, -2.0, 1e-9);
    EXPECT_NEAR(m.decrease_rpm, 70.0, 1e-9);
    EXPECT_NEAR(m.overshoot_percent, 0.4, 1e-9);
    EXPECT_NEAR(m.within_5_percent_s.value_or(-1.0), 0.02, 1e-9);
    EXPECT_NEAR(m.within_2_percent_s.value_or(-1.0), 0.04, 1e-9);
    EXPECT_NEAR(m.within_1_percent_s.value_or(-1.0), 0.06, 1e-9);
}

TEST(Metrics, TailOfItsOwnLength)
{
    const sdre::Metrics m =
        of_rpm([](double t) { return t < 0.1495 ? 0.0 : 500.0; }); // rows 150 .. 199

    EXPECT_EQ(m.ripple_e_radps, 0.0);
    EXPECT_NEAR(m.offset_rpm, 0.0, 1e-9);
}

/// The edge of the band belongs to it: a speed that only touches it has reached it, from either side.
TEST(Metrics, TouchingTheBandIsReachingIt)
{
    for (const double sign : {1.0, -1.0}) {
        const auto m = only(
            trace_of(
                100, [&](double t) { return sign * (std::abs(t - 0.05) < 1e-6 ? 98.0 : 90.0); },
                sign * 100.0),
            2.0);
        EXPECT_NEAR(m.dip_e_radps, 10.0, 1e-12); // fallen back
        EXPECT_EQ(m.overshoot_e_radps, 0.0);
        EXPECT_NEAR(m.steady_state_error_e_radps, 10.0, 1e-12); // a size, on either side
    }
}

TEST(Metrics, RatesAboutZeroAreNone)
{
    sdre::Trace trace = trace_of(
        100, [](double) { return 0.0; }, 0.0);
    for (std::size_t k = 0; k < trace.size(); k++) {
        trace[k].omega_e_radps = k % 2 == 0 ? 1.5 : -1.5;
    }
    const sdre::Metrics m = only(trace, 5.0);
    EXPECT_EQ(m.fluctuation_rate_percent, 0.0);
    EXPECT_EQ(m.overshoot_percent, 0.0);
    EXPECT_NEAR(m.ripple_e_radps, 1.5, 1e-12);
}

/// The tail of a window in the middle of a trace: its last ticks, whatever follows and however long it is.
TEST(Metrics, TailsAreTheLastTicksOfTheirOwnWindow)
{
    const auto trace = trace_of(
        400, [](double) { return 0.0; }, 0.0);
    for (int ticks = 1; ticks <= 90; ticks += 7) {
        sdre::Scenario s = scenario_with({event("a", 0.0, 1.0), event("b", 0.1, 1.0)});
        for (sdre::Measure &m : s.measures) {
            m.tail_s = ticks * ts_s;
        }
        const auto windows = sdre::windows_of(s, trace);
        ASSERT_EQ(windows.size(), 2U);
        EXPECT_EQ(windows[0].end - windows[0].begin, 100);
        EXPECT_EQ(windows[1].end - windows[1].begin, 300);
        for (const sdre::Window &w : windows) {
            EXPECT_EQ(w.end - w.tail, ticks);
        }
        s.measures[0].tail_s = s.measures[1].tail_s = std::nullopt;
        const auto fifths                           = sdre::windows_of(s, trace);
        EXPECT_EQ(fifths[0].end - fifths[0].tail, 20);
        EXPECT_EQ(fifths[1].end - fifths[1].tail, 60);
    }
    sdre::Scenario longer     = scenario_with({event("a", 0.0, 1.0)});
    longer.measures[0].tail_s = 5.0; // the whole window
    EXPECT_EQ(sdre::windows_of(longer, trace)[0].tail, trace.begin());
}

/// Position in counts of 2 n_p pi / (4 lines): errors by hand, and the last entry into two counts.
TEST(Metrics, PositionIsMeasuredInCounts)
{
    for (const int lines : {500, 2500}) {
        const double   count_e   = 2.0 * std::acos(-1.0) * 3 / (4.0 * lines);
        sdre::Scenario s         = scenario_with({event("m", 0.0, 1.0)});
        s.drive.motor.pole_pairs = 3;
        s.drive.encoder.lines    = lines;
        s.position_reference     = {{0.0, 1.0}};
        sdre::Trace trace        = trace_of(
                   100, [](double) { return 0.0; }, 0.0);
        const double target_e = 2.0 * std::acos(-1.0) * 3; // a turn of the shaft
        for (std::size_t k = 0; k < trace.size(); k++) {
            const double off_cnt    = k < 10   ? -7.0
                                      : k < 50 ? 2.01
                                      : k < 70 ? 1.99
                                      : k < 90 ? -1.5
                                               : 0.5;
            trace[k].position_e_rad = target_e + off_cnt * count_e;
            // A reference that passes the target and comes to rest elsewhere.
            trace[k].position_ref_e_rad = trace[k].position_e_rad - (k == 60 ? 9.0 : 4.0) * count_e;
        }
        const sdre::Metrics m = sdre::measure(s, trace).at(0);
        EXPECT_NEAR(m.position_off_cnt.value_or(-1.0), 9.0, 1e-7);
        EXPECT_NEAR(m.position_steady_cnt.value_or(-1.0), 1.5, 1e-7); // of the last fifth
        EXPECT_NEAR(m.position_settled_s.value_or(-1.0), 50 * ts_s, 1e-12);
        EXPECT_NEAR(m.position_overshoot_cnt.value_or(-1.0), 2.01, 1e-7);
        trace[0].position_e_rad = target_e + 20.0 * count_e; // from the other side
        EXPECT_NEAR(sdre::measure(s, trace).at(0).position_overshoot_cnt.value_or(-1.0), 7.0, 1e-7);
        trace[0].position_e_rad = target_e; // no motion
        EXPECT_FALSE(sdre::measure(s, trace).at(0).position_overshoot_cnt);

        s.position_reference = {{0.05, 1.0}}; // begins later: a run at a speed until then
        EXPECT_FALSE(sdre::measure(s, trace).at(0).position_off_cnt);
        s.position_reference = {};
        EXPECT_FALSE(sdre::measure(s, trace).at(0).position_settled_s);
    }
}

TEST(Results, PublishedValuesStandBesideTheirOwnMeasure)
{
    // The first measure falls between two ticks and has no row: the second keeps its own figures.
    sdre::Scenario scenario =
        scenario_with({event("first", 0.0101, 1.0), event("second", 0.0105, 1.0)});
    scenario.measures[0].paper = {{"id_A", -77.0}};
    scenario.measures[1].paper = {{"id_A", -55.0}};
    sdre::SimulationResult result;
    result.trace = trace_of(
        50, [](double) { return 0.0; }, 0.0);

    const std::string text =
        sdre::result_text(scenario, result, sdre::measure(scenario, result.trace));

    EXPECT_NE(text.find("-55.000"), std::string::npos) << text;
}
