// SPDX-License-Identifier: MIT
#include "design.hpp"

#include <cmath>

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

} // namespace

Design design_drive(const Drive &drive)
{
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
