// SPDX-License-Identifier: MIT
#include "design/firmware_config.hpp"

#include <algorithm>
#include <cmath>

#include "design/sampled_model.hpp"
#include "design/trip_levels.hpp"

namespace sdre {
namespace {

// Chosen: 2.5 % of the current limit, ten times the rms noise of the shipped board's sensors.
constexpr double dead_time_fade_ratio = 0.025;

/// The MTPA curve has this current at the rated torque. It is within the current limit.
double rated_current_A(const Design &d)
{
    const Motor &m    = d.drive.motor;
    const double iq_A = mtpa_iq_A(m, d.l, m.rated_torque_Nm, m.max_current_A);
    return std::min(std::hypot(iq_A, mtpa_id_A(d.l, iq_A)), m.max_current_A);
}

} // namespace

drive_config_t common_config(const Design &d)
{
    const Motor             &m   = d.drive.motor;
    const Inverter          &inv = d.drive.inverter;
    const ReducedParameters &l   = d.l;

    drive_config_t c{};
    c.ts_s               = single(control_period_s(d.drive));
    c.current_max_A      = single(m.max_current_A);
    c.rated_current_A    = single(rated_current_A(d));
    c.rated_torque_Nm    = single(m.rated_torque_Nm);
    c.trip_current_A     = single(trip_current_A(d.drive));
    c.trip_speed_e_radps = single(trip_speed_e_radps(d.drive));
    c.speed_max_e_radps  = single(largest_command_e_radps(d.drive));
    c.dc_link_min_V      = single(trip_dc_link_min_V(d.drive));
    c.dc_link_max_V      = single(trip_dc_link_max_V(d.drive));
    c.positions          = d.drive.position.has_value();
    c.torques            = d.drive.torque && takes_torque(d.drive);
    c.overmodulation     = inv.overmodulation;

    c.motor = {single(l[1]),  single(l[2]),       single(l[3]),      single(l[4]), single(l[5]),
               single(l[6]),  single(l[7]),       single(l[8]),      single(l[9]), single(l[10]),
               single(l[11]), single(1.0 / l[6]), single(1.0 / l[8])};

    c.dead_time.share =
        single(inv.dead_time_compensation ? inv.dead_time_s * inv.pwm_frequency_Hz : 0.0);
    c.dead_time.inv_fade_1pA = single(1.0 / (dead_time_fade_ratio * m.max_current_A));

    c.hardware.encoder_positions  = 4U * static_cast<std::uint32_t>(d.drive.encoder.lines);
    c.hardware.pole_pairs         = static_cast<std::uint16_t>(m.pole_pairs);
    c.hardware.updates_per_period = static_cast<std::uint16_t>(inv.updates_per_period);
    c.hardware.dead_time_s        = single(inv.dead_time_s);
    c.hardware.edge_times         = d.drive.encoder.edge_times;
    return c;
}

} // namespace sdre
