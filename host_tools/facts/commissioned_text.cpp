// SPDX-License-Identifier: MIT
#include "facts/commissioned_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
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

/// The table [mechanics] of what was found; empty when nobody has searched.
std::string mechanics_table(const commission_result_t &f)
{
    if (f.coupling == COMMISSION_COUPLING_UNKNOWN) {
        return "";
    }
    std::string text = "[mechanics]\n";
    if (f.coupling != COMMISSION_COUPLING_ELASTIC) {
        return text + fmt::format("coupling = \"rigid\" # commissioned: {}\n\n", coupling_words(f));
    }
    for (const auto &[key, v] :
         {std::pair{"resonance_Hz", f.resonance_Hz}, std::pair{"damping", f.damping},
          std::pair{"load_inertia_share", f.load_share}}) {
        text += fmt::format(
            "{:<18} = {:<9} # +- {:.2g}, commissioned: answers to an oscillating torque\n", key,
            number(v.value), v.error);
    }
    return text + "\n";
}

} // namespace

std::string coupling_words(const commission_result_t &f)
{
    const double from_Hz = COMMISSION_RING_FROM_Hz;
    switch (f.coupling) {
    case COMMISSION_COUPLING_ELASTIC:
        return fmt::format("elastic: resonance {:.4g} Hz, damping ratio {:.2g}, {:.2g} of the "
                           "inertia behind the coupling",
                           f.resonance_Hz.value, f.damping.value, f.load_share.value);
    case COMMISSION_COUPLING_RIGID:
        return fmt::format("rigid: no resonance found between {:.0f} and {:.0f} Hz", from_Hz,
                           f.searched_Hz);
    case COMMISSION_COUPLING_BELOW:
        return fmt::format("elastic: the resonance is below {:.0f} Hz", from_Hz);
    case COMMISSION_COUPLING_ABOVE:
        return fmt::format("elastic: the resonance is above {:.0f} Hz", f.searched_Hz);
    case COMMISSION_COUPLING_UNKNOWN:
        break;
    }
    return "not searched for a resonance";
}

std::string commissioned_text(const std::string &text, const commission_result_t &found,
                              const std::string &origin)
{
    std::vector<Replacement> all = replacements(found);
    std::string              out =
        fmt::format("# Motor values found by self-commissioning ({}); +- is twice the "
                    "standard deviation.\n",
                    origin);
    std::string section;
    std::string mechanics = mechanics_table(found);
    const bool  searched  = !mechanics.empty();
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end  = std::min(text.find('\n', at), text.size() - 1) + 1;
        std::string       line = text.substr(at, end - at);
        at                     = end;
        if (line[0] == '[') {
            out += section == "motor" ? std::exchange(mechanics, "") : "";
            section = line.substr(1, line.find(']') - 1);
        }
        if (section == "mechanics" && searched && line[0] != '#') {
            continue;
        }
        for (Replacement &r : all) {
            if (r.section == section && has_key(line, r.key)) {
                line   = r.line;
                r.done = true;
            }
        }
        out += line;
    }
    out += mechanics.empty() ? "" : "\n" + mechanics;
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
