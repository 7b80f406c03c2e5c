// SPDX-License-Identifier: MIT
#include "sil/eval/spectrum.hpp"

#include <cmath>
#include <complex>

#include <fmt/format.h>
#include <unsupported/Eigen/FFT>

namespace sdre {
namespace {

const double pi = std::acos(-1.0);

/// The mechanical speed error without its mean, in r/min.
std::vector<double> swing_rpm(const Window &window, int pole_pairs)
{
    std::vector<double> e;
    double              sum = 0.0;
    for (auto row = window.tail; row != window.end; ++row) {
        e.push_back((row->omega_ref_e_radps - row->omega_e_radps) * 30.0 / pi / pole_pairs);
        sum += e.back();
    }
    for (double &x : e) {
        x -= sum / static_cast<double>(e.size());
    }
    return e;
}

} // namespace

std::vector<SpectrumLine> speed_spectrum(const Window &window, int pole_pairs)
{
    const std::vector<double> e = swing_rpm(window, pole_pairs);
    const std::size_t         n = e.size();
    std::vector<SpectrumLine> lines;
    if (n < 2) {
        return lines;
    }
    const double                      ts_s = (window.tail + 1)->time_s - window.tail->time_s;
    const auto                        rows = static_cast<double>(n);
    Eigen::FFT<double>                transform;
    std::vector<std::complex<double>> sums;
    transform.fwd(sums, e);
    for (std::size_t m = 1; m <= n / 2; m++) { // EQ-SPECTRUM-1
        const double sides = 2 * m == n ? 1.0 : 2.0;
        lines.push_back({static_cast<double>(m) / (rows * ts_s), sides / rows * std::abs(sums[m])});
    }
    return lines;
}

std::string spectrum_csv(const Scenario &scenario, const Trace &trace)
{
    std::string s = "measure,frequency_Hz,amplitude_rpm\n";
    for (const Window &window : windows_of(scenario, trace)) {
        for (const SpectrumLine &line : speed_spectrum(window, scenario.drive.motor.pole_pairs)) {
            s += fmt::format("{},{:.6g},{:.6g}\n", window.measure.name, line.frequency_Hz,
                             line.amplitude_rpm);
        }
    }
    return s;
}

} // namespace sdre
