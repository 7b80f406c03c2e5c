// SPDX-License-Identifier: MIT
/// Minimum of a function that has kinks and steps.
#pragma once

#include <functional>
#include <vector>

#include "tune/objective.hpp"

namespace sdre {

/// The best point found from `start`, by NLopt's Subplex: Nelder-Mead in subspaces. It repeats itself exactly when `f` does.
Point minimise(const Point &start, const std::function<double(const Point &)> &f);

/// A settling time jumps where an oscillation leaves its band, and a search ends there too early. It begins again, until it gains
/// less than 2 %.
Point minimise_again(Point start, const std::function<double(const Point &)> &f);

/// minimise() with short steps and few of them, for a point that is nearly good.
Point improve(const Point &start, const std::function<double(const Point &)> &f);

/// The best point of any number of coordinates, in decades: as many evaluations at most as minimise().
std::vector<double> minimise_decades(const std::vector<double> &start, double last_step,
                                     const std::function<double(const std::vector<double> &)> &f);

} // namespace sdre
