// SPDX-License-Identifier: MIT
#include "design.hpp"

#include <cmath>

#include <fmt/format.h>

#include "certificate.hpp"
#include "firmware_config.hpp"

namespace sdre {
namespace {

GainSeries solve_nosc(const ReducedParameters &l, const NoscSpec &spec)
{
    GainSeries out;
    out.problem = nosc_problem(l, spec);
    out.series  = solve_sdre_series(out.problem, spec.order);

    const Eigen::Vector2d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1]);
    const Eigen::MatrixXd to_gain = T_inverse.asDiagonal() * nosc_input_matrix(l).transpose();
    for (const SeriesTerm &term : out.series.terms) {
        out.gain.emplace_back(to_gain * term.X); // (26)
        out.residuals.push_back(term.relative_residual);
    }
    return out;
}

GainSeries solve_nodo(const ReducedParameters &l, const NodoSpec &spec)
{
    GainSeries out;
    out.problem = nodo_problem(l, spec);
    out.series  = solve_sdre_series(out.problem, spec.order);

    const Eigen::Vector3d T_inverse(1.0 / spec.T[0], 1.0 / spec.T[1], 1.0 / spec.T[2]);
    for (const SeriesTerm &term : out.series.terms) {
        out.gain.emplace_back(term.X * nodo_model(l, spec.form).C.transpose() *
                              T_inverse.asDiagonal()); // (32), (39)
        out.residuals.push_back(term.relative_residual);
    }
    return out;
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

} // namespace

Design design_drive(const Drive &drive)
{
    if (drive.law != Law::noc) {
        return design_servo(drive);
    }
    Design design;
    design.drive       = drive;
    design.l           = reduced_parameters(drive.motor);
    design.nosc        = solve_nosc(design.l, drive.nosc);
    design.nodo        = solve_nodo(design.l, drive.nodo);
    design.certificate = certify(design);
    design.config      = firmware_config(design);
    add_firmware_failures(design.config, design.certificate);
    return design;
}

} // namespace sdre
