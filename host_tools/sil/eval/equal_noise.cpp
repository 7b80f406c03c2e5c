// SPDX-License-Identifier: MIT
#include "sil/eval/equal_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/law_design.hpp"
#include "sil/eval/seeds.hpp"

namespace sdre {
namespace {

// Chosen: the observer's bandwidth goes with a root of its weights; 1.6^30 is beyond any use.
constexpr double first_step    = 1.6;
constexpr int    steps_most    = 30;
constexpr int    halvings_most = 12;

bool near(double noise, double wanted)
{
    return std::abs(noise - wanted) <= noise_tolerance * wanted;
}

std::optional<double> noise_at(const Scenario &scenario, double factor, int seeds)
{
    Scenario s = scenario;
    s.drive    = with_bandwidth(scenario.drive, factor);
    return noise_V(s, seeds);
}

} // namespace

Drive with_bandwidth(const Drive &drive, double factor)
{
    const std::optional<NoiseKnob> &knob = law_design(drive).noise_knob;
    if (!knob) {
        throw InputError(
            fmt::format("--equal-noise: {}: law \"{}\" has no bandwidth to turn: must be {}",
                        drive.name, law_name(drive.law), noise_knob_laws()));
    }
    Drive d = drive;
    knob->turn(d, factor);
    return d;
}

std::string knob_text(const Drive &d)
{
    return law_design(d).noise_knob->text(d);
}

std::optional<double> noise_V(const Scenario &scenario, int seeds)
{
    try {
        const SeedRuns runs = run_seeds(scenario, seeds);
        if (runs.faults > 0 || !runs.first.uncertified.empty() || runs.measures.empty()) {
            return std::nullopt;
        }
        for (const SeedSpread &spread : runs.measures.back().spread) {
            if (spread.metric == "vq_noise_V") {
                return spread.mean;
            }
        }
    } catch (const DesignError &) {
        return std::nullopt; // no gains so far out
    }
    return std::nullopt;
}

NoiseMatch match_noise(const Scenario &scenario, double wanted_V, int seeds)
{
    const std::optional<double> start = noise_at(scenario, 1.0, seeds);
    if (!start) {
        throw InputError(fmt::format("--equal-noise: {} on {}: faults, is not certified or has no "
                                     "measure as its drive file is",
                                     scenario.drive.name, scenario.name));
    }
    NoiseMatch   best{1.0, *start, near(*start, wanted_V)};
    const double step = *start > wanted_V ? 1.0 / first_step : first_step;
    double       from = 1.0;                 // on the near side of the goal
    double       to   = 1.0;                 // on the far side, or of no use
    const auto   take = [&](double factor) { // whether it is still on the near side
        const std::optional<double> noise = noise_at(scenario, factor, seeds);
        if (noise && std::abs(*noise - wanted_V) < std::abs(best.noise_V - wanted_V)) {
              best = {factor, *noise, near(*noise, wanted_V)};
        }
        return noise && (*noise > wanted_V) == (step < 1.0);
    };
    for (int i = 0; i < steps_most && !best.reached; i++) {
        to = from * step;
        if (!take(to)) {
            break;
        }
        from = to;
    }
    for (int i = 0; i < halvings_most && !best.reached && from != to; i++) {
        const double middle        = std::sqrt(from * to);
        (take(middle) ? from : to) = middle;
    }
    return best;
}

} // namespace sdre
