// SPDX-License-Identifier: MIT
/// A short closed-loop scenario as text, to be changed by a test.
#pragma once

#include <string>

namespace support {

/// A scenario on one of the shipped drives, constant speed and load, 20 ms.
inline std::string scenario_text(const std::string &drive = "ipmsm_390w_speed")
{
    return "drive = \"" + (std::string(SDRE_SOURCE_DIR) + "/firmware/config/drives/" + drive) +
           ".toml\"\n"
           "law = \"noc\"\n"
           "duration_s = 0.02\n"
           "initial_speed_e_radps = 100.0\n"
           "[sensors]\n"
           "ideal = true\n"
           "[controller_scale]\n"
           "[plant_scale]\n"
           "[[speed_reference]]\n"
           "time_s = 0.0\n"
           "value_e_radps = 100.0\n"
           "[[load_torque]]\n"
           "time_s = 0.0\n"
           "value_Nm = 0.5\n"
           "[[measure]]\n"
           "name = \"whole\"\n"
           "time_s = 0.0\n"
           "band_e_radps = 3.0\n";
}

} // namespace support
