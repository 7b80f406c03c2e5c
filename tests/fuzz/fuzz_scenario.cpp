// SPDX-License-Identifier: MIT
/// Scenario files, where the shipped ones are: a drive's path is relative.
#include <filesystem>

#include "reader.hpp"
#include "sil/setup/scenario.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const bool there = (std::filesystem::current_path(SDRE_SCENARIOS), true);
    static_cast<void>(there);
    return fuzz::read(data, size,
                      [](const auto &file) { static_cast<void>(sdre::read_scenario_file(file)); });
}
