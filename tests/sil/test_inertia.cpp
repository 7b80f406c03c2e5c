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
    double ratio   = 0.0;
    double least   = 1.0; ///< of the whole run
    double most    = 1.0;
    int    changes = 0;
};

/// The background sees every `each`-th tick of the core.
Learned learned(const Scenario &s, std::uint32_t each)
{
    const Controller    controller = prepare_controller(s);
    Simulation          run(s, controller);
    const double        ts_s = control_period_s(s.drive);
    app_watch_inertia_t watch;
    app_watch_inertia_reset(&watch);
    Learned out;
    for (std::uint32_t tick = 0; tick < static_cast<std::uint32_t>(s.duration_s / ts_s); tick++) {
        run.step(wanted_e_radps(s, tick * ts_s));
        EXPECT_EQ(run.drive().state, DRIVE_RUN);
        const law_output_t            &answer = run.drive().answer;
        const app_watch_inertia_seen_t seen{tick, true, answer.now.omega_e_radps, answer.d_omega};
        if (tick % each == 0) {
            app_watch_inertia_see(&watch, &seen, controller.config.speed_max_e_radps,
                                  static_cast<float>(ts_s));
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

/// Each change halves the error, so an eighth of the first one remains after three.
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
            EXPECT_NEAR(l.ratio, k + (1.0 - k) / 8.0, 0.03 * k) << k; // the worst is 0.009 k off
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
        EXPECT_NEAR(l.ratio, 2.0 - 1.0 / 8.0, 0.06) << drive;
    }
}
