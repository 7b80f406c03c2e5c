// SPDX-License-Identifier: MIT
#include "bindings.hpp"

#include <filesystem>

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "cases.hpp"
#include "common/errors.hpp"
#include "common/toml_reader.hpp"

namespace nb = nanobind;

namespace sdre {
namespace {

using Values = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Seeds  = nb::ndarray<const std::uint64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// Key paths, and whether the value is a whole number.
using Variables = std::vector<std::pair<std::vector<KeyPath>, bool>>;

CaseRunner runner(const std::string &text, const std::string &source, const std::string &name,
                  const Drive &drive, const std::string &own_law_file, const Variables &variables,
                  const std::vector<std::string> &metrics)
{
    const Law own = own_law_file.empty() ? drive.law : read_drive_file(own_law_file).law;
    std::vector<CaseVariable> list;
    for (const auto &[keys, whole] : variables) {
        for (const KeyPath &path : keys) {
            if (path.empty()) {
                throw InputError("a variable's key is empty");
            }
        }
        list.push_back({keys, whole});
    }
    return {{parse_toml_text(text, source), source, name, drive, own}, list, metrics};
}

/// A row of `values` and a seed for every case.
nb::tuple run_cases(CaseRunner &cases, const Values &values, const Seeds &seeds)
{
    const std::size_t         n = values.shape(0), width = values.shape(1);
    std::vector<std::int32_t> fault(n);
    std::vector<std::uint8_t> failed(n);
    std::vector<double>       current(n), speed(n), metrics;
    {
        const nb::gil_scoped_release free;
        for (std::size_t i = 0; i < n; i++) {
            const CaseResult r = cases.run(values.data() + i * width, seeds.data()[i]);
            fault[i]           = r.fault;
            failed[i]          = r.failed ? 1 : 0;
            current[i]         = r.current_margin;
            speed[i]           = r.speed_margin;
            metrics.insert(metrics.end(), r.metrics.begin(), r.metrics.end());
        }
    }
    const std::size_t columns = n == 0 ? 0 : metrics.size() / n;
    return nb::make_tuple(numpy_array(std::move(fault), {n}), numpy_array(std::move(failed), {n}),
                          numpy_array(std::move(current), {n}), numpy_array(std::move(speed), {n}),
                          numpy_array(std::move(metrics), {n, columns}));
}

/// The factors of `sdre-sil motors`, motors first + 1 .. first + count: R, Ld, Lq, flux, J.
nb::object draw_motors(const Scenario &s, std::uint64_t seed, int first, int count)
{
    if (!s.motor_ranges) {
        throw InputError("scenario " + s.name + ": [motor_ranges] is missing");
    }
    std::vector<double> factors;
    for (int motor = first + 1; motor <= first + count; motor++) {
        const MotorScale scale = draw_motor(*s.motor_ranges, seed, motor);
        for (const char *key : {"stator_resistance_Ohm", "d_axis_inductance_H",
                                "q_axis_inductance_H", "pm_flux_Wb", "inertia_kgm2"}) {
            factors.push_back(scale.at(key));
        }
    }
    return nb::cast(numpy_array(std::move(factors), {static_cast<std::size_t>(count), 5}));
}

} // namespace

void bind_cases(nb::module_ &m)
{
    nb::class_<CaseRunner>(m, "Cases")
        .def_prop_ro("measures", &CaseRunner::measures)
        .def("check", [](CaseRunner                &cases,
                         const std::vector<double> &values) { cases.check(values.data()); })
        .def("run", &run_cases);
    m.def("cases", &runner);
    m.def("draw_motors", &draw_motors);
    m.def("fault_name", &fault_name);
}

} // namespace sdre
