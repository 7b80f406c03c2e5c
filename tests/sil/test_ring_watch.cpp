// SPDX-License-Identifier: MIT
/// The report of a torque current that oscillates: elastic shafts are found, shipped scenarios are not.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/parallel.hpp"
#include "shipped_drive.hpp"
#include "sil/run/controller.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/board_reader.hpp"
#include "sil/setup/scenario.hpp"
#include "sweep.hpp"

extern "C" {
#include "app_watch_ring.h"
}

using namespace sdre;

namespace {

struct Heard {
    double at_s   = -1.0; ///< when it was first reported; -1: never
    double hz     = 0.0;
    double ends_s = 0.0; ///< of the run, or when it tripped
};

/// The background sees every `each`-th tick of the core.
Heard heard(const Scenario &s, const Controller &controller, std::uint32_t each)
{
    Simulation       run(s, controller);
    const auto       ts_s = static_cast<float>(control_period_s(s.drive));
    app_watch_ring_t watch;
    app_watch_ring_reset(&watch);
    Heard         out;
    std::uint32_t tick = 0;
    run_ticks(s, controller, [&](double time_s, double reference_e_radps) {
        const TickEnd end  = run.step(reference_e_radps);
        const bool    runs = run.drive().state == DRIVE_RUN;
        out.ends_s         = runs ? time_s : out.ends_s;
        if (tick % each == 0) {
            const app_watch_ring_seen_t seen{tick, runs, run.drive().answer.now.iq_A};
            app_watch_ring_see(&watch, &seen, controller.config.current_max_A, ts_s);
        }
        if (watch.rings && out.at_s < 0.0) {
            out.at_s = time_s;
        }
        tick++;
        return end;
    });
    out.hz = static_cast<double>(watch.hz);
    return out;
}

/// Half a second at 200 rad/s, then a load step and a speed step.
Scenario run_of(const Drive &drive, std::uint64_t seed)
{
    Scenario s;
    s.name                  = "ring";
    s.drive                 = drive;
    s.dc_link_V             = drive.inverter.dc_link_V;
    s.sensors               = sensors_of_drive(drive);
    s.sensors.ideal         = false;
    s.seed                  = seed;
    s.duration_s            = 2.0;
    s.initial_speed_e_radps = 200.0;
    s.speed_reference       = {{0.0, 200.0}, {1.2, 300.0}};
    s.load_torque           = {{0.0, 0.0}, {0.2, 0.5 * drive.motor.rated_torque_Nm}};
    s.motor_effects         = effects_of_drive(drive);
    return s;
}

Drive with_shaft(double hz, double damping)
{
    Drive d                        = read_drive_file(support::shipped_drive("ipmsm_390w"));
    d.mechanics.coupling           = Coupling::known;
    d.mechanics.resonance_Hz       = hz;
    d.mechanics.least_damping      = damping;
    d.mechanics.load_inertia_share = 0.5;
    return d;
}

} // namespace

/// A shaft that rings with weights of a rigid one is reported, at the frequency of the loop. The observer's
/// phase raises it above the resonance by up to half.
TEST(RingWatch, AShaftThatRingsIsReported)
{
    const Drive      rigid      = read_drive_file(support::shipped_drive("ipmsm_390w"));
    const Controller controller = prepare_controller(run_of(rigid, 1));
    const std::vector<std::pair<double, double>> shafts{
        {220.0, 0.1}, {300.0, 0.1}, {350.0, 0.1}, {400.0, 0.1}, {500.0, 0.1}};
    for (const auto &[hz, damping] : shafts) {
        std::vector<Heard> all(support::swept<std::size_t>(10, 2));
        parallel_for(all.size(), [&](std::size_t k) {
            all[k] = heard(run_of(with_shaft(hz, damping), k + 1), controller,
                           1 + static_cast<std::uint32_t>(k % 2));
        });
        for (const Heard &h : all) {
            if (std::getenv("SDRE_RING") != nullptr) {
                fmt::print("{} Hz, {}: after {:.3f} s, {:.0f} Hz\n", hz, damping, h.at_s, h.hz);
            }
            EXPECT_GT(h.at_s, 0.0) << hz << " " << damping;
            EXPECT_LT(h.at_s, 0.2 + 1.0)
                << hz << " " << damping << ": 0.2 s after the load step, 1 s";
            EXPECT_GT(h.hz, 0.95 * hz);
            EXPECT_LT(h.hz, 1.6 * hz);
        }
    }
}

/// Discs, slow speeds and reversals of the shipped drive.
TEST(RingWatch, ADriveThatDoesNotRingIsQuiet)
{
    const Drive        d     = read_drive_file(support::shipped_drive("ipmsm_390w"));
    const Controller   rigid = prepare_controller(run_of(d, 1));
    std::vector<Heard> all(support::swept<std::size_t>(48, 12));
    parallel_for(all.size(), [&](std::size_t k) {
        Scenario             s    = run_of(d, k + 1);
        EncoderDiscSettings &disc = s.sensors.encoder_disc;
        switch (k % 4) {
        case 1:
            disc = {0.0, 0.0, 0.0, 0};
            break;
        case 2:
            disc = {0.0, 0.0, 0.1, 0};
            break;
        case 3:
            disc = {0.14, 0.14, 0.1, 16};
            break;
        default:
            break;
        }
        if (k / 4 % 3 == 1) {
            s.initial_speed_e_radps = 4.0;
            s.speed_reference       = {{0.0, 4.0}, {1.0, 8.0}, {1.5, 0.0}};
            s.load_torque           = {{0.0, 0.75}};
        }
        if (k / 4 % 3 == 2) {
            s.speed_reference = {{0.0, 200.0}, {0.6, -200.0}, {1.2, 450.0}};
        }
        all[k] = heard(s, rigid, 1);
    });
    for (std::size_t k = 0; k < all.size(); k++) {
        EXPECT_LT(all[k].at_s, 0.0) << k << ": " << all[k].hz << " Hz";
        EXPECT_GT(all[k].ends_s, 1.99) << k;
    }
}

/// The load of board_load_sine swings at 50 Hz, and paper A's weights of fig4 oscillate with half the inductance: both are
/// reported. No other scenario is.
TEST(RingWatch, NoOtherScenarioIsReported)
{
    std::vector<std::filesystem::path> files;
    for (const auto &e :
         std::filesystem::directory_iterator(SDRE_SOURCE_DIR "/host_tools/sil/scenarios")) {
        if (e.path().extension() == ".toml") {
            files.push_back(e.path());
        }
    }
    ASSERT_GT(files.size(), 25U);
    std::vector<Heard> all(files.size());
    parallel_for(files.size(), [&](std::size_t k) {
        const Scenario s = read_scenario_file(files[k]);
        all[k]           = heard(s, prepare_controller(s), 1);
    });
    for (std::size_t k = 0; k < files.size(); k++) {
        const std::string name  = files[k].stem().string();
        const bool        known = name == "board_load_sine" || name.rfind("fig4", 0) == 0;
        EXPECT_EQ(all[k].at_s > 0.0, known) << name << ": " << all[k].hz << " Hz";
    }
}
