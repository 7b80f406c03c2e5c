// SPDX-License-Identifier: MIT
#include "sil/qualify/words.hpp"

#include <cmath>

#include <fmt/format.h>

namespace sdre {
namespace {

// A hub motor with an edge in 1.7 periods is good, with one in 3.3 it is not (docs/motors.md).
constexpr double most_periods_per_edge = 2.0;

std::string share_words(const char *what, const MotorShare &m)
{
    return m.count == 0 ? ""
                        : fmt::format("{}: {} of {} good, {:.1f} %", what, m.good, m.count,
                                      100.0 * m.share());
}

} // namespace

void beyond(std::vector<std::string> &reasons, const char *what, double is, double most,
            const char *unit, double scale)
{
    if (most > 0.0 && !(is <= most)) {
        reasons.push_back(
            fmt::format("{} {:.4g} {}, at most {:.4g}", what, scale * is, unit, scale * most));
    }
}

std::string settling_words(const TrialResult &r)
{
    return r.settling_time_s ? fmt::format("{:.2f}", 1e3 * *r.settling_time_s) : "never";
}

std::string verdict_words(const TrialResult &r)
{
    return !r.reasons.empty() ? fmt::format("{}", fmt::join(r.reasons, ", "))
           : r.faults > 0     ? "good, trips"
                              : "good";
}

std::string rival_words(const Rival &rival)
{
    if (!rival.load_step) {
        return fmt::format("{}: none of {} tunings is certified, as quiet and settles",
                           rival.law->name, rival.evaluations);
    }
    std::string settings;
    for (const auto &[key, value] : rival.settings) {
        settings += fmt::format("{}{} = {:g}", settings.empty() ? "" : ", ", key, value);
    }
    return fmt::format("{} with {}: the best of {} tunings that are not noisier", rival.law->name,
                       settings, rival.evaluations);
}

std::string rival_verdict(const Qualification &q, const Rival &rival)
{
    const TrialResult &own = q.trials.front();
    if (!rival.load_step || !own.settling_time_s) {
        return "";
    }
    std::string ahead, behind;
    const auto  add = [&](const char *what, double mine, double other) {
        std::string &s = mine > same_within * other ? ahead : behind;
        if (mine > same_within * other || other > same_within * mine) {
            s += fmt::format("{}{} ({:.3g} for {:.3g})", s.empty() ? "" : ", ", what, other, mine);
        }
    };
    add("settling time", 1e3 * *own.settling_time_s, 1e3 * *rival.load_step->settling_time_s);
    add("dip", own.dip_e_radps, rival.load_step->dip_e_radps);
    const auto said = [](const char *where, const std::string &what) {
        return what.empty() ? "" : fmt::format(" {} in {}", where, what);
    };
    const std::string all = said("ahead", ahead) + (ahead.empty() || behind.empty() ? "" : ",") +
                            said("behind", behind);
    return fmt::format("{} against this drive:{}", rival.law->name,
                       all.empty() ? " the same within 5 %" : all);
}

std::string next_step(const Qualification &q)
{
    struct Advice {
        const char *about; ///< in a reason
        const char *what;
    };
    constexpr Advice all[] = {
        {"not certified", "`sdre-gains tune` finds weights that are"},
        {"trips", "a larger max_current_A or dc_link_V, or a smaller rated_torque_Nm"},
        {"peak current", "a smaller rated_torque_Nm or a larger max_current_A; a higher pwm_kHz"},
        {"noise of v_q", "more encoder lines or edge times, current sensors with less noise or "
                         "range; a slower goal "
                         "(docs/tuning.md), or --noise"},
        {"plane on the board",
         "more encoder lines or edge times, current sensors with less noise or range"},
        {"plane", "a smaller largest speed or torque; other weights by `sdre-gains tune`"},
        {"motors fail",
         "a slower goal of settling time (docs/tuning.md), or facts with less tolerance"},
        {"pi_foc", "a faster goal of settling time (docs/tuning.md): the noise leaves room"},
        {"", "a larger dip or settling time as the goal (docs/tuning.md), a higher pwm_kHz, more "
             "encoder lines"}};
    if (!q.good() && q.periods_per_edge > most_periods_per_edge) {
        return fmt::format(
            "next: encoder_lines = {:.0f} or more; now an edge comes in {:.1f} periods "
            "at half the rated speed",
            std::ceil(q.lines * q.periods_per_edge / most_periods_per_edge), q.periods_per_edge);
    }
    for (const Advice &a : all) {
        if (!q.reasons.empty() && q.reasons.front().find(a.about) != std::string::npos) {
            return fmt::format("next: {}", a.what);
        }
    }
    return "";
}

std::string motors_words(const Qualification &q)
{
    return share_words("R, L, flux +-30 %, J x0.5 .. 2", q.motors);
}

std::string wide_motors_words(const Qualification &q)
{
    return share_words("R, L, flux +-50 %, J x0.5 .. 3 (for information)", q.wide);
}

} // namespace sdre
