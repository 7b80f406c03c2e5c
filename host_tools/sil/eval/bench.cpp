// SPDX-License-Identifier: MIT
#include "sil/eval/bench.hpp"

#include <algorithm>
#include <ctime>
#include <limits>

#include <fmt/format.h>

#include "common/data_files.hpp"
#include "sil/eval/pi_foc.hpp"
#include "sil/run/recording.hpp"
#include "sil/run/simulation.hpp"

namespace sdre {
namespace {

// Chosen: the best of a few runs is the one that the machine's other work disturbed least.
constexpr int repeats = 5;

/// Processor time of this thread: other programs do not count.
double thread_time_s()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work> double best_time_s(const Work &work)
{
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeats; i++) {
        const double start = thread_time_s();
        work();
        best = std::min(best, thread_time_s() - start);
    }
    return best;
}

struct Speed {
    double sim_per_s = 0.0;
    double tick_s    = 0.0; ///< one control period of simulation, everything in
    int    fault     = 0;
};

Speed speed_of(const Scenario &s, const Controller &controller)
{
    Speed        speed;
    std::size_t  ticks  = 0;
    const double time_s = best_time_s([&] {
        const SimulationResult result = simulate(s, controller);
        ticks                         = result.trace.size();
        speed.fault                   = result.fault;
    });
    speed.tick_s        = time_s / static_cast<double>(ticks);
    speed.sim_per_s     = control_period_s(s.drive) / speed.tick_s;
    return speed;
}

template <typename Tick> double tick_ns(const Recording &r, const Tick &tick)
{
    volatile float sink = 0.0F; // the result is used, so that the work is done
    const double   s    = best_time_s([&] {
        for (std::size_t k = 0; k < r.samples.size(); k++) {
            sink = tick(k).duty.a;
        }
    });
    static_cast<void>(sink);
    return 1e9 * s / static_cast<double>(r.samples.size());
}

} // namespace

std::filesystem::path default_bench_scenario()
{
    return data_file("host_tools/sil/scenarios/fig5_load_step.toml");
}

std::string bench_text(const std::filesystem::path &file)
{
    Scenario         ideal      = read_scenario_file(file);
    const Controller controller = prepare_controller(ideal);
    Scenario         averaged   = ideal;
    averaged.sensors.ideal      = false;
    averaged.inverter.model     = InverterModel::averaged;
    Scenario switched           = averaged;
    switched.inverter.model     = InverterModel::switched;

    const Recording      r = record(averaged, controller);
    drive_t              drive{};
    const double         core_ns = tick_ns(r, [&](std::size_t k) {
        if (k == 0) {
            drive_init(&drive, &controller.config);
        }
        return drive_tick(&drive, &r.samples[k], &r.commands[k]);
    });
    const pi_foc_gains_t gains   = pi_foc_gains(averaged.drive);
    pi_foc_t             pi{};
    pi_foc_init(&pi, &gains);
    const double pi_ns =
        tick_ns(r, [&](std::size_t k) { return pi_foc_tick(&pi, &r.samples[k], &r.commands[k]); });

    std::string text = fmt::format("{}, one core, best of {}\n", ideal.name, repeats);
    const auto  line = [&](const char *name, const Scenario &s) {
        const Speed speed = speed_of(s, controller);
        text += fmt::format(
             "{:<18}{:8.0f} simulated s/s {:8.0f} ns per period, core {:.0f} %{}\n", name,
             speed.sim_per_s, 1e9 * speed.tick_s, 100.0 * core_ns / (1e9 * speed.tick_s),
            speed.fault != 0 ? fmt::format(" (fault: {})", fault_name(speed.fault)) : "");
    };
    line("ideal", ideal);
    line("averaged inverter", averaged);
    line("switched inverter", switched);
    text += fmt::format("drive_tick {:.0f} ns, plain PI-FOC {:.0f} ns, ratio {:.2f}\n", core_ns,
                        pi_ns, core_ns / pi_ns);
    return text;
}

} // namespace sdre
