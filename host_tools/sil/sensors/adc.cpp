// SPDX-License-Identifier: MIT
#include "sil/sensors/adc.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

double lsb_A(const AdcChannel &c)
{
    return std::ldexp(c.full_scale_A, 1 - c.bits);
}

} // namespace

AdcChannel channel_a(const SensorSettings &s)
{
    return {s.adc_bits, s.adc_full_scale_A, s.adc_noise_rms_A, s.adc_offset_a_A, s.adc_gain_a};
}

AdcChannel channel_b(const SensorSettings &s)
{
    return {s.adc_bits, s.adc_full_scale_A, s.adc_noise_rms_A, s.adc_offset_b_A, s.adc_gain_b};
}

int adc_code(const AdcChannel &c, double current_A, Noise &noise)
{
    const double signal  = c.gain * current_A + c.offset_A + c.noise_rms_A * noise.next();
    const double highest = std::ldexp(1.0, c.bits - 1) - 1.0;
    return static_cast<int>(
        std::clamp(std::round(signal / lsb_A(c)), -highest - 1.0, highest)); // EQ-ADC-1
}

double adc_current_A(const AdcChannel &c, int code)
{
    return lsb_A(c) * code;
}

} // namespace sdre
