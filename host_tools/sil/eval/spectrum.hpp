// SPDX-License-Identifier: MIT
/// Amplitude spectrum of the speed error, as in paper B's Fig. 6.
///
///     a(f) = 2/n |sum_k (e_k - mean e) exp(-2 pi i f k Ts)|,  f = m / (n Ts)              EQ-SPECTRUM-1
///
/// e is the error of the mechanical speed over the n rows of a measure's tail; rectangular window.
/// An oscillation with a whole number of periods in the tail is one line of its own amplitude. A
/// line at half the sampling rate has no mirror image; its factor is 1/n.
#pragma once

#include <string>
#include <vector>

#include "sil/eval/metrics.hpp"

namespace sdre {

struct SpectrumLine {
    double frequency_Hz  = 0.0;
    double amplitude_rpm = 0.0;
};

/// Lines above zero up to half the sampling rate; none of a tail that is shorter than two rows.
std::vector<SpectrumLine> speed_spectrum(const Window &window, int pole_pairs);

/// All measures below each other: measure, frequency, amplitude.
std::string spectrum_csv(const Scenario &scenario, const Trace &trace);

} // namespace sdre
