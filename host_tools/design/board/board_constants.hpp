// SPDX-License-Identifier: MIT
/// What the application and the board layer of the F28335 have to know of a drive, from its file (EQ-BOARD-1 to 6).
#pragma once

#include <array>
#include <string>

#include "drive/drive_file.hpp"

extern "C" {
#include "app_config.h"
}

namespace sdre {

constexpr std::size_t ntc_points = 28;

/// The application's constants. The table of temperatures and the names belong to them: config points into them, so that an
/// object can be moved only with its pointers (bind()).
struct BoardConstants {
    app_config_t                  config{};
    std::array<float, ntc_points> ntc_degC{};
    std::string                   drive_name;
    std::string                   digest;

    /// The constants, with pointers into this object.
    const app_config_t &bind()
    {
        config.scale.ntc_degC = ntc_degC.data();
        config.drive_name     = drive_name.c_str();
        config.digest         = digest.c_str();
        return config;
    }
};

/// InputError in one line on the first quantity that the board cannot do or show, with what it can.
BoardConstants board_constants(const Drive &drive);

/// What the converters show at most: a trip beyond would never come.
double largest_shown_current_A(const Drive &drive);
double largest_shown_dc_link_V(const Drive &drive);

} // namespace sdre
