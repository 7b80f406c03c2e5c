// SPDX-License-Identifier: MIT
#include "tune/search.hpp"

#include <algorithm>
#include <vector>

#include <nlopt.hpp>

#include "common/errors.hpp"

namespace sdre {
namespace {

using Function = std::function<double(const Point &)>;

constexpr double first_step = 0.5;  // decades
constexpr double last_step  = 1e-3; // decades: a quarter of a per cent, weights have three digits
constexpr int    most_evaluations = 1500; // chosen: twice what the shipped drives take
constexpr double short_step       = 0.15; // decades
constexpr int few_evaluations = 250; // chosen: each looks at the whole verdict, a tenth of a second

Point point_of(const std::vector<double> &x)
{
    Point p{};
    std::copy(x.begin(), x.end(), p.begin());
    return p;
}

double call(const std::vector<double> &x, std::vector<double> & /*gradient*/, void *function)
{
    return (*static_cast<const Function *>(function))(point_of(x));
}

Point search_from(const Point &start, const Function &f, double step, int evaluations)
{
    nlopt::opt search(nlopt::LN_SBPLX, weight_count);
    Function   function = f;
    search.set_min_objective(call, &function);
    search.set_initial_step(step);
    search.set_xtol_abs(last_step);
    search.set_maxeval(evaluations);
    std::vector<double> x(start.begin(), start.end());
    double              value = 0.0;
    try {
        search.optimize(x, value);
    } catch (const nlopt::roundoff_limited &) { // x is the best so far
    }
    return point_of(x);
}

} // namespace

Point minimise(const Point &start, const Function &f)
{
    return search_from(start, f, first_step, most_evaluations);
}

Point improve(const Point &start, const Function &f)
{
    return search_from(start, f, short_step, few_evaluations);
}

} // namespace sdre
