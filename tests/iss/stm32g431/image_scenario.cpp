// SPDX-License-Identifier: MIT
#include "stm32g431/image_scenario.hpp"

#include <algorithm>
#include <ctime>
#include <memory>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "sil/board/board_scenario.hpp"
#include "sil/run/controller.hpp"

namespace iss::stm32g431 {
namespace {

std::string share(const char *what, std::uint64_t worst, std::uint64_t median, double period)
{
    return fmt::format("  {:<34}{:>7}{:>7.1f} %{:>9}{:>7.1f} %\n", what, worst,
                       100.0 * static_cast<double>(worst) / period, median,
                       100.0 * static_cast<double>(median) / period);
}

} // namespace

sdre::Scenario with_three_shunts(sdre::Scenario s)
{
    s.sensors.current_sensors = 3;
    for (sdre::PlantChange &change : s.changes) {
        if (change.sensors) {
            change.sensors->current_sensors = 3;
        }
    }
    return s;
}

Program read_program(const std::filesystem::path &image)
{
    return {read_elf(image), read_elf(ISS_LAYOUT)};
}

/// The digest of the drive file is among the constants.
void require_constants(const Program &program, const sdre::Drive &drive)
{
    const std::string digest = sdre::drive_digest(drive);
    const bool        has    = std::any_of(
                  program.image.segments.begin(), program.image.segments.end(), [&](const ElfSegment &s) {
            return std::search(s.octets.begin(), s.octets.end(), digest.begin(), digest.end()) !=
                   s.octets.end();
        });
    if (!has) {
        throw sdre::InputError(
            fmt::format("the image has the constants of another drive than {} ({}): build it with "
                        "the tables of this one (-DSDRE_TABLES=DIR)",
                        drive.name, digest));
    }
}

ImageResult simulate_image(const sdre::Scenario &scenario, const Program &program)
{
    require_constants(program, sdre::believed_drive(scenario));
    const sdre::Scenario        s          = with_three_shunts(scenario);
    const sdre::Controller      controller = sdre::prepare_controller(s);
    ImageResult                 out;
    std::unique_ptr<CycleMeter> meter;
    double                      rehearsed_s = 0.0;
    const std::clock_t          began       = std::clock();

    const auto power_up = [&](const sdre::BoardScenario &b, long start_tick) {
        auto run =
            std::make_unique<ImageRun>(b.scenario, start_tick, program, b.dead_time_s <= 0.0);
        if (start_tick != sdre::MotorBench::never) {
            meter =
                std::make_unique<CycleMeter>(run->chip().core(), program.image, [r = run.get()] {
                    return r->drive().state == DRIVE_RUN;
                });
            rehearsed_s = 2.0 * static_cast<double>(start_tick) * sdre::control_period_s(s.drive);
        }
        return run;
    };
    out.board         = sdre::simulate_on_board(s, power_up, controller);
    out.interrupts    = meter->runs();
    out.functions     = meter->functions();
    out.period_cycles = sdre::control_period_s(s.drive) * core_Hz;
    out.speed         = (rehearsed_s + static_cast<double>(out.board.result.trace.size()) *
                                   sdre::control_period_s(s.drive)) /
                (static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC);
    return out;
}

std::string cycles_text(const ImageResult &r)
{
    const auto line = [&](const char *what, const auto &of) {
        std::vector<std::uint64_t> all;
        for (const CycleMeter::Run &run : r.interrupts) {
            all.push_back(of(run));
        }
        std::sort(all.begin(), all.end());
        return all.empty() ? std::string{}
                           : share(what, all.back(), all[all.size() / 2U], r.period_cycles);
    };
    return fmt::format("control interrupt, worst and median of {} [cycles, of {:.0f}]\n",
                       r.interrupts.size(), r.period_cycles) +
           line("instructions alone", [](const CycleMeter::Run &x) { return x.cycles; }) +
           line("with the flash's waits, estimated",
                [](const CycleMeter::Run &x) { return x.estimate(); }) +
           line("without any cache, bound", [](const CycleMeter::Run &x) { return x.bound(); }) +
           fmt::format("simulator: {:.2f} of real time, by the time of the processor\n", r.speed);
}

} // namespace iss::stm32g431
