// SPDX-License-Identifier: MIT
// The inertia that changes of speed show, on the realistic board. SDRE_INERTIA=all prints what was learned.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/run/simulation.hpp"
#include "sweep.hpp"
#include "temp_dir.hpp"

extern "C" {
#include "app_believe.h"
#include "app_watch_inertia.h"
}

using namespace sdre;

namespace {

constexpr int seeds = 10;

/// A shaft with `inertia` times the drive's; a load of 0.75 N m; 200 -> 400 -> 200 -> 400 rad/s at 0.4, 0.9 and 1.4 s.
Scenario three_changes(const std::string &drive, double inertia, int seed)
{
    const support::TempDir dir;
    Scenario               s = read_scenario_file(
                      dir.write("s.toml",
                                fmt::format("drive = \"" SDRE_SOURCE_DIR "/firmware/config/drives/{}.toml\"\n"
                                                          "duration_s = 2.0\ninitial_speed_e_radps = 200.0\n"
                                                          "[sensors]\nideal = false\n"
                                                          "[[load_torque]]\ntime_s = 0.0\nvalue_Nm = 0.75\n"
                                                          "[plant_scale]\ninertia_kgm2 = {}\n"
                                                          "[[speed_reference]]\ntime_s = 0.0\nvalue_e_radps = 200.0\n",
                                            drive, inertia)),
                      support::shipped_drive(drive));
    s.speed_reference = {{0.0, 200.0}, {0.4, 400.0}, {0.9, 200.0}, {1.4, 400.0}};
    s.seed            = static_cast<std::uint64_t>(seed);
    return s;
}

double wanted_e_radps(const Scenario &s, double time_s)
{
    double wanted = s.speed_reference.front().value;
    for (const auto &p : s.speed_reference) {
        wanted = p.time_s <= time_s + 1e-9 ? p.value : wanted;
    }
    return wanted;
}

struct Learned {
    double settled_s = 0.0; ///< after the last step of load: within 0.5 rad/s
    double off_radps = 0.0; ///< largest deviation in the 100 ms before it
    int    swaps     = 0;   ///< of constants

    /// Sees the speed of each period.
    void follow(const Scenario &s, double time_s, double omega_e_radps)
    {
        const double step_s = s.load_torque.back().time_s;
        const double off    = std::abs(omega_e_radps - wanted_e_radps(s, time_s));
        if (time_s >= step_s && off > 0.5) {
            settled_s = time_s - step_s;
        }
        if (time_s >= step_s - 0.1 && time_s < step_s) {
            off_radps = std::max(off_radps, off);
        }
    }

    double ratio   = 0.0;
    double least   = 1.0; ///< of the whole run
    double most    = 1.0;
    int    changes = 0;
};

/// The background sees every `each`-th tick of the core. `acts`: the law goes over to what was learned.
Learned learned(const Scenario &s, std::uint32_t each, bool acts = false)
{
    const Controller    controller = prepare_controller(s);
    Simulation          run(s, controller);
    const double        ts_s = control_period_s(s.drive);
    app_watch_inertia_t watch;
    app_watch_inertia_reset(&watch, 1.0F);
    app_believe_t second;
    app_believe_init(&second, &controller.config);
    Learned out;
    for (std::uint32_t tick = 0; tick < static_cast<std::uint32_t>(s.duration_s / ts_s); tick++) {
        const double  time_s = tick * ts_s;
        const TickEnd end    = run.step(wanted_e_radps(s, time_s));
        EXPECT_EQ(run.drive().state, DRIVE_RUN);
        out.follow(s, time_s, end.row.omega_e_radps);
        const law_output_t            &answer   = run.drive().answer;
        const drive_config_t          *in_force = run.drive().config;
        const float                    believed = in_force == &second.drive ? second.ratio : 1.0F;
        const app_watch_inertia_seen_t seen{tick, believed, true, answer.now.omega_e_radps,
                                            answer.d_omega};
        if (tick % each == 0) {
            app_watch_inertia_see(&watch, &seen, controller.config.speed_max_e_radps,
                                  static_cast<float>(ts_s));
            bool        made = false;
            const auto *next = app_believe_choose(&second, &controller.config, in_force,
                                                  acts ? watch.ratio : 1.0F, &made);
            if (next != in_force) {
                out.swaps++;
                run.adopt(*next);
            }
        }
        out.least = std::min(out.least, static_cast<double>(watch.ratio));
        out.most  = std::max(out.most, static_cast<double>(watch.ratio));
    }
    out.ratio   = static_cast<double>(watch.ratio);
    out.changes = watch.changes;
    return out;
}

void show(const std::string &what, const Learned &l)
{
    if (std::getenv("SDRE_INERTIA") != nullptr) {
        fmt::print("{}: {:.3f} ({:.3f} .. {:.3f}) by {}\n", what, l.ratio, l.least, l.most,
                   l.changes);
    }
}

} // namespace

/// Each change leaves a quarter of the error, so a 64th of the first one remains after three.
TEST(Inertia, ThreeChangesShowEveryInertia)
{
    for (const double k : {0.5, 0.7, 1.0, 2.0, 3.0, 5.0}) {
        std::vector<Learned> all(support::swept<std::size_t>(seeds, 2));
        parallel_for(all.size(), [&](std::size_t i) {
            all[i] = learned(three_changes("ipmsm_390w", k, static_cast<int>(i) + 1),
                             1 + static_cast<std::uint32_t>(i % 5));
        });
        for (const Learned &l : all) {
            show(fmt::format("J x{}", k), l);
            EXPECT_EQ(l.changes, 3) << k;
            EXPECT_NEAR(l.ratio, k + (1.0 - k) / 64.0, 0.03 * k) << k; // the worst is 0.009 k off
        }
    }
}

/// A load that swings by half of the rated torque, at ten phases of the changes. The largest error is 0.037, at 2 Hz.
TEST(Inertia, ALoadThatSwingsMovesItLittle)
{
    for (const double frequency_Hz : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
        std::vector<Learned> all(seeds);
        parallel_for(all.size(), [&](std::size_t i) {
            Scenario s               = three_changes("ipmsm_390w", 1.0, static_cast<int>(i) + 1);
            s.load_sine.amplitude_Nm = 0.75;
            s.load_sine.frequency_Hz = frequency_Hz;
            s.load_sine.start_s      = 0.1 / frequency_Hz * static_cast<double>(i);
            all[i]                   = learned(s, 1);
        });
        for (const Learned &l : all) {
            show(fmt::format("{} Hz", frequency_Hz), l);
            EXPECT_GT(l.least, 0.92) << frequency_Hz;
            EXPECT_LT(l.most, 1.08) << frequency_Hz;
        }
    }
}

/// Two changes of 200 rad/s, then a load step 0.75 -> 1.5 N m at 300 rad/s: the law has the inertia that they showed. Without
/// it the same step takes 18, 6.4, 5, 14, 17 and 33 ms.
TEST(Inertia, TheLawHasWhatTwoChangesShowed)
{
    for (const double k : {0.5, 0.7, 1.0, 2.0, 3.0, 5.0}) {
        std::vector<Learned> all(support::swept<std::size_t>(20, 2));
        parallel_for(all.size(), [&](std::size_t i) {
            Scenario s        = three_changes("ipmsm_390w", k, static_cast<int>(i) + 1);
            s.speed_reference = {{0.0, 300.0}, {0.4, 500.0}, {0.9, 300.0}};
            s.load_torque     = {{0.0, 0.75}, {1.7, 1.5}};
            all[i]            = learned(s, 1 + static_cast<std::uint32_t>(i % 5), true);
        });
        double settled_s = 0.0;
        for (const Learned &l : all) {
            settled_s = std::max(settled_s, l.settled_s);
            EXPECT_EQ(l.changes, 2) << k;
            EXPECT_LT(l.off_radps, 0.5) << k;
            EXPECT_LE(l.swaps, 3) << k;
        }
        if (std::getenv("SDRE_INERTIA") != nullptr) {
            fmt::print("J x{}: {:.1f} ms\n", k, 1e3 * settled_s);
        }
        EXPECT_LE(settled_s, 8.01e-3) << k;
    }
}

/// The constants change by a factor of two and more while the motor turns under load: no step in speed and torque.
TEST(Inertia, OtherConstantsMakeNoBump)
{
    const Scenario s    = three_changes("ipmsm_390w", 2.0, 1);
    const double   ts_s = control_period_s(s.drive);
    const auto     own  = prepare_controller(s);
    for (const double ratio : {0.6, 2.0, 5.0}) {
        app_believe_t second;
        app_believe_init(&second, &own.config);
        bool made = false;
        ASSERT_EQ(
            app_believe_choose(&second, &own.config, &own.config, static_cast<float>(ratio), &made),
            &second.drive);
        Simulation run(s, own);
        double     speed_off = 0.0;
        double     before_A  = 0.0;
        double     step_A    = 0.0;
        for (int tick = 0; tick < 3000; tick++) {
            const TickEnd end = run.step(200.0);
            if (tick >= 1500 && tick % 50 == 0) {
                run.adopt(tick % 100 == 0 ? second.drive : own.config);
            }
            if (tick >= 1000) {
                const double iq_A = static_cast<double>(run.drive().answer.i_ref_A.q);
                speed_off         = std::max(speed_off, std::abs(end.row.omega_e_radps - 200.0));
                (tick < 1500 ? before_A : step_A) =
                    std::max(tick < 1500 ? before_A : step_A, std::abs(iq_A));
            }
        }
        (void)ts_s;
        EXPECT_EQ(run.drive().state, DRIVE_RUN) << ratio;
        EXPECT_LT(speed_off, 0.5) << ratio;
        EXPECT_LT(step_A, before_A + 0.3) << ratio;
    }
}

TEST(Inertia, LoadStepsTeachNothing)
{
    for (const double k : {0.5, 1.0, 5.0}) {
        Scenario s        = three_changes("ipmsm_390w", k, 1);
        s.speed_reference = {{0.0, 200.0}};
        s.load_torque     = {{0.0, 0.0}, {0.4, 1.5}, {0.8, -1.5}, {1.2, 0.75}};
        EXPECT_EQ(learned(s, 1).changes, 0) << k;
    }
}

/// Laws with an estimate of the load that has little noise.
TEST(Inertia, OtherLawsShowItToo)
{
    for (const char *drive : {
             "ipmsm_390w_noc_h",
             "ipmsm_390w_ladrc_edges",
         }) {
        const Learned l = learned(three_changes(drive, 2.0, 1), 1);
        show(drive, l);
        EXPECT_EQ(l.changes, 3) << drive;
        EXPECT_NEAR(l.ratio, 2.0 - 1.0 / 64.0, 0.06) << drive;
    }
}
