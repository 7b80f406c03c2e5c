// SPDX-License-Identifier: MIT
#include "stm32g431/served_image.hpp"

#include "common/errors.hpp"
#include "stm32g431/image_scenario.hpp"

namespace iss::stm32g431 {
namespace {

constexpr double longest_boot_s = 0.5; // beyond the longest boot

sdre::Scenario with_three_shunts(sdre::Scenario s)
{
    s.sensors.current_sensors = 3;
    return s;
}

} // namespace

ServedImage::ServedImage(const sdre::Drive &drive, const sdre::Machine &machine, std::uint64_t seed,
                         const Program &program)
    : ServedDrive(with_three_shunts(sdre::bench_scenario(drive, machine, seed))), program_(program),
      circuit_(bench(), scenario().drive, false), chip_(program.image, circuit_)
{
    require_constants(program, drive);
    start();
}

void ServedImage::start()
{
    const double end_s = chip_.time_s() + longest_boot_s;
    for (const long before = bench().tick(); bench().tick() == before;) {
        if (chip_.time_s() > end_s) {
            throw sdre::InputError("serve: the image does not start" +
                                   (findings().empty() ? "" : ": " + findings().front()));
        }
        chip_.run_for(period_s());
    }
}

void ServedImage::period()
{
    set_load();
    chip_.open_home_switch(home_is_open());
    const int before = chip_.resets();
    chip_.run_for(period_s());
    if (chip_.resets() != before) {
        resets_ += chip_.resets() - before;
        forget_processor_faults();
    }
}

void ServedImage::power_cycle()
{
    forget_processor_faults();
    chip_.power_cycle();
    start();
}

void ServedImage::break_processor(sdre::FaultKind kind)
{
    break_chip(chip_, program_, kind);
}

} // namespace iss::stm32g431
