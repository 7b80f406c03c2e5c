// SPDX-License-Identifier: MIT
#include "design/series_error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sdre {
namespace {

int degree(const SeriesTerm &term)
{
    return std::accumulate(term.powers.begin(), term.powers.end(), 0);
}

void append_points(Schedule &head, std::size_t variables, double range, int per_side,
                   std::vector<Schedule> &all)
{
    if (head.size() == variables) {
        all.push_back(head);
        return;
    }
    for (int i = -per_side; i <= per_side; i++) {
        head.push_back(range * i / per_side);
        append_points(head, variables, range, per_side, all);
        head.pop_back();
    }
}

} // namespace

GainSeries solve_gain_series(const SdreProblem &problem, const Eigen::MatrixXd &left,
                             const Eigen::MatrixXd &right, int order, Precision precision)
{
    GainSeries out;
    out.problem = problem;
    out.series  = solve_sdre_series(problem, order, precision);
    out.exact   = [=](const Schedule &s) -> Eigen::MatrixXd {
        return left * solve_sdre_exact(problem, s).X * right;
    };
    for (const SeriesTerm &term : out.series.terms) {
        out.gain.emplace_back(left * term.X * right);
        out.residuals.push_back(term.relative_residual);
    }
    return out;
}

int series_order(const GainSeries &g)
{
    return degree(g.series.terms.back()); // sorted by degree
}

Eigen::MatrixXd series_gain(const GainSeries &g, const std::vector<double> &s, int order)
{
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(g.gain[0].rows(), g.gain[0].cols());
    for (std::size_t i = 0; i < g.gain.size() && degree(g.series.terms[i]) <= order; i++) {
        double factor = 1.0;
        for (std::size_t k = 0; k < s.size(); k++) {
            factor *= std::pow(s[k], g.series.terms[i].powers[k]);
        }
        K += factor * g.gain[i];
    }
    return K;
}

std::vector<Schedule> box_grid(std::size_t variables, double range, int per_side)
{
    std::vector<Schedule> all;
    Schedule              head;
    append_points(head, variables, range, per_side, all);
    return all;
}

double reach(const Schedule &s)
{
    double largest = 0.0;
    for (const double x : s) {
        largest = std::max(largest, std::abs(x));
    }
    return largest;
}

std::vector<std::vector<double>> series_errors(const GainSeries            &g,
                                               const std::vector<Schedule> &points)
{
    const int                        orders = series_order(g) + 1;
    std::vector<std::vector<double>> errors(static_cast<std::size_t>(orders),
                                            std::vector<double>(points.size()));
    for (std::size_t i = 0; i < points.size(); i++) {
        const Eigen::MatrixXd exact = g.exact(points[i]);
        const double          norm  = std::max(exact.norm(), 1e-300);
        for (int order = 0; order < orders; order++) {
            errors[static_cast<std::size_t>(order)][i] =
                (series_gain(g, points[i], order) - exact).norm() / norm;
        }
    }
    return errors;
}

} // namespace sdre
