// SPDX-License-Identifier: MIT
#include "design/design.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "design/certificate.hpp"
#include "design/firmware_config.hpp"
#include "design/noc_h/harmonic_loop.hpp"
#include "design/sampled_model.hpp"

namespace sdre {
namespace {

// Chosen: four points between two nodes of the table where they are closest, and every half of the current limit.
constexpr int harmonic_speed_points   = 64;
constexpr int harmonic_current_points = 4;

GainSeries solve_nosc(const ReducedParameters &l, const Drive &drive)
{
    const NoscSpec       &spec = drive.nosc;
    const Eigen::Vector2d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1]);
    const SdreProblem     problem = drive.law == Law::conventional_noc
                                        ? conventional_nosc_problem(l, spec)
                                        : nosc_problem(l, spec);
    return solve_gain_series(problem, T_inverse.asDiagonal() * nosc_input_matrix(l).transpose(),
                             Eigen::MatrixXd::Identity(3, 3), spec.order);
}

GainSeries solve_nodo(const ReducedParameters &l, const NodoSpec &spec)
{
    const Eigen::Vector3d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1], 1.0 / spec.T[2]);
    const Eigen::MatrixXd C = nodo_model(l, spec.form).C;
    return solve_gain_series(nodo_problem(l, spec), Eigen::MatrixXd::Identity(C.cols(), C.cols()),
                             C.transpose() * T_inverse.asDiagonal(), spec.order);
}

void judge(const char *name, const LoopCheck &loop, std::vector<std::string> &failures)
{
    if (!(loop.spectral_radius < 1.0)) {
        failures.push_back(fmt::format("{}: the sampled loop is unstable: spectral radius {:.5f}",
                                       name, loop.spectral_radius));
    }
    if (!(loop.peak <= peak_sensitivity_limit)) {
        failures.push_back(fmt::format("{}: sensitivity peak {:.3g} at {:.0f} Hz exceeds {:g}",
                                       name, loop.peak, loop.peak_Hz, peak_sensitivity_limit));
    }
}

Design design_servo(const Drive &drive)
{
    Design design;
    design.drive = drive;
    design.l     = reduced_parameters(drive.motor);
    design.servo.emplace();
    ServoDesign              &servo    = *design.servo;
    std::vector<std::string> &failures = design.certificate.failures;
    if (drive.law != Law::pid) {
        servo.dobc = design_dobc(drive.motor, drive.dobc, control_period_s(drive));
        if (!(servo.dobc->matching_error <= matching_error_limit)) {
            failures.push_back(fmt::format("observer: coefficient matching is off by {:.1e}",
                                           servo.dobc->matching_error));
        }
    }
    design.config = firmware_config(design);
    servo.speed =
        check_loop(speed_loop(drive.motor, design.config), disturbance_frequencies(drive));
    servo.d_axis =
        check_loop(d_axis_loop(drive.motor, design.config), disturbance_frequencies(drive));
    judge("speed loop", servo.speed, failures);
    judge("d axis", servo.d_axis, failures);
    add_firmware_failures(design.config, design.certificate);
    return design;
}

/// Stability wherever the firmware can be, with the table's interpolated gains; negative speeds are mirror images.
void certify_harmonics(Design &d)
{
    const nodo_harmonic_gains_t &table = *d.harmonics->table;
    HarmonicCheck               &check = d.harmonic_check;
    const double                 ts    = control_period_s(d.drive);
    const double                 trip  = d.harmonics->nodes.back().omega_e_radps;
    const double                 range = 2.0 * d.drive.motor.max_current_A;
    for (int k = 0; k <= harmonic_speed_points; k++) {
        for (int j = -harmonic_current_points; j <= harmonic_current_points; j++) {
            const double         iq = range * j / harmonic_current_points;
            const OperatingPoint at{trip * k / harmonic_speed_points, iq, mtpa_id_A(d.l, iq)};
            const double         radius =
                spectral_radius(sampled_harmonic_model(d.l, table, d.nosc.gain[0], at, ts).A);
            if (radius > check.spectral_radius) {
                check.spectral_radius     = radius;
                check.worst_speed_e_radps = at.omega_e_radps;
                check.worst_iq_A          = iq;
            }
        }
    }
    for (const HarmonicNode &node : d.harmonics->nodes) {
        check.worst_residual = std::max(check.worst_residual, node.residual);
    }
    const OperatingPoint  at{d.drive.harmonics.weight_speed_e_radps, 0.0, 0.0};
    const HarmonicSampled loop = sampled_harmonic_model(d.l, table, d.nosc.gain[0], at, ts);
    check.speed_loop =
        check_loop({loop.A, loop.b_voltage, loop.c_voltage, ts}, disturbance_frequencies(d.drive));

    std::vector<std::string> &failures = d.certificate.failures;
    if (!(check.spectral_radius < 1.0)) {
        failures.push_back(fmt::format("noc_h: the sampled loop is unstable at {:.0f} rad/s, iq "
                                       "{:.2f} A: spectral radius {:.5f}",
                                       check.worst_speed_e_radps, check.worst_iq_A,
                                       check.spectral_radius));
    }
    if (!(check.worst_residual <= residual_limit)) {
        failures.push_back(fmt::format("noc_h: relative residual {:.1e} exceeds {:.0e}",
                                       check.worst_residual, residual_limit));
    }
}

void add_harmonics(Design &d)
{
    const double trip = static_cast<double>(trip_speed_ratio) * d.drive.motor.rated_speed_e_radps;
    d.harmonics       = design_harmonics(d.l, d.drive, trip, d.drive.motor.max_current_A);
    certify_harmonics(d);
}

} // namespace

Design design_drive(const Drive &drive)
{
    if (!is_near_optimal(drive.law)) {
        return design_servo(drive);
    }
    if (drive.law == Law::conventional_noc &&
        std::max(drive.nosc.order, drive.nodo.order) > DOUBLE_SERIES_ORDER_MAX) {
        throw InputError(fmt::format("{}: order = {} is not allowed: a series in two variables has "
                                     "at most order {}",
                                     drive.name, std::max(drive.nosc.order, drive.nodo.order),
                                     DOUBLE_SERIES_ORDER_MAX));
    }
    Design design;
    design.drive = drive;
    design.l     = reduced_parameters(drive.motor);
    design.nosc  = solve_nosc(design.l, drive);
    if (drive.law != Law::noc_h) {
        design.nodo = solve_nodo(design.l, drive.nodo);
    }
    design.certificate = certify(design);
    if (drive.law == Law::noc_h) {
        add_harmonics(design);
    }
    design.config = firmware_config(design);
    add_firmware_failures(design.config, design.certificate);
    return design;
}

} // namespace sdre
