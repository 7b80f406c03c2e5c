// SPDX-License-Identifier: MIT
#include "tune/verdict_penalty.hpp"

#include <algorithm>

#include "common/errors.hpp"
#include "design/design.hpp"
#include "design/sampled_model.hpp"
#include "design/verdict.hpp"

namespace sdre {
namespace {

// Chosen: a verdict that does not hold outweighs every goal, and a hair's breadth of room is kept.
constexpr double excess_weight = 100.0;
constexpr double held          = 0.98;
constexpr double no_design     = 1e3;

double excess_of(const Drive &d)
{
    try {
        const Design design = design_drive(d);
        return design.certificate.loop ? excess(*design.certificate.loop, control_period_s(d))
                                       : no_design;
    } catch (const DesignError &) {
        return no_design;
    }
}

} // namespace

bool is_certified(const Drive &drive)
{
    try {
        return design_drive(drive).certificate.passed();
    } catch (const DesignError &) {
        return false;
    }
}

double verdict_penalty(const Drive &drive)
{
    return excess_weight * std::max(excess_of(drive) - held, 0.0);
}

} // namespace sdre
