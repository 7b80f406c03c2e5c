// SPDX-License-Identifier: MIT
#include <cmath>

#include <fmt/format.h>

#include "common/json.hpp"
#include "drive/pwm_frequency.hpp"
#include "sil/qualify/qualify.hpp"
#include "sil/qualify/words.hpp"

namespace sdre {
namespace {

std::string row_text(const TrialResult &r, const Qualification &q)
{
    return fmt::format("{:<34} {:>9} {:>9.3g} {:>9.3g} {:>8.2f} {:>8.2f} {:>8.2f}  {}\n", r.what,
                       settling_words(r), r.dip_e_radps, r.ripple_e_radps,
                       r.peak_current_A / q.limit_A, 100.0 * r.voltage_noise_V / q.circle_V,
                       100.0 * r.vd_noise_V / q.circle_V, verdict_words(r));
}

std::string line(const std::string &words)
{
    return words.empty() ? "" : words + "\n";
}

std::string rivals_text(const Qualification &q)
{
    std::string s;
    for (const Rival &rival : q.rivals) {
        if (rival.load_step) {
            TrialResult r = *rival.load_step;
            r.what += fmt::format(", {}", rival.law->name);
            s += row_text(r, q);
        }
        s += line(rival_words(rival)) + line(rival_verdict(q, rival));
    }
    return s;
}

Json trial_json(const TrialResult &r)
{
    Json j{{"what", r.what},
           {"good", r.reasons.empty()},
           {"faults", r.faults},
           {"dip_e_radps", r.dip_e_radps},
           {"ripple_e_radps", r.ripple_e_radps},
           {"peak_current_A", r.peak_current_A},
           {"vq_noise_V", r.voltage_noise_V},
           {"vd_noise_V", r.vd_noise_V},
           {"reasons", r.reasons}};
    if (r.settling_time_s) {
        j["settling_time_s"] = *r.settling_time_s;
    } else {
        j["settling_time_s"] = nullptr;
    }
    return j;
}

/// Null when no tuning is as quiet and settles.
Json rival_json(const Rival &rival)
{
    if (!rival.load_step) {
        return nullptr;
    }
    Json j{{"evaluations", rival.evaluations}, {"load_step", trial_json(*rival.load_step)}};
    for (const auto &[key, value] : rival.settings) {
        j[key] = value;
    }
    return j;
}

Json ripples_json(const Ripples &r)
{
    return {{"vq_V", r.vq_V}, {"vd_V", r.vd_V}, {"speed_e_radps", r.speed_e_radps}};
}

Json map_json(const PlaneMap &map)
{
    Json points = Json::array();
    for (const MapPoint &p : map.points) {
        points.push_back({{"speed_e_radps", p.speed_e_radps},
                          {"torque_Nm", p.torque_Nm},
                          {"ideal", ripples_json(p.ideal)},
                          {"board", ripples_json(p.board)},
                          {"faults", p.faults}});
    }
    return {{"ideal_limit", ripples_json(map.ideal_limit)},
            {"board_limit", ripples_json(map.board_limit)},
            {"points", points}};
}

Json time_json(const std::optional<double> &time_s)
{
    return time_s && std::isfinite(*time_s) ? Json(*time_s) : Json();
}

Json torques_json(const TorqueTrial &t)
{
    return {{"speed_e_radps", t.speed_e_radps},
            {"good", t.reasons.empty()},
            {"faults", t.faults},
            {"least_tenth_s", time_json(t.least_tenth_s)},
            {"tenth_s", time_json(t.tenth_s)},
            {"least_rated_s", time_json(t.least_rated_s)},
            {"rated_s", time_json(t.rated_s)},
            {"overshoot_percent", t.overshoot_percent},
            {"error_percent", t.error_percent},
            {"ripple_percent", t.ripple_percent},
            {"peak_current_A", t.peak_current_A},
            {"reasons", t.reasons}};
}

Json share_json(const MotorShare &m)
{
    return {{"count", m.count}, {"good", m.good}};
}

} // namespace

std::string qualification_text(const Qualification &q)
{
    std::string s =
        fmt::format("{}: {}\n{}\n", q.drive, q.good() ? "good" : "NOT GOOD", pwm_note(q.inverter));
    s += fmt::format("{:<34} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "worst of all seeds",
                     "settles", "dip", "ripple", "peak", "v_q", "v_d");
    s += fmt::format("{:<34} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "", "ms", "rad/s", "rad/s",
                     "of limit", "noise %", "noise %");
    for (const TrialResult &r : q.trials) {
        s += row_text(r, q);
    }
    s += rivals_text(q);
    s += q.torques ? line(torque_words(*q.torques)) : "";
    s += map_text(q.map);
    s += line(motors_words(q));
    s += line(wide_motors_words(q));
    for (const std::string &reason : q.reasons) {
        s += "not good: " + reason + "\n";
    }
    s += line(next_step(q));
    return s;
}

std::string qualification_json(const Qualification &q)
{
    Json trials = Json::array();
    for (const TrialResult &r : q.trials) {
        trials.push_back(trial_json(r));
    }
    Json j{{"drive", q.drive},
           {"good", q.good()},
           {"pwm_wanted_Hz", q.inverter.pwm_wanted_Hz},
           {"pwm_frequency_Hz", q.inverter.pwm_frequency_Hz},
           {"certified", q.certified},
           {"current_limit_A", q.limit_A},
           {"voltage_circle_V", q.circle_V},
           {"trials", trials},
           {"map", map_json(q.map)},
           {"motors", share_json(q.motors)},
           {"wide_motors", share_json(q.wide)},
           {"reasons", q.reasons}};
    if (q.torques) {
        j["torques"] = torques_json(*q.torques);
    }
    for (const Rival &rival : q.rivals) {
        j[rival.law->name] = rival_json(rival);
    }
    return j.text();
}

} // namespace sdre
