// SPDX-License-Identifier: MIT
#include "facts/commissioned_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {
namespace {

struct Replacement {
    std::string section;
    std::string key;
    std::string line;
    bool        done = false;
};

std::string number(double value)
{
    std::string text = fmt::format("{:.6g}", value);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return text;
}

Replacement measured(const char *key, double value, double uncertainty, const std::string &how)
{
    return {"motor", key,
            fmt::format("{:<21} = {:<12} # +- {:.2g}, {}\n", key, number(value), uncertainty, how)};
}

Replacement counted(const char *section, const char *key, int value, const std::string &how)
{
    return {section, key, fmt::format("{:<21} = {:<12} # {}\n", key, value, how)};
}

std::vector<Replacement> replacements(const commission_result_t &f)
{
    // A symmetric machine is found symmetric only within the error, and a drive file needs Ld <=
    // Lq.
    const bool   round = f.ld_H.value > f.lq_H.value;
    const double mean  = 0.5 * (f.ld_H.value + f.lq_H.value);
    const double ld    = round ? mean : f.ld_H.value;
    const double lq    = round ? mean : f.lq_H.value;
    return {
        counted("motor", "pole_pairs", f.pole_pairs,
                "commissioned: counts of a turn over those of an electrical turn"),
        measured("stator_resistance_Ohm", f.r_Ohm.value, f.r_Ohm.error,
                 "commissioned: direct currents at three angles"),
        measured("d_axis_inductance_H", ld, f.ld_H.error,
                 "commissioned: square waves of voltage along d"),
        measured("q_axis_inductance_H", lq, f.lq_H.error,
                 "commissioned: square waves of voltage along q"),
        measured("pm_flux_Wb", f.flux_Wb.value, f.flux_Wb.error,
                 "commissioned: voltage while coasting without current"),
        measured("inertia_kgm2", f.inertia_kgm2.value, f.inertia_kgm2.error,
                 "commissioned: accelerations with a known torque"),
        measured(
            "viscous_friction_Nms", f.friction_Nms.value, f.friction_Nms.error,
            fmt::format("commissioned: coasting; beside it {:.3g} N m dry", f.coulomb_Nm.value)),
        counted("encoder", "lines", f.counts_per_turn / 4,
                fmt::format("commissioned: {} with the electrical angle, d axis at {:.4f} rad "
                            "where the count began",
                            f.direction > 0 ? "counts up" : "counts down", f.offset_rad.value))};
}

bool has_key(const std::string &line, const std::string &key)
{
    return line.rfind(key, 0) == 0 && line.size() > key.size() &&
           (line[key.size()] == ' ' || line[key.size()] == '=');
}

} // namespace

std::string commissioned_text(const std::string &text, const commission_result_t &found,
                              const std::string &origin)
{
    std::vector<Replacement> all = replacements(found);
    std::string              out =
        fmt::format("# Motor values found by self-commissioning ({}); +- is twice the "
                    "standard deviation.\n",
                    origin);
    std::string section;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end  = std::min(text.find('\n', at), text.size() - 1) + 1;
        std::string       line = text.substr(at, end - at);
        at                     = end;
        if (line[0] == '[') {
            section = line.substr(1, line.find(']') - 1);
        }
        for (Replacement &r : all) {
            if (r.section == section && has_key(line, r.key)) {
                line   = r.line;
                r.done = true;
            }
        }
        out += line;
    }
    for (const Replacement &r : all) {
        if (!r.done) {
            throw InputError(
                fmt::format("[{}] {} must stand at the start of a line, so that it can "
                            "be replaced",
                            r.section, r.key));
        }
    }
    return out;
}

} // namespace sdre
