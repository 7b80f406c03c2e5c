// SPDX-License-Identifier: MIT
/// The 24 V motor in the tests of tests/served.
#pragma once

namespace sdre {

/// Largest speeds of images that are loaded: not those of the shipped drive.
constexpr double first_image_e_radps  = 1300.0;
constexpr double second_image_e_radps = 1400.0;
constexpr double speed_band_rpm       = 12.0; ///< of a few readings; a light rotor
constexpr double sine_band_e_radps    = 2.0; ///< rms; measured: 1.55, a light rotor with 1000 lines
constexpr double coasting_s      = 0.03; ///< from 600 r/min it still turns; a quick stop has ended
constexpr double to_rest_s       = 0.5;
constexpr int    counts_per_turn = 4000; ///< four times the lines

} // namespace sdre
