// SPDX-License-Identifier: MIT
#include "sil/verify/judge.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/parallel.hpp"

namespace sdre {
namespace {

constexpr double far_away = 2.0; // uncertainties of the machines that teach the estimator
constexpr double tripping = 0.01;
// Machines of those for the widening that stay outside: one that rings would widen everything for all.
constexpr std::size_t outside_by_chance = 2;
// Chosen: room beyond what the rehearsals have shown. It leaves half of what a change of twice an uncertainty is away.
constexpr double room = 1.1;
// Some figures are the same in all rehearsals: the flux of a motor without a magnet.
constexpr double least_half_width = 0.05;

/// Rehearsals that did not trip.
struct Rehearsed {
    std::vector<Difference>      differences;
    std::vector<Eigen::VectorXd> features;
    int                          tripped = 0;
    std::string                  fault; ///< of the last that did
};

Rehearsed rehearse_all(const Drive &d, const Controller &c, const Programme &p, std::size_t count,
                       double times, std::uint64_t first_seed)
{
    std::vector<Difference>                     x(count);
    std::vector<std::optional<std::string>>     faults(count);
    std::vector<std::optional<Eigen::VectorXd>> y(count);
    parallel_for(count, [&](std::size_t k) {
        x[k] = draw_difference(first_seed + k);
        for (double &value : x[k]) {
            value *= times;
        }
        const Records records = rehearse(machine_on_bench(d, x[k], first_seed + k), c, p);
        faults[k]             = records.fault;
        if (!records.fault) {
            y[k] = features_of(d, p, records);
        }
    });
    Rehearsed all;
    for (std::size_t k = 0; k < count; k++) {
        if (y[k]) {
            all.differences.push_back(x[k]);
            all.features.push_back(*y[k]);
        } else {
            all.tripped++;
            all.fault = faults[k].value_or("");
        }
    }
    return all;
}

void require_few_trips(const Drive &d, const Rehearsed &r, std::size_t count, double allowed)
{
    if (r.tripped > allowed * static_cast<double>(count)) {
        throw DesignError(fmt::format("{}: trips in {} of {} rehearsals ({}): smaller values in "
                                      "[uncertainty], or another tuning",
                                      d.name, r.tripped, count, r.fault));
    }
}

Eigen::MatrixXd in_rows(const std::vector<Eigen::VectorXd> &features)
{
    Eigen::MatrixXd rows(features.size(), features.front().size());
    for (std::size_t k = 0; k < features.size(); k++) {
        rows.row(static_cast<Eigen::Index>(k)) = features[k].transpose();
    }
    return rows;
}

} // namespace

Expectation::Expectation(const Drive &drive, const Programme &programme,
                         const RehearsalCounts &counts)
    : drive_(drive), programme_(programme)
{
    const Controller controller = controller_of(drive);
    const auto       taught     = static_cast<std::size_t>(counts.of_estimator);
    const auto       ranged     = static_cast<std::size_t>(counts.of_range);
    const auto       all        = ranged + static_cast<std::size_t>(counts.of_widening);
    const Rehearsed  far        = rehearse_all(drive, controller, programme, taught, far_away, 1);
    require_few_trips(drive, far, taught, 0.5);
    estimator_.emplace(far.differences, in_rows(far.features));

    const Rehearsed near = rehearse_all(drive, controller, programme, all, 1.0, 1 + taught);
    require_few_trips(drive, near, all, tripping);
    Figures lo{};
    Figures hi{};
    lo.fill(INFINITY);
    hi.fill(-INFINITY);
    for (std::size_t k = 0; k < ranged; k++) {
        const Figures f = figures_of(near.features[k]);
        for (std::size_t n = 0; n < f.size(); n++) {
            lo[n] = std::min(lo[n], f[n]);
            hi[n] = std::max(hi[n], f[n]);
        }
    }
    for (std::size_t n = 0; n < figure_count; n++) {
        middle_[n] = 0.5 * (lo[n] + hi[n]);
        half_[n]   = std::max(0.5 * (hi[n] - lo[n]), least_half_width);
    }
    std::vector<double> wider;
    for (std::size_t k = ranged; k < near.features.size(); k++) {
        const Figures f    = figures_of(near.features[k]);
        double        most = 1.0;
        for (std::size_t n = 0; n < f.size(); n++) {
            most = std::max(most, distance(n, f));
        }
        wider.push_back(most);
    }
    std::sort(wider.begin(), wider.end(), std::greater<>());
    const double wide = wider.at(outside_by_chance);
    for (double &half : half_) {
        half *= room * wide;
    }
}

Figures Expectation::figures_of(const Eigen::VectorXd &features) const
{
    const Estimate e = estimator_->of(features);
    Figures        f{};
    std::copy(e.difference.begin(), e.difference.end(), f.begin());
    f.back() = e.misfit;
    return f;
}

/// The misfit has no lower end: nothing can be too much as expected.
double Expectation::distance(std::size_t figure, const Figures &figures) const
{
    const double x = (figures[figure] - middle_[figure]) / half_[figure];
    return figure == believed_count ? x : std::abs(x);
}

Judgement Expectation::judge(const Records &records) const
{
    Judgement j;
    j.fault = records.fault;
    if (j.fault) {
        return j;
    }
    j.figures = figures_of(features_of(drive_, programme_, records));
    for (std::size_t n = 0; n < figure_count; n++) {
        j.lo[n]        = middle_[n] - half_[n];
        j.hi[n]        = middle_[n] + half_[n];
        const double x = distance(n, j.figures);
        if (x > j.farthest) {
            j.farthest = x;
            j.cause    = n;
        }
    }
    return j;
}

} // namespace sdre
