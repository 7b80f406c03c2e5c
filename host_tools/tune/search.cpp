// SPDX-License-Identifier: MIT
#include "tune/search.hpp"

#include <algorithm>
#include <vector>

#include <nlopt.hpp>

#include "common/errors.hpp"

namespace sdre {
namespace {

using Function = std::function<double(const std::vector<double> &)>;

constexpr double first_step = 0.5;  // decades
constexpr double last_step  = 1e-3; // decades: a quarter of a per cent, weights have three digits
constexpr int    most_evaluations = 1500; // chosen: twice what the shipped drives take
constexpr double short_step       = 0.15; // decades
constexpr int few_evaluations = 250; // chosen: each looks at the whole verdict, a tenth of a second

// Chosen: a search that gains less than this is not begun again.
constexpr double restart_gain  = 0.98;
constexpr int    most_restarts = 6;

double call(const std::vector<double> &x, std::vector<double> & /*gradient*/, void *function)
{
    return (*static_cast<const Function *>(function))(x);
}

struct Steps {
    double first;
    double last;
    int    evaluations;
};

std::vector<double> search_from(std::vector<double> x, Function f, const Steps &steps)
{
    nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(x.size()));
    search.set_min_objective(call, &f);
    search.set_initial_step(steps.first);
    search.set_xtol_abs(steps.last);
    search.set_maxeval(steps.evaluations);
    double value = 0.0;
    try {
        search.optimize(x, value);
    } catch (const nlopt::roundoff_limited &) { // x is the best so far
    }
    return x;
}

} // namespace

Point minimise(const Point &start, const std::function<double(const Point &)> &f)
{
    return search_from(start, f, {first_step, last_step, most_evaluations});
}

Point minimise_again(Point x, const std::function<double(const Point &)> &f)
{
    double before = 1e300;
    for (int i = 0; i < most_restarts; i++) {
        x                = minimise(x, f);
        const double now = f(x);
        if (now > restart_gain * before) {
            break;
        }
        before = now;
    }
    return x;
}

Point improve(const Point &start, const std::function<double(const Point &)> &f)
{
    return search_from(start, f, {short_step, last_step, few_evaluations});
}

std::vector<double> minimise_decades(const std::vector<double> &start, double last,
                                     const std::function<double(const std::vector<double> &)> &f)
{
    return search_from(start, f, {short_step, last, most_evaluations});
}

} // namespace sdre
