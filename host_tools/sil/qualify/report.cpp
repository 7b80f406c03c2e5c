// SPDX-License-Identifier: MIT
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

std::string rival_text(const Qualification &q)
{
    if (!q.rival) {
        return "pi_foc: no tuning of the grid is as quiet and settles\n";
    }
    return row_text(q.rival->load_step, q) +
           fmt::format("  pi_foc with {:.4g} Hz, a = {:g}: the quickest that is not noisier\n",
                       q.rival->current_bandwidth_Hz, q.rival->optimum_a);
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
    s += q.compared ? rival_text(q) : "";
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
    if (q.compared && !q.rival) {
        j["pi_foc"] = nullptr;
    }
    if (q.rival) {
        j["pi_foc"] = {{"current_bandwidth_Hz", q.rival->current_bandwidth_Hz},
                       {"symmetrical_optimum_a", q.rival->optimum_a},
                       {"load_step", trial_json(q.rival->load_step)}};
    }
    return j.text();
}

} // namespace sdre
