// SPDX-License-Identifier: MIT
#include "design/laws/noc_inertia.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace sdre {
namespace {

// Chosen: a factor of 1.4 apart. The conditions hold for motors with 0.5 to 3 times each node's inertia.
constexpr std::array below{0.7, 0.6, 0.5};
constexpr std::array above{1.4, 2.0, 2.8, 4.0, 5.0};

template <typename Nodes>
float farthest(const Nodes &nodes, const std::function<bool(double ratio)> &holds)
{
    double last = 1.0;
    for (const double ratio : nodes) {
        if (!holds(ratio)) {
            break;
        }
        last = ratio;
    }
    return static_cast<float>(last);
}

/// The drive's constants with the whole range.
law_noc_config_t without_range(const Design &d)
{
    law_noc_config_t c = *constants_of<law_noc_config_t>(d.config);
    c.inertia          = {INERTIA_LEAST, INERTIA_MOST};
    return c;
}

} // namespace

law_noc_inertia_t outermost(const std::function<bool(double ratio)> &holds)
{
    return {farthest(below, holds), farthest(above, holds)};
}

std::string inertia_line(const law_noc_inertia_t &range)
{
    if (range.least == range.most) {
        return "";
    }
    return fmt::format(" *            inertia:    may be learned within x{:.2g} .. x{:.2g}\n",
                       range.least, range.most);
}

Design with_inertia(const Design &design, double ratio, law_noc_config_t &constants)
{
    const double root = std::sqrt(ratio);
    Design       d    = design;
    d.drive.motor.inertia_kgm2 *= ratio;
    d.l            = reduced_parameters(d.drive.motor);
    d.nosc.problem = nosc_problem(at_rest(d.l), d.drive.nosc);
    d.nodo.problem = nodo_problem(at_rest(d.l), d.drive.nodo);
    for (Eigen::MatrixXd &Lambda : d.nosc.gain) {
        Lambda.col(0) *= root;
    }
    for (Eigen::MatrixXd &L : d.nodo.gain) {
        L.row(0) /= root;
    }
    d.nosc.held_A = design.certificate.nosc.series_range_A;
    d.nodo.held_A = design.certificate.nodo.series_range_A;
    d.position.reset(); // a run to a position keeps the drive's inertia
    d.precision   = Precision::quick;
    d.certificate = {};

    const law_noc_config_t own  = without_range(design);
    drive_config_t         from = design.config;
    from.constants              = &own;
    law_noc_believe(&d.config, &constants, &from, static_cast<float>(ratio));
    return d;
}

} // namespace sdre
