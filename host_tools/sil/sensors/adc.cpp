// SPDX-License-Identifier: MIT
#include "sil/sensors/adc.hpp"

#include <algorithm>
#include <cstdint>

namespace sdre {
namespace {

/// Codes of one sign: 2^(bits - 1).
double half_codes(const AdcChannel &c)
{
    return static_cast<double>(std::int64_t{1} << (c.bits - 1));
}

double lsb_A(const AdcChannel &c)
{
    return c.full_scale_A / half_codes(c);
}

/// std::round() of what is within the codes: quick, because it needs no library.
int rounded(double x)
{
    const int    whole = static_cast<int>(x);
    const double rest  = x - whole;
    return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
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

AdcChannel channel_c(const SensorSettings &s)
{
    return {s.adc_bits, s.adc_full_scale_A, s.adc_noise_rms_A, s.adc_offset_c_A, s.adc_gain_c};
}

int adc_code(const AdcChannel &c, double current_A, Noise &noise)
{
    const double signal = c.gain * current_A + c.offset_A + c.noise_rms_A * noise.next();
    const double lowest = -half_codes(c);
    const double code   = signal / lsb_A(c);
    // Written so that what is no number is a code too.
    return rounded(code > lowest ? std::min(code, -lowest - 1.0) : lowest); // EQ-ADC-1
}

double adc_current_A(const AdcChannel &c, int code)
{
    return lsb_A(c) * code;
}

} // namespace sdre
