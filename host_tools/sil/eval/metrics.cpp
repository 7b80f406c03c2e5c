// SPDX-License-Identifier: MIT
#include "sil/eval/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "sil/eval/rows.hpp"

namespace sdre {
namespace {

using Iterator = Trace::const_iterator;

constexpr double tail_share    = 0.2;
constexpr double current_share = 0.01; // of the largest current: below it there is no distortion
constexpr double settled_cnt =
    2.0; // chosen: a shaft at rest has a limit cycle of one about the edges of its count
constexpr double time_tolerance_s = 1e-9; // far below a period: two times that mean the same tick

/// Last entry of a value into a band.
template <typename Value>
std::optional<double> settling_time_s(Iterator begin, Iterator end, double target, double band,
                                      const Value &value)
{
    Iterator inside = end; // first row of the last stretch within the band
    for (Iterator row = end; row != begin;) {
        --row;
        if (std::abs(value(*row) - target) > band) {
            break;
        }
        inside = row;
    }
    if (inside == end) {
        return std::nullopt;
    }
    return inside->time_s - begin->time_s;
}

double speed_of(const TraceRow &r)
{
    return r.omega_e_radps;
}

void excursions(Iterator begin, Iterator end, double target, double band, Metrics &m)
{
    const double start    = begin->omega_e_radps - target;
    const bool   step     = std::abs(start) > band;
    const double upwards  = (step && start > 0.0) ? -1.0 : 1.0; // direction in which the step goes
    bool         counting = !step;
    for (Iterator row = begin; row != end; ++row) {
        const double beyond = upwards * (row->omega_e_radps - target);
        counting            = counting || beyond >= -band;
        if (counting) {
            m.overshoot_e_radps = std::max(m.overshoot_e_radps, beyond);
            m.dip_e_radps       = std::max(m.dip_e_radps, -beyond);
        }
    }
}

Iterator tail_of(const Measure &measure, Iterator begin, Iterator end)
{
    if (measure.tail_s) {
        const double from_s = (end - 1)->time_s - *measure.tail_s + time_tolerance_s;
        return std::find_if(begin, end - 1, [&](const TraceRow &r) { return r.time_s > from_s; });
    }
    const auto length = static_cast<double>(end - begin);
    return end - std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(tail_share * length));
}

/// From the figures of the electrical speed.
void add_paper_b(Metrics &m, Iterator begin, Iterator tail, Iterator end, int pole_pairs)
{
    const double target = (end - 1)->omega_ref_e_radps;
    const double centre = mean(tail, end, speed_of);
    const double rpm    = 30.0 / std::acos(-1.0) / pole_pairs;
    m.fluctuation_rpm   = rpm * m.ripple_e_radps;
    m.offset_rpm        = rpm * (centre - target);
    const auto slower   = [&](const TraceRow &a, const TraceRow &b) {
        return speed_of(a) < speed_of(b);
    };
    m.decrease_rpm           = rpm * (target - speed_of(*std::min_element(begin, end, slower)));
    const auto [least, most] = std::minmax_element(tail, end, slower);
    const double sum         = speed_of(*least) + speed_of(*most);
    if (sum != 0.0) {
        m.fluctuation_rate_percent = 100.0 * 2.0 * m.ripple_e_radps / std::abs(sum);
    }
    if (target != 0.0) {
        m.overshoot_percent = 100.0 * m.overshoot_e_radps / std::abs(target);
    }
    const auto within = [&](double share) {
        return settling_time_s(begin, end, centre, share * std::abs(target), speed_of);
    };
    m.within_5_percent_s = within(0.05);
    m.within_2_percent_s = within(0.02);
    m.within_1_percent_s = within(0.01);
}

std::optional<double> current_distortion_percent(Iterator tail, Iterator end, double id_A,
                                                 double iq_A, double least_A)
{
    const double fundamental = std::hypot(id_A, iq_A);
    if (!(fundamental > 0.0 && fundamental >= least_A)) {
        return std::nullopt;
    }
    const double square = mean(tail, end, [&](const TraceRow &r) {
        return std::pow(r.id_A - id_A, 2) + std::pow(r.iq_A - iq_A, 2);
    });
    return 100.0 * std::sqrt(square) / fundamental;
}

double off_e_rad(const TraceRow &r)
{
    return std::abs(r.position_e_rad - r.position_ref_e_rad);
}

double largest_off_e_rad(Iterator begin, Iterator end)
{
    return off_e_rad(*std::max_element(begin, end, [](const TraceRow &a, const TraceRow &b) {
        return off_e_rad(a) < off_e_rad(b);
    }));
}

/// How far the shaft passes the target; nothing if it is there at the beginning.
std::optional<double> passed_e_rad(Iterator begin, Iterator end, double target, double count_e_rad)
{
    const double way = target - begin->position_e_rad;
    if (std::abs(way) <= settled_cnt * count_e_rad) {
        return std::nullopt;
    }
    double passed = 0.0;
    for (Iterator row = begin; row != end; ++row) {
        passed = std::max(passed, std::copysign(1.0, way) * (row->position_e_rad - target));
    }
    return passed;
}

/// The target is the commanded one: a reference that passes it is an error too.
void add_position(Metrics &m, const Window &window, double target, double count_e_rad)
{
    const auto &[measure, begin, tail, end] = window;
    const auto position                     = [](const TraceRow &r) { return r.position_e_rad; };
    double     steady                       = 0.0;
    for (Iterator row = tail; row != end; ++row) {
        steady = std::max(steady, std::abs(row->position_e_rad - target));
    }
    m.position_off_cnt    = largest_off_e_rad(begin, end) / count_e_rad;
    m.position_steady_cnt = steady / count_e_rad;
    m.position_settled_s = settling_time_s(begin, end, target, settled_cnt * count_e_rad, position);
    if (const auto passed = passed_e_rad(begin, end, target, count_e_rad)) {
        m.position_overshoot_cnt = *passed / count_e_rad;
    }
}

Metrics metrics_of(const Window &window, const Drive &drive, double load_before_Nm)
{
    const Motor &motor                      = drive.motor;
    const auto &[measure, begin, tail, end] = window;

    const double target     = (end - 1)->omega_ref_e_radps;
    const auto   speed_less = [](const TraceRow &a, const TraceRow &b) {
        return a.omega_e_radps < b.omega_e_radps;
    };
    const auto [lowest, highest] = std::minmax_element(tail, end, speed_less);

    Metrics m;
    m.name            = measure.name;
    m.time_s          = measure.time_s;
    m.settling_time_s = settling_time_s(begin, end, target, measure.band_e_radps, speed_of);
    excursions(begin, end, target, measure.band_e_radps, m);
    m.steady_state_error_e_radps = std::abs(mean(tail, end, speed_of) - target);
    m.ripple_e_radps             = 0.5 * (highest->omega_e_radps - lowest->omega_e_radps);
    for (Iterator row = begin; row != end; ++row) {
        m.peak_current_A =
            std::max({m.peak_current_A, std::hypot(row->id_A, row->iq_A), row->peak_current_A});
    }
    m.steady_current_A =
        mean(tail, end, [](const TraceRow &r) { return std::hypot(r.id_A, r.iq_A); });
    m.effort      = effort_of(tail, end, drive.motor, control_period_s(drive));
    m.d_omega_hat = mean(tail, end, [](const TraceRow &r) { return r.d_omega_hat; });
    m.d_q_hat     = mean(tail, end, [](const TraceRow &r) { return r.d_q_hat; });
    m.d_d_hat     = mean(tail, end, [](const TraceRow &r) { return r.d_d_hat; });
    m.iq_A        = mean(tail, end, [](const TraceRow &r) { return r.iq_A; });
    m.id_A        = mean(tail, end, [](const TraceRow &r) { return r.id_A; });
    m.sensor_offset_hat_A =
        mean(tail, end, [](const TraceRow &r) { return r.sensor_offset_hat_A; });
    m.current_distortion_percent =
        current_distortion_percent(tail, end, m.id_A, m.iq_A, current_share * motor.max_current_A);
    m.equivalent_delay_s =
        equivalent_delay_s(begin, end, load_before_Nm, m.dip_e_radps, drive.motor);
    add_paper_b(m, begin, tail, end, motor.pole_pairs);
    return m;
}

void add_torque(Metrics &m, const Window &window, const Scenario &scenario)
{
    const std::vector<Step> &torques = scenario.torque_reference;
    const double before_Nm = value_at(torques, window.measure.time_s - time_tolerance_s, 0.0);
    const double target_Nm = value_at(torques, (window.end - 1)->time_s, 0.0);
    m.torque = torque_metrics_of({window.begin, window.tail, window.end, before_Nm, target_Nm},
                                 scenario.drive.motor.rated_torque_Nm);
}

/// Whether the steps have begun with a measure.
bool has_begun(const std::vector<Step> &steps, const Measure &measure)
{
    return !steps.empty() && steps.front().time_s <= measure.time_s;
}

} // namespace

std::vector<Window> windows_of(const Scenario &scenario, const Trace &trace)
{
    const auto first_at = [&](double time_s) {
        return std::find_if(trace.begin(), trace.end(),
                            [&](const TraceRow &r) { return r.time_s >= time_s - 1e-12; });
    };
    std::vector<Window> out;
    for (std::size_t i = 0; i < scenario.measures.size(); i++) {
        const Iterator begin = first_at(scenario.measures[i].time_s);
        const Iterator end   = (i + 1 < scenario.measures.size())
                                   ? first_at(scenario.measures[i + 1].time_s)
                                   : trace.end();
        if (begin != end) {
            out.push_back(
                {scenario.measures[i], begin, tail_of(scenario.measures[i], begin, end), end});
        }
    }
    return out;
}

std::vector<Metrics> measure(const Scenario &scenario, const Trace &trace)
{
    std::vector<Metrics> out;
    for (const Window &window : windows_of(scenario, trace)) {
        const Iterator before = window.begin == trace.begin() ? window.begin : window.begin - 1;
        out.push_back(metrics_of(window, scenario.drive, before->load_torque_Nm));
        const std::vector<Step> &positions = scenario.position_reference;
        if (has_begun(scenario.torque_reference, window.measure)) {
            add_torque(out.back(), window, scenario);
        }
        if (has_begun(positions, window.measure)) {
            const double turns = value_at(positions, (window.end - 1)->time_s, 0.0);
            add_position(out.back(), window,
                         2.0 * std::acos(-1.0) * scenario.drive.motor.pole_pairs * turns,
                         count_e_rad(scenario.drive));
        }
    }
    return out;
}

std::vector<std::pair<std::string, double>> metric_values(const Metrics &m)
{
    const auto torque = [&](auto TorqueMetrics::*value) {
        return m.torque ? std::optional<double>((*m.torque).*value) : std::nullopt;
    };
    const std::pair<const char *, std::optional<double>> all[] = {
        {"settling_time_s", m.settling_time_s},
        {"dip_e_radps", m.dip_e_radps},
        {"overshoot_e_radps", m.overshoot_e_radps},
        {"steady_state_error_e_radps", m.steady_state_error_e_radps},
        {"ripple_e_radps", m.ripple_e_radps},
        {"peak_current_A", m.peak_current_A},
        {"steady_current_A", m.steady_current_A},
        {"vq_noise_V", m.effort.vq_noise_V},
        {"vd_noise_V", m.effort.vd_noise_V},
        {"vq_noise_percent", m.effort.vq_noise_percent},
        {"iq_noise_A", m.effort.iq_noise_A},
        {"torque_noise_percent", m.effort.torque_noise_percent},
        {"audible_torque_percent", m.effort.audible_torque_percent},
        {"audible_current_A", m.effort.audible_current_A},
        {"equivalent_delay_s", m.equivalent_delay_s},
        {"d_omega_hat", m.d_omega_hat},
        {"d_q_hat", m.d_q_hat},
        {"d_d_hat", m.d_d_hat},
        {"iq_A", m.iq_A},
        {"id_A", m.id_A},
        {"sensor_offset_hat_A", m.sensor_offset_hat_A},
        {"position_off_cnt", m.position_off_cnt},
        {"position_steady_cnt", m.position_steady_cnt},
        {"position_settled_s", m.position_settled_s},
        {"position_overshoot_cnt", m.position_overshoot_cnt},
        {"torque_rise_s", torque(&TorqueMetrics::rise_s)},
        {"torque_overshoot_percent", torque(&TorqueMetrics::overshoot_percent)},
        {"torque_error_percent", torque(&TorqueMetrics::error_percent)},
        {"torque_ripple_percent", torque(&TorqueMetrics::ripple_percent)},
        {"current_distortion_percent", m.current_distortion_percent},
        {"fluctuation_rpm", m.fluctuation_rpm},
        {"fluctuation_rate_percent", m.fluctuation_rate_percent},
        {"offset_rpm", m.offset_rpm},
        {"decrease_rpm", m.decrease_rpm},
        {"overshoot_percent", m.overshoot_percent},
        {"within_5_percent_s", m.within_5_percent_s},
        {"within_2_percent_s", m.within_2_percent_s},
        {"within_1_percent_s", m.within_1_percent_s}};
    std::vector<std::pair<std::string, double>> values;
    for (const auto &[name, value] : all) {
        if (value) {
            values.emplace_back(name, *value);
        }
    }
    return values;
}

} // namespace sdre
