// SPDX-License-Identifier: MIT
#include "facts/fact_units.hpp"

#include <cmath>

namespace sdre {
namespace {

const double rpm = std::acos(-1.0) / 30.0;

constexpr double pound_kg   = 0.45359237;
constexpr double inch_m     = 0.0254;
constexpr double standard_g = 9.80665;
constexpr double ounce_kg   = pound_kg / 16.0;
constexpr double ounce_N    = ounce_kg * standard_g;
constexpr double pound_N    = pound_kg * standard_g;
constexpr double foot_m     = 12.0 * inch_m;

} // namespace

const std::vector<Unit> &fact_units()
{
    using D = Dimension;
    static const std::vector<Unit> units{{D::count, "", 1.0},
                                         {D::resistance, "ohm", 1.0},
                                         {D::resistance, "mohm", 1e-3},
                                         {D::resistance, "uohm", 1e-6},
                                         {D::inductance, "h", 1.0},
                                         {D::inductance, "mh", 1e-3},
                                         {D::inductance, "uh", 1e-6},
                                         {D::flux, "vs", 1.0},
                                         {D::flux, "wb", 1.0},
                                         {D::flux, "mvs", 1e-3},
                                         {D::flux, "mwb", 1e-3},
                                         {D::emf_per_speed, "v_per_krpm", 1e-3 / rpm},
                                         {D::emf_per_speed, "v_per_1000rpm", 1e-3 / rpm},
                                         {D::emf_per_speed, "v_per_rpm", 1.0 / rpm},
                                         {D::emf_per_speed, "mv_per_rpm", 1e-3 / rpm},
                                         {D::emf_per_speed, "v_per_radps", 1.0},
                                         {D::emf_per_speed, "mv_per_radps", 1e-3},
                                         {D::emf_per_speed, "vs_per_rad", 1.0},
                                         {D::emf_per_speed, "mvs_per_rad", 1e-3},
                                         {D::speed_per_volt, "rpm_per_v", rpm},
                                         {D::speed_per_volt, "radps_per_v", 1.0},
                                         {D::torque_per_current, "nm_per_a", 1.0},
                                         {D::torque_per_current, "mnm_per_a", 1e-3},
                                         {D::torque_per_current, "ncm_per_a", 1e-2},
                                         {D::torque_per_current, "ozin_per_a", ounce_N * inch_m},
                                         {D::torque_per_current, "lbin_per_a", pound_N * inch_m},
                                         {D::torque_per_current, "lbft_per_a", pound_N * foot_m},
                                         {D::inertia, "kgm2", 1.0},
                                         {D::inertia, "kgcm2", 1e-4},
                                         {D::inertia, "gm2", 1e-3},
                                         {D::inertia, "gcm2", 1e-7},
                                         {D::inertia, "kgmm2", 1e-6},
                                         {D::inertia, "gmm2", 1e-9},
                                         {D::inertia, "mkgm2", 1e-3},
                                         {D::inertia, "nms2", 1.0},
                                         {D::inertia, "ozin2", ounce_kg * inch_m * inch_m},
                                         {D::inertia, "lbin2", pound_kg * inch_m * inch_m},
                                         {D::inertia, "lbft2", pound_kg * foot_m * foot_m},
                                         {D::inertia, "ozins2", ounce_N * inch_m},
                                         {D::inertia, "lbins2", pound_N * inch_m},
                                         {D::friction, "nms", 1.0},
                                         {D::friction, "nms_per_rad", 1.0},
                                         {D::friction, "nm_per_radps", 1.0},
                                         {D::friction, "mnms", 1e-3},
                                         {D::friction, "mnms_per_rad", 1e-3},
                                         {D::friction, "nm_per_krpm", 1e-3 / rpm},
                                         {D::friction, "mnm_per_krpm", 1e-6 / rpm},
                                         {D::friction, "nm_per_rpm", 1.0 / rpm},
                                         {D::speed, "rpm", rpm},
                                         {D::speed, "krpm", 1e3 * rpm},
                                         {D::speed, "radps", 1.0},
                                         {D::speed, "rad_per_s", 1.0},
                                         {D::speed, "rps", 60.0 * rpm},
                                         {D::speed, "e_radps", 1.0, true},
                                         {D::speed, "e_hz", 60.0 * rpm, true},
                                         {D::speed, "hz", 60.0 * rpm, true},
                                         {D::torque, "nm", 1.0},
                                         {D::torque, "mnm", 1e-3},
                                         {D::torque, "knm", 1e3},
                                         {D::torque, "ncm", 1e-2},
                                         {D::torque, "ozin", ounce_N * inch_m},
                                         {D::torque, "lbin", pound_N * inch_m},
                                         {D::torque, "lbft", pound_N * foot_m},
                                         {D::torque, "kgfcm", standard_g * 1e-2},
                                         {D::current, "a", 1.0},
                                         {D::current, "ma", 1e-3},
                                         {D::current, "ka", 1e3},
                                         {D::power, "w", 1.0},
                                         {D::power, "kw", 1e3},
                                         {D::power, "hp", 550.0 * pound_N * foot_m},
                                         {D::voltage, "v", 1.0},
                                         {D::voltage, "mv", 1e-3},
                                         {D::voltage, "kv", 1e3},
                                         {D::frequency, "hz", 1.0},
                                         {D::frequency, "khz", 1e3},
                                         {D::time, "s", 1.0},
                                         {D::time, "ms", 1e-3},
                                         {D::time, "us", 1e-6},
                                         {D::time, "ns", 1e-9},
                                         {D::motor_constant, "nm_per_sqrtw", 1.0},
                                         {D::motor_constant, "mnm_per_sqrtw", 1e-3}};
    return units;
}

std::string unit_names(Dimension dimension)
{
    std::string names;
    for (const Unit &unit : fact_units()) {
        if (unit.dimension == dimension) {
            names += (names.empty() ? "" : ", ") + unit.name;
        }
    }
    return names;
}

} // namespace sdre
