// SPDX-License-Identifier: MIT
/// Tells whether a machine is one of those that its drive file allows.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sil/verify/estimate.hpp"
#include "sil/verify/features.hpp"

namespace sdre {

/// How many rehearsals. The defaults are chosen: 0.75 % of such machines then exceed the widening on average. More than 2 %
/// do in one set of rehearsals of 70.
struct RehearsalCounts {
    int of_estimator = 300; ///< machines up to twice the uncertainties away
    int of_range     = 200; ///< machines within them, here and below
    int of_widening  = 400;
};

/// Figures of a run: the estimated differences, and last the misfit.
constexpr std::size_t figure_count = believed_count + 1;
using Figures                      = std::array<double, figure_count>;

struct Judgement {
    std::optional<std::string> fault; ///< the drive tripped; there are no figures then
    Figures                    figures{};
    Figures                    lo{}; ///< of machines as the drive file says
    Figures                    hi{};
    double      farthest = 0.0; ///< distance from the middle, largest, in half widths
    std::size_t cause    = 0;   ///< the figure that has it

    bool within() const
    {
        return !fault && farthest <= 1.0;
    }
};

class Expectation {
public:
    /// Rehearses, on all cores. DesignError when the drive trips in more than one in a hundred.
    Expectation(const Drive &drive, const Programme &programme, const RehearsalCounts &counts = {});

    Judgement judge(const Records &records) const; // EQ-VERIFY-5

private:
    Figures figures_of(const Eigen::VectorXd &features) const;
    double  distance(std::size_t figure, const Figures &figures) const;

    Drive                    drive_;
    Programme                programme_;
    std::optional<Estimator> estimator_;
    Figures                  middle_{};
    Figures                  half_{};
};

} // namespace sdre
