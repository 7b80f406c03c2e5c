// SPDX-License-Identifier: MIT
#include "sil/eval/effort.hpp"

#include <cmath>

#include "sil/eval/rows.hpp"

namespace sdre {
namespace {

using Iterator = Trace::const_iterator;

constexpr double audible_Hz = 100.0;
// Share of the rated torque: a smaller change of the load is not a step.
constexpr double step_share = 0.01;

/// Mean square of what a first-order high-pass leaves, from the mean on.
template <typename Value>
double audible(Iterator begin, Iterator end, double period_s, const Value &value)
{
    const double keep = std::exp(-2.0 * std::acos(-1.0) * audible_Hz * period_s);
    double       slow = mean(begin, end, value);
    return mean(begin, end, [&](const TraceRow &r) {
        const double fast = value(r) - slow;
        slow += (1.0 - keep) * fast;
        return fast * fast;
    });
}

} // namespace

Effort effort_of(Iterator begin, Iterator end, const Motor &motor, double period_s)
{
    const auto vq     = [](const TraceRow &r) { return r.vq_V; };
    const auto iq     = [](const TraceRow &r) { return r.iq_A; };
    const auto id     = [](const TraceRow &r) { return r.id_A; };
    const auto torque = [](const TraceRow &r) { return r.torque_Nm; };
    const auto link   = [](const TraceRow &r) { return r.dc_link_V; };
    const auto share  = [&](double square) {
        return motor.rated_torque_Nm > 0.0 ? 100.0 * std::sqrt(square) / motor.rated_torque_Nm
                                            : 0.0;
    };

    Effort       e;
    const double circle_V = mean(begin, end, link) / std::sqrt(3.0);
    e.vq_noise_V          = std::sqrt(variance(begin, end, vq));
    e.vd_noise_V       = std::sqrt(variance(begin, end, [](const TraceRow &r) { return r.vd_V; }));
    e.vq_noise_percent = circle_V > 0.0 ? 100.0 * e.vq_noise_V / circle_V : 0.0;
    e.iq_noise_A       = std::sqrt(variance(begin, end, iq));
    e.torque_noise_percent   = share(variance(begin, end, torque));
    e.audible_torque_percent = share(audible(begin, end, period_s, torque));
    e.audible_current_A =
        std::sqrt(audible(begin, end, period_s, iq) + audible(begin, end, period_s, id));
    return e;
}

std::optional<double> equivalent_delay_s(Iterator begin, Iterator end, double load_before_Nm,
                                         double dip_e_radps, const Motor &motor)
{
    const double step_Nm = begin->load_torque_Nm - load_before_Nm;
    const bool   held    = begin->load_torque_Nm == (end - 1)->load_torque_Nm &&
                      begin->omega_ref_e_radps == (end - 1)->omega_ref_e_radps;
    if (!held || !(step_Nm > step_share * motor.rated_torque_Nm)) {
        return std::nullopt;
    }
    return dip_e_radps * motor.inertia_kgm2 / (motor.pole_pairs * step_Nm);
}

} // namespace sdre
