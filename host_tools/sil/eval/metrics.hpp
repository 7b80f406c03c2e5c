// SPDX-License-Identifier: MIT
/// Metrics of a trace.
///
/// A measure's window runs from its time to the next measure or the end. Its target is the reference at the
/// end of the window; its tail is the last fifth, or the last tail_s of the measure. A window is a step when the speed
/// starts more than a band away from the target, otherwise a disturbance.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sil/eval/effort.hpp"
#include "sil/eval/torque_metrics.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/metric_names.hpp"

namespace sdre {

struct Metrics {
    std::string name;
    double      time_s = 0.0;
    std::optional<double>
        settling_time_s; ///< last entry into the band; none when outside at the end
    /// Step: how far the speed falls back from the target after first reaching the band, and how far it goes
    /// beyond. Disturbance: largest deviation below and above the target.
    double                dip_e_radps                = 0.0;
    double                overshoot_e_radps          = 0.0;
    double                steady_state_error_e_radps = 0.0; ///< |mean error| in the tail
    double                ripple_e_radps             = 0.0; ///< (max - min) / 2 in the tail
    double                peak_current_A = 0.0; ///< largest |i| in the window, between instants too
    double                steady_current_A = 0.0;    ///< mean |i| in the tail
    Effort                effort;                    ///< of the tail
    std::optional<double> equivalent_delay_s;        ///< of a load step at the measure's time
    double                d_omega_hat         = 0.0; ///< means in the tail [rad/s^2]
    double                d_q_hat             = 0.0; ///< [A/s]
    double                d_d_hat             = 0.0; ///< [A/s]
    double                iq_A                = 0.0;
    double                id_A                = 0.0;
    double                sensor_offset_hat_A = 0.0; ///< noc_h: estimate, mean in the tail
    // Position run, in counts of the encoder.
    std::optional<double> position_off_cnt;       ///< largest |shaft - reference| in the window
    std::optional<double> position_steady_cnt;    ///< largest |shaft - target| in the tail
    std::optional<double> position_settled_s;     ///< last entry into two counts about the target
    std::optional<double> position_overshoot_cnt; ///< of a motion: how far it passes the target
    std::optional<TorqueMetrics> torque;          ///< torque run
    /// All of the true phase currents but their fundamental, rms over that of the fundamental, in the tail. At constant
    /// speed: the deviation of (id, iq) from its mean over that mean. None when the fundamental is below 1 % of the drive's
    /// largest current (chosen: a ratio to less says nothing of the current).
    std::optional<double> current_distortion_percent;
    // Paper B's figures, of the mechanical speed.
    double fluctuation_rpm          = 0.0; ///< (max - min) / 2 in the tail
    double fluctuation_rate_percent = 0.0; ///< (max - min) / (max + min) in the tail; 0 about 0
    double offset_rpm               = 0.0; ///< mean in the tail minus the target
    double decrease_rpm             = 0.0; ///< target minus the lowest speed in the window
    double overshoot_percent        = 0.0; ///< overshoot_e_radps, of the target; 0 about 0
    /// Last entry into this share of the target about the mean of the tail; none when outside at
    /// the end. Paper B calls it settling and recovery time and does not name its band. Used are 5
    /// % and 2 % after a speed step, 5 % and 1 % after a load step.
    std::optional<double> within_5_percent_s;
    std::optional<double> within_2_percent_s;
    std::optional<double> within_1_percent_s;
};

/// The rows of a measure.
struct Window {
    Measure               measure;
    Trace::const_iterator begin;
    Trace::const_iterator tail; ///< its steady part goes from here to `end`
    Trace::const_iterator end;
};

/// The windows of all measures that have a row. They point into the trace.
std::vector<Window> windows_of(const Scenario &scenario, const Trace &trace);

std::vector<Metrics> measure(const Scenario &scenario, const Trace &trace);

/// The numeric metrics by their JSON name, in the order of metric_names(); one without a value is left out.
std::vector<std::pair<std::string, double>> metric_values(const Metrics &metrics);

} // namespace sdre
