// SPDX-License-Identifier: MIT
// Flips one bit in the RAM of the running application: its state, its constants, the tables. The
// result may be no effect or a trip. A current beyond 1.5 times the limit without a trip is a
// failure.
//
// Every flip has its own process and starts from the same instant of the same run. SDRE_BIT_FLIPS
// sets their number.
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../support/bit_flips.hpp"
#include "sil/board/board_run.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/board/board_scenario.hpp"

extern "C" {
#include "app.h"
#include "app_modes.h"

extern drive_config_t sil_drive_config;
}

using namespace sdre;

namespace {

constexpr int    short_form  = 60;
constexpr double limit_A     = 4.0;
constexpr long   settle      = 200; // ticks in RUN before a flip
constexpr long   after       = 400; // and after it: 80 ms, several passes of the check sums
constexpr int    exit_quiet  = 0;
constexpr int    exit_trip   = 1;
constexpr int    exit_missed = 2; // beyond 1.5 times the limit, and no fault

law_noc_config_t constants; // in RAM, as on the board

struct Region {
    unsigned char *first;
    std::size_t    bytes;
};

Scenario scenario()
{
    Scenario s =
        read_scenario_file(SDRE_SOURCE_DIR "/host_tools/sil/scenarios/board_load_step.toml");
    s.load_torque = {{0.0, 1.5}};
    return for_board(s).scenario;
}

/// To the first tick in RUN; its number.
long bring_to_run(ApiRun &run)
{
    while (app_drive()->state != DRIVE_RUN && run.bench().tick() < 2000) {
        if (run.bench().tick() == 1560) {
            run.set_speed(3000);
        } else if (run.bench().tick() == 1640) {
            run.set_run();
        }
        run.step();
    }
    return run.bench().tick();
}

std::vector<Region> regions()
{
    auto *modes = reinterpret_cast<unsigned char *>(const_cast<drive_t *>(app_drive())) -
                  offsetof(app_modes_t, drive);
    const auto *as_modes = reinterpret_cast<const app_modes_t *>(modes);
    auto *config = reinterpret_cast<unsigned char *>(const_cast<app_config_t *>(as_modes->config));
    return {{modes, sizeof(app_modes_t)},
            {config, sizeof(app_config_t)},
            {reinterpret_cast<unsigned char *>(&sil_drive_config), sizeof(sil_drive_config)},
            {reinterpret_cast<unsigned char *>(&constants), sizeof(constants)}};
}

/// In the child: flips, goes on, and says by its exit code what came of it.
[[noreturn]] void flip_and_go_on(ApiRun &run, unsigned char *at, int bit)
{
    *at           = static_cast<unsigned char>(*at ^ (1U << bit));
    double peak_A = 0.0;
    for (long k = 0; k < after && !run.bench().runaway(); k++) {
        run.step();
        peak_A = std::max(peak_A, run.bench().peak_current_A());
    }
    const bool told = app_status_read().fault != APP_FAULT_NONE || !run.bench().bridge_on();
    _exit(told ? exit_trip : peak_A > 1.5 * limit_A ? exit_missed : exit_quiet);
}

} // namespace

TEST(BitFlips, NoneLeadsToTooMuchCurrentUnnoticed)
{
    const Scenario s = scenario();
    Controller     c = prepare_controller(s);
    std::memcpy(&constants, c.config.constants, sizeof constants);
    c.config.constants = &constants;
    set_firmware(c.config, s.drive);

    const long start = [&] {
        ApiRun rehearsal(s, MotorBench::never, 3e-6);
        return bring_to_run(rehearsal);
    }();
    ApiRun run(s, start, 3e-6);
    ASSERT_EQ(bring_to_run(run), start);
    for (long k = 0; k < settle; k++) {
        run.step();
    }
    ASSERT_EQ(app_status_read().mode, APP_MODE_RUN);

    const std::vector<Region> all   = regions();
    std::size_t               bytes = 0;
    for (const Region &r : all) {
        bytes += r.bytes;
    }
    const auto at = [&](std::size_t place) { // of the bits: region and byte
        std::size_t byte = place / 8;
        std::size_t r    = 0;
        while (byte >= all[r].bytes) {
            byte -= all[r++].bytes;
        }
        return std::pair(r, byte);
    };
    const auto flips = support::flip_bits(8 * bytes, short_form, [&](std::size_t place) {
        const auto [r, byte] = at(place);
        flip_and_go_on(run, all[r].first + byte, static_cast<int>(place % 8));
    });
    int        trips = 0, missed = 0, crashed = 0;
    for (const auto &[place, code] : flips) {
        trips += code == exit_trip ? 1 : 0;
        missed += code == exit_missed ? 1 : 0;
        // Sanitizers stop at a bool that is neither 0 nor 1, which a processor takes for true.
        crashed += code < 0 || code > exit_missed ? 1 : 0;
        if (code == exit_missed || code < 0 || code > exit_missed) {
            const auto [r, byte] = at(place);
            std::printf("flip at region %zu byte %zu bit %zu: %d\n", r, byte, place % 8, code);
        }
    }
    std::printf("%zu flips in %zu bytes: %d trips, %d missed, %d crashes\n", flips.size(), bytes,
                trips, missed, crashed);
    EXPECT_EQ(missed, 0);
}
