// SPDX-License-Identifier: MIT
#include "gains/order_study.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/json.hpp"
#include "design/law_design.hpp"

namespace sdre {
namespace {

// Chosen: both have the quarters of the current limit among their points.
constexpr int line_per_side = 64;
constexpr int box_per_side  = 16;

int terms_up_to(const GainSeries &g, int order)
{
    int count = 0;
    for (const SeriesTerm &term : g.series.terms) {
        int degree = 0;
        for (const int power : term.powers) {
            degree += power;
        }
        count += degree <= order ? 1 : 0;
    }
    return count;
}

LoopOrders orders_of(const std::string &name, const std::string &variable, const GainSeries &g,
                     double range_A)
{
    const std::size_t           variables = g.problem.dA.size();
    const int                   per_side  = variables == 1 ? line_per_side : box_per_side;
    const std::vector<Schedule> points    = box_grid(variables, range_A, per_side);
    const auto                  at        = series_errors(g, points);

    LoopOrders out{name, variable, {}, {}, {}};
    for (int i = 0; i <= per_side; i++) {
        out.within_A.push_back(range_A * i / per_side);
    }
    for (std::size_t order = 0; order < at.size(); order++) {
        out.lyapunov.push_back(terms_up_to(g, static_cast<int>(order)) - 1);
        std::vector<double> worst(out.within_A.size(), 0.0);
        for (std::size_t p = 0; p < points.size(); p++) {
            const auto i =
                static_cast<std::size_t>(std::lround(reach(points[p]) / range_A * per_side));
            worst[i] = std::max(worst[i], at[order][p]);
        }
        for (std::size_t i = 1; i < worst.size(); i++) {
            worst[i] = std::max(worst[i], worst[i - 1]);
        }
        out.errors.push_back(worst);
    }
    return out;
}

std::string listed(const std::vector<const char *> &currents)
{
    return fmt::format("{}", fmt::join(currents, ", "));
}

} // namespace

OrderStudy study_orders(Drive drive, int highest)
{
    const Scheduling &scheduling = law_design(drive).scheduling;
    if (scheduling.controller.empty()) {
        throw InputError(
            fmt::format("{}: law = \"{}\" has no series", drive.name, law_name(drive.law)));
    }
    drive.nosc.order   = highest;
    drive.nodo.order   = highest;
    const Design d     = design_drive(drive);
    const double range = 2.0 * drive.motor.max_current_A;
    return {drive.name,
            drive.motor.max_current_A,
            {orders_of("controller", listed(scheduling.controller), d.nosc, range),
             orders_of("observer", listed(scheduling.observer), d.nodo, range)}};
}

std::string orders_text(const OrderStudy &study)
{
    std::string s =
        fmt::format("{}: largest relative gain error against the exact SDRE\n", study.drive);
    for (const LoopOrders &loop : study.loops) {
        s += fmt::format("\n{:<30}", fmt::format("{}, {} within", loop.name, loop.variable));
        const std::size_t step = (loop.within_A.size() - 1) / 8;
        for (std::size_t i = step; i < loop.within_A.size(); i += step) {
            s += fmt::format("{:>11}", fmt::format("{:.4g} A", loop.within_A[i]));
        }
        s += "\n";
        for (std::size_t order = 0; order < loop.errors.size(); order++) {
            s += fmt::format("  order {}, {:2} Lyapunov equations", order, loop.lyapunov[order]);
            for (std::size_t i = step; i < loop.within_A.size(); i += step) {
                s += fmt::format("{:>11.2e}", loop.errors[order][i]);
            }
            s += "\n";
        }
    }
    return s;
}

std::string orders_csv(const OrderStudy &study)
{
    std::string s = "loop,order,within_A,error\n";
    for (const LoopOrders &loop : study.loops) {
        for (std::size_t order = 0; order < loop.errors.size(); order++) {
            for (std::size_t i = 1; i < loop.within_A.size(); i++) {
                s += fmt::format("{},{},{:.6g},{:.6e}\n", loop.name, order, loop.within_A[i],
                                 loop.errors[order][i]);
            }
        }
    }
    return s;
}

std::string orders_json(const OrderStudy &study)
{
    Json loops;
    for (const LoopOrders &loop : study.loops) {
        loops[loop.name] = {{"variable", loop.variable},
                            {"lyapunov_equations", loop.lyapunov},
                            {"within_A", loop.within_A},
                            {"errors", loop.errors}};
    }
    return Json{{"drive", study.drive}, {"max_current_A", study.max_current_A}, {"loops", loops}}
        .text();
}

} // namespace sdre
