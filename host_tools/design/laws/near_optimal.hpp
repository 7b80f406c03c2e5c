// SPDX-License-Identifier: MIT
/// Common part of the designs of the near optimal laws.
#pragma once

#include "common/c_text.hpp"
#include "design/certificate.hpp"
#include "design/id_reference.hpp"
#include "design/laws/laws.hpp"
#include "design/noc_iron/iron_loop.hpp"
#include "design/position.hpp"
#include "design/torque.hpp"
#include "linalg/linalg_checks.hpp"

namespace sdre {

/// nosc, nodo and certificate of both; noc_h has no nodo.
void solve_near_optimal(Design &design);

/// The first terms of both series, for the motor that the design believes. DesignError without a solution.
LoopGains first_gains(const Design &design);

/// The current references of a near optimal law; none of other laws.
const current_ref_config_t *current_references(const Design &design);

/// Needs `drive`, `l` and the first term of `nosc`.
current_ref_config_t current_ref_constants(const Design &design, bool exact_mtpa);

/// Current references and the series of the feedback; without nosc_series its first term alone (EQ-NOSC-3).
near_optimal_config_t near_optimal_constants(const Design &design, bool exact_mtpa,
                                             bool nosc_series);

/// Share of the current limit for an error of speed or position (EQ-NOSC-3). Chosen by simulation
/// of 10,000 random motors: 48 failed without this limit and 36 with it. A smaller share deepens
/// the dip after a load step.
constexpr double speed_current_ratio = 0.25;

/// k of EQ-CURRENT-REF-2.
double mtpa_A(const ReducedParameters &l);
/// The iq at which the MTPA curve meets the current circle.
double largest_iq_A(const Motor &motor, double k, bool exact);
/// The same of the motor's own curve, exact unless a map of its iron says otherwise.
double largest_iq_A(const Motor &motor, const ReducedParameters &l);

encoder_form_limits_t encoder_limits(const Design &design);
/// L_0 Ts of the angle, for edges that are rarer than samples.
encoder_form_gains_t sample_gains(const nodo_encoder_gains_t &gains, const Drive &drive);
/// The largest load that can be right: of `limits`, or what the encoder's own error adds to the torque.
float believed_d_omega(const encoder_form_limits_t &limits, const encoder_form_gains_t &gains,
                       const Drive &drive);

/// The estimated disturbance after a step of the full torque, plus six standard deviations of the
/// sensors' noise, and its trip level.
///
/// @param A, B_noise of the whole loop at rated speed; `angle_weight` variance of the angle times the period.
TripMargin disturbance_margin(const Design &design, const encoder_form_limits_t &limits,
                              const Eigen::MatrixXd &A, const Eigen::MatrixXd &B_noise,
                              double angle_weight);

/// Gains of law noc at that current, with one of feedback_gains(). Beyond its range the observer's
/// series is held, as in the firmware.
LoopGains encoder_form_gains(const Design &design, double iq_A, const Eigen::MatrixXd &Lambda);

/// Gains of a position when the drive has learned the motor's inertia, EQ-INERTIA-4.
Eigen::MatrixXd learned_gains(const Design &design, const Motor &motor, Eigen::MatrixXd Lambda);

/// The points of verdict_points() with the currents that the references settle at.
std::vector<OperatingPoint> loaded_points(const Design &design, const IdReference &r);

/// EQ-CERT-7 of a law in a speed form, for whole_loop(). The observer's gain is held at the ends of its range, as in the firmware.
SampledModel speed_form_at(const Design &design, const TrueMotor &motor, const OperatingPoint &at,
                           const Eigen::MatrixXd &Lambda, const MovingReference *moving);

/// The whole loop with all feedback_gains(). `model_at(design, motor, point, Lambda, reference)` has the A, B_voltage and C_voltage
/// of EQ-CERT-6. Other motors are judged with a d-current reference that stands still, and for positions
/// also with the gains for a learned inertia. The family refers to `d` and `model_at`.
template <typename ModelAt>
LoopFamily whole_loop(const Design &d, const current_ref_config_t &references,
                      const ModelAt &model_at)
{
    const IdReference id          = id_reference(d, references);
    const auto        at_voltages = [&d](const auto &m, std::vector<BrokenLoop> &all,
                                  double shaft_mode = 0.0) {
        for (BrokenLoop &loop :
             broken_at_voltages(m.A, m.B_voltage, m.C_voltage, control_period_s(d.drive))) {
            loop.shaft_mode = shaft_mode;
            all.push_back(std::move(loop));
        }
    };
    LoopFamily f;
    f.channels               = {"q axis", "d axis"};
    f.points                 = loaded_points(d, id);
    f.box_points             = verdict_box_points(d);
    const TrueMotor nominal  = true_motor(d.drive, d.drive.motor);
    const int       per_side = d.precision == Precision::extended
                                   ? plane_points_per_side // tables that are written
                               : d.drive.saturation ? quick_points_per_side
                                                    : 0;
    if (per_side > 0) {
        f.plane = plane_points(id, nominal, d.l, static_cast<double>(d.config.speed_max_e_radps),
                               per_side);
    }
    const TrueMotor loaded = true_motor(d.drive, with_load_of_its_own(d.drive.motor));
    f.loops                = [&d, &model_at, id, at_voltages, nominal, loaded](const Motor &,
                                                                const OperatingPoint &at) {
        std::vector<BrokenLoop> all;
        const ReducedParameters l = believed_motor(d, at);
        const SteadyState       s = state_at(nominal, l, at);
        const IdReference       r = believed_reference(id, d.l, l);
        for (const Eigen::MatrixXd &Lambda : feedback_gains(d)) {
            const MovingReference moving = moving_reference(r, l, Lambda, s);
            at_voltages(model_at(d, nominal, at, Lambda, &moving), all);
        }
        for (const Eigen::MatrixXd &Lambda : torque_gains(d)) {
            MovingReference moving = moving_reference(r, l, Lambda, s);
            moving.torque          = true;
            if (is_limited(Lambda)) {
                at_voltages(model_at(d, nominal, at, Lambda, &moving), all);
            } else {
                moving.of_estimate(0) = 0.0; // the torque does not follow the load
                at_voltages(model_at(d, loaded, at, Lambda, &moving), all,
                                           shaft_mode(d.drive.motor, control_period_s(d.drive)));
            }
        }
        return all;
    };
    f.loops_of_others = [&d, &model_at, at_voltages](const Motor &motor, const OperatingPoint &at) {
        std::vector<BrokenLoop> all;
        const TrueMotor         other = true_motor(d.drive, motor);
        for (const Eigen::MatrixXd &Lambda : feedback_gains(d)) {
            at_voltages(model_at(d, other, at, Lambda, nullptr), all);
            if (has_angle(Lambda)) {
                const auto learned = learned_gains(d, motor, Lambda);
                at_voltages(model_at(d, other, at, learned, nullptr), all);
            }
        }
        const TrueMotor       other_loaded = true_motor(d.drive, with_load_of_its_own(motor));
        const double          ts           = control_period_s(d.drive);
        const MovingReference still        = still_reference(ts);
        for (const Eigen::MatrixXd &Lambda : torque_gains(d)) {
            if (is_limited(Lambda)) {
                at_voltages(model_at(d, other, at, Lambda, &still), all);
            } else {
                at_voltages(model_at(d, other_loaded, at, Lambda, &still), all,
                            shaft_mode(motor, ts));
            }
        }
        return all;
    };
    return f;
}

/// The verdict of a law that observes the angle; `angle_weight` as for disturbance_margin().
template <typename ModelAt>
void certify_whole(Design &d, const encoder_form_limits_t &limits, double angle_weight,
                   const current_ref_config_t &references, const ModelAt &model_at)
{
    const auto m =
        model_at(d, true_motor(d.drive, d.drive.motor),
                 OperatingPoint{d.drive.motor.rated_speed_e_radps, 0.0, mtpa_id_A(d.l, 0.0)},
                 d.nosc.gain[0], nullptr);
    certify_loop(d, whole_loop(d, references, model_at),
                 {disturbance_margin(d, limits, m.A, m.B_noise, angle_weight)});
}

/// Limits of the innovation for an observer with these gains, EQ-ANGLE-GATE-3.
angle_gate_config_t angle_gate_constants(const encoder_form_limits_t &limits,
                                         const encoder_form_gains_t &gains, double ts_s);

/// Entries in single precision; zeros where exact arithmetic has zeros.
template <std::size_t Rows, std::size_t Columns>
void copy_matrix(const Eigen::MatrixXd &from, float (&to)[Rows][Columns])
{
    for (std::size_t row = 0; row < Rows; row++) {
        for (std::size_t column = 0; column < Columns; column++) {
            to[row][column] =
                gain_entry(from, static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        }
    }
}

/// The observer's matrices.
template <std::size_t Rows>
void copy_series(const GainSeries &from, float (&to)[NODO_ORDER_MAX + 1][Rows][3])
{
    for (std::size_t n = 0; n < from.gain.size(); n++) {
        copy_matrix(from.gain[n], to[n]);
    }
}

/// Largest residual of both, for the summary.
double worst_residual(const Design &design);

std::string method_line(const std::string &method);
std::string residual_line(double worst);
std::string controller_line(const SampledLoop &controller);
std::string observer_line(const SampledLoop &observer);

/// Layout of the constants "near_optimal". A drive without positions gets no gains of them.
Layout near_optimal_layout(const Design &design, const near_optimal_config_t &c);

/// A term of a series: a comment, the columns' names, rows with labels.
std::string term_block(int n, const char *columns, const std::vector<std::string> &labels,
                       const float (*rows)[3]);
/// ".gain = {..},\n" of an observer with the columns' names.
template <std::size_t Rows>
std::string gain_block(const char *columns, const std::vector<std::string> &labels, int order,
                       const float (&gain)[NODO_ORDER_MAX + 1][Rows][3])
{
    std::string s;
    for (int n = 0; n <= order; n++) {
        s += term_block(n, columns, labels, gain[n]);
    }
    return c_block("gain", s);
}

/// The observer's T, for `law` of drive files.
NoiseKnob observer_knob(const char *law);

/// For LawDesign::mismatches.
std::vector<std::string> nosc_mismatches(const near_optimal_config_t &c);

} // namespace sdre
