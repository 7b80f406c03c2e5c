// SPDX-License-Identifier: MIT
#include "sil/commission/board_bench.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/board/board_scenario.hpp"
#include "sil/run/controller.hpp"

extern "C" {
#include "app.h"
}

namespace sdre {
namespace {

const double two_pi = 4.0 * std::acos(0.0);

// The application is ready after 306 ms; then the dynamometer lets the shaft go.
constexpr double free_s = 0.35;
// The command has been taken well within so long.
constexpr double taken_s   = 0.2;
constexpr double longest_s = 600.0;
// Chosen: ten polls a second, as an operator's display would; after half a second of silence the command is withdrawn.
constexpr double chat_s = 0.1;

std::unique_ptr<BoardRun> make_run(const BoardScenario &b, BoardKind kind, long start_tick)
{
    if (kind == BoardKind::api) {
        return std::make_unique<ApiRun>(b.scenario, start_tick, b.dead_time_s);
    }
    return std::make_unique<F28335Run>(b.scenario, start_tick, b.dead_time_s);
}

bool ended(const app_status_t &s)
{
    return s.mode == APP_MODE_FAULT || s.commission.stage >= COMMISSION_FINISHED;
}

} // namespace

CommissionRun commission_on_board(const Drive &truth, const CommissionOptions &o, BoardKind kind)
{
    const Controller controller = prepare_controller(commission_scenario(truth, o));
    return commission_on_board(truth, o, [&](const BoardScenario &b, long start_tick) {
        set_firmware(controller.config, truth);
        return make_run(b, kind, start_tick);
    });
}

CommissionRun commission_on_board(const Drive &truth, const CommissionOptions &o,
                                  const PowerUp &power_up)
{
    const BoardScenario board  = for_board(commission_scenario(truth, o));
    const double        ts     = control_period_s(truth);
    const long          start  = std::lround(free_s / ts);
    const long          chat   = std::lround(chat_s / ts);
    const auto          most   = start + std::lround(longest_s / ts);
    const auto          bounds = commission_config_of(truth, o);
    const auto          current =
        static_cast<std::uint16_t>(std::lround(100.0 * static_cast<double>(bounds.current_max_A)));
    const auto speed = static_cast<std::uint16_t>(
        std::lround(10.0 * static_cast<double>(bounds.speed_max_m_radps)));
    const std::unique_ptr<BoardRun> run = power_up(board, start);

    CommissionRun result;
    bool          asked = false;
    std::int64_t  first = 0;
    app_status_t  s     = run->status();
    while (run->bench().tick() < most && !ended(s)) {
        const long tick = run->bench().tick();
        if (tick >= start && !asked) {
            asked = run->commission(current, speed);
        } else if (asked && tick % chat == 0 && run->can_command()) {
            run->chat();
        }
        const commission_stage_t before = s.commission.stage;
        const bool               alive  = run->step();
        s                               = run->status();
        if (before == COMMISSION_IDLE && s.commission.stage == COMMISSION_WATCH) {
            first = run->bench().sample().count;
        }
        result.peak_current_A = std::max(result.peak_current_A, run->bench().peak_current_A());
        if (!alive ||
            (s.commission.stage == COMMISSION_IDLE && tick > start + std::lround(taken_s / ts))) {
            throw InputError(fmt::format("--board: the commissioning does not begin: mode {}",
                                         static_cast<int>(s.mode)));
        }
    }
    for (const std::string &finding : run->findings()) {
        throw InputError("--board: " + finding);
    }
    result.stage   = s.commission.stage;
    result.during  = s.commission.last_stage;
    result.reason  = s.commission.reason;
    result.found   = s.commission.found;
    result.bound_A = static_cast<double>(bounds.current_max_A);
    result.time_s  = static_cast<double>(run->bench().tick() - start) * ts;
    result.true_offset_e_rad =
        std::remainder(static_cast<double>(first) * count_e_rad(truth), two_pi);
    result.true_coulomb_Nm = board.scenario.motor_effects.coulomb_friction_Nm;
    return result;
}

} // namespace sdre
