// SPDX-License-Identifier: MIT
#include "sil/commission/report.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "common/json.hpp"
#include "facts/commissioned_text.hpp"
#include "facts/found_map.hpp"

namespace sdre {
namespace {

const double pi = std::acos(-1.0);

CommissionLine line(const char *name, const char *unit, double truth,
                    const commission_value_t &found)
{
    CommissionLine l{name, unit, truth, found.value, found.error};
    l.relative = truth != 0.0;
    l.error    = l.relative ? (l.found - truth) / truth : l.found;
    return l;
}

CommissionLine exact(const char *name, double truth, double found)
{
    return {name, "", truth, found, 0.0, found - truth, false};
}

std::string map_text(const std::string &name, const FoundMap::Row &l_H, double last_A)
{
    std::string s = fmt::format("  {:<17}", name);
    for (std::size_t k = 0; k < l_H.size(); k++) {
        s += fmt::format(
            "  {:.3g} A {:.4g} H",
            last_A * (2.0 * static_cast<double>(k) + 1.0) / (2.0 * COMMISSION_BINS - 1.0), l_H[k]);
    }
    return s + "\n";
}

std::string map_text(const FoundMap &map)
{
    const std::size_t last = COMMISSION_BINS - 1;
    const double      d_A  = map.step_A * (COMMISSION_BINS - 0.5);
    std::string       s =
        map_text("Ld at id", map.ld_H[0], d_A) + map_text("Ld at id", map.ld_H[1], -d_A);
    for (std::size_t row = 0; row < map.lq_H.size(); row++) {
        s += map_text(fmt::format("Lq, id {:.3g} A", 0.0 - map.bias_A * static_cast<double>(row)),
                      map.lq_H[row], map.iq_A(row, last));
    }
    return s;
}

std::string error_text(const CommissionLine &l)
{
    return l.relative ? fmt::format("{:+.2f} %", 100.0 * l.error) : fmt::format("{:+.3g}", l.error);
}

} // namespace

std::vector<CommissionLine> commission_lines(const Drive &d, const CommissionRun &r)
{
    const Motor               &m = d.motor;
    const commission_result_t &f = r.found;
    CommissionLine             offset{"offset", "deg electrical", 180.0 / pi * r.true_offset_e_rad,
                          180.0 / pi * f.offset_rad.value, 180.0 / pi * f.offset_rad.error};
    offset.relative = false;
    // Without a magnet, both ends of the d axis are the same.
    offset.error = std::remainder(offset.found - offset.truth, m.pm_flux_Wb > 0.0 ? 360.0 : 180.0);
    std::vector<CommissionLine> lines = {
        line("resistance", "Ohm", m.stator_resistance_Ohm, f.r_Ohm),
        line("Ld", "H", m.d_axis_inductance_H, f.ld_H),
        line("Lq", "H", m.q_axis_inductance_H, f.lq_H),
        line("flux", "Wb", m.pm_flux_Wb, f.flux_Wb),
        line("inertia", "kg m2", m.inertia_kgm2, f.inertia_kgm2),
        line("viscous friction", "N m s", m.viscous_friction_Nms, f.friction_Nms),
        line("Coulomb friction", "N m", r.true_coulomb_Nm, f.coulomb_Nm),
        offset,
        exact("pole pairs", m.pole_pairs, f.pole_pairs),
        exact("encoder counts", 4.0 * d.encoder.lines, f.counts_per_turn),
        exact("direction", r.reversed ? -1.0 : 1.0, f.direction)};
    if (d.mechanics.coupling == Coupling::known) {
        lines.push_back(line("resonance", "Hz", d.mechanics.resonance_Hz, f.resonance_Hz));
        lines.push_back(line("damping ratio", "", d.mechanics.least_damping, f.damping));
        lines.push_back(line("load inertia", "of J", d.mechanics.load_inertia_share, f.load_share));
    }
    return lines;
}

std::string commission_text(const Drive &d, const CommissionRun &r)
{
    std::string s = fmt::format("{}: commissioning {} after {:.1f} s\n", d.name,
                                r.finished() ? "finished" : "ABORTED", r.time_s);
    if (!r.finished()) {
        s += fmt::format("  in stage {}: {}\n", commission_stage_name(r.during),
                         commission_reason_text(r.reason));
    }
    s += fmt::format("  {:<17} {:>12} {:>12} {:>12} {:>10}\n", "", "truth", "found", "uncertain",
                     "error");
    for (const CommissionLine &l : commission_lines(d, r)) {
        s += fmt::format("  {:<17} {:>12.5g} {:>12.5g} {:>12.2g} {:>10}  {}\n", l.name, l.truth,
                         l.found, l.uncertainty, error_text(l), l.unit);
    }
    if (r.map.step_A > 0.0F) {
        s += map_text(found_map(r.map, r.found));
    }
    s += fmt::format("  a phase loses {:.3g} V; lag by friction {:.2f} deg, ripple {:.2f} deg; "
                     "{}\n",
                     r.found.v_loss_V.value, 180.0 / pi * r.found.lag_rad,
                     180.0 / pi * r.found.ripple_rad,
                     r.found.reluctance ? "aligned by reluctance" : "aligned by the magnet");
    s += fmt::format("  shaft {}\n", coupling_words(r.found));
    if (r.finished() && r.map.step_A > 0.0F) {
        s += fmt::format("  {}\n",
                         iron_words({r.found, found_map(r.map, r.found)}, d.motor.max_current_A));
    }
    s += fmt::format("  peak current {:.4g} A, {:.3f} of the bound\n", r.peak_current_A,
                     r.peak_share());
    return s;
}

std::string commission_json(const Drive &d, const CommissionRun &r)
{
    Json root          = Json::object();
    root["drive"]      = d.name;
    root["finished"]   = r.finished();
    root["stage"]      = commission_stage_name(r.finished() ? r.stage : r.during);
    root["reason"]     = commission_reason_text(r.reason);
    root["time_s"]     = r.time_s;
    root["peak_share"] = r.peak_share();
    Json lines         = Json::object();
    for (const CommissionLine &l : commission_lines(d, r)) {
        Json one           = Json::object();
        one["unit"]        = l.unit;
        one["truth"]       = l.truth;
        one["found"]       = l.found;
        one["uncertainty"] = l.uncertainty;
        one["error"]       = l.error;
        one["relative"]    = l.relative;
        lines[l.name]      = one;
    }
    root["values"] = lines;
    root["shaft"]  = coupling_words(r.found);
    return root.text();
}

std::string commission_csv(const CommissionRun &r)
{
    std::string s = "time_s,stage,id_A,iq_A,omega_e_radps,theta_e_rad,peak_A\n";
    for (const CommissionRow &row : r.trace) {
        s += fmt::format("{:.6g},{},{:.5g},{:.5g},{:.6g},{:.6g},{:.5g}\n", row.time_s, row.stage,
                         row.id_A, row.iq_A, row.omega_e_radps, row.theta_e_rad, row.peak_A);
    }
    return s;
}

} // namespace sdre
