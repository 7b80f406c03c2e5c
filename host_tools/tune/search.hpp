// SPDX-License-Identifier: MIT
/// Minimum of a function that has kinks and steps.
#pragma once

#include <functional>

#include "tune/objective.hpp"

namespace sdre {

/// The best point found from `start`, by NLopt's Subplex: Nelder-Mead in subspaces. It repeats itself exactly when `f` does.
Point minimise(const Point &start, const std::function<double(const Point &)> &f);

/// The same with short steps and few of them, for a point that is nearly good.
Point improve(const Point &start, const std::function<double(const Point &)> &f);

} // namespace sdre
