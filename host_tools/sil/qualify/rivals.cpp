// SPDX-License-Identifier: MIT
#include "sil/qualify/rivals.hpp"

#include <algorithm>
#include <cmath>

#include "design/law_design.hpp"
#include "tune/search.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

// Chosen: settling times are whole periods, so finer steps tell nothing.
constexpr double last_step   = 0.01; // decades
constexpr double noise_slope = 3.0;  // a limit: beyond it nothing else counts, as in `tune`
constexpr double no_design   = 1e3;  // worse than any that is certified
constexpr double never       = 1e2;  // times the goal: does not settle
constexpr double every       = 0.1;  // share of the other ratios, so that none idles

using Tuning = std::vector<RivalKey>;

double value_at(const RivalKey &key, double decades, double ts_s)
{
    return written(key.least +
                   key.start * std::pow(10.0, decades) * (key.is_rate ? 1.0 / ts_s : 1.0));
}

Drive rival_at(const Drive &drive, const RivalLaw &law, const Tuning &tuning,
               const std::vector<double> &decades)
{
    Drive d   = drive;
    d.cascade = {};
    law.use(d);
    for (std::size_t i = 0; i < tuning.size(); i++) {
        d.cascade.*tuning[i].value = value_at(tuning[i], decades[i], control_period_s(drive));
    }
    return d;
}

double value_of(const TrialResult &r, const TrialResult &own, double settling_s)
{
    double       noise   = r.voltage_noise_V / own.voltage_noise_V;
    const double settled = r.settling_time_s ? *r.settling_time_s / settling_s : never;
    const double dip     = r.dip_e_radps / own.dip_e_radps;
    const double others  = every * (noise + settled + dip) / 3.0;
    noise                = noise > 1.0 ? noise_slope * noise * noise * noise * noise : 0.0;
    return std::max({settled, dip, noise}) + others + (r.faults > 0 ? never : 0.0);
}

struct Found {
    Rival  rival;
    double value = no_design;
};

/// The comparison that all searches have.
struct Contest {
    const Trial       &load_step;
    const TrialResult &own;
    int                seeds;
    const RunTrial    &run;
};

Found search(const Contest &contest, const RivalLaw &law, const Tuning &tuning)
{
    const TrialResult &own    = contest.own;
    const double       goal_s = own.settling_time_s.value_or(contest.load_step.most_settling_s);
    Trial              trial  = contest.load_step;
    Found              found;
    const auto result = [&](const std::vector<double> &decades) -> std::optional<TrialResult> {
        trial.scenario.drive = rival_at(contest.load_step.scenario.drive, law, tuning, decades);
        found.rival.evaluations++;
        return is_certified(trial.scenario.drive) ? std::optional(contest.run(trial, contest.seeds))
                                                  : std::nullopt;
    };
    const auto value = [&](const std::optional<TrialResult> &r) {
        return r ? value_of(*r, own, goal_s) : no_design;
    };
    const std::optional<TrialResult> r = result(minimise_decades(
        std::vector<double>(tuning.size()), last_step,
        [&](const std::vector<double> &decades) { return value(result(decades)); }));

    found.rival.law = &law;
    for (const RivalKey &key : tuning) {
        found.rival.settings.emplace_back(key.key, trial.scenario.drive.cascade.*key.value);
    }
    if (r && r->settling_time_s && r->reasons.empty() &&
        r->voltage_noise_V <= same_within * own.voltage_noise_V) {
        found.rival.load_step = r;
        found.value           = value(r);
    }
    return found;
}

/// The best of the law's tunings, with the evaluations of all.
Rival best_rival(const Contest &contest, const RivalLaw &law)
{
    Found best;
    int   evaluations = 0;
    for (const Tuning &tuning : law.tunings) {
        const Found found = search(contest, law, tuning);
        evaluations += found.rival.evaluations;
        if (best.rival.law == nullptr || found.value < best.value) {
            best = found;
        }
    }
    best.rival.evaluations = evaluations;
    return best.rival;
}

} // namespace

std::vector<Rival> best_rivals(const Trial &load_step, const TrialResult &own, int seeds,
                               const RunTrial &run)
{
    std::vector<Rival> rivals;
    for (const RivalLaw *law : rival_laws()) {
        rivals.push_back(best_rival({load_step, own, seeds, run}, *law));
    }
    return rivals;
}

} // namespace sdre
