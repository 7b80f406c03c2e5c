// SPDX-License-Identifier: MIT
#include "facts/cross_checks.hpp"

#include <cmath>

#include <fmt/format.h>

namespace sdre {
namespace {

// Chosen: friction, iron losses and rounding; the mistakes begin at 1.41.
constexpr double torque_within = 1.3;
// Chosen: P = T w holds but for the rounding of the three.
constexpr double power_within = 1.12;
// Chosen: time constants are given for a warm or a cold winding, of a phase or between terminals.
constexpr double time_within = 1.35;
// Chosen: saturation takes up to a third of the torque of the largest current.
constexpr double saturated_share = 0.74;
// Chosen: a motor that can ten times its rating for a moment does not exist.
constexpr double largest_overload = 10.0;

class Checks {
public:
    explicit Checks(Findings &findings) : findings_(findings) {}

    /// One quantity, as stated and as computed, in its unit.
    void same(const std::string &said, double said_si, const std::string &computed,
              double computed_si, const char *unit, double within)
    {
        const double ratio = computed_si / said_si;
        if (!(ratio < within && ratio > 1.0 / within)) {
            findings_.contradictions.push_back(fmt::format("{} against {:.4g} {} from {}{}", said,
                                                           computed_si, unit, computed,
                                                           usual_mistake(ratio)));
        }
    }
    void contradiction(const std::string &text)
    {
        findings_.contradictions.push_back(text);
    }

private:
    Findings &findings_;
};

void check_torque(const Facts &facts, const Machine &m, Checks &checks)
{
    for (const Fact &f : facts.of("rated_current")) {
        if (facts.has("rated_torque")) {
            checks.same(m.rated_torque_Nm.origin, m.rated_torque_Nm.si,
                        fmt::format("{} and {}", f.text, m.flux_Wb.origin),
                        mtpa_torque_Nm(m, peak_A(f)), "N m", torque_within);
        }
        if (peak_A(f) > 1.001 * m.max_current_A.si) {
            checks.contradiction(fmt::format("{} is above {}: {:.4g} A and {:.4g} A peak", f.text,
                                             m.max_current_A.origin, peak_A(f),
                                             m.max_current_A.si));
        }
    }
    const double most_Nm = mtpa_torque_Nm(m, m.max_current_A.si);
    for (const Fact &f : facts.of("max_torque")) {
        if (!(most_Nm > saturated_share * f.si && most_Nm < f.si / saturated_share)) {
            checks.contradiction(fmt::format("{} against {:.4g} N m from {}{}", f.text, most_Nm,
                                             m.max_current_A.origin,
                                             usual_mistake(most_Nm / f.si)));
        }
    }
    if (!(most_Nm > 0.98 * m.rated_torque_Nm.si &&
          most_Nm < largest_overload * m.rated_torque_Nm.si)) {
        checks.contradiction(fmt::format("{} ({:.4g} N m) against {:.4g} N m from {} and {}{}",
                                         m.rated_torque_Nm.origin, m.rated_torque_Nm.si, most_Nm,
                                         m.max_current_A.origin, m.flux_Wb.origin,
                                         usual_mistake(most_Nm / m.rated_torque_Nm.si)));
    }
}

void check_power(const Facts &facts, const Machine &m, Checks &checks)
{
    for (const Fact &f : facts.of("rated_power")) {
        if (facts.has("rated_torque") && facts.has("rated_speed")) {
            checks.same(
                f.text, f.si,
                fmt::format("{} and {}", m.rated_torque_Nm.origin, m.rated_speed_radps.origin),
                m.rated_torque_Nm.si * m.rated_speed_radps.si, "W", power_within);
        }
        for (const Fact &i : facts.of("rated_current")) {
            const double loss_W = 1.5 * m.resistance_Ohm.si * peak_A(i) * peak_A(i);
            if (loss_W > f.si) {
                checks.contradiction(fmt::format("{} and {} lose {:.4g} W in copper, more than {}",
                                                 m.resistance_Ohm.origin, i.text, loss_W, f.text));
            }
        }
    }
}

void check_times(const Facts &facts, const Machine &m, Checks &checks)
{
    const double kt = 1.5 * m.pole_pairs.si * m.flux_Wb.si;
    for (const Fact &f : facts.of("electrical_time_constant")) {
        checks.same(f.text, f.si, fmt::format("{} and {}", m.lq_H.origin, m.resistance_Ohm.origin),
                    m.lq_H.si / m.resistance_Ohm.si, "s", time_within);
    }
    for (const Fact &f : facts.of("mechanical_time_constant")) {
        checks.same(f.text, f.si,
                    fmt::format("{}, {} and {}", m.inertia_kgm2.origin, m.resistance_Ohm.origin,
                                m.flux_Wb.origin),
                    1.5 * m.inertia_kgm2.si * m.resistance_Ohm.si / (kt * kt), "s", time_within);
    }
    for (const Fact &f : facts.of("motor_constant")) { // torque per root of the copper loss
        checks.same(f.text, f.si,
                    fmt::format("{} and {}", m.flux_Wb.origin, m.resistance_Ohm.origin),
                    kt / std::sqrt(1.5 * m.resistance_Ohm.si), "N m/sqrt(W)", time_within);
    }
    for (const Fact &f : facts.of("no_load_speed")) {
        const double no_load_radps = m.dc_link_V.si / std::sqrt(3.0) / m.flux_Wb.si;
        const double said_radps    = f.electrical ? f.si : f.si * m.pole_pairs.si;
        checks.same(f.text, said_radps,
                    fmt::format("{} and {}", m.dc_link_V.origin, m.flux_Wb.origin), no_load_radps,
                    "rad/s electrical", time_within);
    }
}

} // namespace

void check_ratings(const Facts &facts, const Machine &m, Findings &findings)
{
    Checks checks(findings);
    check_torque(facts, m, checks);
    check_power(facts, m, checks);
    check_times(facts, m, checks);
}

} // namespace sdre
