// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "version.hpp"

namespace sdre {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const Eigen::MatrixXd &M)
{
    ordered_json rows = ordered_json::array();
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        ordered_json row = ordered_json::array();
        for (Eigen::Index j = 0; j < M.cols(); j++) {
            row.push_back(M(i, j));
        }
        rows.push_back(row);
    }
    return rows;
}

ordered_json to_json(const Eigen::VectorXcd &v)
{
    ordered_json out = ordered_json::array();
    for (Eigen::Index i = 0; i < v.size(); i++) {
        out.push_back({v(i).real(), v(i).imag()});
    }
    return out;
}

ordered_json gain_json(const GainSeries &g, const char *gain_key, const char *solution_key,
                       const char *poles_key)
{
    ordered_json gains     = ordered_json::array();
    ordered_json solutions = ordered_json::array();
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        gains.push_back(to_json(g.gain[n]));
        solutions.push_back(to_json(g.series.terms[n].X));
    }
    return {{"order", static_cast<int>(g.gain.size()) - 1},
            {gain_key, gains},
            {solution_key, solutions},
            {poles_key, to_json(g.series.care.closed_loop_eigenvalues)},
            {"residuals", g.residuals}};
}

ordered_json nodo_json(const Design &d)
{
    ordered_json out = gain_json(d.nodo, "gain", "pi", "eigenvalues");
    out["form"]      = d.drive.nodo.form == NodoForm::encoder ? "encoder" : "speed";
    return out;
}

ordered_json loop_json(const SampledLoop &loop, const char *variable)
{
    return {{"range", {{"variable", variable}, {"min_A", -loop.range_A}, {"max_A", loop.range_A}}},
            {"series_range_A", loop.series_range_A},
            {"worst_pole_1ps", loop.worst_pole_1ps},
            {"fastest_pole_times_period", loop.fastest_pole_ts},
            {"spectral_radius", loop.spectral_radius},
            {"series_error", loop.series_error},
            {"series_error_full_range", loop.series_error_full}};
}

std::string loop_text(const char *name, const char *variable, const SampledLoop &loop)
{
    std::string s =
        fmt::format("  {}, {} in +-{:g} A (series used in +-{:.2f} A, gain held beyond)\n", name,
                    variable, loop.range_A, loop.series_range_A);
    s += fmt::format(
        "    slowest pole {:.3g} 1/s, fastest |pole| x Ts {:.2f}, sampled spectral radius {:.4f}\n",
        loop.worst_pole_1ps, loop.fastest_pole_ts, loop.spectral_radius);
    for (std::size_t n = 0; n < loop.series_error.size(); n++) {
        s += fmt::format("    order {}: gain error {:8.2e} in +-{:.2f} A, {:8.2e} in +-{:g} A\n", n,
                         loop.series_error[n], loop.series_range_A, loop.series_error_full[n],
                         loop.range_A);
    }
    return s;
}

std::string gain_text(const char *symbol, const GainSeries &g)
{
    std::string s;
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        s += fmt::format("  {}_{} (relative residual {:.1e})\n", symbol, n, g.residuals[n]);
        for (Eigen::Index i = 0; i < g.gain[n].rows(); i++) {
            s += fmt::format("    {:14.6g} {:14.6g} {:14.6g}\n", g.gain[n](i, 0), g.gain[n](i, 1),
                             g.gain[n](i, 2));
        }
    }
    return s;
}

std::string poles_text(const Eigen::VectorXcd &poles)
{
    std::string s;
    for (Eigen::Index i = 0; i < poles.size(); i++) {
        s += fmt::format("  {:.4g}", poles(i).real());
        if (poles(i).imag() != 0.0) {
            s += fmt::format("{:+.4g}i", poles(i).imag());
        }
    }
    return s;
}

} // namespace

std::string report_json(const Design &d)
{
    ordered_json reduced;
    for (int i = 1; i <= 11; i++) {
        reduced[fmt::format("l{}", i)] = d.l[static_cast<std::size_t>(i)];
    }
    const Certificate &c = d.certificate;
    const ordered_json report{
        {"tool", fmt::format("sdre-gains {}", tool_version)},
        {"drive", d.drive.name},
        {"digest", drive_digest(d.drive)},
        {"control_period_s", control_period_s(d.drive)},
        {"reduced_parameters", reduced},
        {"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
        {"nodo", nodo_json(d)},
        {"certificate",
         {{"certified", c.passed()},
          {"failures", c.failures},
          {"range",
           {{"e_iq_A", {-c.nosc.range_A, c.nosc.range_A}},
            {"i_q_hat_A", {-c.nodo.range_A, c.nodo.range_A}}}},
          {"worst_pole",
           {{"nosc_1ps", c.nosc.worst_pole_1ps}, {"nodo_1ps", c.nodo.worst_pole_1ps}}},
          {"series_error", {{"nosc", c.nosc.series_error}, {"nodo", c.nodo.series_error}}},
          {"nosc", loop_json(c.nosc, "e_iq")},
          {"nodo", loop_json(c.nodo, "i_q_hat")}}}};
    return report.dump(2) + "\n";
}

std::string report_text(const Design &d)
{
    std::string s =
        fmt::format("{} ({}), control period {:g} us\n\nreduced parameters\n", d.drive.name,
                    drive_digest(d.drive), 1e6 * control_period_s(d.drive));
    for (std::size_t i = 1; i <= 11; i++) {
        s += fmt::format("  l{:<3} {:.9g}\n", i, d.l[i]);
    }
    s += "\ncontroller (rows v_q, v_d; columns e_w, e_iq, e_id)\n" + gain_text("Lambda", d.nosc);
    s += "  poles" + poles_text(d.nosc.series.care.closed_loop_eigenvalues) + " 1/s\n";
    s +=
        (d.drive.nodo.form == NodoForm::encoder
             ? "\nobserver (rows d_w, d_q, d_d, w, iq, id, theta; columns measured iq, id, theta)\n"
             : "\nobserver (rows d_w, d_q, d_d, w, iq, id; columns measured w, iq, id)\n") +
        gain_text("L", d.nodo);
    s += "  poles" + poles_text(d.nodo.series.care.closed_loop_eigenvalues) + " 1/s\n";
    s += "\ncertificate\n" + loop_text("controller", "e_iq", d.certificate.nosc) +
         loop_text("observer", "iq_hat", d.certificate.nodo);
    s += d.certificate.passed() ? "\nverdict: certified\n" : "\nverdict: refused\n";
    for (const std::string &failure : d.certificate.failures) {
        s += "  " + failure + "\n";
    }
    return s;
}

} // namespace sdre
