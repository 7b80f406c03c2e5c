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

// Chosen: of the smaller inductance. The range of every certificate has room for less, and two waves of one motor differ by 2 %.
constexpr double flat = 0.1;
// Share of the limit that the current has to reach. A bound of 0.85 of the limit does. The fluxes are then within 3.1 % (sil.commission_iron_all).
constexpr double reached = 0.57;

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

bool is_curved(const FoundMap &m)
{
    return m.change() > flat;
}

bool is_far_enough(const FoundMap &m, double limit_A)
{
    return m.most_A() >= reached * limit_A;
}

/// The table [saturation]; empty when the inductances were not measured far enough.
std::string iron_table(const Found &found, double limit_A)
{
    const FoundMap &m = found.map;
    if (!is_far_enough(m, limit_A)) {
        return "";
    }
    const FoundIron iron = fit_iron(m);
    return saturation_table(
        iron, found.values.flux_Wb.value, limit_A,
        fmt::format("commissioned: inductances up to {:.3g} A, fitted within {:.1f} % rms",
                    m.most_A(), 100.0 * iron.misfit));
}

/// A table that was found, in place of that of the drive file.
struct Table {
    std::string name;
    std::string text; ///< empty: the file's stays
    bool        replaces() const
    {
        return !text.empty();
    }
};

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

std::string iron_words(const Found &found, double limit_A)
{
    const FoundMap &m = found.map;
    if (!m.measured()) {
        return "";
    }
    const std::string change =
        fmt::format("inductances change by {:.0f} % with the current", 100.0 * m.change());
    if (!is_curved(m)) {
        return change + ": constants will do";
    }
    if (!is_far_enough(m, limit_A)) {
        return fmt::format(
            "{}; no map: they were measured up to {:.3g} A, and {:.3g} A are needed; "
            "next: {:.2f} times the bound of the current",
            change, m.most_A(), reached * limit_A, reached * limit_A / m.most_A() + 0.005);
    }
    return change + ": the map is in [saturation]; law noc_iron has it in the firmware";
}

std::string commissioned_text(const std::string &text, const Found &found, double limit_A,
                              const std::string &origin)
{
    const bool has_iron =
        text.rfind("[saturation]", 0) == 0 || text.find("\n[saturation]") != std::string::npos;
    const bool               iron = found.map.measured() && (has_iron || is_curved(found.map));
    const std::vector<Table> tables{{"mechanics", mechanics_table(found.values)},
                                    {"saturation", iron ? iron_table(found, limit_A) : ""}};
    std::string              fresh = tables[0].text + tables[1].text;
    std::vector<Replacement> all   = replacements(found.values);
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
            out += section == "motor" ? std::exchange(fresh, "") : "";
            section = line.substr(1, line.find(']') - 1);
        }
        const bool replaced = std::any_of(tables.begin(), tables.end(), [&](const Table &t) {
            return t.name == section && t.replaces();
        });
        if (replaced && line[0] != '#') {
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
    out += fresh.empty() ? "" : "\n" + fresh;
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
