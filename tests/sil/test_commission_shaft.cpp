// SPDX-License-Identifier: MIT
/// The resonance of an elastic shaft, found by the firmware's commissioning with real sensors, disc and inverter.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shipped_drive.hpp"
#include "sil/commission/bench.hpp"
#include "sil/commission/board_bench.hpp"
#include "sil/commission/report.hpp"

#include "common/parallel.hpp"
#include "facts/commissioned_text.hpp"

using namespace sdre;

namespace {

struct Case {
    double        resonance_Hz;
    double        damping;
    double        share = 0.5;
    std::uint64_t seed  = 1;
};

Drive drive_of(const Case &c)
{
    Drive d                        = read_drive_file(support::shipped_drive("ipmsm_390w"));
    d.mechanics.coupling           = Coupling::known;
    d.mechanics.resonance_Hz       = c.resonance_Hz;
    d.mechanics.least_damping      = c.damping;
    d.mechanics.load_inertia_share = c.share;
    return d;
}

CommissionRun run_of(const Case &c)
{
    CommissionOptions o;
    o.seed          = c.seed;
    o.current_share = 0.75;
    return commission(drive_of(c), o);
}

struct Worst {
    double resonance = 0.0;
    double damping   = 0.0;
    double share     = 0.0;
    double time_s    = 0.0;
    double peak      = 0.0;
};

/// 3 % of the resonance, 30 % of the damping ratio; the worst errors are printed.
void expect_found(const std::vector<Case> &cases)
{
    std::vector<CommissionRun> runs(cases.size());
    parallel_for(cases.size(), [&](std::size_t k) { runs[k] = run_of(cases[k]); });
    Worst worst;
    for (std::size_t k = 0; k < cases.size(); k++) {
        const Case          &c = cases[k];
        const CommissionRun &r = runs[k];
        const std::string    text =
            fmt::format("{} Hz, damping {}, share {}, seed {}: {}", c.resonance_Hz, c.damping,
                        c.share, c.seed, commission_text(drive_of(c), r));
        ASSERT_TRUE(r.finished()) << text;
        ASSERT_EQ(r.found.coupling, COMMISSION_COUPLING_ELASTIC) << text;
        const double f = std::abs(double(r.found.resonance_Hz.value) / c.resonance_Hz - 1.0);
        const double z = std::abs(double(r.found.damping.value) / c.damping - 1.0);
        const double s = std::abs(double(r.found.load_share.value) - c.share);
        EXPECT_LE(f, 0.03) << text;
        EXPECT_LE(z, 0.30) << text;
        EXPECT_LE(s, 0.05) << text;
        EXPECT_LE(r.peak_share(), 1.0) << text;
        worst.resonance = std::max(worst.resonance, f);
        worst.damping   = std::max(worst.damping, z);
        worst.share     = std::max(worst.share, s);
        worst.time_s    = std::max(worst.time_s, r.time_s);
        worst.peak      = std::max(worst.peak, r.peak_share());
    }
    fmt::print("{} runs: resonance {:.2f} %, damping {:.1f} %, share {:.3f}, {:.0f} s, peak {:.2f} "
               "of the bound\n",
               cases.size(), 100.0 * worst.resonance, 100.0 * worst.damping, worst.share,
               worst.time_s, worst.peak);
}

void expect_coupling(const Case &c, commission_coupling_t coupling)
{
    const CommissionRun r = run_of(c);
    ASSERT_TRUE(r.finished()) << commission_text(drive_of(c), r);
    EXPECT_EQ(r.found.coupling, coupling) << c.resonance_Hz << " Hz, " << c.damping << ", seed "
                                          << c.seed << ": " << coupling_words(r.found);
}

} // namespace

TEST(CommissionShaft, FindsTheResonance)
{
    expect_found({{60.0, 0.02}, {60.0, 0.1}, {220.0, 0.02, 0.1}, {400.0, 0.02, 0.8}, {400.0, 0.1}});
}

TEST(CommissionShaft, SaysWhatIsOutsideItsRange)
{
    for (const double damping : {0.02, 0.1}) {
        expect_coupling({30.0, damping}, COMMISSION_COUPLING_BELOW);
        expect_coupling({800.0, damping}, COMMISSION_COUPLING_ABOVE);
    }
    const CommissionRun stiff =
        commission(read_drive_file(support::shipped_drive("ipmsm_390w")), {});
    EXPECT_EQ(stiff.found.coupling, COMMISSION_COUPLING_RIGID);
    EXPECT_EQ(coupling_words(stiff.found), "rigid: no resonance found between 40 and 600 Hz");
}

TEST(CommissionShaftAll, Sweep)
{
    for (const double f : {45.0, 60.0, 80.0, 120.0, 220.0, 300.0, 400.0, 500.0, 590.0}) {
        for (const double z : {0.02, 0.1}) {
            std::vector<Case> cases;
            for (std::uint64_t seed = 1; seed <= 10; seed++) {
                cases.push_back({f, z, 0.5, seed});
            }
            fmt::print("{} Hz, damping ratio {}: ", f, z);
            expect_found(cases);
        }
    }
}

TEST(CommissionShaftAll, Shares)
{
    for (const double share : {0.1, 0.25, 0.8}) {
        std::vector<Case> cases;
        for (std::uint64_t seed = 1; seed <= 10; seed++) {
            cases.push_back(
                {seed % 2 == 0 ? 80.0 : 300.0, seed % 3 == 0 ? 0.1 : 0.02, share, seed});
        }
        fmt::print("share {}: ", share);
        expect_found(cases);
    }
}

TEST(CommissionShaftAll, Words)
{
    for (std::uint64_t seed = 1; seed <= 10; seed++) {
        for (const double damping : {0.02, 0.1}) {
            expect_coupling({30.0, damping, 0.5, seed}, COMMISSION_COUPLING_BELOW);
            expect_coupling({800.0, damping, 0.5, seed}, COMMISSION_COUPLING_ABOVE);
        }
    }
    for (const char *name : {"ipmsm_390w", "servo_200w"}) {
        for (std::uint64_t seed = 1; seed <= 20; seed++) {
            CommissionOptions o;
            o.seed                = seed;
            o.cogging_share       = seed % 2 == 0 ? 0.02 : 0.0;
            const CommissionRun r = commission(read_drive_file(support::shipped_drive(name)), o);
            EXPECT_EQ(r.found.coupling, COMMISSION_COUPLING_RIGID)
                << name << " " << seed << ": "
                << commission_text(read_drive_file(support::shipped_drive(name)), r);
        }
    }
}

/// Through the application, and through drivers and Modbus.
TEST(CommissionShaftAll, OnBothBoards)
{
    const Case c{220.0, 0.02};
    for (const BoardKind kind : {BoardKind::api, BoardKind::f28335}) {
        const CommissionRun r = commission_on_board(drive_of(c), {}, kind);
        ASSERT_EQ(r.found.coupling, COMMISSION_COUPLING_ELASTIC);
        EXPECT_NEAR(double(r.found.resonance_Hz.value), 220.0, 0.03 * 220.0);
        EXPECT_NEAR(double(r.found.damping.value), 0.02, 0.3 * 0.02);
    }
}
