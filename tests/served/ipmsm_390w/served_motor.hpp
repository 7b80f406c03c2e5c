// SPDX-License-Identifier: MIT
/// The 390 W motor in the tests of tests/served.
#pragma once

namespace sdre {

/// Largest speeds of images that are loaded: not those of the shipped drive.
constexpr double first_image_e_radps  = 300.0;
constexpr double second_image_e_radps = 400.0;
constexpr double speed_band_rpm       = 3.0;
constexpr double sine_band_e_radps    = 0.3;
constexpr double coasting_s      = 1.5; ///< from 600 r/min it still turns; a quick stop has ended
constexpr double to_rest_s       = 8.5;
constexpr int    counts_per_turn = 10000; ///< four times the lines

} // namespace sdre
