// SPDX-License-Identifier: MIT
#include "sil/board/board_run.hpp"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/board/board_constants.hpp"
#include "sil/board/board_runs.hpp"
#include "sil/board/board_scenario.hpp"

extern "C" {
#include "app.h"
}

namespace sdre {
namespace {

// When the commands go out. The application is ready after 306 ms.
constexpr double speed_s = 0.312;
constexpr double run_s   = 0.328;
// A command has arrived and been answered well within so long.
constexpr double command_s = 0.012;
// Chosen: ten polls a second, as an operator's display would.
constexpr double chat_s = 0.1;

long ticks_in(double time_s, double period_s)
{
    return std::lround(time_s / period_s);
}

std::unique_ptr<BoardRun> make_run(const BoardScenario &b, BoardKind kind, long start_tick)
{
    if (kind == BoardKind::api) {
        return std::make_unique<ApiRun>(b.scenario, start_tick, b.dead_time_s);
    }
    return std::make_unique<F28335Run>(b.scenario, start_tick, b.dead_time_s);
}

bool running(const BoardRun &run)
{
    return run.drive().state == DRIVE_RUN;
}

/// From power-up to the first tick in RUN; its number.
long bring_to_run(BoardRun &run, int speed_tenths)
{
    const double period_s      = run.bench().period_s();
    const long   speed_tick    = ticks_in(speed_s, period_s);
    const long   run_tick      = ticks_in(run_s, period_s);
    const long   command_ticks = ticks_in(command_s, period_s);
    while (!running(run)) {
        const long tick = run.bench().tick();
        if (tick == speed_tick) {
            run.set_speed(speed_tenths);
        } else if (tick == run_tick) {
            run.set_run();
        }
        const bool alive = run.step();
        if (!alive || tick > run_tick + command_ticks) {
            const app_status_t s   = run.status();
            std::string        why = fmt::format(
                       "--board: the drive does not come to RUN: mode {}, {}, drive: {}, board faults {}",
                       static_cast<int>(s.mode), fault_name(app_fault_base + static_cast<int>(s.fault)),
                       fault_name(s.drive_fault), s.board_faults);
            for (const std::string &finding : run.findings()) {
                why += "; " + finding;
            }
            throw InputError(why);
        }
    }
    return run.bench().tick();
}

/// The commanded speed tick by tick; the commands leave as much earlier as they take.
class Commands {
public:
    Commands(const Scenario &s, long ticks, long latency_ticks)
        : reference_(s.speed_reference, s.initial_speed_e_radps), ticks_(ticks),
          latency_ticks_(latency_ticks),
          command_ticks_(ticks_in(command_s, control_period_s(s.drive))),
          chat_ticks_(ticks_in(chat_s, control_period_s(s.drive))),
          now_tenths_(tenths_of(reference_.at(0.0))), period_s_(control_period_s(s.drive))
    {
        find_next(1);
    }
    /// After tick k of the scenario.
    void after(long k, BoardRun &run)
    {
        if (k + latency_ticks_ >= next_tick_) {
            if (!run.can_command() || k + latency_ticks_ > next_tick_) {
                throw InputError("--board: speed commands follow each other too fast for the "
                                 "serial line");
            }
            run.set_speed(next_tenths_);
            now_tenths_ = next_tenths_;
            find_next(next_tick_ + 1);
        } else if (k % chat_ticks_ == 0 && k + latency_ticks_ + command_ticks_ < next_tick_ &&
                   run.can_command()) {
            run.chat();
        }
    }

private:
    void find_next(long from)
    {
        next_tick_ = ticks_ + latency_ticks_ + command_ticks_ + 1;
        for (long k = from; k < ticks_; k++) {
            const int tenths = tenths_of(reference_.at(static_cast<double>(k) * period_s_));
            if (tenths != now_tenths_) {
                next_tick_   = k;
                next_tenths_ = tenths;
                return;
            }
        }
    }

    StepCursor reference_;
    long       ticks_;
    long       latency_ticks_;
    long       command_ticks_;
    long       chat_ticks_;
    int        now_tenths_;
    int        next_tenths_ = 0;
    double     period_s_;
    long       next_tick_ = 0;
};

/// Breaks the processor when its time has come.
void inject_faults(const Scenario &s, double time_s, double period_s, BoardRun &run)
{
    for (const InjectedFault &f : s.faults) {
        if (needs_processor(f.kind) && std::abs(f.time_s - time_s) < 0.5 * period_s) {
            run.inject(f.kind);
        }
    }
}

int present_fault(const BoardRun &run)
{
    const app_status_t s = run.status();
    return s.fault == APP_FAULT_NONE    ? 0
           : s.fault == APP_FAULT_DRIVE ? static_cast<int>(s.drive_fault)
                                        : app_fault_base + static_cast<int>(s.fault);
}

} // namespace

BoardResult simulate_on_board(const Scenario &s, BoardKind kind)
{
    return simulate_on_board(s, kind, prepare_controller(s));
}

BoardResult simulate_on_board(const Scenario &scenario, BoardKind kind,
                              const Controller &controller)
{
    return simulate_on_board(
        scenario,
        [&](const BoardScenario &b, long start_tick) {
            set_firmware(controller.config, b.scenario.drive);
            return make_run(b, kind, start_tick);
        },
        controller);
}

BoardResult simulate_on_board(const Scenario &scenario, const PowerUp &power_up,
                              const Controller &controller)
{
    const BoardScenario b = for_board(scenario);
    const Scenario     &s = b.scenario;

    StepCursor  reference(s.speed_reference, s.initial_speed_e_radps);
    const int   first_tenths = tenths_of(reference.at(0.0));
    BoardResult out;
    out.notes = b.notes;
    // In the rehearsal the shaft passes the encoder's edges at other times. They take their time in the firmware, so that a
    // command on the limit of two ticks may be read in the other one. The later start holds then.
    std::unique_ptr<BoardRun> run;
    const auto                begin = [&](long start) {
        run.reset();
        run = power_up(b, start);
        return bring_to_run(*run, first_tenths);
    };
    long start_tick = begin(MotorBench::never);
    long began      = begin(start_tick);
    if (began > start_tick) {
        start_tick = began;
        began      = begin(start_tick);
    }
    const bool waits = began < start_tick;
    if (began > start_tick || began + 1 < start_tick || (waits && !run->step())) {
        throw InputError("--board: the start of the firmware does not repeat itself");
    }
    const MotorBench &bench = run->bench();
    // The first command waits until the gates' supplies are charged, those of a running drive do not.
    const long latency_ticks = start_tick - ticks_in(run_s, control_period_s(s.drive)) -
                               board_constants(s.drive).config.gate.precharge_ticks;
    Commands commands(s, ticks_of(s), latency_ticks);
    out.result                = run_ticks(s, controller, [&](double time_s, double omega_ref) {
        // The board stands at the tick: the application has answered its samples.
        TickEnd end;
        end.row = row_of(time_s, omega_ref, bench.plant_state());
        add_drive(end.row, run->drive());
        end.fault            = present_fault(*run);
        const RawSample &raw = bench.sample();
        out.ticks.push_back(
                           {{raw.ia_code, raw.ib_code}, raw.count, run->duty_cnt(), bench.bridge_on()});
        commands.after(bench.tick() - start_tick, *run);
        inject_faults(s, time_s, bench.period_s(), *run);
        const bool alive = run->step();
        end.ended        = !alive ? device_reset_fault : bench.runaway() ? runaway_fault : 0;
        end.row.peak_current_A =
            end.ended == runaway_fault ? instant_A(end.row) : bench.peak_current_A();
        return end;
    });
    const app_status_t status = run->status();
    out.zero_a_cnt            = static_cast<double>(status.zero_a_cnt);
    out.zero_b_cnt            = static_cast<double>(status.zero_b_cnt);
    out.findings              = run->findings();
    out.modbus_answers        = run->answers();
    out.modbus_errors         = run->errors();
    if (bench.driven_while_held()) {
        out.findings.emplace_back("the bridge was on while the shaft was held");
    }
    return out;
}

} // namespace sdre
