// SPDX-License-Identifier: MIT
#include "design/firmware_config.hpp"

#include <algorithm>
#include <cmath>

#include "design/board/board_constants.hpp"

namespace sdre {
namespace {

// Chosen: room for regeneration and for a weak supply; the board's hardware limits stand behind it.
constexpr double dc_link_min_ratio  = 0.3;
constexpr double dc_link_max_ratio  = 1.35;
constexpr double trip_current_ratio = 2.0;
// Chosen: 2.5 % of the current limit, ten times the rms noise of the shipped board's sensors.
constexpr double dead_time_fade_ratio = 0.025;

/// The speed at which the line EMF alone reaches the dc link's trip level through the diodes of an open bridge.
double emf_limit_e_radps(const Drive &d) // EQ-OPEN-3
{
    return dc_link_max_ratio * d.inverter.dc_link_V / (std::sqrt(3.0) * d.motor.pm_flux_Wb);
}

} // namespace

double largest_command_e_radps(const Drive &d)
{
    const double said =
        d.motor.max_speed_e_radps > 0.0 ? d.motor.max_speed_e_radps : trip_speed_e_radps(d);
    return d.inverter.regeneration == DcLinkSink::none ? std::min(said, emf_limit_e_radps(d))
                                                       : said;
}

drive_config_t common_config(const Design &d)
{
    const Motor             &m   = d.drive.motor;
    const Inverter          &inv = d.drive.inverter;
    const ReducedParameters &l   = d.l;

    drive_config_t c{};
    c.ts_s          = single(control_period_s(d.drive));
    c.current_max_A = single(m.max_current_A);
    c.trip_current_A =
        single(std::min(trip_current_ratio * m.max_current_A, largest_shown_current_A(d.drive)));
    c.trip_speed_e_radps = single(trip_speed_e_radps(d.drive));
    c.speed_max_e_radps  = single(largest_command_e_radps(d.drive));
    c.dc_link_min_V      = single(dc_link_min_ratio * inv.dc_link_V);
    c.dc_link_max_V =
        single(std::min(dc_link_max_ratio * inv.dc_link_V, largest_shown_dc_link_V(d.drive)));
    c.positions      = d.drive.position.has_value();
    c.overmodulation = inv.overmodulation;

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
