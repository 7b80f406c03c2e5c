// SPDX-License-Identifier: MIT
// Surroundings that a test sets by hand and looks at.
#pragma once

#include <array>
#include <cstdlib>

#include "sil/f28335/surroundings.hpp"

class PlainSurroundings : public sdre::f28335::Surroundings {
public:
    void period_begins(const sdre::f28335::ControlPeriod &now) override
    {
        period = now;
        periods++;
        count += counts_per_period;
    }
    void legs_change(const std::array<bool, 3> &enabled, double into_period_s) override
    {
        legs           = enabled;
        legs_changed_s = into_period_s;
    }
    double analog_V(int side, int number) override
    {
        return input_V.at(static_cast<std::size_t>(side)).at(static_cast<std::size_t>(number));
    }
    sdre::f28335::ShaftCount shaft(double) override
    {
        sdre::f28335::ShaftCount now;
        now.count       = count;
        now.index       = count / turn != seen_count / turn;
        now.index_count = count / turn * turn;
        now.phase_error = phase_error;
        for (std::int64_t n = std::abs(count - seen_count); n > 0; n--) { // the last one first
            now.edges.insert(now.edges.begin(),
                             {edge_age_s + 1e-6 * static_cast<double>(now.edges.size()),
                              count > seen_count ? 1 : -1});
        }
        if (turns_back && now.edges.size() > 2) { // two edges more, forth and back
            turns_back = false;
            now.edges.insert(now.edges.end() - 1,
                             {1.5e-6 + edge_age_s, now.edges.back().direction});
            now.edges.insert(now.edges.end() - 1,
                             {1.2e-6 + edge_age_s, -now.edges.back().direction});
        }
        seen_count  = count;
        phase_error = false;
        return now;
    }

    static constexpr std::int64_t        turn = 10000;
    sdre::f28335::ControlPeriod          period;
    int                                  periods = 0;
    std::array<bool, 3>                  legs{};
    double                               legs_changed_s = 0.0;
    std::array<std::array<double, 8>, 2> input_V{};
    std::int64_t                         count             = 0;
    std::int64_t                         counts_per_period = 0;
    std::int64_t                         seen_count        = 0;
    bool                                 phase_error       = false;
    bool                                 turns_back        = false; ///< once, in the next period
    double                               edge_age_s        = 1e-6;  ///< of the last edge
};
