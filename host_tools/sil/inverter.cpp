// SPDX-License-Identifier: MIT
#include "inverter.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: below this current the diodes' rail voltage fades out, so that the averaged model comes to rest.
constexpr double diode_fade_A = 0.05;

StatorVector clarke(double a, double b, double c)
{
    return {(2.0 * a - b - c) / 3.0, (b - c) / std::sqrt(3.0)};
}

double diode_share(double current_A)
{
    return -0.5 * std::clamp(current_A / diode_fade_A, -1.0, 1.0);
}

} // namespace

StatorVector inverter_voltage(const drive_output_t &output, double dc_link_V, StatorVector i)
{
    StatorVector share;
    if (output.gate_enable) {
        share = clarke(output.duty.a, output.duty.b, output.duty.c); // EQ-INVERTER-1
    } else {
        const double half_beta = 0.5 * std::sqrt(3.0) * i.beta;
        share = clarke(diode_share(i.alpha), diode_share(half_beta - 0.5 * i.alpha),
                       diode_share(-half_beta - 0.5 * i.alpha));
    }
    return {dc_link_V * share.alpha, dc_link_V * share.beta};
}

} // namespace sdre
