// SPDX-License-Identifier: MIT
#include "emit/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/version.hpp"
#include "emit/report_parts.hpp"

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

/// A gain as the tables have it.
ordered_json gain_to_json(const Eigen::MatrixXd &K)
{
    Eigen::MatrixXd clean = K;
    for (Eigen::Index i = 0; i < K.rows(); i++) {
        for (Eigen::Index j = 0; j < K.cols(); j++) {
            clean(i, j) = report_entry(K, i, j);
        }
    }
    return to_json(clean);
}

/// The same of a harmonic node, whose rows are of different sizes.
ordered_json node_gain_to_json(const Eigen::MatrixXd &K)
{
    ordered_json rows = ordered_json::array();
    for (Eigen::Index i = 0; i < K.rows(); i++) {
        rows.push_back(gain_to_json(K.row(i)).at(0));
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
        gains.push_back(gain_to_json(g.gain[n]));
        solutions.push_back(to_json(g.series.terms[n].X));
    }
    ordered_json out{{"order", series_order(g)},
                     {gain_key, gains},
                     {solution_key, solutions},
                     {poles_key, to_json(g.series.care.closed_loop_eigenvalues)},
                     {"residuals", g.residuals}};
    if (g.problem.dA.size() > 1) {
        for (const SeriesTerm &term : g.series.terms) {
            out["powers"].push_back(term.powers);
        }
    }
    return out;
}

ordered_json nodo_json(const Design &d)
{
    ordered_json out = gain_json(d.nodo, "gain", "pi", "eigenvalues");
    out["form"]      = nodo_form_name(d.drive.nodo.form);
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

ordered_json loop_json(const LoopCheck &loop)
{
    ordered_json at = ordered_json::object();
    for (const SensitivityAt &x : loop.at) {
        at[x.name] = {{"frequency_Hz", x.frequency_Hz}, {"sensitivity", x.value}};
    }
    return {{"spectral_radius", loop.spectral_radius},
            {"sensitivity_peak", loop.peak},
            {"sensitivity_peak_Hz", loop.peak_Hz},
            {"disturbances", at}};
}

ordered_json dobc_json(const DobcDesign &d)
{
    return {{"oscillators_radps", d.oscillators_radps},
            {"wanted_polynomial", d.wanted},
            {"matching_error", d.matching_error},
            {"l", std::vector<double>(d.l.begin(), d.l.end())},
            {"k1_Vs_per_rad", d.k1},
            {"k2_V_per_A", d.k2},
            {"K", std::vector<double>(d.K.begin(), d.K.end())},
            {"M", to_json(d.M)},
            {"g", std::vector<double>(d.g.begin(), d.g.end())},
            {"h", std::vector<double>(d.h.begin(), d.h.end())}};
}

ordered_json harmonics_json(const Design &d)
{
    const nodo_harmonic_gains_t &t     = *d.harmonics->table;
    ordered_json                 pairs = ordered_json::array();
    ordered_json                 nodes = ordered_json::array();
    for (int i = 0; i < t.n_pairs; i++) {
        pairs.push_back({{"channel", report_channel_name(t.pair[i].channel)},
                         {"order", static_cast<double>(t.pair[i].order)}});
    }
    for (const HarmonicNode &node : d.harmonics->nodes) {
        nodes.push_back({{"omega_e_radps", node.omega_e_radps},
                         {"K0", node_gain_to_json(node.K0)},
                         {"K1", node_gain_to_json(node.K1)},
                         {"residual", node.residual}});
    }
    return {{"iq_max_A", static_cast<double>(t.iq_max_A)},
            {"keep", static_cast<double>(t.keep)},
            {"keep_fast", static_cast<double>(t.keep_fast)},
            {"pairs", pairs},
            {"nodes", nodes}};
}

ordered_json harmonic_check_json(const HarmonicCheck &check)
{
    return {{"spectral_radius", check.spectral_radius},
            {"worst_speed_e_radps", check.worst_speed_e_radps},
            {"worst_iq_A", check.worst_iq_A},
            {"worst_residual", check.worst_residual},
            {"speed_loop", loop_json(check.speed_loop)}};
}

ordered_json noc_h_json(const Design &d)
{
    const Certificate &c = d.certificate;
    return {{"law", law_name(d.drive.law)},
            {"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
            {"harmonics", harmonics_json(d)},
            {"harmonic_check", harmonic_check_json(d.harmonic_check)},
            {"certificate",
             {{"certified", c.passed()},
              {"failures", c.failures},
              {"nosc", loop_json(c.nosc, "e_iq")}}}};
}

ordered_json heading_json(const Design &d)
{
    ordered_json reduced;
    for (int i = 1; i <= 11; i++) {
        reduced[fmt::format("l{}", i)] = d.l[static_cast<std::size_t>(i)];
    }
    return {{"tool", fmt::format("sdre-gains {}", tool_version)},
            {"drive", d.drive.name},
            {"digest", drive_digest(d.drive)},
            {"control_period_s", control_period_s(d.drive)},
            {"reduced_parameters", reduced}};
}

ordered_json servo_json(const Design &d)
{
    const ServoDesign &servo = *d.servo;
    ordered_json       out   = {{"law", law_name(d.drive.law)}};
    if (servo.dobc) {
        out["dobc"] = dobc_json(*servo.dobc);
    }
    out["speed_loop"]  = loop_json(servo.speed);
    out["d_axis_loop"] = loop_json(servo.d_axis);
    out["certificate"] = {{"certified", d.certificate.passed()},
                          {"failures", d.certificate.failures}};
    return out;
}

} // namespace

std::string report_json(const Design &d)
{
    ordered_json report = heading_json(d);
    if (d.servo) {
        report.update(servo_json(d));
        return report.dump(2) + "\n";
    }
    if (d.harmonics) {
        report.update(noc_h_json(d));
        return report.dump(2) + "\n";
    }
    const Certificate &c = d.certificate;
    report.update(ordered_json{
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
          {"nodo", loop_json(c.nodo, "i_q_hat")}}}});
    return report.dump(2) + "\n";
}

} // namespace sdre
