// SPDX-License-Identifier: MIT
#include "sil/eval/spectrum.hpp"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

namespace {

constexpr double ts_s  = 1e-4;
const double     pi    = std::acos(-1.0);
const double     radps = pi / 30.0 * 4; // electrical, per r/min with four pole pairs

/// 0.2 s about 500 r/min; the last 90 ms are the measure's tail.
struct Case {
    sdre::Scenario scenario;
    sdre::Trace    trace;

    explicit Case(double (*swing_rpm)(double))
    {
        sdre::Measure m;
        m.name                          = "m";
        m.tail_s                        = 0.09;
        scenario.measures               = {m};
        scenario.drive.motor.pole_pairs = 4;
        for (int k = 0; k < 2000; k++) {
            sdre::TraceRow row;
            row.time_s            = k * ts_s;
            row.omega_ref_e_radps = 500.0 * radps;
            row.omega_e_radps     = (500.0 + swing_rpm(row.time_s)) * radps;
            trace.push_back(row);
        }
    }

    std::vector<sdre::SpectrumLine> lines() const
    {
        return sdre::speed_spectrum(sdre::windows_of(scenario, trace).at(0), 4);
    }
};

} // namespace

TEST(Spectrum, WholePeriodsAreOneLineEach)
{
    const Case c([](double t) {
        return 3.0 + 2.0 * std::sin(2.0 * pi * 100.0 / 3.0 * t) +
               0.5 * std::cos(2.0 * pi * 200.0 * t + 1.0);
    });

    const auto lines = c.lines();

    ASSERT_EQ(lines.size(), 450U);
    for (const sdre::SpectrumLine &line : lines) {
        const double expected = std::abs(line.frequency_Hz - 100.0 / 3.0) < 1.0 ? 2.0
                                : std::abs(line.frequency_Hz - 200.0) < 1.0     ? 0.5
                                                                                : 0.0;
        EXPECT_NEAR(line.amplitude_rpm, expected, 1e-6) << line.frequency_Hz;
    }
    EXPECT_NEAR(lines.front().frequency_Hz, 1.0 / 0.09, 1e-6);
    EXPECT_NEAR(lines.back().frequency_Hz, 5000.0, 1e-6);
}

TEST(Spectrum, HalfTheSamplingRateIsCountedOnce)
{
    const Case c([](double t) { return std::lround(t / ts_s) % 2 == 0 ? 1.5 : -1.5; });

    const auto lines = c.lines();

    EXPECT_NEAR(lines.back().frequency_Hz, 5000.0, 1e-6);
    EXPECT_NEAR(lines.back().amplitude_rpm, 1.5, 1e-9);
    EXPECT_NEAR(lines.front().amplitude_rpm, 0.0, 1e-9);
}

TEST(Spectrum, OddNumberOfRowsIsTheSameSum)
{
    Case c([](double t) { return 3.0 * std::sin(2.0 * pi * 77.0 * t) + 100.0 * t; });
    c.scenario.measures[0].tail_s = 0.0103; // 103 rows, a prime

    const auto lines  = c.lines();
    const auto window = sdre::windows_of(c.scenario, c.trace).at(0);

    ASSERT_EQ(window.end - window.tail, 103);
    ASSERT_EQ(lines.size(), 51U);
    double mean = 0.0;
    for (auto row = window.tail; row != window.end; ++row) {
        mean += (500.0 - row->omega_e_radps / radps) / 103.0;
    }
    for (std::size_t m = 1; m <= 51; m++) { // EQ-SPECTRUM-1, term by term
        std::complex<double> sum;
        for (int k = 0; k < 103; k++) {
            const double e = 500.0 - (window.tail + k)->omega_e_radps / radps - mean;
            sum += e * std::polar(1.0, -2.0 * pi * static_cast<double>(m) * k / 103.0);
        }
        EXPECT_NEAR(lines[m - 1].amplitude_rpm, 2.0 / 103.0 * std::abs(sum), 1e-9) << m;
    }
}

TEST(Spectrum, ConstantErrorHasNoLines)
{
    for (const sdre::SpectrumLine &line : Case([](double) { return 12.0; }).lines()) {
        EXPECT_NEAR(line.amplitude_rpm, 0.0, 1e-9);
    }
}

TEST(Spectrum, CsvNamesTheMeasure)
{
    const Case        c([](double) { return 0.0; });
    const std::string csv = sdre::spectrum_csv(c.scenario, c.trace);

    EXPECT_EQ(csv.rfind("measure,frequency_Hz,amplitude_rpm\nm,11.1111,", 0), 0U);
}

TEST(Spectrum, OneRowHasNone)
{
    Case c([](double) { return 0.0; });
    c.trace.resize(1);

    EXPECT_TRUE(c.lines().empty());
}
