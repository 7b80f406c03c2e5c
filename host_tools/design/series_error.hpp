// SPDX-License-Identifier: MIT
/// How far a truncated series of gains is from the exact point-wise solution of its SDRE.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "design/sdre_series.hpp"

namespace sdre {

/// Values of the scheduling variables.
using Schedule = std::vector<double>;

/// A solved series with the gain matrices read off it.
struct GainSeries {
    SdreProblem problem;
    SdreSeries  series;
    std::vector<Eigen::MatrixXd>
        gain; ///< per term. NOSC: Lambda, 2 x 3. NODO: L, 6 x 3; encoder form 7 x 3, load only 4 x 3.
    std::vector<double>
        residuals; ///< per term, relative: of the Riccati, then of the Lyapunov or Stein equations
    std::function<Eigen::MatrixXd(const Schedule &)> exact; ///< the gain without a series
    std::optional<double> held_A; ///< gains that solve no equation: the series is used in +-held_A
};

/// Solves the series and reads the gains off it, (26), (32), (39).
GainSeries solve_gain_series(const SdreProblem &problem, const Eigen::MatrixXd &left,
                             const Eigen::MatrixXd &right, int order,
                             Precision precision = Precision::quick);

/// Highest total degree.
int series_order(const GainSeries &g);

/// The gain at s from all terms up to a total degree.
Eigen::MatrixXd series_gain(const GainSeries &g, const std::vector<double> &s, int order);

/// The box +-range of any number of variables, (2 per_side + 1) values of each.
std::vector<Schedule> box_grid(std::size_t variables, double range, int per_side);

/// Largest absolute value.
double reach(const Schedule &s);

/// errors[order][i]: relative gain error (Frobenius norm) of the series of that order at points[i].
std::vector<std::vector<double>> series_errors(const GainSeries            &g,
                                               const std::vector<Schedule> &points);

} // namespace sdre
