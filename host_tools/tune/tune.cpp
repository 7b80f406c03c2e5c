// SPDX-License-Identifier: MIT
#include "tune/tune.hpp"

#include <algorithm>

#include "common/errors.hpp"
#include "design/law_design.hpp"
#include "tune/position_weights.hpp"
#include "tune/search.hpp"
#include "tune/start_weights.hpp"
#include "tune/verdict_penalty.hpp"

namespace sdre {
namespace {

/// Chosen: in the middle of the region in which the shipped motors are stable.
const Point start{0.3, 0.9, 9.0, 7.0, 2.0, 1.0};
/// Chosen: a slow feedback of the speed with a quick load estimate, stable with most shafts.
const Point slow_start{-1.7, -5.6, 9.5, 5.8, 0.8, 0.2};
/// Chosen: ten times slower.
const Point slower_start{-2.8, -4.4, 10.5, 6.9, 0.0, -0.2};

// Chosen: the error of the linear model is larger (a dip of 5.1 rad/s is 5.5 on the board). A
// smaller gain does not justify new tables.
constexpr double worth_a_change = 0.03;

// Chosen: from further off, certified weights would not meet the goals by far.
constexpr double near_goal = 2.0;

constexpr int report_every = 100; // evaluations

/// Whether these weights could have come from this search: what the specification fixes is the same, and three digits
/// say all of them.
bool is_candidate(const Drive &own, const Drive &found)
{
    const NoscSpec &c       = own.nosc;
    const NodoSpec &o       = own.nodo;
    const auto      is_text = [](double x) { return x == written(x); };
    return c.T == found.nosc.T && c.Q[2] == found.nosc.Q[2] && o.form == found.nodo.form &&
           o.T == found.nodo.T && o.Q[1] == o.Q[2] && o.Q[4] == o.Q[5] && o.Q[6] == 0.0 &&
           std::all_of(c.Q.begin(), c.Q.end(), is_text) &&
           std::all_of(o.Q.begin(), o.Q.end(), is_text) &&
           std::all_of(own.shaft.Q.begin(), own.shaft.Q.end(), is_text) &&
           std::all_of(own.shaft.nodo_Q.begin(), own.shaft.nodo_Q.end(), is_text);
}

using Value     = std::function<double(const Point &)>;
using Certified = std::function<bool(const Point &)>;

/// noc_shaft's are its own and those of goals from physics, and the others' are chosen.
std::vector<Point> shaft_starts(const Drive &drive)
{
    std::vector<Point> starts{start, slow_start, slower_start};
    if (law_design(drive).shaft_states) {
        starts.assign(1, point_of(drive));
        for (const Drive &d : own_plant_starts(drive)) {
            starts.push_back(point_of(d));
        }
    }
    return starts;
}

/// Returns the best of several starts; certified ones come first. `strict` moves uncertified ones until they are certified.
Point best_of(const std::vector<Point> &starts, const Value &value, const Value &strict,
              const Certified &certified)
{
    Point  best{};
    double least = 1e300;
    bool   found = false;
    for (const Point &from : starts) {
        Point x      = minimise_again(from, value);
        bool  passes = certified(x);
        if (!passes) {
            x      = improve(x, strict);
            passes = certified(x);
        }
        const double now = value(x);
        if ((passes && !found) || (passes == found && now < least)) {
            best  = x;
            least = now;
            found = passes;
        }
    }
    return best;
}

} // namespace

TuneResult tune_drive(const Drive &own_drive, const TuneSpec &wanted, const TuneProgress &progress)
{
    const bool elastic = own_drive.mechanics.coupling != Coupling::rigid;
    Drive      drive   = own_drive;
    TuneSpec   spec    = wanted;
    if (elastic) {
        spec.noise_is_a_limit =
            true; // else it rises as far as the settling time with the worst shaft allows
        drive.position.reset(); // its weights follow from the found ones
    }
    TuneResult result;
    double     best  = 1e300;
    const auto value = [&](const Point &x) {
        const Score s = score(with_weights(drive, spec, x), spec);
        best          = std::min(best, s.worst);
        if (++result.evaluations % report_every == 0) {
            progress(result.evaluations, best);
        }
        return s.value;
    };
    const auto passes = [&](const Point &x) { return is_certified(with_weights(drive, spec, x)); };
    const auto strict = [&](const Point &x) {
        return value(x) + verdict_penalty(with_weights(drive, spec, x));
    };
    Point found =
        elastic ? best_of(shaft_starts(drive), value, strict, passes) : minimise(start, value);
    result.drive = with_weights(drive, spec, found);
    if (!elastic && best < near_goal && !is_certified(result.drive)) {
        found        = improve(found, strict);
        result.drive = with_weights(drive, spec, found);
    }
    Score s = score(result.drive, spec);
    if (is_candidate(drive, result.drive)) {
        const Score own = score(drive, spec);
        result.kept     = own.worst <= (1.0 + worth_a_change) * s.worst && is_certified(own_drive);
        if (result.kept) {
            result.drive = own_drive;
            s            = own;
        }
    }
    if (!(s.worst < unstable_score)) {
        throw DesignError("no stable design found for these specifications");
    }
    const bool follows = own_drive.position && !result.kept &&
                         (elastic || (follows_speed(own_drive) && !is_certified(result.drive)));
    if (follows) {
        result.drive          = with_position(result.drive, *own_drive.position);
        result.moved_position = true;
    }
    result.cases       = s.cases;
    result.worst_ratio = s.worst;
    return result;
}

} // namespace sdre
