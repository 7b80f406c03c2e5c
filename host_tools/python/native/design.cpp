// SPDX-License-Identifier: MIT
/// Drive files, their reports by sdre-gains, and its Riccati solver.
#include "bindings.hpp"

#include <nanobind/eigen/dense.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "common/toml_reader.hpp"
#include "drive/drive_file.hpp"
#include "emit/report.hpp"
#include "linalg/care.hpp"
#include "tune/auto_tune.hpp"
#include "tune/drive_text.hpp"
#include "tune/prediction.hpp"

namespace nb = nanobind;

namespace sdre {
namespace {

/// Keys of a drive file's [motor] that are numbers; a rotor's pole pairs are one too.
std::map<std::string, double> motor_numbers(const Drive &d)
{
    const Motor &m = d.motor;
    return {{"pole_pairs", m.pole_pairs},
            {"stator_resistance_Ohm", m.stator_resistance_Ohm},
            {"d_axis_inductance_H", m.d_axis_inductance_H},
            {"q_axis_inductance_H", m.q_axis_inductance_H},
            {"pm_flux_Wb", m.pm_flux_Wb},
            {"inertia_kgm2", m.inertia_kgm2},
            {"viscous_friction_Nms", m.viscous_friction_Nms},
            {"rated_speed_e_radps", m.rated_speed_e_radps},
            {"rated_torque_Nm", m.rated_torque_Nm},
            {"max_current_A", m.max_current_A}};
}

/// As `sdre-gains report --json`, or as `generate` solves it.
std::string report(const Drive &drive, bool extended)
{
    const nb::gil_scoped_release free;
    const Design design = design_drive(drive, extended ? Precision::extended : Precision::quick);
    return report_json(design, predicted(design.drive));
}

/// As `sdre-gains care`.
nb::tuple care(const Eigen::MatrixXd &A, const std::optional<Eigen::MatrixXd> &B,
               const std::optional<Eigen::MatrixXd> &R, const std::optional<Eigen::MatrixXd> &G,
               const Eigen::MatrixXd &Q)
{
    CareSolution x;
    {
        const nb::gil_scoped_release free;
        const CareOptions            options{Precision::quick, true};
        x = B ? solve_care(A, *B, *R, Q, options) : solve_care(A, *G, Q, options);
    }
    return nb::make_tuple(x.X, x.semidefinite, x.relative_residual, x.closed_loop_eigenvalues);
}

/// As `sdre-gains tune` without a specification: the drive file's text with the weights found, and the hardest goal.
nb::tuple tune(const std::string &text, const std::string &source)
{
    std::string found, binding;
    {
        const nb::gil_scoped_release free;
        const Drive                  drive = read_drive_text(text, source);
        require_rewritable(source, text, drive);
        const AutoTuneResult r = auto_tune(drive, [](int, double) {});
        found                  = with_sections(text, tuned_sections(r.tuned, r.goals));
        binding                = r.binding;
    }
    return nb::make_tuple(found, binding);
}

} // namespace

void bind_design(nb::module_ &m)
{
    nb::class_<Drive>(m, "Drive")
        .def_ro("name", &Drive::name)
        .def_prop_ro("law", [](const Drive &d) { return law_name(d.law); })
        .def_prop_ro("digest", &drive_digest)
        .def_prop_ro("control_period_s", &control_period_s)
        .def_prop_ro("trip_speed_e_radps", &trip_speed_e_radps)
        .def_prop_ro("dc_link_V", [](const Drive &d) { return d.inverter.dc_link_V; })
        .def_prop_ro("motor", &motor_numbers);
    m.def("read_drive", [](const std::string &text, const std::string &source) {
        return read_drive_text(text, source);
    });
    m.def("report", &report);
    m.def("tune", &tune);
    m.def("care", &care, nb::arg("A"), nb::arg("B").none(), nb::arg("R").none(),
          nb::arg("G").none(), nb::arg("Q"));
}

} // namespace sdre
