// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "drive/pwm_frequency.hpp"
#include "sil/qualify/qualify.hpp"
#include "sil/qualify/words.hpp"

namespace sdre {
namespace {

constexpr const char *head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title><style>
body {{ font: 15px/1.4 sans-serif; margin: 2em auto; max-width: 60em; color: #222 }}
table {{ border-collapse: collapse }} th, td {{ padding: 3px 10px; border-bottom: 1px solid #ccc; text-align: right }}
th:first-child, td:first-child, td:last-child {{ text-align: left }} tr.bad td {{ background: #eee; font-weight: bold }}
</style></head><body><h1>{0}: {1}</h1>
)";

std::string escaped(const std::string &text)
{
    std::string out;
    for (const char c : text) {
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return out;
}

std::string row(const TrialResult &r, const Qualification &q)
{
    return fmt::format("<tr{}><td>{}</td><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.2f}</td>"
                       "<td>{:.2f}</td><td>{:.2f}</td><td>{}</td></tr>\n",
                       r.reasons.empty() ? "" : " class=\"bad\"", escaped(r.what),
                       settling_words(r), r.dip_e_radps, r.ripple_e_radps,
                       r.peak_current_A / q.limit_A, 100.0 * r.voltage_noise_V / q.circle_V,
                       100.0 * r.vd_noise_V / q.circle_V, escaped(verdict_words(r)));
}

std::string paragraph(const std::string &words)
{
    return words.empty() ? "" : "<p>" + words + "</p>\n";
}

} // namespace

std::string qualification_html(const Qualification &q)
{
    std::string s = fmt::format(head, escaped(q.drive), q.good() ? "good" : "NOT GOOD");
    s += paragraph(pwm_note(q.inverter));
    s += "<table><tr><th>worst of all seeds</th><th>settles<br>ms</th><th>dip<br>rad/s</th>"
         "<th>ripple<br>rad/s</th><th>peak<br>of limit</th><th>noise of "
         "v_q<br>%</th><th>noise of v_d<br>%</th><th></th></tr>\n";
    for (const TrialResult &r : q.trials) {
        s += row(r, q);
    }
    for (const Rival &rival : q.rivals) {
        if (rival.load_step) {
            TrialResult r = *rival.load_step;
            r.what += fmt::format(" with {}", rival.law->name);
            s += row(r, q);
        }
    }
    s += "</table>\n";
    for (const Rival &rival : q.rivals) {
        s += paragraph(escaped(rival_words(rival))) + paragraph(rival_verdict(q, rival));
    }
    s += q.torques ? paragraph(escaped(torque_words(*q.torques))) : "";
    s += "<h2>Steady over speed and torque</h2>\n" + (q.map.points.empty() ? "" : map_svg(q.map));
    s += paragraph(motors_words(q));
    s += paragraph(wide_motors_words(q));
    for (const std::string &reason : q.reasons) {
        s += paragraph("not good: " + escaped(reason));
    }
    s += paragraph(next_step(q));
    return s + "</body></html>\n";
}

} // namespace sdre
