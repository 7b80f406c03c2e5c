// SPDX-License-Identifier: MIT
#include "tune/auto_tune.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "tune/goals.hpp"
#include "tune/search.hpp"
#include "tune/start_weights.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

// Chosen: the best pace of these, relative to that of the sensors, is within a fifth of the best there is.
constexpr std::array paces{0.6, 0.8, 1.0, 1.3, 1.7, 2.2, 3.0};
// Chosen: with rare edges the search often ends beside the best weights. The best of these starts, relative to the best pace.
constexpr std::array rare_edges_starts{1.0, 0.85, 0.7, 0.5};
// Chosen: with rare edges the search may leave through a valley without feedback, where large steps end in a limit cycle.
constexpr double least_decades = 1.5;
// Chosen: number of searches from slower starts, while the weights are not certified.
constexpr int    attempts     = 4;
constexpr double slower       = 1.4;
constexpr int    report_every = 100; // evaluations

/// The start weights with the searched ones changed by decades.
Drive moved(const Drive &start, const Point &decades)
{
    Drive       d = start;
    std::size_t i = 0;
    for (const SearchedWeight &w : searched_weights(d)) {
        for (double *weight : w.values) {
            *weight = written(std::pow(10.0, decades[i]) * *weight);
        }
        i++;
    }
    return d;
}

Point no_change(Drive start)
{
    return Point(searched_weights(start).size(), 0.0);
}

/// 1, or more where hardly any weight is left on the speed or the q current.
double without_feedback(const Point &decades)
{
    return 1.0 + std::max(-least_decades - decades[0], 0.0) +
           std::max(-least_decades - decades[1], 0.0);
}

/// Whether the whole certificate passes; if not, why.
bool passes(const Drive &d, std::string &refused)
{
    const Certificate certificate = design_drive(d).certificate;
    refused                       = fmt::format("{}", fmt::join(certificate.failures, "; "));
    return certificate.passed();
}

class Search {
public:
    Search(const Drive &drive, const TuneSpec &goals, const TuneProgress &progress)
        : drive_(drive), goals_(goals), progress_(progress)
    {
    }

    double best_pace()
    {
        const double sensors = pace_of_sensors(drive_);
        double       best    = sensors;
        double       least   = 1e300;
        for (const double pace : paces) {
            const double value = evaluate(start_weights(drive_, pace * sensors));
            if (value < least) {
                least = value;
                best  = pace * sensors;
            }
        }
        return best;
    }
    Drive from(const Drive &start)
    {
        const auto value = [&](const Point &x) {
            return evaluate(moved(start, x)) * (goals_.rare_edges ? without_feedback(x) : 1.0);
        };
        const Point none = no_change(start);
        return moved(start,
                     has_own_plant(drive_) ? minimise_again(none, value) : minimise(none, value));
    }
    /// The best certified weights of several starts, if there are any.
    std::optional<Drive> best_certified(const std::vector<Drive> &starts, std::string &refused)
    {
        std::optional<Drive> best;
        double               least = unstable_score;
        for (const Drive &start : starts) {
            const Drive  found = from(start);
            const double worst = score(found, goals_).worst;
            if (worst < least && passes(found, refused)) {
                best  = found;
                least = worst;
            }
        }
        return best;
    }
    /// Weights near these that the verdict holds for, if there are any.
    Drive certifiable(const Drive &found)
    {
        return moved(found, improve(no_change(found), [&](const Point &x) {
                         const Drive d = moved(found, x);
                         return evaluate(d) + verdict_penalty(d);
                     }));
    }
    int evaluations() const
    {
        return evaluations_;
    }

private:
    double evaluate(const Drive &d)
    {
        const Score s = score(d, goals_);
        best_         = std::min(best_, s.worst);
        if (++evaluations_ % report_every == 0) {
            progress_(evaluations_, best_);
        }
        return s.value;
    }

    const Drive        &drive_;
    const TuneSpec     &goals_;
    const TuneProgress &progress_;
    double              best_        = 1e300;
    int                 evaluations_ = 0;
};

const char *what_relaxes(const std::string &goal)
{
    if (goal == "noise of v_q") {
        return "a finer encoder, current sensors with less noise or range";
    }
    if (goal == "voltage") {
        return "a higher dc link";
    }
    if (goal == "ripple") {
        return "a finer encoder";
    }
    return "a higher PWM frequency, two updates a period, finer sensors";
}

std::string binding_goal(const Score &s, const TuneSpec &goals)
{
    std::string name;
    std::size_t at    = 0;
    double      worst = 0.0;
    for (std::size_t i = 0; i < goals.cases.size(); i++) {
        for (const GoalRatio &g : goal_ratios(s.cases[i], goals.cases[i], goals)) {
            if (g.ratio > worst) {
                worst = g.ratio;
                name  = g.name;
                at    = i;
            }
        }
    }
    const double noise = s.cases[0].voltage_noise_V / goals.voltage_noise_V;
    const char  *whose = at == 0                            ? ""
                         : goals.cases[at].resonance == 1.0 ? " of a motor that is not as believed"
                                                            : " with another resonance";
    return fmt::format(
        "{}{} is {:.2f} times its goal from physics; v_q noise at {:.2f} of its limit. What would "
        "improve it: {}",
        name, whose, worst, noise, what_relaxes(noise > 0.9 ? "noise of v_q" : name));
}

} // namespace

AutoTuneResult auto_tune(const Drive &drive, const TuneProgress &progress)
{
    AutoTuneResult r;
    r.goals            = goals_from_physics(drive);
    r.goals.rare_edges = periods_per_edge(drive) > 1.0;
    Search             search(drive, r.goals, progress);
    double             pace = search.best_pace();
    std::string        refused;
    std::vector<Drive> candidates;
    const auto         result_of = [&](const Drive &found, const Score &s) {
        r.tuned                = {found, s.cases, s.worst, search.evaluations(), false};
        r.goals.voltage_V      = 1.0 / std::sqrt(found.nosc.T[0]);
        r.goals.d_axis_error_A = 1.0 / std::sqrt(found.nosc.Q[2]);
        r.binding              = binding_goal(s, r.goals);
        return r;
    };
    std::vector<Drive> starts;
    if (has_own_plant(drive)) {
        starts = own_plant_starts(drive);
    } else if (r.goals.rare_edges) {
        for (const double start : rare_edges_starts) {
            starts.push_back(start_weights(drive, start * pace));
        }
    }
    if (!starts.empty()) {
        if (const auto best = search.best_certified(starts, refused)) {
            return result_of(*best, score(*best, r.goals));
        }
    }
    for (int i = 0; i < attempts; i++, pace *= slower) {
        Drive found   = search.from(start_weights(drive, pace));
        found.law     = drive.law;
        const Score s = score(found, r.goals);
        if (!(s.worst < unstable_score)) {
            refused = "no stable design found";
            continue;
        }
        if (passes(found, refused)) {
            return result_of(found, s);
        }
        candidates.push_back(found);
    }
    for (const Drive &candidate : candidates) {
        const Drive found = search.certifiable(candidate);
        if (passes(found, refused)) {
            return result_of(found, score(found, r.goals));
        }
    }
    throw DesignError(fmt::format("nothing certified was found: {}", refused));
}

} // namespace sdre
