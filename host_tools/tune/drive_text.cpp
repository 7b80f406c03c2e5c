// SPDX-License-Identifier: MIT
#include "tune/drive_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/law_design.hpp"
#include "drive/pwm_frequency.hpp"
#include "tune/position_weights.hpp"

namespace sdre {
namespace {

std::vector<std::string> lines_of(const std::string &text)
{
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        lines.push_back(text.substr(at, end - at));
        at = end;
    }
    return lines;
}

bool starts_with(const std::string &line, const char *prefix)
{
    return line.rfind(prefix, 0) == 0;
}

/// Whether the tuned sections take the place of the one that begins here.
bool is_replaced(const std::string &line, const std::string &sections)
{
    const auto is = [&](const char *header) {
        return starts_with(line, header) && sections.find(header) != std::string::npos;
    };
    return is("[nosc]") || is("[nodo]") || is("[shaft]") || is("[position]");
}

std::string shaft_section(const ShaftSpec &s)
{
    return fmt::format("\n[shaft]\n# controller: speed of the load against the motor's, twist; "
                       "noise of the load's speed and of the twist\n"
                       "Q = [{:.3g}, {:.3g}]\nnodo_Q = [{:.3g}, {:.3g}]\n",
                       s.Q[0], s.Q[1], s.nodo_Q[0], s.nodo_Q[1]);
}

bool is_old_note(const std::string &line)
{
    return starts_with(line, "# The weights below were found by") ||
           starts_with(line, "# The weights below were kept by") ||
           starts_with(line, "# for PWM at") || starts_with(line, "# for a load step of") ||
           starts_with(line, "#   J, B x") || starts_with(line, "# Behind an elastic shaft");
}

} // namespace

std::string tuned_sections(const TuneResult &r, const TuneSpec &spec)
{
    const Drive  &d       = r.drive;
    const Sensors sensors = sensors_of(d, spec);
    std::string   s       = fmt::format(
                "# The weights below were {} by `sdre-gains tune` ({} evaluations) on the sampled "
                        "closed loop,\n"
                        "# for a load step of {:g} N m at {:g} rad/s. Linear model, believed parameters scaled.\n",
        r.kept ? "kept" : "found", r.evaluations, spec.load_step_Nm, spec.speed_e_radps);
    if (!pwm_note(d.inverter).empty()) {
        s += "# for " + pwm_note(d.inverter);
    }
    for (std::size_t i = 0; i < r.cases.size(); i++) {
        const CaseResult     &c = r.cases[i];
        const RobustnessCase &w = spec.cases[i];
        std::string           further =
            w.inductance == 1.0 ? "" : fmt::format(", L x{:g} more", w.inductance);
        further += w.resonance == 1.0 ? "" : fmt::format(", resonance x{:g}", w.resonance);
        s += fmt::format("#   J, B x{:g}, R, L, flux x{:g}{}: dip {:.2f} (wanted {:g}), settled "
                         "{:.1f} ms ({:g}). With noise: 3 sigma {:.2f} ({:g}) rad/s, "
                         "{:.0f} V ({:g}), v_q noise {:.1f} V, pole {:.3f}.\n",
                         w.mechanical, w.electrical, further, c.dip_e_radps, w.dip_e_radps,
                         1e3 * c.settling_time_s, 1e3 * w.settling_time_s, c.ripple_e_radps,
                         w.ripple_e_radps, c.voltage_V, spec.voltage_headroom_V, c.voltage_noise_V,
                         c.spectral_radius);
    }
    const ShaftStep &shaft = r.cases.front().shaft;
    if (shaft.ratio > 0.0) {
        s += fmt::format("# Behind an elastic shaft of {:.0f} Hz it settles in {:.1f} ms. The "
                         "farthest goal there is at {:.2f}.\n",
                         shaft.resonance_Hz, 1e3 * shaft.settling_time_s, shaft.ratio);
    }
    s += fmt::format("[nosc]\norder = {}\n", d.nosc.order);
    s += fmt::format("Q = [{:.3g}, {:.3g}, {:.3g}] # speed, i_q: searched; i_d: 1 / ({:g} A)^2\n",
                     d.nosc.Q[0], d.nosc.Q[1], d.nosc.Q[2], spec.d_axis_error_A);
    s += fmt::format("T = [{:.3g}, {:.3g}] # v_q, v_d: 1 / ({:g} V)^2\n\n", d.nosc.T[0],
                     d.nosc.T[1], spec.voltage_V);
    s += fmt::format("[nodo]\nform = \"encoder\"\norder = {}\n", d.nodo.order);
    s += fmt::format("# d_w, d_q = d_d (drift of the disturbances), w, i_q = i_d: searched; theta' "
                     "= w is exact: 0\n");
    s += fmt::format("Q = [{:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, {:.3g}, 0.0]\n", d.nodo.Q[0],
                     d.nodo.Q[1], d.nodo.Q[2], d.nodo.Q[3], d.nodo.Q[4], d.nodo.Q[5]);
    s += fmt::format("# variance x period of one sample: currents {:.3g} A, angle {:.3g} rad "
                     "({:.3g} counts)\n",
                     sensors.current_A, sensors.angle_rad, spec.angle_error_cnt);
    s += fmt::format("T = [{:.3g}, {:.3g}, {:.3g}]\n", d.nodo.T[0], d.nodo.T[1], d.nodo.T[2]);
    s += law_design(d).shaft_states ? shaft_section(d.shaft) : "";
    return r.moved_position ? s + position_text(*d.position) : s;
}

void require_rewritable(const std::filesystem::path &file, const std::string &text,
                        const Drive &drive)
{
    std::vector<const char *> headers{"[nosc]", "[nodo]"};
    if (law_design(drive).shaft_states) {
        headers.push_back("[shaft]");
    }
    const std::vector<std::string> lines = lines_of(text);
    for (const char *header : headers) {
        if (std::none_of(lines.begin(), lines.end(),
                         [header](const std::string &line) { return starts_with(line, header); })) {
            throw InputError(fmt::format("{}: {} must stand at the start of a line, so that its "
                                         "weights can be replaced",
                                         file.string(), header));
        }
    }
}

std::string with_sections(const std::string &text, const std::string &sections)
{
    std::string out;
    std::string
         pending; // comments and blank lines that may belong to the section after the tuned ones
    bool skipping = false;
    bool inserted = false;
    for (const std::string &line : lines_of(text)) {
        if (is_old_note(line)) {
            continue;
        }
        if (line[0] == '[') {
            skipping = is_replaced(line, sections);
            out += skipping ? "" : pending;
            pending.clear();
        }
        if (skipping && !inserted) {
            out += sections;
            inserted = true;
        }
        if (!skipping) {
            out += line;
        } else if (line[0] == '#' || line[0] == '\n') {
            pending += line;
        } else {
            pending.clear();
        }
    }
    return pending.find('#') == std::string::npos ? out : out + pending;
}

} // namespace sdre
