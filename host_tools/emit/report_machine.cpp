// SPDX-License-Identifier: MIT
#include "emit/report_machine.hpp"

#include <cmath>

#include <fmt/format.h>

#include "design/laws/near_optimal.hpp"
#include "design/machine_points.hpp"
#include "design/trip_levels.hpp"
#include "drive/mtpa_fit.hpp"

namespace sdre {
namespace {

double mechanical_rpm(const Drive &d, double omega_e_radps)
{
    return omega_e_radps / d.motor.pole_pairs * 30.0 / std::acos(-1.0);
}

std::string speed_text(const Drive &d, double omega_e_radps)
{
    return fmt::format("{:.1f} rad/s el. ({:.0f} r/min)", omega_e_radps,
                       mechanical_rpm(d, omega_e_radps));
}

std::string point_text(const Drive &d, const char *name, const MachinePoint &p)
{
    return fmt::format(
        "  {:<22} {:8.3f} N m up to {}, i_d {:.2f} A, i_q {:.2f} A, {:.1f} V, {:.0f} W\n", name,
        p.torque_Nm, speed_text(d, p.speed_e_radps), p.id_A, p.iq_A, p.voltage_V, p.power_W);
}

std::string fastest_text(const Drive &d, const MachinePoints &m)
{
    if (m.fastest.torque_Nm <= 0.0) {
        return fmt::format("  {:<22} none: the EMF leaves no voltage at {}\n",
                           "at the largest command", speed_text(d, m.fastest.speed_e_radps));
    }
    return fmt::format("  {:<22} {:8.3f} N m at {}, i_d {:.2f} A, i_q {:.2f} A, limited by {}\n",
                       "at the largest command", m.fastest.torque_Nm,
                       speed_text(d, m.fastest.speed_e_radps), m.fastest.id_A, m.fastest.iq_A,
                       m.mtpv ? "the voltage alone (MTPV)" : "current and voltage");
}

std::string trips_text(const Design &design)
{
    const drive_config_t &c      = design.config;
    const Motor          &m      = design.drive.motor;
    const bool            by_emf = static_cast<double>(c.speed_max_e_radps) <
                        0.9999 * (m.max_speed_e_radps > 0.0 ? m.max_speed_e_radps
                                                            : trip_speed_e_radps(design.drive));
    return fmt::format("  commands up to {}{}\n", speed_text(design.drive, c.speed_max_e_radps),
                       by_emf ? ", whose line EMF is the highest dc link (regeneration = \"none\")"
                              : "") +
           fmt::format("  trips at {}, {:.3g} A in a phase, dc link outside {:.1f} .. {:.1f} V\n",
                       speed_text(design.drive, c.trip_speed_e_radps), c.trip_current_A,
                       c.dc_link_min_V, c.dc_link_max_V);
}

/// The machine by the map of its iron: least currents, and what the drive's curve takes more.
std::string iron_text(const Drive &d)
{
    const FluxMap  &map   = *d.saturation;
    const Motor    &m     = d.motor;
    const MtpaPoint rated = least_current(map, m.pole_pairs, m.rated_torque_Nm, m.max_current_A);
    const MtpaPoint limit = most_torque(map, m.pole_pairs, m.max_current_A);
    const auto      point = [](const MtpaPoint &p) {
        return fmt::format("{:.3f} N m with {:.2f} A (i_d {:.2f}, i_q {:.2f})", p.torque_Nm,
                                p.current_A, p.id_A, p.iq_A);
    };
    const auto excess = [&](const MtpaCurve &curve) {
        return fmt::format("{:.1f} % at {:.3g} N m, {:.1f} % at most",
                           100.0 * excess_current(map, m.pole_pairs, curve, rated), rated.torque_Nm,
                           100.0 * largest_excess(map, m, curve));
    };
    std::string s = fmt::format("  saturated iron: {}, {}\n", point(rated), point(limit));
    if (m.mtpa.k_A > 0.0) {
        Motor constant = m;
        constant.mtpa  = {};
        const double k = std::max(mtpa_A(reduced_parameters(constant)), 1e-3 * m.max_current_A);
        s += fmt::format(
            "  current beyond the least: {}; with the curve of constant inductances {}\n",
            excess(m.mtpa), excess({k, false}));
    }
    return s;
}

std::string prediction_text(const Drive &d, const Prediction &p)
{
    return fmt::format(
               "  load step of {:.3g} N m at {}: dip {:.2f} rad/s, within {:.2g} rad/s after "
               "{:.1f} ms (linear model)\n",
               p.load_step_Nm, speed_text(d, p.speed_e_radps), p.dip_e_radps, p.band_e_radps,
               1e3 * p.settling_time_s) +
           fmt::format("  noise: 3 sigma of the speed {:.2g} rad/s, v_q {:.2g} V rms\n",
                       p.ripple_e_radps, p.voltage_noise_V);
}

Json point_json(const MachinePoint &p)
{
    return {{"torque_Nm", p.torque_Nm}, {"speed_e_radps", p.speed_e_radps}, {"id_A", p.id_A},
            {"iq_A", p.iq_A},           {"voltage_V", p.voltage_V},         {"power_W", p.power_W}};
}

} // namespace

std::string machine_text(const Design &design, const std::optional<Prediction> &prediction)
{
    const Drive        &d = design.drive;
    const MachinePoints m = machine_points(d);
    std::string         s = "\nmachine\n";
    s += d.saturation ? "  (with the inductances of [motor])\n" : "";
    s += point_text(d, "rated", m.rated);
    s += point_text(d, "at the current limit", m.limit);
    s += fastest_text(d, m);
    s += fmt::format("  line EMF at the largest command {:.0f} V of a dc link of {:g} V", m.emf_V,
                     d.inverter.dc_link_V);
    s += d.motor.pm_flux_Wb > 0.0
             ? fmt::format("; {:.2f} A of d current cancel the magnet\n", m.current_for_no_flux_A)
             : "; no magnet\n";
    s += d.saturation ? iron_text(d) : "";
    s += trips_text(design);
    return s + (prediction ? prediction_text(d, *prediction) : "");
}

Json machine_json(const Design &design, const std::optional<Prediction> &p)
{
    const MachinePoints m   = machine_points(design.drive);
    Json                out = {{"rated", point_json(m.rated)},
                               {"current_limit", point_json(m.limit)},
                               {"largest_command", point_json(m.fastest)},
                               {"largest_command_is_mtpv", m.mtpv},
                               {"line_emf_V", m.emf_V},
                               {"command_max_e_radps", largest_command_e_radps(design.drive)},
                               {"trip_speed_e_radps", trip_speed_e_radps(design.drive)},
                               {"trip_current_A", static_cast<double>(design.config.trip_current_A)}};
    if (p) {
        out["predicted"] = {
            {"speed_e_radps", p->speed_e_radps},     {"load_step_Nm", p->load_step_Nm},
            {"dip_e_radps", p->dip_e_radps},         {"band_e_radps", p->band_e_radps},
            {"settling_time_s", p->settling_time_s}, {"ripple_e_radps", p->ripple_e_radps},
            {"voltage_noise_V", p->voltage_noise_V}};
    }
    return out;
}

} // namespace sdre
