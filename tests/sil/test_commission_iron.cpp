// SPDX-License-Identifier: MIT
/// Saturated iron, found by the firmware's commissioning with real sensors, disc and inverter, and written as the map of a drive file.
/// Oracle: the closed form of iron.hpp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "iron.hpp"
#include "shipped_drive.hpp"
#include "sil/commission/bench.hpp"
#include "sil/commission/report.hpp"

#include "common/file_output.hpp"
#include "common/parallel.hpp"
#include "facts/commissioned_text.hpp"
#include "facts/found_map.hpp"

using namespace sdre;

namespace {

/// The d currents that a commissioning sees.
const std::vector<double> seen_id_axis = support::even_axis(-4.18, 0.22, 33);

struct Off {
    double bins = 0.0; ///< largest of the inductances, as a share
    double d    = 0.0; ///< largest of the fluxes within the current limit, over the largest psi_q
    double q    = 0.0;
};

double slope_of(const support::Iron &iron, double id_A, double iq_A, bool d)
{
    const double step = 1e-4;
    return d ? (iron.psi_d(id_A + step, iq_A) - iron.psi_d(id_A - step, iq_A)) / (2.0 * step)
             : (iron.psi_q(id_A, iq_A + step) - iron.psi_q(id_A, iq_A - step)) / (2.0 * step);
}

double bins_off(const support::Iron &iron, const FoundMap &m)
{
    double worst = 0.0;
    for (std::size_t k = 0; k < COMMISSION_BINS; k++) {
        const double i_A = m.step_A * (double(k) + 0.5);
        for (std::size_t row = 0; row < 2; row++) {
            const double truth = slope_of(iron, row == 0 ? i_A : -i_A, 0.0, true);
            worst              = std::max(worst, std::abs(m.ld_H[row][k] / truth - 1.0));
        }
        for (std::size_t row = 0; row < 3; row++) {
            const double truth = slope_of(iron, -m.bias_A * double(row), m.iq_A(row, k), false);
            worst              = std::max(worst, std::abs(m.lq_H[row][k] / truth - 1.0));
        }
    }
    return worst;
}

/// Compares the written map with the closed form, up to the limit.
Off map_off(const support::Iron &iron, const std::string &text)
{
    const Drive  found   = read_drive_text(text, "found.toml");
    const double limit_A = found.motor.max_current_A;
    const double unit_Wb = iron.psi_q(0.0, limit_A);
    Off          off;
    EXPECT_TRUE(found.saturation != nullptr) << text;
    for (double id = -limit_A; found.saturation && id <= 0.0; id += limit_A / 16.0) {
        for (double iq = 0.0; std::hypot(id, iq) <= limit_A; iq += limit_A / 16.0) {
            const FluxAt f = found.saturation->at(id, iq);
            off.d          = std::max(off.d, std::abs(f.d_Wb - iron.psi_d(id, iq)) / unit_Wb);
            off.q          = std::max(off.q, std::abs(f.q_Wb - iron.psi_q(id, iq)) / unit_Wb);
        }
    }
    return off;
}

Off run_of(double b, std::uint64_t seed, double share)
{
    support::Iron iron;
    iron.b              = b;
    const Drive       d = support::saturated_drive(iron, seen_id_axis);
    CommissionOptions o;
    o.seed                = seed;
    o.current_share       = share;
    const CommissionRun r = commission(d, o);
    EXPECT_TRUE(r.finished()) << commission_text(d, r);
    EXPECT_LE(r.peak_share(), 1.0) << commission_text(d, r);
    const FoundMap m = found_map(r.map, r.found);
    Off off  = map_off(iron, commissioned_text(read_text_file(support::shipped_drive("ipmsm_390w")),
                                               {r.found, m}, d.motor.max_current_A, "here"));
    off.bins = bins_off(iron, m);
    return off;
}

} // namespace

TEST(CommissionIron, FindsTheMapWithItsCrossSaturation)
{
    const Off off = run_of(0.3, 1, 1.0);
    EXPECT_LE(off.bins, 0.05);
    EXPECT_LE(off.d, 0.03);
    EXPECT_LE(off.q, 0.03);
}

/// The inductances of a motor without saturation are equal within the noise: no map is written.
TEST(CommissionIron, ALinearMotorGetsNoMap)
{
    const Drive         d = read_drive_file(support::shipped_drive("ipmsm_390w"));
    const CommissionRun r = commission(d, {});
    const FoundMap      m = found_map(r.map, r.found);
    EXPECT_TRUE(m.measured());
    EXPECT_LT(m.change(), 0.06);
    const std::string text = commissioned_text(read_text_file(support::shipped_drive("ipmsm_390w")),
                                               {r.found, m}, 4.0, "here");
    EXPECT_EQ(text.find("[saturation]"), std::string::npos);
}

TEST(CommissionIronAll, Sweep)
{
    for (const double share : {1.0, 0.85}) {
        for (const double b : {0.15, 0.3}) {
            std::vector<Off> all(10);
            parallel_for(all.size(), [&](std::size_t k) { all[k] = run_of(b, k + 1, share); });
            Off worst;
            for (const Off &off : all) {
                worst.bins = std::max(worst.bins, off.bins);
                worst.d    = std::max(worst.d, off.d);
                worst.q    = std::max(worst.q, off.q);
            }
            fmt::print("b {} J^-1, bound {} of the limit, 10 seeds: inductances {:.1f} %, psi_d "
                       "{:.1f} %, psi_q {:.1f} % of the largest\n",
                       b, share, 100.0 * worst.bins, 100.0 * worst.d, 100.0 * worst.q);
            EXPECT_LE(worst.bins, 0.05);
            EXPECT_LE(worst.d, 0.05);
            EXPECT_LE(worst.q, 0.05);
        }
    }
}
