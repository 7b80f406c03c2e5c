// SPDX-License-Identifier: MIT
#include "design/loop_check.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include "design/law_design.hpp"
#include "linalg/eigenvalues.hpp"
#include "linalg/transfer_function.hpp"

namespace sdre {
namespace {

const double pi = std::acos(-1.0);

// Chosen: neighbouring points of the sweep are 1.7 % apart; the peak between them is searched for.
constexpr int    sweep_points   = 500;
constexpr double sweep_from     = 1e-4; // of the sampling rate
constexpr int    peak_halvings  = 60;
constexpr double golden_section = 0.6180339887498949;

constexpr double shaft_mode_share =
    0.9; // chosen: the mode is then as far from 1 as slowest_mode_s is

double sensitivity(const TransferFunction &loop, double frequency_Hz, double ts_s) // EQ-CERT-4
{
    const double s = std::abs(1.0 + loop.at(std::polar(1.0, 2.0 * pi * frequency_Hz * ts_s)));
    return std::isfinite(s) ? s : std::numeric_limits<double>::infinity();
}

struct Peak {
    double value = 0.0;
    double at_Hz = 0.0;
};

/// Ratio of neighbouring frequencies.
double step_of(int points)
{
    return std::pow(0.5 / sweep_from, 1.0 / points);
}

/// The largest |S| of points + 1 frequencies.
Peak sweep(const TransferFunction &loop, double ts_s, int points)
{
    const double rate_Hz = 1.0 / ts_s;
    const double step    = step_of(points);
    Peak         peak;
    for (int i = 0; i <= points; i++) {
        const double f = rate_Hz * sweep_from * std::pow(step, i);
        const double s = sensitivity(loop, f, ts_s);
        if (s > peak.value) {
            peak = {s, f};
        }
    }
    return peak;
}

} // namespace

double spectral_radius(const BrokenLoop &loop)
{
    if (!(loop.shaft_mode > 0.0) || !loop.A.allFinite()) {
        return spectral_radius(loop.A);
    }
    const Eigen::VectorXcd all = eigenvalues(loop.A);
    Eigen::Index           own = 0;
    (all.array() - loop.shaft_mode).abs().minCoeff(&own);
    const bool left_out =
        std::abs(all(own) - loop.shaft_mode) <= shaft_mode_share * (1.0 - loop.shaft_mode);
    double most = 0.0;
    for (Eigen::Index i = 0; i < all.size(); i++) {
        most = std::max(most, left_out && i == own ? 0.0 : std::abs(all(i)));
    }
    return most;
}

double sensitivity(const BrokenLoop &loop, double frequency_Hz)
{
    return sensitivity(TransferFunction(loop.A, loop.B, loop.c), frequency_Hz, loop.ts_s);
}

double rough_peak(const BrokenLoop &loop)
{
    constexpr int          points = 40; // chosen: 24 % apart
    const TransferFunction transfer(loop.A, loop.B, loop.c);
    return sweep(transfer, loop.ts_s, points).value;
}

LoopCheck check_loop(const BrokenLoop &loop, std::vector<SensitivityAt> disturbances)
{
    const double rate_Hz = 1.0 / loop.ts_s;
    const double step    = step_of(sweep_points);
    LoopCheck    out;

    const TransferFunction transfer(loop.A, loop.B, loop.c);
    const auto             at_Hz = [&](double f) { return sensitivity(transfer, f, loop.ts_s); };
    out.spectral_radius          = spectral_radius(loop);
    const Peak found             = sweep(transfer, loop.ts_s, sweep_points);
    out.peak                     = found.value;
    out.peak_Hz                  = found.at_Hz;
    double lo                    = out.peak_Hz / step;
    double hi                    = std::min(out.peak_Hz * step, 0.5 * rate_Hz);
    for (int i = 0; i < peak_halvings; i++) {
        const double left  = hi - golden_section * (hi - lo);
        const double right = lo + golden_section * (hi - lo);
        const bool   lower = at_Hz(left) > at_Hz(right);
        lo                 = lower ? lo : left;
        hi                 = lower ? right : hi;
    }
    out.peak_Hz = 0.5 * (lo + hi);
    out.peak    = std::max(out.peak, at_Hz(out.peak_Hz));
    out.at      = std::move(disturbances);
    for (SensitivityAt &x : out.at) {
        x.value = at_Hz(x.frequency_Hz);
    }
    return out;
}

std::vector<SensitivityAt> disturbance_frequencies(const Drive &drive)
{
    const int                  np      = drive.motor.pole_pairs;
    const auto                 of_law  = law_design(drive).design_speed_e_radps;
    const double               design  = of_law != nullptr ? of_law(drive) : 0.0;
    const double               speed   = design > 0.0 ? design : drive.motor.rated_speed_e_radps;
    const double               turn_Hz = speed / np / (2.0 * pi);
    std::vector<SensitivityAt> out{{"current sensor offset", np * turn_Hz, 0.0},
                                   {"current sensor gain", 2 * np * turn_Hz, 0.0},
                                   {"dead time", 6 * np * turn_Hz, 0.0}};
    std::vector<double>        per_turn = drive.dobc.harmonics_per_turn;
    for (const double multiple : drive.harmonics.cogging) {
        per_turn.push_back(multiple * drive.motor.slots);
    }
    for (const double order : per_turn) {
        if (std::abs(order - 6.0 * np) < 1e-9) {
            continue; // the dead time's
        }
        out.push_back({fmt::format("harmonic {:g}", order), order * turn_Hz, 0.0});
    }
    const double limit_Hz = 0.5 / control_period_s(drive);
    out.erase(std::remove_if(out.begin(), out.end(),
                             [&](const SensitivityAt &x) { return x.frequency_Hz >= limit_Hz; }),
              out.end());
    return out;
}

} // namespace sdre
