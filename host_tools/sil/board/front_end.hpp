// SPDX-License-Identifier: MIT
/// The electronics between the motor's quantities and the converter's pins (docs/hardware.md). It
/// is independent of the firmware's scaling, so that an error there cannot cancel here.
#pragma once

#include <algorithm>
#include <cmath>

namespace sdre::f28335 {

constexpr int adc_codes        = 4096;
constexpr int adc_middle       = 2048; ///< no current: half of the 3 V
constexpr int temperature_code = 3357; ///< 25 degC

inline int current_code(int signed_code)
{
    return signed_code + adc_middle;
}

/// @param range_V Gives 3 V.
inline int dc_link_code(double V, double range_V)
{
    const double code = std::floor(adc_codes * V / range_V);
    return static_cast<int>(code > 0.0 ? std::min(code, adc_codes - 1.0) : 0.0);
}

/// The middle of the voltages that give a code.
inline double voltage_V(int code)
{
    return 3.0 * (code + 0.5) / adc_codes;
}

} // namespace sdre::f28335
