// SPDX-License-Identifier: MIT
#include "sil/plant/motor_effects.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

// Chosen: far below any effect on the current, above the rounding of L i.
constexpr double flux_tolerance = 1e-13;
// Measured: 3 Newton steps suffice from the current of the step before; the rest is margin.
constexpr int newton_steps = 20;

/// Where x lies on an increasing axis: the cell and the share of it, at the edge when outside.
struct Place {
    std::size_t cell;
    double      share;
};

Place place_on(const std::vector<double> &axis, double x)
{
    std::size_t i = 0;
    while (i + 2 < axis.size() && x >= axis[i + 1]) {
        i++;
    }
    return {i, std::clamp((x - axis[i]) / (axis[i + 1] - axis[i]), 0.0, 1.0)};
}

/// Written so that equal corners give exactly their value.
double bilinear(const std::vector<double> &table, std::size_t width, Place d, Place q)
{
    const double *row  = table.data() + d.cell * width + q.cell;
    const double *next = row + width;
    const double  lo   = row[0] + q.share * (row[1] - row[0]);
    const double  hi   = next[0] + q.share * (next[1] - next[0]);
    return lo + d.share * (hi - lo);
}

RotorVector flux_of(const SaturationMap &map, RotorVector i)
{
    const RotorVector L = inductance_H(map, i);
    return {L.d * i.d, L.q * i.q};
}

} // namespace

bool any_effect(const MotorEffects &e)
{
    return e.saturation || e.flux || e.cogging_amplitude_Nm != 0.0 ||
           e.coulomb_friction_Nm != 0.0 || e.static_friction_Nm != 0.0 ||
           e.load_inertia_share != 0.0 || e.flux_5th != 0.0 || e.flux_7th != 0.0 ||
           e.iron_hysteresis_Nm != 0.0 || e.iron_eddy_Nms != 0.0;
}

double cogging_Nm(const MotorEffects &e, double theta_e_rad, int pole_pairs) // EQ-EFFECTS-2
{
    if (e.cogging_amplitude_Nm == 0.0) {
        return 0.0;
    }
    const double angle  = e.cogging_order * theta_e_rad / pole_pairs;
    double       torque = e.cogging_amplitude_Nm * std::sin(angle);
    if (e.cogging_second_Nm != 0.0) {
        torque += e.cogging_second_Nm * std::sin(2.0 * angle + e.cogging_second_rad);
    }
    return torque;
}

double friction_Nm(const MotorEffects &e, double omega_m_radps) // EQ-EFFECTS-3
{
    if (e.static_friction_Nm == 0.0) {
        return e.coulomb_friction_Nm;
    }
    const double share = omega_m_radps / e.stribeck_speed_m_radps;
    return e.coulomb_friction_Nm +
           (e.static_friction_Nm - e.coulomb_friction_Nm) * std::exp(-share * share);
}

MagnetFlux magnet_flux(const MotorEffects &e, double pm_flux_Wb, double theta_e_rad)
{
    if (e.flux_5th == 0.0 && e.flux_7th == 0.0) {
        return {{pm_flux_Wb, 0.0}, {}};
    }
    const double d = pm_flux_Wb * (e.flux_7th + e.flux_5th); // EQ-EFFECTS-5
    const double q = pm_flux_Wb * (e.flux_7th - e.flux_5th);
    const double c = std::cos(6.0 * theta_e_rad);
    const double s = std::sin(6.0 * theta_e_rad);
    return {{pm_flux_Wb + d * c, q * s}, {-6.0 * d * s, 6.0 * q * c}};
}

SaturationMap scaled(SaturationMap map, double ld_factor, double lq_factor)
{
    for (double &x : map.ld_H) {
        x *= ld_factor;
    }
    for (double &x : map.lq_H) {
        x *= lq_factor;
    }
    return map;
}

RotorVector inductance_H(const SaturationMap &map, RotorVector i)
{
    const Place d = place_on(map.id_A, i.d);
    const Place q = place_on(map.iq_A, i.q);
    return {bilinear(map.ld_H, map.iq_A.size(), d, q), bilinear(map.lq_H, map.iq_A.size(), d, q)};
}

RotorVector saturated_current_A(const SaturationMap &map, RotorVector flux, RotorVector guess)
{
    const RotorVector L = inductance_H(map, guess);
    // The answer where L does not change, with the bits of the linear motor's reciprocals.
    RotorVector  i         = {flux.d * (1.0 / L.d), flux.q * (1.0 / L.q)};
    const double tolerance = flux_tolerance * (1.0 + std::abs(flux.d) + std::abs(flux.q));
    for (int n = 0; n < newton_steps; n++) {
        const RotorVector found = flux_of(map, i);
        const double      rd    = found.d - flux.d;
        const double      rq    = found.q - flux.q;
        if (std::abs(rd) + std::abs(rq) <= tolerance) {
            break;
        }
        constexpr double  step_A = 1e-6; // for the slope of the flux; L is piecewise smooth
        const RotorVector by_d   = flux_of(map, {i.d + step_A, i.q});
        const RotorVector by_q   = flux_of(map, {i.d, i.q + step_A});
        const double      dd     = (by_d.d - found.d) / step_A;
        const double      qd     = (by_d.q - found.q) / step_A;
        const double      dq     = (by_q.d - found.d) / step_A;
        const double      qq     = (by_q.q - found.q) / step_A;
        const double      det    = dd * qq - dq * qd;
        i.d -= (qq * rd - dq * rq) / det;
        i.q -= (dd * rq - qd * rd) / det;
    }
    return i;
}

RotorVector saturated_current_A(const SaturatedMotor &motor, RotorVector flux, RotorVector guess)
{
    RotorVector  i         = guess;
    const double tolerance = flux_tolerance * (1.0 + std::abs(flux.d) + std::abs(flux.q));
    for (int n = 0; n < newton_steps; n++) {
        const FluxAt found = motor.at(i.d, i.q);
        const double rd    = found.d_Wb - motor.magnet_Wb() - flux.d;
        const double rq    = found.q_Wb - flux.q;
        if (std::abs(rd) + std::abs(rq) <= tolerance) {
            break;
        }
        const auto step = by_inductance(found, rd, rq);
        i.d -= step[0];
        i.q -= step[1];
    }
    return i;
}

double drifted(double value, double share_per_s, double time_s)
{
    return value * std::max(0.01, 1.0 + share_per_s * time_s);
}

} // namespace sdre
