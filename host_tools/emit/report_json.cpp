// SPDX-License-Identifier: MIT
#include "emit/report.hpp"

#include <fmt/format.h>

#include "common/json.hpp"
#include "common/version.hpp"
#include "design/certificate.hpp"
#include "drive/pwm_frequency.hpp"
#include "emit/report_machine.hpp"
#include "emit/report_parts.hpp"
#include "emit/report_torque.hpp"

namespace sdre {
namespace {

Json row_to_json(const Eigen::RowVectorXd &row)
{
    return std::vector<double>(row.begin(), row.end());
}

Json to_json(const Eigen::MatrixXd &M)
{
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < M.rows(); i++) {
        rows.push_back(row_to_json(M.row(i)));
    }
    return rows;
}

/// A gain as the tables have it.
Eigen::MatrixXd as_reported(const Eigen::MatrixXd &K)
{
    Eigen::MatrixXd clean = K;
    for (Eigen::Index i = 0; i < K.rows(); i++) {
        for (Eigen::Index j = 0; j < K.cols(); j++) {
            clean(i, j) = report_entry(K, i, j);
        }
    }
    return clean;
}

/// The same of a harmonic node, whose rows are of different sizes.
Json node_gain_to_json(const Eigen::MatrixXd &K)
{
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < K.rows(); i++) {
        rows.push_back(row_to_json(as_reported(K.row(i))));
    }
    return rows;
}

Json to_json(const Eigen::VectorXcd &v)
{
    Json out = Json::array();
    for (Eigen::Index i = 0; i < v.size(); i++) {
        out.push_back({v(i).real(), v(i).imag()});
    }
    return out;
}

Json gain_json(const GainSeries &g, const char *gain_key, const char *solution_key,
               const char *poles_key)
{
    Json gains     = Json::array();
    Json solutions = Json::array();
    for (std::size_t n = 0; n < g.gain.size(); n++) {
        gains.push_back(to_json(as_reported(g.gain[n])));
        solutions.push_back(to_json(g.series.terms[n].X));
    }
    Json out{{"order", series_order(g)},
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

Json nodo_json(const Design &d)
{
    Json out    = gain_json(d.nodo, "gain", "pi", "eigenvalues");
    out["form"] = nodo_form_name(d.drive.nodo.form);
    return out;
}

Json loop_json(const SampledLoop &loop, const char *variable)
{
    return {{"range", {{"variable", variable}, {"min_A", -loop.range_A}, {"max_A", loop.range_A}}},
            {"series_range_A", loop.series_range_A},
            {"worst_pole_1ps", loop.worst_pole_1ps},
            {"fastest_pole_times_period", loop.fastest_pole_ts},
            {"spectral_radius", loop.spectral_radius},
            {"series_error", loop.series_error},
            {"series_error_full_range", loop.series_error_full}};
}

Json loop_json(const LoopCheck &loop)
{
    Json at = Json::object();
    for (const SensitivityAt &x : loop.at) {
        at[x.name] = {{"frequency_Hz", x.frequency_Hz}, {"sensitivity", x.value}};
    }
    return {{"spectral_radius", loop.spectral_radius},
            {"sensitivity_peak", loop.peak},
            {"sensitivity_peak_Hz", loop.peak_Hz},
            {"disturbances", at}};
}

Json dobc_json(const DobcDesign &d)
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

Json harmonics_json(const Design &d)
{
    const nodo_harmonic_gains_t &t     = *d.harmonics->table;
    Json                         pairs = Json::array();
    Json                         nodes = Json::array();
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

Json harmonic_check_json(const HarmonicCheck &check)
{
    return {{"spectral_radius", check.spectral_radius},
            {"worst_speed_e_radps", check.worst_speed_e_radps},
            {"worst_iq_A", check.worst_iq_A},
            {"worst_residual", check.worst_residual},
            {"speed_loop", loop_json(check.speed_loop)}};
}

Json noc_h_json(const Design &d)
{
    const Certificate &c = d.certificate;
    return {{"law", law_name(d.drive.law)},
            {"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
            {"harmonics", harmonics_json(d)},
            {"harmonic_check", harmonic_check_json(d.harmonic_check)},
            {"certificate",
             {{"certified", c.passed()},
              {"failures", c.failures},
              {"verdict", verdict_words(d)},
              {"nosc", loop_json(c.nosc, "e_iq")}}}};
}

Json verdict_json(const Verdict &v)
{
    Json out = {{"spectral_radius", v.spectral_radius}};
    if (v.box) {
        out["box_share"]           = v.box->share;
        out["one_at_a_time_share"] = v.alone->share;
    }
    if (v.shaft) {
        out["shaft_stable_Hz"] = Json::array();
        for (const ResonanceRange &r : v.shaft->stable) {
            out["shaft_stable_Hz"].push_back({r.from_Hz, r.to_Hz});
        }
    }
    for (const Channel &c : v.channels) {
        out["channels"][c.name] = loop_json(c.worst);
    }
    for (const TripMargin &t : v.trips) {
        out["trips"][t.name] = {{"healthy", t.healthy}, {"limit", t.limit}};
    }
    return out;
}

Json heading_json(const Design &d)
{
    Json reduced;
    for (int i = 1; i <= 11; i++) {
        reduced[fmt::format("l{}", i)] = d.l[static_cast<std::size_t>(i)];
    }
    Json out = {{"tool", fmt::format("sdre-gains {}", tool_version)},
                {"drive", d.drive.name},
                {"digest", drive_digest(d.drive)},
                {"control_period_s", control_period_s(d.drive)},
                {"reduced_parameters", reduced}};
    if (!pwm_note(d.drive.inverter).empty()) {
        out["pwm_wanted_Hz"]    = d.drive.inverter.pwm_wanted_Hz;
        out["pwm_frequency_Hz"] = d.drive.inverter.pwm_frequency_Hz;
    }
    return out;
}

Json servo_json(const Design &d)
{
    const ServoDesign &servo = *d.servo;
    Json               out   = {{"law", law_name(d.drive.law)}};
    if (servo.dobc) {
        out["dobc"] = dobc_json(*servo.dobc);
    }
    out["certificate"] = {{"certified", d.certificate.passed()},
                          {"failures", d.certificate.failures},
                          {"verdict", verdict_words(d)}};
    return out;
}

Json cascade_json(const Design &d)
{
    return {{"law", law_name(d.drive.law)},
            {"certificate",
             {{"certified", d.certificate.passed()},
              {"failures", d.certificate.failures},
              {"verdict", verdict_words(d)}}}};
}

Json noc_json(const Design &d)
{
    const Certificate &c = d.certificate;
    return {{"nosc", gain_json(d.nosc, "lambda", "gamma", "closed_loop_eigenvalues")},
            {"nodo", nodo_json(d)},
            {"certificate",
             {{"certified", c.passed()},
              {"failures", c.failures},
              {"verdict", verdict_words(d)},
              {"range",
               {{"e_iq_A", {-c.nosc.range_A, c.nosc.range_A}},
                {"i_q_hat_A", {-c.nodo.range_A, c.nodo.range_A}}}},
              {"worst_pole",
               {{"nosc_1ps", c.nosc.worst_pole_1ps}, {"nodo_1ps", c.nodo.worst_pole_1ps}}},
              {"series_error", {{"nosc", c.nosc.series_error}, {"nodo", c.nodo.series_error}}},
              {"nosc", loop_json(c.nosc, "e_iq")},
              {"nodo", loop_json(c.nodo, "i_q_hat")}}}};
}

Json law_json(const Design &d)
{
    if (d.servo) {
        return servo_json(d);
    }
    if (is_cascade(d.drive.law)) {
        return cascade_json(d);
    }
    return d.harmonics ? noc_h_json(d) : noc_json(d);
}

} // namespace

std::string report_json(const Design &d, const std::optional<Prediction> &prediction)
{
    Json report       = heading_json(d);
    report["machine"] = machine_json(d, prediction);
    report.update(law_json(d));
    if (d.torque) {
        report["torque"] = torque_json(d);
    }
    if (d.certificate.loop) {
        report["whole_loop"] = verdict_json(*d.certificate.loop);
    }
    return report.text();
}

} // namespace sdre
