// SPDX-License-Identifier: MIT
/// Constants of the application and of the board layer, from the drive file (EQ-BOARD-1 to
/// 8).
#pragma once

#include <array>
#include <string>

#include "drive/drive_file.hpp"

extern "C" {
#include "app_config.h"
}

namespace sdre {

constexpr std::size_t ntc_points = 28;

/// The application's constants. They own the table of temperatures and the names. config points
/// into them, so a moved object needs bind().
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

/// Largest trip levels: what the converters show, since one beyond would never act, and the board's own limits.
double largest_trip_current_A(const Drive &drive);
double largest_trip_dc_link_V(const Drive &drive);

} // namespace sdre
